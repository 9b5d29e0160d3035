//! What the screw solver is asked for, and what it answers.

use nalgebra::{Point3, Translation3, Unit, UnitQuaternion, Vector3};

use super::model::ray_goal;
use super::reduced::{Goal, Member, Reduced};
use crate::kinematics::{Chain, Plane, Task};
use crate::spatial::{Pose, pitch_and_roll};
use crate::{Error, ErrorKind, Result};

/// Where the tip is to be, in the base frame; lengths in the chain's unit.
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
    /// The position of the tip, and where the task's direction points.
    Ray {
        /// The position.
        point: Point3<f64>,
        /// The direction, of length one.
        direction: Vector3<f64>,
    },
    /// Where the task's direction points: a vector of length one.
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
}

/// One inverse-kinematics answer, checked by forward kinematics.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// The joint values, base to tip: radians in (-pi, pi] or lengths of the chain's unit; zero for a free joint.
    pub q: Vec<f64>,
    /// The joints, from 0, for which every value does it (the others changing along with it) at this singular pose.
    pub free: Vec<usize>,
    /// The distance of the tip from its target, in the chain's unit.
    pub position_residual: f64,
    /// The angle \[rad\] of the tip from its target; zero when only a position is asked for.
    pub rotation_residual: f64,
    /// Which answer of each step it comes from: a number below [`super::Plan::most_solutions`], whose digits, the first step's
    /// first, count in the numbers of answers of the steps. Numbers from there on are of an order that was taken in place of the
    /// plan.
    pub branch: usize,
}

impl Target {
    /// What the tip of `chain` reaches at `q`, in the form of its task.
    ///
    /// # Errors
    /// As [`Chain::forward`].
    pub fn reached(chain: &Chain, q: &[f64]) -> Result<Target> {
        let pose = chain.forward(q)?;
        let tip = pose.translation.vector;
        let aimed = || pose.rotation * chain.aim().into_inner();
        Ok(match chain.task() {
            Task::Pose => Target::Pose(pose),
            Task::Position => Target::Position(tip.into()),
            Task::Ray => Target::Ray { point: tip.into(), direction: aimed() },
            Task::Direction => Target::Direction(aimed()),
            Task::Rotation => Target::Rotation(pose.rotation),
            Task::PositionPitchRoll => {
                let (pitch, roll) = pitch_and_roll(&pose.rotation);
                Target::PositionPitchRoll { point: tip.into(), pitch, roll }
            }
            Task::PlanarPosition { plane } => Target::PlanarPosition(plane.coordinates().map(|i| tip[i])),
            Task::PlanarPose { plane } => {
                let [x, y] = plane.coordinates().map(|i| tip[i]);
                let turn = pose.rotation * chain.base_from_tip().rotation.inverse();
                let phi = 2.0 * turn.imag()[plane.normal()].atan2(turn.scalar());
                Target::PlanarPose([x, y, crate::spatial::angle::wrap(phi)])
            }
        })
    }

    /// Fails unless the target is of the kind of `chain`'s task and finite.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] then, and for a quaternion or a direction that is not of norm one.
    pub fn check(&self, chain: &Chain) -> Result<()> {
        self.goal(chain).map(drop)
    }

    /// The goal of the loop of all joints of `chain`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when the target is not the chain's task's kind, or not finite.
    pub(super) fn goal(&self, chain: &Chain) -> Result<Goal> {
        if let (Target::PositionPitchRoll { point, pitch, roll }, Task::PositionPitchRoll) = (self, chain.task()) {
            let size = if pitch.is_finite() && roll.is_finite() { point.coords } else { Vector3::repeat(f64::NAN) };
            return check_finite(Goal::Point { from: Point3::origin(), to: size.into() });
        }
        let tip = chain.base_from_tip();
        let from = Point3::from(tip.translation.vector);
        let goal = match (self, chain.task()) {
            (Target::Pose(pose), Task::Pose) => {
                check_unit(pose)?;
                Goal::Pose(pose * tip.inverse())
            }
            (Target::Position(to), Task::Position) => Goal::Point { from, to: *to },
            (Target::Ray { point, direction }, Task::Ray) => {
                check_direction(direction)?;
                ray_goal(chain, point, direction)
            }
            (Target::Direction(direction), Task::Direction) => {
                check_direction(direction)?;
                Goal::Point { from: (tip.rotation * chain.aim().into_inner()).into(), to: (*direction).into() }
            }
            (Target::Rotation(rotation), Task::Rotation) => {
                let pose = Pose::from_parts(Translation3::identity(), *rotation);
                check_unit(&pose)?;
                Goal::Pose(Pose::from_parts(Translation3::identity(), rotation * tip.rotation.inverse()))
            }
            (Target::PlanarPosition(at), Task::PlanarPosition { plane }) => {
                Goal::Point { from, to: in_plane(&from, plane, at) }
            }
            (Target::PlanarPose([x, y, phi]), Task::PlanarPose { plane }) => {
                let normal = Unit::new_unchecked(Vector3::ith(plane.normal(), 1.0));
                let rotation = UnitQuaternion::from_axis_angle(&normal, *phi) * tip.rotation;
                let at = Translation3::from(in_plane(&from, plane, &[*x, *y]).coords);
                Goal::Pose(Pose::from_parts(at, rotation) * tip.inverse())
            }
            (_, task) => {
                let text = format!("the chain's task is `{}`; give a target of that kind", task.name());
                return Err(Error::new(ErrorKind::BadValue, text));
            }
        };
        check_finite(goal)
    }
}

fn in_plane(tip: &Point3<f64>, plane: Plane, at: &[f64; 2]) -> Point3<f64> {
    let mut point = *tip;
    for (axis, value) in plane.coordinates().into_iter().zip(at) {
        point[axis] = *value;
    }
    point
}

fn check_unit(pose: &Pose) -> Result<()> {
    let norm = pose.rotation.as_ref().norm();
    if (norm - 1.0).abs() <= 1e-9 {
        return Ok(());
    }
    let text = format!("the rotation's quaternion has the norm {norm}; give a unit quaternion");
    Err(Error::new(ErrorKind::BadValue, text))
}

fn check_direction(direction: &Vector3<f64>) -> Result<()> {
    let norm = direction.norm();
    if (norm - 1.0).abs() <= 1e-9 {
        return Ok(());
    }
    let text = format!("the direction has the length {norm}; give a vector of length one");
    Err(Error::new(ErrorKind::BadValue, text))
}

fn check_finite(goal: Goal) -> Result<Goal> {
    let size = match goal {
        Goal::Pose(pose) => pose.translation.vector.norm(),
        Goal::Point { to, .. } => to.coords.norm(),
    };
    if size.is_finite() {
        return Ok(goal);
    }
    Err(Error::new(
        ErrorKind::BadValue,
        "a target has a value that is not finite, or whose square is not; give finite numbers below 1e150",
    ))
}

/// The loop of all joints.
pub(super) fn whole(screws: &[crate::spatial::Screw], goal: Goal) -> Reduced {
    let row = screws.iter().enumerate().map(|(joint, &screw)| Member { joint, screw }).collect();
    Reduced { row, goal }
}
