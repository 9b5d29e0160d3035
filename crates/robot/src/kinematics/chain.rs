//! The validated, immutable model of a serial chain, with exact numbers: 0.1029 is 1029/10000.
//!
//! [`ChainParts`] is plain data; [`Chain::new`] checks it. Axes, points and the tip are given in the base frame at the
//! zero configuration, as in the product of exponentials (RH0 2.1.4).

use std::fmt;

use serde::{Deserialize, Serialize};

use super::doubles::Numeric;
use super::parts::{ChainParts, Choice, Joint, JointKind, Tip};
use super::task::{Stated, Task};
use super::validate::{self, Fault, Part};
use super::{ExactVector, LengthUnit};
use crate::spatial::exact::vector::show;
use crate::{Error, ErrorKind, Result};

/// A validated serial chain. It is immutable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "ChainParts", into = "ChainParts")]
pub struct Chain {
    parts: ChainParts,
    pub(super) numeric: Numeric,
}

impl Chain {
    /// Validates `parts` and builds the chain.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] for no joints, more than 12 joints, an axis of zero, inverted or infinite limits,
    /// a coordinate above 10^12, a tip matrix that is not a rotation, a joint that leaves the plane of a planar task by
    /// more than 0.1 rad, a direction of zero, all joints given, an incomplete order, an empty name, or a symbol that
    /// is not 1 to 16 ASCII letters and digits; [`crate::ErrorKind::DuplicateName`] for joint names, symbols, given
    /// joints or unknowns of `order` named twice; [`crate::ErrorKind::UnknownName`] for an unknown or a given joint
    /// that does not belong to the chain.
    pub fn new(parts: ChainParts) -> Result<Self> {
        Chain::assemble(parts).map_err(|fault| fault.error)
    }

    pub(super) fn assemble(parts: ChainParts) -> std::result::Result<Self, Fault> {
        validate::check(&parts)?;
        let numeric = Numeric::of(&parts).map_err(|error| Fault { part: Part::Chain, key: "joint", error })?;
        Ok(Chain { parts, numeric })
    }

    /// Same mechanism, but with another task, another direction of the tip frame for the tasks `ray` and `direction`,
    /// and other given joints. The order and the choice are kept.
    ///
    /// # Errors
    /// Those of [`Chain::new`] for a zero direction, unknown joints, and joints that leave a task's plane.
    pub fn with_task(&self, task: Task, direction: ExactVector, given: Vec<String>) -> Result<Self> {
        Chain::new(ChainParts { task, direction, given, ..self.parts.clone() })
    }

    /// The plain data of this chain.
    pub fn parts(&self) -> &ChainParts {
        &self.parts
    }

    /// The name of the mechanism.
    pub fn name(&self) -> &str {
        &self.parts.name
    }

    /// The unit of every length.
    pub fn length_unit(&self) -> LengthUnit {
        self.parts.length_unit
    }

    /// The joints from base to tip.
    pub fn joints(&self) -> &[Joint] {
        &self.parts.joints
    }

    /// The tip frame at the zero configuration.
    pub fn tip(&self) -> &Tip {
        &self.parts.tip
    }

    /// The task of the tip.
    pub fn task(&self) -> Task {
        self.parts.task
    }

    /// The direction in the tip frame for the tasks `ray` and `direction`, of any length.
    pub fn direction(&self) -> &ExactVector {
        &self.parts.direction
    }

    /// The indices of the given joints and of their mimic joints, from base to tip.
    pub fn given(&self) -> Vec<usize> {
        let is_named = |name: &String| self.parts.given.contains(name);
        let is_given = |joint: &Joint| is_named(joint.mimic.as_ref().map_or(&joint.name, |mimic| &mimic.leader));
        self.joints().iter().enumerate().filter(|(_, joint)| is_given(joint)).map(|(place, _)| place).collect()
    }

    /// Checks that there is one finite value for each given joint that is not a mimic joint.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] with their names.
    pub(crate) fn check_given(&self, values: &[f64]) -> Result<()> {
        let count = self.given_inputs().len();
        if values.len() == count && values.iter().all(|value| value.is_finite()) {
            return Ok(());
        }
        let names = self.parts.given.join(", ");
        let text = format!("{} values are given; give a finite one for each of {count} joints: {names}", values.len());
        Err(Error::new(ErrorKind::BadValue, text))
    }

    /// All unknowns from the greatest to the smallest, if a term order is requested.
    #[doc(hidden)]
    pub fn order(&self) -> Option<&[String]> {
        self.parts.order.as_deref()
    }

    /// The selected root, if one is selected.
    #[doc(hidden)]
    pub fn choice(&self) -> Option<&Choice> {
        self.parts.choice.as_ref()
    }

    /// The names of all unknowns, joint by joint from the base: c1, s1, c2, s2, d3 ...
    #[doc(hidden)]
    pub fn unknowns(&self) -> Vec<String> {
        self.joints().iter().flat_map(Joint::unknowns).collect()
    }
}

impl TryFrom<ChainParts> for Chain {
    type Error = crate::Error;

    fn try_from(parts: ChainParts) -> Result<Self> {
        Chain::new(parts)
    }
}

impl From<Chain> for ChainParts {
    fn from(chain: Chain) -> Self {
        chain.parts
    }
}

impl Chain {
    /// Describes the task: `planar_pose in xz`, `ray of [1, 0, 0]`, `position, ElbowYaw given`.
    pub fn task_text(&self) -> String {
        let stated = Stated { task: self.task(), direction: self.task().aims().then(|| self.direction()) };
        let given = &self.parts.given;
        let given = if given.is_empty() { String::new() } else { format!(", {} given", given.join(", ")) };
        format!("{stated}{given}")
    }
}

/// A short table, one line for each joint.
impl fmt::Display for Chain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: {}, lengths in {}", self.name(), self.task_text(), self.length_unit().symbol())?;
        for joint in self.joints() {
            let (kind, limits) = match (joint.kind, joint.limits) {
                (JointKind::Revolute, Some((low, high))) => {
                    ("turns about", format!(", {:.2}..{:.2} deg", low.to_degrees(), high.to_degrees()))
                }
                (JointKind::Prismatic, Some((low, high))) => ("slides along", format!(", {low}..{high}")),
                (JointKind::Revolute, None) => ("turns about", String::new()),
                (JointKind::Prismatic, None) => ("slides along", String::new()),
            };
            let (unknowns, axis, point) = (joint.unknowns().join(" "), show(&joint.axis), show(&joint.point));
            let follows = joint.mimic.as_ref().map(|mimic| format!(", follows {mimic}")).unwrap_or_default();
            writeln!(f, "  {unknowns:<6} {:<14} {kind} {axis} through {point}{limits}{follows}", joint.name)?;
        }
        write!(f, "  tip at {}", show(&self.tip().point))
    }
}
