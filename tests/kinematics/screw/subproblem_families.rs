//! The families of subproblems: random instances with a known answer, and what the answers to them are worth.

use groebot::kinematics::screw::values::Reach;
use groebot::kinematics::screw::{circles, one_joint, three_joints, two_joints};
use groebot::spatial::{Axis, Pose, Screw};
use nalgebra::{Point3, Unit, UnitQuaternion, Vector3};

use super::instance::{Question, Random, Verdict, carried, judge, list};
use super::turned;

/// A name and what makes an instance. T is a joint that turns, S one that slides.
pub type Family = (&'static str, fn(&mut Random) -> Verdict);

const EXACT: Reach = Reach::EXACT;

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

/// Two equations in two angles.
pub const FOUR_CIRCLES: &[Family] = &[("SP6", sp6), ("SP6 singular", sp6_singular)];

/// Judges the values of one joint.
fn one(turns: bool, size: f64, q: f64, answers: Vec<Vec<Option<f64>>>, miss: impl Fn(f64) -> Vec<f64>) -> Verdict {
    let misses = |q: &[f64]| miss(q[0]);
    Question { units: &[if turns { 1.0 } else { size }], turns: &[turns], misses: &misses }.judge(&[q], &answers)
}

fn parts(v: Vector3<f64>) -> Vec<f64> {
    v.iter().copied().collect()
}

/// The larger distance of two points from the axis' point.
fn size(axis: &Axis, p: &Point3<f64>, k: &Point3<f64>) -> f64 {
    (p - axis.point()).norm().max((k - axis.point()).norm())
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

/// The angle that brings `p` to the side of `k`.
fn towards(axis: &Axis, p: &Point3<f64>, k: &Point3<f64>) -> f64 {
    let (w, u, v) = (axis.direction(), p - axis.point(), k - axis.point());
    w.dot(&u.cross(&v)).atan2(u.dot(&v) - w.dot(&u) * w.dot(&v))
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

/// A value for each joint.
fn values<const N: usize>(r: &mut Random, screws: &[Screw; N]) -> [f64; N] {
    screws.map(|screw| if screw.axis().is_some() { r.angle() } else { r.within(-1.0, 1.0) })
}

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

/// Two axes along one direction, or against each other.
fn parallel(r: &mut Random) -> [Axis; 2] {
    let w = r.direction();
    let other = if r.integer(0, 1) == 0 { w } else { -w };
    [w, other].map(|w| Axis::central(w).shifted(&r.vector()))
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

/// Axes that pass each other at 10^-1 ... 10^-16.
fn pg6_at_a_small_distance(r: &mut Random) -> Verdict {
    let first = r.axis();
    let shift = first.point().coords + r.vector() * 10f64.powi(-r.integer(1, 16));
    let screws = [first, Axis::central(r.direction()).shifted(&shift)].map(Screw::Revolute);
    let (q, p) = (values(r, &screws), r.point());
    two_by(screws, p, q)
}

/// The joints, and the point, as they were before they moved to where they are at `q`, the point being at `k`.
fn moved_back<const N: usize>(there: [Screw; N], q: &[f64; N], k: &Point3<f64>) -> ([Screw; N], Point3<f64>) {
    let mut before = Pose::identity();
    let screws = std::array::from_fn(|i| {
        let screw = there[i].moved(&before.inverse());
        before *= screw.exp(q[i]);
        screw
    });
    (screws, before.inverse() * k)
}

/// An axis about which `k` moves in the plane normal to `n`.
fn axis_moving_across(r: &mut Random, k: &Point3<f64>, n: &Vector3<f64>) -> Axis {
    let w = r.direction();
    let arm = n.normalize() * r.within(0.1, 1.0) + w.scale(r.within(-1.0, 1.0));
    Axis::central(w).shifted(&(k.coords - arm))
}

/// How fast `k` moves with the joint.
fn velocity(screw: &Screw, k: &Point3<f64>) -> Vector3<f64> {
    match screw {
        Screw::Revolute(axis) => axis.direction().cross(&(k - axis.point())),
        Screw::Prismatic(direction) => direction.into_inner(),
    }
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

/// The axes `place` and `place + 1` meet.
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
    let far = super::instance::size(&[a, b].map(Screw::Revolute), &c.point(), &(goal * c.point()));
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

/// Judges the answers of four circles.
pub fn sp6_by(h: [Vector3<f64>; 4], k: [Unit<Vector3<f64>>; 4], p: [Vector3<f64>; 4], q: [f64; 2]) -> Verdict {
    let term = |i: usize, q: f64| h[i].dot(&turned(&Axis::central(k[i]), q, &Point3::from(p[i])).coords);
    let sums = |q: &[f64]| [term(0, q[0]) + term(1, q[1]), term(2, q[0]) + term(3, q[1])];
    let [d1, d2] = sums(&q);
    let found = circles::four_circles(h, k, p, d1, d2, EXACT);
    let answers: Vec<_> = found.iter().map(|answer| answer.to_vec()).collect();
    let size = (0..4).map(|i| h[i].norm() * p[i].norm()).sum::<f64>();
    let misses = |q: &[f64]| {
        let [a, b] = sums(q);
        vec![(a - d1) / size, (b - d2) / size]
    };
    Question { units: &[1.0; 2], turns: &[true; 2], misses: &misses }.judge(&q, &answers)
}

fn sp6(r: &mut Random) -> Verdict {
    let (h, k, p) = ([(); 4].map(|()| r.vector()), [(); 4].map(|()| r.direction()), [(); 4].map(|()| r.vector()));
    sp6_by(h, k, p, [r.angle(), r.angle()])
}

/// The last vector is such that the two equations are dependent at the answer.
fn sp6_singular(r: &mut Random) -> Verdict {
    let (mut h, k, p) = ([(); 4].map(|()| r.vector()), [(); 4].map(|()| r.direction()), [(); 4].map(|()| r.vector()));
    let q = [r.angle(), r.angle()];
    let tangent = |i: usize| k[i].cross(&turned(&Axis::central(k[i]), q[i % 2], &Point3::from(p[i])).coords);
    let slope = |i: usize, h: &Vector3<f64>| h.dot(&tangent(i));
    let wanted = slope(1, &h[1]) * slope(2, &h[2]) / slope(0, &h[0]);
    h[3] += tangent(3) * ((wanted - slope(3, &h[3])) / tangent(3).norm_squared());
    sp6_by(h, k, p, q)
}
