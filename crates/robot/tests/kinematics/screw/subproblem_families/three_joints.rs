//! Instances of the subproblems of three joints.

use groebot_robot::kinematics::screw::{circles, three_joints};
use groebot_robot::spatial::{Axis, Pose, Screw};
use nalgebra::{Point3, UnitQuaternion, Vector3};

use super::super::instance::{self, Question, Random, Verdict, carried, judge};
use super::super::turned;
use super::{EXACT, Family, axis_moving_across, moved_back, parallel, parts, values, velocity};

/// Three joints.
pub const THREE_JOINTS: &[Family] = &[
    ("TTT", |r| three(r, [true, true, true])),
    ("TTS", |r| three(r, [true, true, false])),
    ("TST", |r| three(r, [true, false, true])),
    ("TSS", |r| three(r, [true, false, false])),
    ("STT", |r| three(r, [false, true, true])),
    ("STS", |r| three(r, [false, true, false])),
    ("SST", |r| three(r, [false, false, true])),
    ("SSS", |r| three(r, [false, false, false])),
    ("TTT two parallel behind (PG7)", |r| aligned(r, 1)),
    ("TTT two parallel before", |r| aligned(r, 0)),
    ("TTT two meeting before", |r| meeting(r, 0)),
    ("TTT two meeting behind", |r| meeting(r, 1)),
    ("TTT point near the third axis", near_the_third_axis),
    ("TTT target near the first axis", |r| near_first(r, [true; 3])),
    ("TST target near the first axis", |r| near_first(r, [true, false, true])),
    ("TTS target near the first axis", |r| near_first(r, [true, true, false])),
    ("TTT singular", |r| singular(r, [true, true, true])),
    ("TTS singular", |r| singular(r, [true, true, false])),
    ("TST singular", |r| singular(r, [true, false, true])),
    ("STT singular", |r| singular(r, [false, true, true])),
    ("PG8", pg8),
    ("SP5", sp5),
];

fn three_by(screws: [Screw; 3], p: Point3<f64>, q: [f64; 3]) -> Verdict {
    let k = carried(&screws, &q, &p);
    judge(
        &screws,
        &p,
        &k,
        &q,
        &three_joints::three_screws_to_point([&screws[0], &screws[1], &screws[2]], &p, &k, EXACT),
    )
}

fn three(r: &mut Random, turns: [bool; 3]) -> Verdict {
    let screws = turns.map(|turns| r.screw(turns));
    let (q, p) = (values(r, &screws), r.point());
    three_by(screws, p, q)
}

/// The axes `place` and `place + 1` are parallel.
fn aligned(r: &mut Random, place: usize) -> Verdict {
    let [a, b] = parallel(r);
    let axes = if place == 0 { [a, b, r.axis()] } else { [r.axis(), a, b] };
    let (q, p) = ([r.angle(), r.angle(), r.angle()], r.point());
    three_by(axes.map(Screw::Revolute), p, q)
}

/// The axes `place` and `place + 1` intersect.
fn meeting(r: &mut Random, place: usize) -> Verdict {
    let a = r.axis();
    let b = Axis::central(r.direction()).shifted(&a.point().coords);
    let axes = if place == 0 { [a, b, r.axis()] } else { [r.axis(), a, b] };
    let (q, p) = ([r.angle(), r.angle(), r.angle()], r.point());
    three_by(axes.map(Screw::Revolute), p, q)
}

/// The joints move the point in one plane.
fn singular(r: &mut Random, turns: [bool; 3]) -> Verdict {
    let (k, [a, b, c]) = (r.point(), turns.map(|turns| r.screw(turns)));
    let third = match (&b, &c) {
        (_, Screw::Revolute(_)) => {
            let n = velocity(&a, &k).cross(&velocity(&b, &k));
            [a, b, Screw::Revolute(axis_moving_across(r, &k, &n))]
        }
        _ => {
            let n = velocity(&a, &k).cross(&velocity(&c, &k));
            [a, Screw::Revolute(axis_moving_across(r, &k, &n)), c]
        }
    };
    let q = values(r, &third);
    let (screws, p) = moved_back(third, &q, &k);
    three_by(screws, p, q)
}

/// A length of 10^-1 ... 10^-6.
fn small(r: &mut Random) -> f64 {
    10f64.powi(-r.integer(1, 6))
}

fn near_the_third_axis(r: &mut Random) -> Verdict {
    let (screws, q) = ([(); 3].map(|()| r.screw(true)), [r.angle(), r.angle(), r.angle()]);
    let axis = screws[2].axis().copied().unwrap_or_else(|| r.axis());
    let p = axis.point() + axis.direction().scale(r.within(-1.0, 1.0)) + r.vector() * small(r);
    three_by(screws, p, q)
}

fn near_first(r: &mut Random, turns: [bool; 3]) -> Verdict {
    let screws = turns.map(|turns| r.screw(turns));
    let q = values(r, &screws);
    let axis = screws[0].axis().copied().unwrap_or_else(|| r.axis());
    let k = axis.point() + axis.direction().scale(r.within(-1.0, 1.0)) + r.vector() * small(r);
    let (screws, p) = moved_back(screws, &q, &k);
    three_by(screws, p, q)
}

fn pg8(r: &mut Random) -> Verdict {
    let [a, b] = parallel(r);
    let c = b.shifted(&r.vector());
    let (axes, q) = ([a, b, c], [r.angle(), r.angle(), r.angle()]);
    let pose = |q: &[f64]| {
        let turn = |i: usize| {
            let turn = UnitQuaternion::from_scaled_axis(axes[i].direction().scale(q[i]));
            Pose::rotation_wrt_point(turn, axes[i].point())
        };
        turn(0) * turn(1) * turn(2)
    };
    let goal = pose(&q);
    let answers: Vec<_> =
        three_joints::rotate_three_parallel_to_pose([&a, &b, &c], &goal, EXACT).iter().map(|q| q.to_vec()).collect();
    let far = instance::size(&[a, b].map(Screw::Revolute), &c.point(), &(goal * c.point()));
    let misses = |q: &[f64]| {
        let reached = pose(q);
        let point = (reached * c.point() - goal * c.point()) / far;
        let turn = (goal.rotation.inverse() * reached.rotation).scaled_axis();
        point.iter().chain(turn.iter()).copied().collect()
    };
    Question { units: &[1.0; 3], turns: &[true; 3], misses: &misses }.judge(&q, &answers)
}

fn sp5(r: &mut Random) -> Verdict {
    let (k, p, q) = ([r.direction(), r.direction(), r.direction()], [r.vector(), r.vector(), r.vector()], [0; 3]);
    let q = q.map(|_| r.angle());
    let turn = |i: usize, q: f64, v: Vector3<f64>| turned(&Axis::central(k[i]), q, &Point3::from(v)).coords;
    let (p1, p2, p3) = (p[0], p[1], p[2]);
    let p0 = turn(1, q[1], p2 + turn(2, q[2], p3)) - turn(0, q[0], p1);
    let found = circles::three_circles([&k[0], &k[1], &k[2]], [&p0, &p1, &p2, &p3], EXACT);
    let answers: Vec<_> = found.iter().map(|answer| answer.to_vec()).collect();
    let size = p0.norm() + p1.norm() + p2.norm() + p3.norm();
    let misses = |q: &[f64]| parts((p0 + turn(0, q[0], p1) - turn(1, q[1], p2 + turn(2, q[2], p3))) / size);
    Question { units: &[1.0; 3], turns: &[true; 3], misses: &misses }.judge(&q, &answers)
}
