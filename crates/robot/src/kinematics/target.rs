//! The target of a solver: [`Target`].

use nalgebra::{Point3, UnitQuaternion, Vector3};

use super::{Chain, Task};
use crate::spatial::{Pose, angle, pitch_and_roll, vertical};
use crate::{Error, ErrorKind, Result};

/// Tolerance of the length of a unit quaternion or a unit vector.
const UNIT: f64 = 1e-9;

/// The target of the tip in the base frame, with lengths in the chain's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// The pose base_from_tip.
    Pose(Pose),
    /// The position of the tip.
    Position(Point3<f64>),
    /// The position in the task's plane, its two coordinates in the order of the plane's name.
    PlanarPosition([f64; 2]),
    /// The position in the task's plane and the angle \[rad\] about its normal, right-handed, from the zero configuration.
    PlanarPose([f64; 3]),
    /// The position of the tip, and the direction of the task's direction vector.
    Ray {
        /// The position.
        point: Point3<f64>,
        /// The direction, a unit vector.
        direction: Vector3<f64>,
    },
    /// The direction of the task's direction vector, a unit vector.
    Direction(Vector3<f64>),
    /// The rotation base_from_tip.
    Rotation(UnitQuaternion<f64>),
    /// The position of the tip, and pitch and roll of R = Rz(yaw) Ry(pitch) Rx(roll) \[rad\].
    PositionPitchRoll {
        /// The position.
        point: Point3<f64>,
        /// The pitch.
        pitch: f64,
        /// The roll.
        roll: f64,
    },
    /// The position of the tip, and the angle \[rad\] of its direction about the task's axis.
    PositionYaw {
        /// The position.
        point: Point3<f64>,
        /// The angle.
        yaw: f64,
    },
}

impl Target {
    /// Computes the target that the tip of `chain` reaches at `q`, in the form of its task.
    ///
    /// # Errors
    /// Those of [`Chain::forward`].
    pub fn reached(chain: &Chain, q: &[f64]) -> Result<Target> {
        Ok(Target::of_pose(chain, &chain.forward(q)?))
    }

    /// The target that the pose `pose` (base_from_tip) of the tip of `chain` is, in the form of its task.
    pub fn of_pose(chain: &Chain, pose: &Pose) -> Target {
        let tip = pose.translation.vector;
        let aimed = || pose.rotation * chain.aim().into_inner();
        match chain.task() {
            Task::Pose => Target::Pose(*pose),
            Task::Position => Target::Position(tip.into()),
            Task::Ray => Target::Ray { point: tip.into(), direction: aimed() },
            Task::Direction => Target::Direction(aimed()),
            Task::Rotation => Target::Rotation(pose.rotation),
            Task::PositionPitchRoll => {
                let (pitch, roll) = pitch_and_roll(&pose.rotation);
                Target::PositionPitchRoll { point: tip.into(), pitch, roll }
            }
            Task::PositionYaw { axis } => {
                let [a, b] = axis.across();
                Target::PositionYaw { point: tip.into(), yaw: aimed()[b].atan2(aimed()[a]) }
            }
            Task::PlanarPosition { plane } => Target::PlanarPosition(plane.coordinates().map(|i| tip[i])),
            Task::PlanarPose { plane } => {
                let [x, y] = plane.coordinates().map(|i| tip[i]);
                let turn = pose.rotation * chain.base_from_tip().rotation.inverse();
                let phi = 2.0 * turn.imag()[plane.normal()].atan2(turn.scalar());
                Target::PlanarPose([x, y, crate::spatial::angle::wrap(phi)])
            }
        }
    }

    /// Whether the target is of the kind that `task` has.
    pub fn is_of(&self, task: Task) -> bool {
        matches!(
            (self, task),
            (Target::Pose(_), Task::Pose)
                | (Target::Position(_), Task::Position)
                | (Target::Ray { .. }, Task::Ray)
                | (Target::Direction(_), Task::Direction)
                | (Target::Rotation(_), Task::Rotation)
                | (Target::PositionPitchRoll { .. }, Task::PositionPitchRoll)
                | (Target::PositionYaw { .. }, Task::PositionYaw { .. })
                | (Target::PlanarPosition(_), Task::PlanarPosition { .. })
                | (Target::PlanarPose(_), Task::PlanarPose { .. })
        )
    }

