//! The solution of a leg that is the nearest to given joint values, by Newton's method, with a proof that no other one is nearer. Main type: [`Nearby`].
//!
//! The known solution is `a`, the given values are `c`, and `d` is the greatest difference between them. A solution `b` that is as near to `c` differs from it by
//! at most `d`, too. Both have the same pose, so the mean of the Jacobian `J` over the segment from `a` to `b` maps `b - a` to zero (mean value theorem). If
//! this mean is regular, `b` is `a`. With `m = (a + c) / 2`, Taylor's formula at `m` gives the mean times `J(m)^-1`: it differs from the identity by at most
//! `M2 d / 2 + M3 d^2 7 / 24`. Here `M2` has bounds of the entries of `J(m)^-1` times the second derivatives at `m`, and `M3` those of the third ones
//! everywhere. The mean is regular if this bound has a norm below one, in which each joint may have a weight (Ortega and Rheinboldt 1970, 2.3 and 3.2).

use nalgebra::{Matrix6, Point3, UnitQuaternion, Vector3, Vector6};

use super::biped::{Biped, Foot};
use groebot_robot::spatial::{Axis, Pose, angle};

/// The number of joints of a leg that holds a pose.
const JOINTS: usize = 6;
/// The greatest number of Newton steps: near a solution the error is squared by each of them.
const STEPS: usize = 8;
/// The greatest error of the pose of a solution, relative to the length of the leg, and \[rad\]: ten times the rounding
/// of forward kinematics.
const HOLDS: f64 = 1e-14;
/// The part of the bound of the proof that is used. The rest is more than its rounding errors.
const USED: f64 = 0.99;
/// The greatest move of a joint for which a proof is tried \[rad\].
const FAR: f64 = 0.3;
/// The number of steps of the power method for the weights of the joints in the norm.
const POWERS: usize = 4;
/// The least weight of a joint, relative to the greatest.
const LEAST_WEIGHT: f64 = 1e-3;

/// Forward kinematics of a leg of six revolute joints, in the torso frame.
#[derive(Clone, Debug)]
pub(super) struct Nearby {
    /// The axes at zero joint values, from the torso to the tip.
    axes: [Axis; JOINTS],
    /// The pose of the tip at zero joint values.
    torso_from_tip: Pose,
    /// By joint, the greatest distance of the tip from a point of its axis, in any posture \[m\].
    spans: [f64; JOINTS],
}

/// The axes and the tip in a posture.
struct Placed {
    axes: [Axis; JOINTS],
    torso_from_tip: Pose,
}

impl Nearby {
    /// The leg of `foot`, whose tip is the link of its sole. `None` unless it has six revolute joints.
    pub fn new(biped: &Biped, foot: &Foot) -> Option<Self> {
        let (_, torso_from_tip) = biped.model.link(foot.link);
        let axes: Option<Vec<Axis>> =
            foot.joints.iter().map(|joint| biped.model.joints()[*joint].screw.axis().copied()).collect();
        let mut axes: [Axis; JOINTS] = axes?.try_into().ok()?;
        let (mut next, mut span): (Point3<f64>, f64) = (torso_from_tip.translation.vector.into(), 0.0);
        let mut spans = [0.0; JOINTS];
        for (axis, to_tip) in axes.iter_mut().zip(&mut spans).rev() {
            *axis = axis.level_with(&next);
            span += (next - axis.point()).norm();
            (*to_tip, next) = (span, axis.point());
        }
        Some(Nearby { axes, torso_from_tip, spans })
    }

    /// The joint values with the tip at `torso_from_tip` that are the nearest to `last` by the greatest difference of a
    /// joint, in (-pi, pi] \[rad\]. `None` where this is not proved: far from `last`, next to a singular posture, and
    /// out of reach.
    pub fn solve(&self, torso_from_tip: &Pose, last: &[f64; JOINTS]) -> Option<[f64; JOINTS]> {
        let last = Vector6::from(*last);
        let move_to = self.solution(torso_from_tip, &last)?;
        self.is_nearest(&(last + move_to / 2.0), move_to.amax()).then(|| (last + move_to).map(angle::wrap).into())
    }

    /// The move from `last` to a solution, by Newton's method.
    fn solution(&self, torso_from_tip: &Pose, last: &Vector6<f64>) -> Option<Vector6<f64>> {
        let (mut moved, mut error) = (Vector6::zeros(), f64::INFINITY);
        for _ in 0..STEPS {
            let placed = self.placed(&(last + moved));
            let missed = placed.error(torso_from_tip);
            let now = self.relative(&missed);
            if now <= HOLDS && now >= error / 2.0 {
                return Some(moved);
            }
            error = now;
            moved += placed.jacobian().lu().solve(&missed)?;
            if moved.amax() > FAR {
                return None;
            }
        }
        None
    }

