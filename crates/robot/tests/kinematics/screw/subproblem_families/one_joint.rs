//! Instances of the subproblems of one joint.

use groebot_robot::kinematics::screw::{circles, one_joint};
use groebot_robot::spatial::Axis;
use nalgebra::{Point3, Unit, Vector3};

use super::super::instance::{Question, Random, Verdict, list};
use super::super::{size, turned};
use super::{EXACT, Family, parts, towards};

/// One joint.
pub const ONE_JOINT: &[Family] = &[
    ("PK1", pk1),
    ("PK3", pk3),
    ("PK3 at an end", pk3_at_an_end),
    ("PG1", pg1),
    ("PG3 (Pardos-One)", pg3),
    ("PG3 at an end", pg3_at_an_end),
    ("PG5 point", pg5),
    ("PG5 point at an end", pg5_at_an_end),
    ("PG5 line", pg5_line),
    ("translation to a point", slide_to_point),
    ("SP1", sp1),
    ("SP3", sp3),
    ("SP4", sp4),
];

/// Evaluates the values of one joint.
fn one(turns: bool, size: f64, q: f64, answers: Vec<Vec<Option<f64>>>, miss: impl Fn(f64) -> Vec<f64>) -> Verdict {
    let misses = |q: &[f64]| miss(q[0]);
    Question { units: &[if turns { 1.0 } else { size }], turns: &[turns], misses: &misses }.judge(&[q], &answers)
}

fn pk1(r: &mut Random) -> Verdict {
    let (axis, p, q) = (r.axis(), r.point(), r.angle());
    let k = turned(&axis, q, &p);
    let answers = list(one_joint::rotate_to_point(&axis, &p, &k, EXACT));
    one(true, size(&axis, &p, &k), q, answers, |q| parts((turned(&axis, q, &p) - k) / size(&axis, &p, &k)))
}

fn distance_by_turn(axis: &Axis, p: &Point3<f64>, k: &Point3<f64>, q: f64) -> Verdict {
    let delta = (turned(axis, q, p) - k).norm();
    let answers = list(one_joint::rotate_to_distance(axis, p, k, delta, EXACT));
    one(true, size(axis, p, k), q, answers, |q| vec![((turned(axis, q, p) - k).norm() - delta) / size(axis, p, k)])
}

fn pk3(r: &mut Random) -> Verdict {
    let (axis, p, k, q) = (r.axis(), r.point(), r.point(), r.angle());
    distance_by_turn(&axis, &p, &k, q)
}

fn pk3_at_an_end(r: &mut Random) -> Verdict {
    let (axis, p, k, half) = (r.axis(), r.point(), r.point(), r.integer(0, 1));
    let q = towards(&axis, &p, &k) + std::f64::consts::PI * f64::from(half);
    distance_by_turn(&axis, &p, &k, q)
}

fn pg1(r: &mut Random) -> Verdict {
    let (v, p, n, q) = (r.direction(), r.point(), r.direction(), r.within(-1.0, 1.0));
    let plane = p + v.scale(q) + r.across(&n).scale(r.within(0.0, 1.0));
    let size = (plane - p).norm();
    let answers = list(one_joint::translate_to_plane(&v, &p, &n, &plane, EXACT));
    one(false, size, q, answers, |q| vec![n.dot(&(p + v.scale(q) - plane)) / size])
}

fn distance_by_slide(v: &Unit<Vector3<f64>>, p: &Point3<f64>, k: &Point3<f64>, q: f64) -> Verdict {
    let delta = (p + v.scale(q) - k).norm();
    let size = (k - p).norm().max(delta);
    let answers = list(one_joint::translate_to_distance(v, p, k, delta, EXACT));
    one(false, size, q, answers, |q| vec![((p + v.scale(q) - k).norm() - delta) / size])
}

fn pg3(r: &mut Random) -> Verdict {
    let (v, p, k, q) = (r.direction(), r.point(), r.point(), r.within(-2.0, 2.0));
    distance_by_slide(&v, &p, &k, q)
}

