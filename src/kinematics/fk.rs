//! Numeric forward kinematics as a product of exponentials (Brockett 1984; RH0 2.1.4).

use nalgebra::{Matrix3, Point3, Rotation3, Translation3, Unit, UnitQuaternion, Vector3};
use num_traits::{Signed, ToPrimitive};

use super::{Chain, ChainParts, ExactMatrix, ExactVector, Joint, JointKind};
use crate::number::BigRational;
use crate::spatial::Pose;
use crate::{Error, ErrorKind, Result};

/// The joint axes and the tip of a chain in doubles, in the base frame at the zero configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct Screws {
    joints: Vec<(JointKind, Unit<Vector3<f64>>, Point3<f64>)>,
    base_from_tip: Pose,
}

impl Screws {
    pub(super) fn of(parts: &ChainParts) -> Self {
        let screw = |joint: &Joint| (joint.kind, joint.direction(), joint.location());
        let translation = Translation3::from(point(&parts.tip.point).coords);
        let base_from_tip = Pose::from_parts(translation, rotation(&parts.tip.rotation));
        Screws { joints: parts.joints.iter().map(screw).collect(), base_from_tip }
    }
}

impl Joint {
    /// The unit vector along the axis.
    pub fn direction(&self) -> Unit<Vector3<f64>> {
        let greatest = self.axis.iter().map(Signed::abs).max().unwrap_or_default();
        let [x, y, z] = self.axis.each_ref().map(|entry| double(&(entry / &greatest)));
        Unit::new_normalize(Vector3::new(x, y, z))
    }

    /// The point on the axis, in the chain's length unit.
    pub fn location(&self) -> Point3<f64> {
        point(&self.point)
    }
}

impl Chain {
    /// The pose base_from_tip of the tip for the joint values `q`, base to tip: radians (revolute) or the chain's
    /// length unit (prismatic). `e^(S1 q1) ... e^(Sn qn) M`, RH0 (2-20) and (2-27); limits are not looked at.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `q` has not one finite value per joint.
    pub fn forward(&self, q: &[f64]) -> Result<Pose> {
        let joints = &self.screws.joints;
        if q.len() != joints.len() {
            let message = format!("{} joint values are given; the chain has {} joints", q.len(), joints.len());
            return Err(Error::new(ErrorKind::BadValue, message));
        }
        if let Some(index) = q.iter().position(|value| !value.is_finite()) {
            let message = format!("joint `{}`: the value {} is not finite", self.joints()[index].name, q[index]);
            return Err(Error::new(ErrorKind::BadValue, message));
        }
        let screws = joints.iter().zip(q).rev();
        Ok(screws.fold(self.screws.base_from_tip, |pose, ((kind, axis, point), &q)| match kind {
            JointKind::Revolute => rotate(axis, point, q, &pose),
            JointKind::Prismatic => Translation3::from(axis.into_inner() * q) * pose,
        }))
    }

    /// The length of the zigzag from the first joint's point over the other joints' points to the tip, in the chain's
    /// length unit. While prismatic joints stand at zero, the tip is never further from the first joint's point.
    pub fn reach(&self) -> f64 {
        let tip = Point3::from(self.screws.base_from_tip.translation.vector);
        let points: Vec<Point3<f64>> = self.screws.joints.iter().map(|joint| joint.2).chain([tip]).collect();
        points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
    }
}

/// `pose` after the rotation by `angle` about the line through `point` along `axis`.
fn rotate(axis: &Unit<Vector3<f64>>, point: &Point3<f64>, angle: f64, pose: &Pose) -> Pose {
    let rotation = UnitQuaternion::from_axis_angle(axis, angle);
    let position = point + rotation * (pose.translation.vector - point.coords);
    Pose::from_parts(Translation3::from(position.coords), rotation * pose.rotation)
}

fn double(exact: &BigRational) -> f64 {
    exact.to_f64().unwrap_or(0.0)
}

fn point(exact: &ExactVector) -> Point3<f64> {
    Point3::from(exact.each_ref().map(double))
}

fn rotation(exact: &ExactMatrix) -> UnitQuaternion<f64> {
    let matrix = Matrix3::from_fn(|i, j| double(&exact[i][j]));
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(matrix))
}
