//! Final check of a solution: its distance from the goal, and a Gauss-Newton step where rounding errors are too large.

use nalgebra::{SMatrix, SVector, Vector3};
use smallvec::SmallVec;

use super::reduced::Goal;
use crate::spatial::{Pose, Screw};

/// Maximum number of joints: six for a pose, plus given joints.
pub(super) const MOST_JOINTS: usize = 10;

/// Maximum number of steps.
const STEPS: usize = 6;

/// Residual of the product of exponentials.
#[derive(Clone, Copy, Debug)]
pub(super) struct Residual {
    /// Distance of the point, or of the origin moved by the pose.
    pub position: f64,
    /// Angle \[rad\].
    pub rotation: f64,
    /// The twist `(v, w)` at the goal that corrects the residual.
    twist: SVector<f64, 6>,
}

impl Residual {
    /// The larger of the angle and the distance in units of `reach`.
    pub fn size(&self, reach: f64) -> f64 {
        (self.position / reach).max(self.rotation)
    }

    /// The residual when the joints move by `motions`. `tip` is the point whose distance is measured.
    pub fn of(motions: &[Pose], goal: &Goal, tip: &Vector3<f64>) -> Residual {
        let product = motions.iter().copied().reduce(|pose, motion| pose * motion).unwrap_or_else(Pose::identity);
        let mut twist = SVector::<f64, 6>::zeros();
        match goal {
            Goal::Point { from, to } => {
                let v = to - product * from;
                twist.fixed_rows_mut::<3>(0).copy_from(&v);
                Residual { position: v.norm(), rotation: 0.0, twist }
            }
            Goal::Pose(pose) => {
                let turn = pose.rotation * product.rotation.inverse();
                let w = turn.imag() * if turn.scalar() < 0.0 { -2.0 } else { 2.0 };
                let v = (pose * nalgebra::Point3::from(*tip)) - (product * nalgebra::Point3::from(*tip));
                twist.fixed_rows_mut::<3>(0).copy_from(&v);
                twist.fixed_rows_mut::<3>(3).copy_from(&w);
                // The angle is twice the arc sine of w / 2; for small angles it is w itself.
                let rotation = if w.norm() < 1e-5 && turn.scalar() != 0.0 { w.norm() } else { turn.angle() };
                Residual { position: v.norm(), rotation, twist }
            }
        }
    }
}

/// Improves `q`, whose residual is `residual`, until the residual is at most `enough`. Returns it with its residual. The
/// joints of `fixed` do not move.
pub(super) fn refine(
    screws: &[Screw],
    goal: &Goal,
    tip: &Vector3<f64>,
    reach: f64,
    (mut q, mut residual, fixed): ([f64; MOST_JOINTS], Residual, &[bool; MOST_JOINTS]),
    enough: f64,
) -> ([f64; MOST_JOINTS], Residual) {
    for _ in 0..STEPS {
        if residual.size(reach) <= enough || residual.size(reach) > 1e-2 {
            break;
        }
        let Some(step) = newton(screws, &q, goal, tip, reach, (&residual, fixed)) else { break };
        let mut next = q;
        next.iter_mut().zip(step.iter()).for_each(|(q, d)| *q += d);
        let motions: SmallVec<[Pose; MOST_JOINTS]> = screws.iter().zip(next).map(|(screw, q)| screw.exp(q)).collect();
        let better = Residual::of(&motions, goal, tip);
        if better.size(reach) >= residual.size(reach) {
            break;
        }
        (q, residual) = (next, better);
    }
    (q, residual)
}

/// Whether some joint of `free` can move near `q` with a fixed tip, by first derivatives. The other joints, except
/// those of `given`, compensate its motion.
pub(super) fn moves_freely(
    screws: &[Screw],
    q: &[f64; MOST_JOINTS],
    goal: &Goal,
    tip: &Vector3<f64>,
    reach: f64,
    (free, given): (&[bool; MOST_JOINTS], &[usize]),
) -> bool {
    /// Threshold of the tip's motion that remains for a joint velocity of one radian after compensation by the others.
    const STILL: f64 = 1e-6;
    let fixed = std::array::from_fn(|i| given.contains(&i));
    let whole = jacobian(screws, q, goal, tip, reach, &fixed);
    (0..screws.len()).filter(|&i| free[i]).any(|i| {
        let mut others = whole;
        others.column_mut(i).fill(0.0);
        let column = whole.column(i).into_owned();
        let undone = others.svd(true, true).solve(&column, STILL * others.norm());
        undone.is_ok_and(|motion| (others * motion - column).norm() <= STILL * column.norm())
    })
}

/// The Jacobian of the tip, `(v / reach, w)` at the goal, for each joint that is not `fixed`; only its first three rows
/// for a point.
fn jacobian(
    screws: &[Screw],
    q: &[f64; MOST_JOINTS],
    goal: &Goal,
    tip: &Vector3<f64>,
    reach: f64,
    fixed: &[bool; MOST_JOINTS],
) -> SMatrix<f64, 6, MOST_JOINTS> {
    let mut jacobian = SMatrix::<f64, 6, MOST_JOINTS>::zeros();
    let mut before = Pose::identity();
    let at = match goal {
        Goal::Point { to, .. } => *to,
        Goal::Pose(pose) => pose * nalgebra::Point3::from(*tip),
    };
    for (i, screw) in screws.iter().enumerate() {
        let (v, w) = match screw.moved(&before) {
            Screw::Revolute(axis) => (axis.direction().cross(&(at - axis.point())), axis.direction().into_inner()),
            Screw::Prismatic(direction) => (direction.into_inner(), Vector3::zeros()),
        };
        if !fixed[i] {
            jacobian.fixed_view_mut::<3, 1>(0, i).copy_from(&(v / reach));
            if matches!(goal, Goal::Pose(_)) {
                jacobian.fixed_view_mut::<3, 1>(3, i).copy_from(&w);
            }
        }
        before *= screw.exp(q[i]);
    }
    jacobian
}

/// The damped least-squares step.
fn newton(
    screws: &[Screw],
    q: &[f64; MOST_JOINTS],
    goal: &Goal,
    tip: &Vector3<f64>,
    reach: f64,
    (residual, fixed): (&Residual, &[bool; MOST_JOINTS]),
) -> Option<SVector<f64, MOST_JOINTS>> {
    let jacobian = jacobian(screws, q, goal, tip, reach, fixed);
    let mut missing = residual.twist;
    missing.fixed_rows_mut::<3>(0).scale_mut(1.0 / reach);
    let normal = jacobian.transpose() * jacobian;
    let damping = 1e-14 * normal.trace().max(f64::MIN_POSITIVE);
    let damped = normal + SMatrix::<f64, MOST_JOINTS, MOST_JOINTS>::identity() * damping;
    Some(nalgebra::Cholesky::new(damped)?.solve(&(jacobian.transpose() * missing)))
}
