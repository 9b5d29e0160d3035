//! Six joints in three pairs with parallel axes, 1 and 2, 3 and 4, 5 and 6: up to sixteen solutions.
//!
//! A pair rotates by the sum of its two angles. The three sums follow from the orientation like the angles of a
//! spherical wrist. Then each pair moves a point on a circle, and the vectors of the three circles have a known sum.

use nalgebra::{Matrix3, Point3, Unit, Vector3};
use smallvec::SmallVec;

use super::reduced::Row;
use super::trigonometric::zeros;
use super::two_joints::two_screws_to_point;
use super::values::Reach;
use crate::spatial::line::PARALLEL;
use crate::spatial::{Axis, Pose, Screw, angle, rotation};

/// The joint values of one solution.
pub(super) type Six = [f64; 6];

/// Maximum number of Newton steps.
const STEPS: usize = 8;

/// Whether the row consists of six revolute joints in three parallel pairs.
pub(super) fn fits(row: &Row) -> bool {
    let pair = |i: usize| match (row[i].screw.axis(), row[i + 1].screw.axis()) {
        (Some(a), Some(b)) => a.is_parallel(b),
        _ => false,
    };
    row.len() == 6 && pair(0) && pair(2) && pair(4)
}

/// All joint values with `e^(S1 q1) ... e^(S6 q6) = pose`.
pub(super) fn solve(row: &Row, pose: &Pose, reach: Reach) -> Vec<Six> {
    let Some(axes) = row.iter().map(|member| member.screw.axis().copied()).collect::<Option<Vec<Axis>>>() else {
        return Vec::new();
    };
    let mut found = Vec::new();
    for sums in sums(&axes, pose, reach) {
        let circles = Circles::new(&axes, pose, &sums);
        for firsts in circles.solve() {
            let mut q = [0.0; 6];
            for pair in 0..3 {
                let (first, second) = (&axes[2 * pair], &axes[2 * pair + 1]);
                let sign = first.direction().dot(&second.direction()).signum();
                q[2 * pair] = angle::wrap(firsts[pair]);
                q[2 * pair + 1] = angle::wrap(sign * (sums[pair] - firsts[pair]));
            }
            found.push(q);
        }
    }
    found
}

/// The rotation angle of each pair about its first axis, as the three angles of a spherical wrist.
fn sums(axes: &[Axis], pose: &Pose, reach: Reach) -> SmallVec<[[f64; 3]; 2]> {
    let central = |i: usize| Screw::Revolute(axes[i].through_origin());
    let last = axes[4].direction();
    let (p, k) = (Point3::from(last.into_inner()), Point3::from(pose.rotation * last.into_inner()));
    let pairs = two_screws_to_point(&central(0), &central(2), &p, &k, reach);
    let complete = |pair: &[Option<f64>; 2]| {
        let (a, b) = (pair[0].unwrap_or(0.0), pair[1].unwrap_or(0.0));
        let rest = (central(0).exp(a) * central(2).exp(b)).inverse().rotation * pose.rotation;
        [a, b, 2.0 * last.dot(&rest.imag()).atan2(rest.scalar())]
    };
    pairs.iter().map(complete).collect()
}

/// Three vectors, each normal to its axis through the origin and rotating about it, and the required sum.
struct Circles {
    axes: [Unit<Vector3<f64>>; 3],
    arms: [Vector3<f64>; 3],
    sum: Vector3<f64>,
}

impl Circles {
    /// From `e1 e2 p = r1 + R(q1) (r2 - r1) + R(q1 + q2) (p - r2)` for each pair, applied to the point of the sixth axis.
    fn new(axes: &[Axis], pose: &Pose, sums: &[f64; 3]) -> Self {
        let r = |i: usize| axes[i].point().coords;
        let first = rotation::rodrigues(&axes[0].direction(), sums[0]);
        let second = first * rotation::rodrigues(&axes[2].direction(), sums[1]);
        let sum = (pose * axes[5].point()).coords - r(0) - first * (r(2) - r(1)) - second * (r(4) - r(3));
        let turned = [axes[0].direction(), first * axes[2].direction(), second * axes[4].direction()];
        let arms = [r(1) - r(0), first * (r(3) - r(2)), second * (r(5) - r(4))];
        let mut circles = Circles { axes: turned, arms, sum };
        for i in 0..3 {
            let along = turned[i].scale(turned[i].dot(&arms[i]));
            circles.arms[i] -= along;
            circles.sum -= along;
        }
        circles
    }