fn pg3_at_an_end(r: &mut Random) -> Verdict {
    let (v, p, k) = (r.direction(), r.point(), r.point());
    distance_by_slide(&v, &p, &k, v.dot(&(k - p)))
}

fn plane_by_turn(r: &mut Random, axis: &Axis, p: &Point3<f64>, n: &Unit<Vector3<f64>>, q: f64) -> Verdict {
    let plane = turned(axis, q, p) + r.across(n).scale(r.within(0.0, 1.0));
    let size = size(axis, p, &plane);
    let answers = list(one_joint::rotate_to_plane(axis, p, n, &plane, EXACT));
    one(true, size, q, answers, |q| vec![n.dot(&(turned(axis, q, p) - plane)) / size])
}

fn pg5(r: &mut Random) -> Verdict {
    let (axis, p, n, q) = (r.axis(), r.point(), r.direction(), r.angle());
    plane_by_turn(r, &axis, &p, &n, q)
}

fn pg5_at_an_end(r: &mut Random) -> Verdict {
    let (axis, p, n, half) = (r.axis(), r.point(), r.direction(), r.integer(0, 1));
    let q = towards(&axis, &p, &(axis.point() + n.into_inner())) + std::f64::consts::PI * f64::from(half);
    plane_by_turn(r, &axis, &p, &n, q)
}

fn pg5_line(r: &mut Random) -> Verdict {
    let (axis, n, q) = (r.axis(), r.direction(), r.angle());
    let (plane, d) = (r.point(), r.across(&n));
    let x = plane + r.across(&n).scale(r.within(0.0, 1.0));
    let line = Axis::central(d).shifted(&x.coords).moved(&axis.rotation(-q));
    let size = size(&axis, &line.point(), &plane);
    let answers = list(one_joint::rotate_line_to_plane(&axis, &line, &n, &plane, EXACT));
    one(true, size, q, answers, |q| {
        let ahead = line.point() + line.direction().into_inner();
        let [x, y] = [line.point(), ahead].map(|x| turned(&axis, q, &x));
        vec![n.dot(&(x - plane)) / size, n.dot(&(y - x))]
    })
}

fn slide_to_point(r: &mut Random) -> Verdict {
    let (v, p, q) = (r.direction(), r.point(), r.within(-2.0, 2.0));
    let k = p + v.scale(q);
    let answers = list(one_joint::translate_to_point(&v, &p, &k, EXACT));
    one(false, q.abs(), q, answers, |x| parts((p + v.scale(x) - k) / q))
}

fn sp1(r: &mut Random) -> Verdict {
    let (k, p, q) = (r.direction(), r.point(), r.angle());
    let goal = turned(&Axis::central(k), q, &p).coords;
    let answers = list(circles::circle_point(&k, &p.coords, &goal, EXACT));
    one(true, p.coords.norm(), q, answers, |q| {
        parts((turned(&Axis::central(k), q, &p).coords - goal) / p.coords.norm())
    })
}

fn sp3(r: &mut Random) -> Verdict {
    let (k, p, goal, q) = (Axis::central(r.direction()), r.point(), r.point(), r.angle());
    let size = size(&k, &p, &goal);
    let d = (turned(&k, q, &p) - goal).norm();
    let answers = list(circles::circle_sphere(&k.direction(), &p.coords, &goal.coords, d, EXACT));
    one(true, size, q, answers, |q| vec![((turned(&k, q, &p) - goal).norm() - d) / size])
}

fn sp4(r: &mut Random) -> Verdict {
    let (h, k, p, q) = (r.direction(), Axis::central(r.direction()), r.point(), r.angle());
    let d = h.dot(&turned(&k, q, &p).coords);
    let answers = list(circles::circle_plane(&h, &k.direction(), &p.coords, d, EXACT));
    one(true, p.coords.norm(), q, answers, |q| vec![(h.dot(&turned(&k, q, &p).coords) - d) / p.coords.norm()])
}
