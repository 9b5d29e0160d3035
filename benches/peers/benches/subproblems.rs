//! Nanoseconds per subproblem on random reachable inputs: groebot compared with ik-geo, whose axes pass through the
//! origin.
//!
//!     cd benches/peers && cargo bench --bench subproblems

use std::hint::black_box;
use std::io::Result;

use groebot::kinematics::screw::one_joint::{rotate_to_distance, rotate_to_plane, rotate_to_point};
use groebot::kinematics::screw::two_joints::rotate_about_meeting_axes;
use groebot::kinematics::screw::values::Reach;
use groebot::spatial::Axis;
use groebot_peers::by_ik_geo::vector;
use groebot_peers::inputs::{COUNT, Random};
use groebot_peers::rounds::{Contender, measure};
use ik_geo::subproblems::{subproblem1, subproblem2, subproblem3, subproblem4};
use nalgebra::{Point3, Unit, Vector3};

type Theirs = ik_geo::nalgebra::Vector3<f64>;

fn main() -> Result<()> {
    rotation_to_a_point()?;
    rotations_about_two_axes()?;
    rotation_to_a_distance()?;
    rotation_to_a_plane()
}

fn rotation_to_a_point() -> Result<()> {
    let inputs = inputs(|random| {
        let (axis, p, turn) = (random.axis(), random.point(), random.angle());
        (axis, p, axis.rotate(turn, &p))
    });
    let theirs: Vec<[Theirs; 3]> =
        inputs.iter().map(|(axis, p, k)| [&axis.direction(), &p.coords, &k.coords].map(vector)).collect();
    let ours = pass("groebot", &inputs, |(axis, p, k): &(Axis, Point3<f64>, Point3<f64>)| {
        rotate_to_point(axis, p, k, Reach::EXACT)
    });
    let theirs = pass("ik-geo", &theirs, |[w, p, k]: &[Theirs; 3]| subproblem1(p, k, w));
    report("subproblem 1, rotation to a point", ours, theirs)
}

fn rotation_to_a_distance() -> Result<()> {
    let inputs = inputs(|random| {
        let (axis, p, k, turn) = (random.axis(), random.point(), random.point(), random.angle());
        (axis, p, k, (axis.rotate(turn, &p) - k).norm())
    });
    let theirs: Vec<([Theirs; 3], f64)> = inputs
        .iter()
        .map(|(axis, p, k, distance)| ([&axis.direction(), &p.coords, &k.coords].map(vector), *distance))
        .collect();
    let ours = pass("groebot", &inputs, |(axis, p, k, d): &(Axis, Point3<f64>, Point3<f64>, f64)| {
        rotate_to_distance(axis, p, k, *d, Reach::EXACT)
    });
    let theirs = pass("ik-geo", &theirs, |([w, p, k], d): &([Theirs; 3], f64)| subproblem3(p, k, w, *d));
    report("subproblem 3, rotation to a distance", ours, theirs)
}

type TwoAxes = (Axis, Axis, Point3<f64>, Point3<f64>);

fn rotations_about_two_axes() -> Result<()> {
    let inputs: Vec<TwoAxes> = inputs(|random| {
        let (first, second, p) = (random.axis(), random.axis(), random.point());
        (first, second, p, first.rotate(random.angle(), &second.rotate(random.angle(), &p)))
    });
    let theirs: Vec<[Theirs; 4]> = inputs
        .iter()
        .map(|(first, second, p, k)| [&-*first.direction(), &second.direction(), &p.coords, &k.coords].map(vector))
        .collect();
    let ours = pass("groebot", &inputs, |(first, second, p, k): &TwoAxes| {
        rotate_about_meeting_axes(first, second, p, k, Reach::EXACT)
    });
    let theirs = pass("ik-geo", &theirs, |[w1, w2, p, k]: &[Theirs; 4]| subproblem2(p, k, w2, w1));
    report("subproblem 2, rotations about two axes", ours, theirs)
}

type Plane = (Axis, Point3<f64>, Unit<Vector3<f64>>, Point3<f64>);

fn rotation_to_a_plane() -> Result<()> {
    let inputs: Vec<Plane> = inputs(|random| {
        let (axis, p, normal) = (random.axis(), random.point(), Unit::new_normalize(random.vector()));
        (axis, p, normal, axis.rotate(random.angle(), &p))
    });
    let theirs: Vec<([Theirs; 3], f64)> = inputs
        .iter()
        .map(|(axis, p, n, k)| ([&*axis.direction(), &p.coords, &**n].map(vector), n.dot(&k.coords)))
        .collect();
    let ours = pass("groebot", &inputs, |(axis, p, n, k): &Plane| rotate_to_plane(axis, p, n, k, Reach::EXACT));
    let theirs = pass("ik-geo", &theirs, |([w, p, n], d): &([Theirs; 3], f64)| subproblem4(n, p, w, *d));
    report("subproblem 4, rotation to a plane", ours, theirs)
}

fn inputs<T>(mut make: impl FnMut(&mut Random) -> T) -> Vec<T> {
    let mut random = Random(3);
    (0..COUNT).map(|_| make(&mut random)).collect()
}

fn pass<'a, T, R>(name: &'a str, inputs: &'a [T], solve: impl Fn(&T) -> R + 'a) -> Contender<'a> {
    Contender::new(name, move || {
        for input in inputs {
            black_box(solve(black_box(input)));
        }
    })
}

fn report(name: &str, ours: Contender<'_>, theirs: Contender<'_>) -> Result<()> {
    print!("{}", measure(&format!("subproblems/{name}"), COUNT, vec![ours, theirs])?);
    Ok(())
}
