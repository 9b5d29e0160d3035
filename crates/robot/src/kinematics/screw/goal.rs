//! The goal of the loop of all joints for a target of the tip.

use nalgebra::{Point3, Translation3, Unit, UnitQuaternion, Vector3};

use super::reduced::{Goal, LOOSE, Member, Reduced};
use super::values::Reach;
use crate::Result;
use crate::kinematics::{Chain, Plane, Target, Task};
use crate::spatial::Pose;

impl Target {
    /// Computes the goal of the loop of all joints of `chain`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when the target is not of the chain's task, or not finite.
    pub(super) fn goal(&self, chain: &Chain) -> Result<Goal> {
        self.check(chain)?;
        let tip = chain.base_from_tip();
        let from = Point3::from(tip.translation.vector);
        let goal = match (self, chain.task()) {
            (Target::Pose(pose), _) => Goal::Pose(pose * tip.inverse()),
            (Target::Position(to), _) => Goal::Point { from, to: *to },
            (Target::Ray { point, direction }, _) => ray_goal(chain, point, direction),
            (Target::Direction(direction), _) => {
                Goal::Point { from: (tip.rotation * chain.aim().into_inner()).into(), to: (*direction).into() }
            }
            (Target::Rotation(rotation), _) => {
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
            (Target::PositionYaw { point, yaw }, Task::PositionYaw { axis }) => {
                let (aim, [a, b]) = (tip.rotation * chain.aim().into_inner(), axis.across());
                let normal = Unit::new_unchecked(Vector3::ith(axis.coordinate(), 1.0));
                let rotation = UnitQuaternion::from_axis_angle(&normal, yaw - aim[b].atan2(aim[a])) * tip.rotation;
                Goal::Pose(Pose::from_parts(point.coords.into(), rotation) * tip.inverse())
            }
            // A position with pitch and roll is solved with its equivalent loop. A planar target has a plane.
            (Target::PositionPitchRoll { point, .. } | Target::PositionYaw { point, .. }, _) => {
                Goal::Point { from, to: *point }
            }
            (Target::PlanarPosition(_) | Target::PlanarPose(_), _) => Goal::Point { from, to: from },
        };
        Ok(goal)
    }
}

/// A rotation of the tip of `chain` that aligns its direction with `wanted`.
fn aimed(chain: &Chain, wanted: &Vector3<f64>) -> UnitQuaternion<f64> {
    let aim = chain.aim();
    let across = aim.cross(&Vector3::ith(aim.iamin(), 1.0));
    let half_turn = UnitQuaternion::from_axis_angle(&Unit::new_normalize(across), std::f64::consts::PI);
    UnitQuaternion::rotation_between(&aim.into_inner(), wanted).unwrap_or(half_turn)
}

/// The goal of a ray: a pose with any rotation that has its direction.
fn ray_goal(chain: &Chain, point: &Point3<f64>, direction: &Vector3<f64>) -> Goal {
    let pose = Pose::from_parts(point.coords.into(), aimed(chain, direction));
    Goal::Pose(pose * chain.base_from_tip().inverse())
}

fn in_plane(tip: &Point3<f64>, plane: Plane, at: &[f64; 2]) -> Point3<f64> {
    let mut point = *tip;
    for (axis, value) in plane.coordinates().into_iter().zip(at) {
        point[axis] = *value;
    }
    point
}

/// The loop of all joints.
pub(super) fn whole(screws: &[crate::spatial::Screw], goal: Goal) -> Reduced {
    let row = screws.iter().enumerate().map(|(joint, &screw)| Member { joint, screw }).collect();
    Reduced { row, goal, loose: Reach::Within(LOOSE) }
}