    /// Whether no other solution is as near to the given values as one at `distance` \[rad\]. `middle` is half-way
    /// between both.
    fn is_nearest(&self, middle: &Vector6<f64>, distance: f64) -> bool {
        let placed = self.placed(middle);
        let Some(inverse) = placed.jacobian().try_inverse() else { return false };
        let third = self.third(&inverse) * (distance * distance * 7.0 / 24.0);
        let change = second(&placed, &inverse) * (distance / 2.0) + third;
        let mut weights = Vector6::repeat(1.0);
        // Any positive weights give a norm; those near the eigenvector give the least one.
        (0..POWERS).any(|_| {
            let grown = change * weights;
            let norm = grown.component_div(&weights).max();
            weights = (grown / grown.amax()).add_scalar(LEAST_WEIGHT);
            norm <= USED
        })
    }
}

impl Nearby {
    fn placed(&self, q: &Vector6<f64>) -> Placed {
        let (mut axes, mut motion) = (self.axes, Pose::identity());
        for (axis, value) in axes.iter_mut().zip(q) {
            let turn = axis.rotation(*value);
            *axis = axis.moved(&motion);
            motion *= turn;
        }
        Placed { axes, torso_from_tip: motion * self.torso_from_tip }
    }

    /// The larger part of an error of the pose: the distance relative to the leg, and the angle.
    fn relative(&self, error: &Vector6<f64>) -> f64 {
        let (position, turn) = (error.fixed_rows::<3>(0).norm() / self.spans[0], error.fixed_rows::<3>(3).norm());
        if turn > position { turn } else { position }
    }

    /// Bounds of the entries of the inverse Jacobian times a third derivative, over all postures, for each joint summed
    /// over the other two.
    fn third(&self, inverse: &Matrix6<f64>) -> Matrix6<f64> {
        // The derivative by three joints is at most the distance of the tip from the outermost of them.
        let pairs = |joint: usize| (2 * joint + 1) as f64;
        let mut farther = 0.0;
        let mut reaches = [0.0; JOINTS];
        for joint in (0..JOINTS).rev() {
            reaches[joint] = farther + self.spans[joint] * ((joint + 1) * (joint + 1)) as f64;
            farther += pairs(joint) * self.spans[joint];
        }
        let all = (JOINTS * JOINTS) as f64;
        Matrix6::from_fn(|row, joint| {
            let row = inverse.fixed_rows::<1>(row);
            row.fixed_columns::<3>(0).norm() * reaches[joint] + row.fixed_columns::<3>(3).norm() * all
        })
    }
}

/// The magnitudes of the entries of the inverse Jacobian times a second derivative, for each joint summed over the other
/// one.
fn second(placed: &Placed, inverse: &Matrix6<f64>) -> Matrix6<f64> {
    let tip = Point3::from(placed.torso_from_tip.translation.vector);
    let mut sums = Matrix6::zeros();
    for (outer, axis) in placed.axes.iter().enumerate() {
        let direction = axis.direction();
        let velocity = direction.cross(&(tip - axis.point()));
        for (inner, before) in placed.axes[..=outer].iter().enumerate() {
            let [position, turn] = [velocity, *direction].map(|vector| before.direction().cross(&vector));
            let moved = (inverse * stacked(&position, &(turn / 2.0))).abs();
            let mut column = sums.column_mut(outer);
            column += moved;
            if inner != outer {
                let mut column = sums.column_mut(inner);
                column += moved;
            }
        }
    }
    sums
}

impl Placed {
    /// The derivatives of the position and of the rotation of the tip, in columns.
    fn jacobian(&self) -> Matrix6<f64> {
        let tip = Point3::from(self.torso_from_tip.translation.vector);
        let column = |axis: &Axis| stacked(&axis.direction().cross(&(tip - axis.point())), &axis.direction());
        Matrix6::from_columns(&self.axes.each_ref().map(column))
    }

    /// The displacement from the tip to a target, and the rotation vector, exact to first order.
    fn error(&self, torso_from_target: &Pose) -> Vector6<f64> {
        let position = torso_from_target.translation.vector - self.torso_from_tip.translation.vector;
        let turn: UnitQuaternion<f64> = torso_from_target.rotation * self.torso_from_tip.rotation.inverse();
        stacked(&position, &(turn.imag() * (2.0 * turn.w.signum())))
    }
}

fn stacked(upper: &Vector3<f64>, lower: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(upper.x, upper.y, upper.z, lower.x, lower.y, lower.z)
}
