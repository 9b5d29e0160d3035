//! The families of subproblems: random instances with a known solution, and the quality of the computed solutions.

mod one_joint;
mod three_joints;
mod two_joints;

use groebot_robot::kinematics::screw::circles;
use groebot_robot::kinematics::screw::values::Reach;
use groebot_robot::spatial::{Axis, Pose, Screw};
use nalgebra::{Point3, Unit, Vector3};

pub use one_joint::ONE_JOINT;
pub use three_joints::THREE_JOINTS;
pub use two_joints::TWO_JOINTS;

use super::instance::{Question, Random, Verdict};
use super::turned;

/// A name and a generator of instances. T is a revolute joint, S a prismatic one.
pub type Family = (&'static str, fn(&mut Random) -> Verdict);

const EXACT: Reach = Reach::EXACT;

/// Two equations in two angles.
pub const FOUR_CIRCLES: &[Family] = &[("SP6", sp6), ("SP6 singular", sp6_singular)];

fn parts(v: Vector3<f64>) -> Vec<f64> {
    v.iter().copied().collect()
}

/// The angle that rotates `p` to the side of `k`.
fn towards(axis: &Axis, p: &Point3<f64>, k: &Point3<f64>) -> f64 {
    let (w, u, v) = (axis.direction(), p - axis.point(), k - axis.point());
    w.dot(&u.cross(&v)).atan2(u.dot(&v) - w.dot(&u) * w.dot(&v))
}

/// A value for each joint.
fn values<const N: usize>(r: &mut Random, screws: &[Screw; N]) -> [f64; N] {
    screws.map(|screw| if screw.axis().is_some() { r.angle() } else { r.within(-1.0, 1.0) })
}

/// The joints and the point at zero, given their positions at `q` with the point at `k`.
fn moved_back<const N: usize>(there: [Screw; N], q: &[f64; N], k: &Point3<f64>) -> ([Screw; N], Point3<f64>) {
    let mut before = Pose::identity();
    let screws = std::array::from_fn(|i| {
        let screw = there[i].moved(&before.inverse());
        before *= screw.exp(q[i]);
        screw
    });
    (screws, before.inverse() * k)
}

/// Two parallel or antiparallel axes.
fn parallel(r: &mut Random) -> [Axis; 2] {
    let w = r.direction();
    let other = if r.integer(0, 1) == 0 { w } else { -w };
    [w, other].map(|w| Axis::central(w).shifted(&r.vector()))
}

/// An axis about which `k` moves in the plane normal to `n`.
fn axis_moving_across(r: &mut Random, k: &Point3<f64>, n: &Vector3<f64>) -> Axis {
    let w = r.direction();
    let arm = n.normalize() * r.within(0.1, 1.0) + w.scale(r.within(-1.0, 1.0));
    Axis::central(w).shifted(&(k.coords - arm))
}

/// The velocity of `k` for a unit velocity of the joint.
fn velocity(screw: &Screw, k: &Point3<f64>) -> Vector3<f64> {
    match screw {
        Screw::Revolute(axis) => axis.direction().cross(&(k - axis.point())),
        Screw::Prismatic(direction) => direction.into_inner(),
    }
}

/// Evaluates the solutions of four circles.
pub fn sp6_by(h: [Vector3<f64>; 4], k: [Unit<Vector3<f64>>; 4], p: [Vector3<f64>; 4], q: [f64; 2]) -> Verdict {
    let term = |i: usize, q: f64| h[i].dot(&turned(&Axis::central(k[i]), q, &Point3::from(p[i])).coords);
    let sums = |q: &[f64]| [term(0, q[0]) + term(1, q[1]), term(2, q[0]) + term(3, q[1])];
    let [d1, d2] = sums(&q);
    let found = circles::four_circles(h, k, p, [d1, d2], EXACT);
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

/// The last vector is chosen so that the two equations are dependent at the solution.
fn sp6_singular(r: &mut Random) -> Verdict {
    let (mut h, k, p) = ([(); 4].map(|()| r.vector()), [(); 4].map(|()| r.direction()), [(); 4].map(|()| r.vector()));
    let q = [r.angle(), r.angle()];
    let tangent = |i: usize| k[i].cross(&turned(&Axis::central(k[i]), q[i % 2], &Point3::from(p[i])).coords);
    let slope = |i: usize, h: &Vector3<f64>| h.dot(&tangent(i));
    let wanted = slope(1, &h[1]) * slope(2, &h[2]) / slope(0, &h[0]);
    h[3] += tangent(3) * ((wanted - slope(3, &h[3])) / tangent(3).norm_squared());
    sp6_by(h, k, p, q)
}