    fn arm(&self, i: usize, angle: f64) -> Vector3<f64> {
        self.arms[i] + rotation::displacement(&self.axes[i], angle, &self.arms[i])
    }

    /// The angles of the three vectors, each solution refined by Newton's method.
    fn solve(&self) -> Vec<[f64; 3]> {
        let Some(common) = Unit::try_new(self.axes[0].cross(&self.axes[1]), PARALLEL) else { return Vec::new() };
        let frame = [self.axes[0].cross(&common), self.axes[1].cross(&common)];
        let (n1, n2) = (self.axes[0], self.axes[1]);
        // For the third angle: the required components of the first two vectors across their common normal, and their
        // sum along it.
        let parts = |angle: f64| {
            let left = self.sum - self.arm(2, angle);
            (n2.dot(&left) / n2.dot(&frame[0]), n1.dot(&left) / n1.dot(&frame[1]), common.dot(&left))
        };
        let lengths = [self.arms[0].norm_squared(), self.arms[1].norm_squared()];
        let condition = |angle: f64| {
            let (s1, s2, along) = parts(angle);
            let (a, b) = (lengths[0] - s1 * s1, lengths[1] - s2 * s2);
            (along * along - a - b).powi(2) - 4.0 * a * b
        };
        let mut found: Vec<[f64; 3]> = Vec::new();
        for third in zeros(4, condition) {
            let (s1, s2, along) = parts(third);
            let (a, b) = (lengths[0] - s1 * s1, lengths[1] - s2 * s2);
            let root = a.max(0.0).sqrt();
            for c1 in [(along * along + a - b) / (2.0 * along), root, -root] {
                let start = [self.bearing(0, &common, c1, s1), self.bearing(1, &common, along - c1, s2), third];
                let Some(answer) = self.refine(start) else { continue };
                let same = |other: &[f64; 3]| (0..3).all(|i| angle::difference(answer[i], other[i]).abs() <= 1e-9);
                if !found.iter().any(same) {
                    found.push(answer);
                }
            }
        }
        found
    }

    /// The angle at which vector `i` has these components along the common normal and across it.
    fn bearing(&self, i: usize, common: &Vector3<f64>, along: f64, across: f64) -> f64 {
        let goal = common * along + self.axes[i].cross(common) * across;
        self.axes[i].dot(&self.arms[i].cross(&goal)).atan2(self.arms[i].dot(&goal))
    }

    /// The solution near `angles`; `None` when there is none.
    fn refine(&self, mut angles: [f64; 3]) -> Option<[f64; 3]> {
        let size = self.arms.iter().map(Vector3::norm).sum::<f64>() + self.sum.norm();
        let miss = |angles: &[f64; 3]| self.sum - (0..3).map(|i| self.arm(i, angles[i])).sum::<Vector3<f64>>();
        let mut left = miss(&angles);
        for _ in 0..STEPS {
            let columns: [Vector3<f64>; 3] = [0, 1, 2].map(|i| self.axes[i].cross(&self.arm(i, angles[i])));
            let Some(step) = Matrix3::from_columns(&columns).lu().solve(&left) else { break };
            let next = [angles[0] + step.x, angles[1] + step.y, angles[2] + step.z];
            let better = miss(&next);
            if better.norm() >= left.norm() {
                break;
            }
            (angles, left) = (next, better);
        }
        (left.norm() <= 1e-9 * size).then(|| angles.map(angle::wrap))
    }
}
