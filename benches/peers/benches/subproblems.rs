//! Nanoseconds per subproblem on random reachable inputs: ours beside ik-geo's, whose axes pass through the origin.
//!
//!     cd benches/peers && cargo bench --bench subproblems

use std::hint::black_box;
use std::io::Result;

use groebot::kinematics::screw::paden_kahan::{rotate_to_distance, rotate_to_point};
use groebot::spatial::Axis;
use groebot_peers::by_ik_geo::vector;
use groebot_peers::inputs::{COUNT, Random};
use groebot_peers::rounds::{Contender, measure};
use ik_geo::subproblems::{subproblem1, subproblem3};
use nalgebra::Point3;

type Theirs = ik_geo::nalgebra::Vector3<f64>;

fn main() -> Result<()> {
    rotation_to_a_point()?;
    rotation_to_a_distance()
}

fn rotation_to_a_point() -> Result<()> {
    let inputs = inputs(|random| {
        let (axis, p, turn) = (random.axis(), random.point(), random.angle());
        (axis, p, axis.rotate(turn, &p))
    });
    let theirs: Vec<[Theirs; 3]> =
        inputs.iter().map(|(axis, p, k)| [&axis.direction(), &p.coords, &k.coords].map(vector)).collect();
    let ours = pass("groebot", &inputs, |(axis, p, k): &(Axis, Point3<f64>, Point3<f64>)| rotate_to_point(axis, p, k));
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
        rotate_to_distance(axis, p, k, *d)
    });
    let theirs = pass("ik-geo", &theirs, |([w, p, k], d): &([Theirs; 3], f64)| subproblem3(p, k, w, *d));
    report("subproblem 3, rotation to a distance", ours, theirs)
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
