//! A position with pitch and roll, for any yaw, of an arm whose first axis is vertical: [`Chain::upright`]. Main type:
//! [`Upright`].
//!
//! With T = (p, Rz(yaw) Ry(pitch) Rx(roll)) the loop is E1 E2 .. En M = T. The first joint and the unknown yaw both
//! rotate about vertical axes, so from p = o + Rz(azimuth) (radius, 0, height), o on the first axis, it follows that
//!
//! E2 .. En M Rx(-roll) Ry(-pitch) Rz(azimuth - yaw) Sx(-radius) Sz(-height) Rz(q1 - azimuth) = 1 shifted by o:
//!
//! the loop of a chain with four given joints and a constant target.

use num_traits::{ToPrimitive, Zero};

use super::Target;
use super::parts::along_z;
use super::{Chain, ChainParts, ExactVector, Joint, JointKind, Task, Tip};
use crate::spatial::{Pose, angle};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;

/// The given numbers of a target: roll, pitch, distance from the first axis, and height.
pub const GIVEN: [&str; 4] = ["roll", "pitch", "radius", "height"];

/// The loop of a chain for its task `position_pitch_roll`.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Upright {
    /// The joints: those after the first one, roll, pitch, a rotation about the vertical, radius, height, and last the
    /// first joint with its own name. The first joint is measured from the target's azimuth. The task is a pose, and
    /// its target is the identity.
    pub chain: Chain,
    /// The position of the first axis in the horizontal plane, in the chain's unit.
    pub axis: [BigRational; 2],
    /// Whether the first axis points down.
    pub is_down: bool,
}

impl Chain {
    /// Builds the loop for the task `position_pitch_roll`.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] if the first joint is given, or does not rotate about an axis along the base's z.
    #[doc(hidden)]
    pub fn upright(&self) -> Result<Upright> {
        let unsupported = |text: &str| Err(Error::new(ErrorKind::Unsupported, text.to_owned()));
        let [first, others @ ..] = self.joints() else { return unsupported("the chain has no joint") };
        let is_vertical = first.axis[0].is_zero() && first.axis[1].is_zero();
        if first.kind != JointKind::Revolute || !is_vertical || self.given().contains(&0) {
            return unsupported(
                "the task `position_pitch_roll` is for arms whose first joint rotates about the base's z and is not given: it compensates the free yaw",
            );
        }
        if self.joints().iter().any(|joint| joint.mimic.is_some()) {
            return unsupported("the task `position_pitch_roll` does not support mimic joints");
        }
        let tip = self.tip();
        let column = |k: usize| tip.rotation.each_ref().map(|row| row[k].clone());
        let back = |k: usize| column(k).map(|x| -x);
        let mut joints: Vec<Joint> = others.to_vec();
        let mut add = |name: &str, kind: JointKind, axis: ExactVector| {
            let (name, symbol) = (self.free(name, |joint| &joint.name), self.free(name, |joint| &joint.symbol));
            joints.push(Joint { name, symbol, kind, axis, point: tip.point.clone(), limits: None, mimic: None });
        };
        add(GIVEN[0], JointKind::Revolute, back(0));
        add(GIVEN[1], JointKind::Revolute, back(1));
        add("turn", JointKind::Revolute, column(2));
        add(GIVEN[2], JointKind::Prismatic, back(0));
        add(GIVEN[3], JointKind::Prismatic, back(2));
        let given: Vec<String> =
            self.parts().given.iter().cloned().chain(GIVEN.map(|name| self.free(name, |joint| &joint.name))).collect();
        let symbol = self.free("azimuth", |joint| &joint.symbol);
        joints.push(Joint { symbol, axis: column(2), point: tip.point.clone(), limits: None, ..first.clone() });
        let axis = [first.point[0].clone(), first.point[1].clone()];
        let shift = [-&axis[0], -&axis[1], BigRational::zero()];
        let point = std::array::from_fn(|i| {
            (0..3).map(|k| &tip.rotation[i][k] * &shift[k]).sum::<BigRational>() + &tip.point[i]
        });
        let chain = Chain::new(ChainParts {
            joints,
            tip: Tip { point, rotation: tip.rotation.clone() },
            meant: None,
            task: Task::Pose,
            direction: along_z(),
            given,
            order: None,
            choice: None,
            ..self.parts().clone()
        })?;
        Ok(Upright { chain, axis, is_down: first.axis[2] < BigRational::zero() })
    }

    /// `name`, or `name` with a number appended if a joint already has it.
    fn free(&self, name: &str, of: impl Fn(&Joint) -> &String) -> String {
        let is_free = |name: &String| !self.joints().iter().any(|joint| of(joint) == name);
        let numbered = (2..).map(|k| format!("{name}{k}"));
        [name.to_owned()].into_iter().chain(numbered).find(is_free).unwrap_or_default()
    }
}

impl Upright {
    /// Converts a target of the task and the values of the chain's given joints to the target of the loop and the
    /// values of its given joints.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a target of another task.
    pub fn loop_target(&self, target: &Target, given: &[f64]) -> Result<(Target, Vec<f64>)> {
        let Target::PositionPitchRoll { point, pitch, roll } = *target else {
            return Err(Error::new(
                ErrorKind::BadValue,
                "the task is `position_pitch_roll`; give a target of that kind",
            ));
        };
        let [x, y] = self.seen_from_above();
        let radius = (point.x - x).hypot(point.y - y);
        let values = given.iter().copied().chain([roll, pitch, radius, point.z]).collect();
        Ok((Target::Pose(Pose::identity()), values))
    }

    /// Converts joint values of the loop to those of the chain.
    pub fn answer(&self, target: &Target, values: &[f64]) -> Vec<f64> {
        let Target::PositionPitchRoll { point, .. } = *target else { return Vec::new() };
        let [x, y] = self.seen_from_above();
        let azimuth = (point.y - y).atan2(point.x - x);
        let own = values.len() - GIVEN.len() - 2;
        let first = angle::wrap(values[values.len() - 1] + azimuth);
        let first = if self.is_down { angle::wrap(-first) } else { first };
        [first].into_iter().chain(values[..own].iter().copied()).collect()
    }

    /// The index in the chain of a joint of the loop; `None` for a joint that only the loop has.
    pub fn place(&self, joint: usize) -> Option<usize> {
        let count = self.chain.joints().len();
        let own = count - GIVEN.len() - 2;
        if joint + 1 == count { Some(0) } else { (joint < own).then_some(joint + 1) }
    }

    fn seen_from_above(&self) -> [f64; 2] {
        self.axis.each_ref().map(|x| x.to_f64().unwrap_or(0.0))
    }
}