    /// Checks that the target belongs to `chain`'s task and is finite.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] otherwise, and for a quaternion or a direction whose norm is not one.
    pub fn check(&self, chain: &Chain) -> Result<()> {
        let task = chain.task();
        let is_finite = |values: Vec<f64>| values.iter().map(|x| x * x).sum::<f64>().is_finite();
        let text = if !self.is_of(task) {
            format!("the chain's task is `{}`; give a target of that kind", task.name())
        } else if let Some((what, norm, whole)) = self.not_of_length_one() {
            format!("the {what} {norm}; give a {whole}")
        } else if !is_finite(task.layout().values(self)?) {
            "a target has a value that is not finite, or whose square is not; give finite numbers below 1e150"
                .to_owned()
        } else {
            return Ok(());
        };
        Err(Error::new(ErrorKind::BadValue, text))
    }

    /// A quantity whose length should be one but is not: its name, its length, and the requirement.
    fn not_of_length_one(&self) -> Option<(&'static str, f64, &'static str)> {
        let (what, norm, whole) = match self {
            Target::Pose(Pose { rotation, .. }) | Target::Rotation(rotation) => {
                ("rotation's quaternion has the norm", rotation.as_ref().norm(), "unit quaternion")
            }
            Target::Ray { direction, .. } | Target::Direction(direction) => {
                ("direction has the length", direction.norm(), "vector of length one")
            }
            _ => return None,
        };
        // A NaN norm is not near one.
        (norm.is_nan() || (norm - 1.0).abs() > UNIT).then_some((what, norm, whole))
    }

    /// The error of the tip of `chain` at `q`: the distance in the chain's unit, and the angle \[rad\]; zero for
    /// numbers that the task does not have. Not finite if `q` is not, or if the target belongs to another task.
    pub fn missed(&self, chain: &Chain, q: &[f64]) -> [f64; 2] {
        let norm = |part: &[f64]| part.iter().map(|miss| miss * miss).sum::<f64>().sqrt();
        match Target::reached(chain, q) {
            Ok(reached) => {
                let (position, rotation) = reached.difference(self);
                [norm(&position), norm(&rotation)]
            }
            Err(_) => [f64::NAN; 2],
        }
    }

    /// The difference from `target`, which is of the same kind: lengths, then numbers whose norm is the angle \[rad\]
    /// for small rotations.
    pub(super) fn difference(&self, target: &Target) -> (Vec<f64>, Vec<f64>) {
        let turn = |a: &UnitQuaternion<f64>, b: &UnitQuaternion<f64>| {
            let difference = a.to_rotation_matrix().matrix() - b.to_rotation_matrix().matrix();
            difference.iter().map(|entry| entry * std::f64::consts::FRAC_1_SQRT_2).collect::<Vec<f64>>()
        };
        let list = |vector: Vector3<f64>| vector.iter().copied().collect::<Vec<f64>>();
        match (self, target) {
            (Target::Pose(a), Target::Pose(b)) => {
                (list(a.translation.vector - b.translation.vector), turn(&a.rotation, &b.rotation))
            }
            (Target::Position(a), Target::Position(b)) => (list(a - b), Vec::new()),
            (Target::Ray { point, direction }, Target::Ray { point: to, direction: along }) => {
                (list(point - to), list(direction - along))
            }
            (
                Target::PositionPitchRoll { point, pitch, roll },
                Target::PositionPitchRoll { point: to, pitch: other, roll: rolled },
            ) => (list(point - to), list(vertical(*pitch, *roll) - vertical(*other, *rolled))),
            (Target::PositionYaw { point, yaw }, Target::PositionYaw { point: to, yaw: other }) => {
                (list(point - to), vec![angle::difference(*yaw, *other)])
            }
            (Target::Direction(a), Target::Direction(b)) => (Vec::new(), list(a - b)),
            (Target::Rotation(a), Target::Rotation(b)) => (Vec::new(), turn(a, b)),
            (Target::PlanarPosition(a), Target::PlanarPosition(b)) => (vec![a[0] - b[0], a[1] - b[1]], Vec::new()),
            (Target::PlanarPose(a), Target::PlanarPose(b)) => {
                (vec![a[0] - b[0], a[1] - b[1]], vec![angle::difference(a[2], b[2])])
            }
            _ => (Vec::new(), vec![f64::NAN]),
        }
    }
}

impl From<Pose> for Target {
    fn from(base_from_tip: Pose) -> Self {
        Target::Pose(base_from_tip)
    }
}

impl From<&Pose> for Target {
    fn from(base_from_tip: &Pose) -> Self {
        Target::Pose(*base_from_tip)
    }
}

impl From<&Target> for Target {
    fn from(target: &Target) -> Self {
        *target
    }
}
