//! A chain in doubles. Main type: [`Numeric`].

use nalgebra::{Point3, Translation3, Unit, Vector3};

use super::{ChainParts, Joint, JointKind};
use crate::Result;
use crate::spatial::exact::{normalized, numeric_rotation, point};
use crate::spatial::{Pose, Screw};

/// The screws and the tip of a chain in doubles, in the base frame at the zero configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct Numeric {
    pub(super) screws: Vec<Screw>,
    pub(super) base_from_tip: Pose,
    pub(super) aim: Unit<Vector3<f64>>,
    pub(super) reach: f64,
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

/// The length of the polyline through these points.
fn length(points: impl Iterator<Item = Point3<f64>>) -> f64 {
    let points: Vec<Point3<f64>> = points.collect();
    points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}
