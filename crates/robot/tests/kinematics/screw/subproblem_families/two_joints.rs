//! Instances of the subproblems of two joints.

use groebot_robot::kinematics::screw::{circles, two_joints};
use groebot_robot::spatial::{Axis, Screw};
use nalgebra::{Point3, Unit, Vector3};

use super::super::instance::{Question, Random, Verdict, carried, judge};
use super::super::turned;
use super::{EXACT, Family, moved_back, parallel, parts, towards, values, velocity};

/// Two joints.
pub const TWO_JOINTS: &[Family] = &[
    ("TT (PG6)", |r| two(r, [true, true])),
    ("TS", |r| two(r, [true, false])),
    ("ST", |r| two(r, [false, true])),
    ("SS (PG2)", |r| two(r, [false, false])),
    ("PK2", pk2),
    ("PG4", pg4),
    ("PG4 stretched", pg4_stretched),
    ("PG6 at a small angle", pg6_at_a_small_angle),
    ("PG6 at a small distance", pg6_at_a_small_distance),
    ("TT singular", singular_pair),
    ("SP2", sp2),
];

fn two_by(screws: [Screw; 2], p: Point3<f64>, q: [f64; 2]) -> Verdict {
    let k = carried(&screws, &q, &p);
    judge(&screws, &p, &k, &q, &two_joints::two_screws_to_point(&screws[0], &screws[1], &p, &k, EXACT))
}

fn two(r: &mut Random, turns: [bool; 2]) -> Verdict {
    let screws = turns.map(|turns| r.screw(turns));
    let (q, p) = (values(r, &screws), r.point());
    two_by(screws, p, q)
}

fn pk2(r: &mut Random) -> Verdict {
    let centre = r.vector();
    let screws = [0, 1].map(|_| Screw::Revolute(Axis::central(r.direction()).shifted(&centre)));
    let (q, p) = (values(r, &screws), r.point());
    two_by(screws, p, q)
}

fn pg4_by(axes: &[Axis; 2], p: &Point3<f64>, q: [f64; 2]) -> Verdict {
    let screws = axes.map(Screw::Revolute);
    let k = carried(&screws, &q, p);
    judge(&screws, p, &k, &q, &two_joints::rotate_about_parallel_axes(&axes[0], &axes[1], p, &k, EXACT))
}

fn pg4(r: &mut Random) -> Verdict {
    let (axes, p) = (parallel(r), r.point());
    pg4_by(&axes, &p, [r.angle(), r.angle()])
}

fn pg4_stretched(r: &mut Random) -> Verdict {
    let (axes, p, half) = (parallel(r), r.point(), f64::from(r.integer(0, 1)));
    let q2 = towards(&axes[1], &p, &axes[0].point()) + std::f64::consts::PI * half;
    pg4_by(&axes, &p, [r.angle(), q2])
}

/// Axes at an angle of 10^-1 ... 10^-8.
fn pg6_at_a_small_angle(r: &mut Random) -> Verdict {
    let first = r.axis();
    let tilt = r.across(&first.direction()).scale(10f64.powi(-r.integer(1, 8)));
    let w = Unit::new_normalize(first.direction().into_inner() + tilt);
    let screws = [first, Axis::central(w).shifted(&r.vector())].map(Screw::Revolute);
    let (q, p) = (values(r, &screws), r.point());
    two_by(screws, p, q)
}

/// Axes at a distance of 10^-1 ... 10^-16.
fn pg6_at_a_small_distance(r: &mut Random) -> Verdict {
    let first = r.axis();
    let shift = first.point().coords + r.vector() * 10f64.powi(-r.integer(1, 16));
    let screws = [first, Axis::central(r.direction()).shifted(&shift)].map(Screw::Revolute);
    let (q, p) = (values(r, &screws), r.point());
    two_by(screws, p, q)
}

/// Both joints move the point along one line.
fn singular_pair(r: &mut Random) -> Verdict {
    let (k, first) = (r.point(), r.screw(true));
    let along = velocity(&first, &k).normalize();
    let w = r.across(&along);
    let arm = along.cross(&w) * r.within(0.1, 1.0) + w.scale(r.within(-1.0, 1.0));
    let second = Screw::Revolute(Axis::central(w).shifted(&(k.coords - arm)));
    let q = [r.angle(), r.angle()];
    let (screws, p) = moved_back([first, second], &q, &k);
    two_by(screws, p, q)
}

fn sp2(r: &mut Random) -> Verdict {
    let ([k1, k2], p1, q) = ([r.direction(), r.direction()], r.point(), [r.angle(), r.angle()]);
    let turn = |k: &Unit<Vector3<f64>>, q: f64, p: &Point3<f64>| turned(&Axis::central(*k), q, p);
    let p2 = turn(&k2, -q[1], &turn(&k1, q[0], &p1));
    let found = circles::two_circles([&k1, &k2], &p1.coords, &p2.coords, EXACT);
    let answers: Vec<_> = found.iter().map(|answer| answer.to_vec()).collect();
    let size = p1.coords.norm();
    let misses = |q: &[f64]| parts((turn(&k1, q[0], &p1) - turn(&k2, q[1], &p2)) / size);
    Question { units: &[1.0; 2], turns: &[true; 2], misses: &misses }.judge(&q, &answers)
}
