//! Robots that differ from a given one in a few parts: held joints, another root frame, another contact shape.

use super::robot::hold;
use super::{Joint, JointType, Link, Robot, Shape, Solid};
use crate::spatial::exact::Placement;
use crate::spatial::{Pose, rotation};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;

impl Robot {
    /// Same robot, but with fixed joints: pairs of an index in [`Robot::joints`] and a constant value \[rad or m\],
    /// within rounding. Joints that follow them are fixed too. Actuators of fixed joints are removed.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a value that is not finite; those of [`Robot::with_faults`].
    pub fn with_held(&self, held: &[(usize, f64)]) -> Result<Self> {
        let exact = |value: f64| {
            let text = || Error::new(ErrorKind::BadValue, format!("a joint cannot be held at {value}"));
            BigRational::from_float(value).ok_or_else(text)
        };
        let mut parts = self.parts().clone();
        let mut fixed = Vec::new();
        for (place, joint) in self.joints().iter().enumerate() {
            let law = self.law(joint);
            let own = held.iter().find(|(other, _)| *other == place);
            let leads = || held.iter().find(|(other, _)| self.joints()[*other].name == law.leader);
            let value = match (own, leads()) {
                (Some((_, value)), _) => exact(*value)?,
                (None, Some((_, value))) => &law.multiplier * exact(*value)? + &law.offset,
                (None, None) => continue,
            };
            hold(joint, &mut parts.joints[place], &value);
            fixed.push(joint.name.clone());
        }
        parts.actuators.retain(|actuator| actuator.joints.iter().all(|(joint, _)| !fixed.contains(joint)));
        Robot::with_faults(parts)
    }

    /// Same robot, but with a new root link in which the old root has the frame `placement`. The new link is the last
    /// one, its name is `wanted`, followed by `_` where that name is used already.
    ///
    /// # Errors
    /// Those of [`Robot::with_faults`].
    pub fn with_root(&self, wanted: &str, placement: Placement) -> Result<Self> {
        let is_taken = |name: &str| {
            self.links().iter().any(|link| link.name == name) || self.joints().iter().any(|joint| joint.name == name)
        };
        let mut name = wanted.to_owned();
        while is_taken(&name) {
            name.push('_');
        }
        let mut parts = self.parts().clone();
        let mut joint = Joint::new(&name, JointType::Fixed, &name, self.root());
        joint.origin = placement.into();
        parts.joints.push(joint);
        parts.links.push(Link::new(&name));
        Robot::with_faults(parts)
    }

    /// Same robot, but the only collision shape of the rigid body of `link` is a box. `link_from_box` is the frame of
    /// its centre in the frame of `link`, `size` are its side lengths \[m\].
    ///
    /// # Errors
    /// Those of [`Robot::with_faults`].
    ///
    /// # Panics
    /// When there is no such link.
    pub fn with_contact_box(&self, link: usize, link_from_box: &Pose, size: [f64; 3]) -> Result<Self> {
        let body = self.rigid_root(link);
        let mut parts = self.parts().clone();
        for (place, other) in parts.links.iter_mut().enumerate() {
            if self.rigid_root(place) == body {
                other.collisions.clear();
            }
        }
        let shape = Shape {
            xyz: link_from_box.translation.vector.into(),
            rpy: rotation::rpy(&link_from_box.rotation),
            ..Shape::new(Solid::Box { size })
        };
        parts.links[link].collisions.push(shape);
        Robot::with_faults(parts)
    }

    /// The link nearest to the root of those that are rigidly connected to `link`.
    fn rigid_root(&self, link: usize) -> usize {
        let moves = |joint: &usize| self.joints()[*joint].kind.is_single();
        let fixed = self.ancestry(link).into_iter().take_while(|joint| !moves(joint));
        fixed.last().map_or(link, |joint| self.ends(joint).0)
    }
}
