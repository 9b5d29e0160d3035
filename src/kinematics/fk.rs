//! Numeric forward kinematics as a product of exponentials (Brockett 1984; RH0 2.1.4).

use nalgebra::{Point3, Translation3, Unit, Vector3};

use super::{Chain, ChainParts, Joint, JointKind};
use crate::spatial::exact::{normalized, numeric_rotation, point};
use crate::spatial::{Pose, Screw};
use crate::{Error, ErrorKind, Result};

/// The screws and the tip of a chain in doubles, in the base frame at the zero configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct Numeric {
    screws: Vec<Screw>,
    base_from_tip: Pose,
    aim: Unit<Vector3<f64>>,
    reach: f64,
}

impl Numeric {
    pub(super) fn of(parts: &ChainParts) -> Result<Self> {
        let screws = parts.joints.iter().map(Joint::screw).collect::<Result<_>>()?;
        let translation = Translation3::from(point(&parts.tip.point).coords);
        let base_from_tip = Pose::from_parts(translation, numeric_rotation(&parts.tip.rotation));
        let points = parts.joints.iter().map(Joint::location).chain([Point3::from(translation.vector)]);
        Ok(Numeric { screws, base_from_tip, aim: normalized(&parts.direction), reach: length(points) })
    }
}

impl Joint {
    /// The unit vector along the axis.
    pub fn direction(&self) -> Unit<Vector3<f64>> {
        normalized(&self.axis)
    }

    /// The point on the axis, in the chain's length unit.
    pub fn location(&self) -> Point3<f64> {
        point(&self.point)
    }

    fn screw(&self) -> Result<Screw> {
        match self.kind {
            JointKind::Revolute => Screw::revolute(self.direction().into_inner(), self.location()),
            JointKind::Prismatic => Screw::prismatic(self.direction().into_inner()),
        }
    }
}

impl Chain {
    /// The unit vector, in the tip frame, of the direction that the tasks `ray` and `direction` aim.
    pub fn aim(&self) -> Unit<Vector3<f64>> {
        self.numeric.aim
    }

    /// The joints' screws from base to tip, in the base frame at the zero configuration and the chain's length unit.
    pub fn screws(&self) -> &[Screw] {
        &self.numeric.screws
    }

    /// The pose of the tip at the zero configuration, in the chain's length unit.
    pub fn base_from_tip(&self) -> Pose {
        self.numeric.base_from_tip
    }

    /// The pose base_from_tip of the tip, in the chain's length unit, for the joint values `q`, base to tip: radians
    /// (revolute) or the chain's length unit (prismatic). `e^(S1 q1) ... e^(Sn qn) M`, RH0 (2-20) and (2-27); limits
    /// are not looked at.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `q` has not one finite value per joint.
    pub fn forward(&self, q: &[f64]) -> Result<Pose> {
        let screws = self.screws();
        if q.len() != screws.len() {
            let message = format!("{} joint values are given; the chain has {} joints", q.len(), screws.len());
            return Err(Error::new(ErrorKind::BadValue, message));
        }
        if let Some(index) = q.iter().position(|value| !value.is_finite()) {
            let message = format!("joint `{}`: the value {} is not finite", self.joints()[index].name, q[index]);
            return Err(Error::new(ErrorKind::BadValue, message));
        }
        let steps = screws.iter().zip(q).rev();
        Ok(steps.fold(self.base_from_tip(), |pose, (screw, &q)| screw.exp(q) * pose))
    }

    /// The length of the zigzag from the first joint's point over the other joints' points to the tip, in the chain's
    /// length unit. While prismatic joints stand at zero, the tip is never further from the first joint's point.
    pub fn reach(&self) -> f64 {
        self.numeric.reach
    }
}

/// The length of a zigzag over these points.
fn length(points: impl Iterator<Item = Point3<f64>>) -> f64 {
    let points: Vec<Point3<f64>> = points.collect();
    points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}
