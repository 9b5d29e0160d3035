//! The solver of six axes as a step of a program ([`SixAxes`]).

use groebot_runtime::six_axes::{Chain, Formulations, Given, Rigid};
use serde::{Deserialize, Serialize};

use super::formulation::Formulation;
use super::layout::{GivenLine, Layout, Line};
use crate::{Error, ErrorKind, Result};
use crate::{JointValue, Operand};

/// A step that finds the unknowns of six joints together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "SixAxesParts", into = "SixAxesParts")]
pub struct SixAxes {
    parts: SixAxesParts,
    chain: Chain,
}

/// The parts of [`SixAxes`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SixAxesParts {
    /// The axes at zero joint values, from base to tip: directions of length one, points in the unit of the target.
    pub lines: [Line; 6],
    /// By joint, whether it is prismatic.
    #[serde(default, skip_serializing_if = "is_none")]
    pub slides: [bool; 6],
    /// A typical length of the chain, in the same unit.
    pub length: f64,
    /// The pose of the tip in the base frame at zero joint values.
    #[serde(with = "RigidParts")]
    pub tip: Rigid,
    /// The eigenvalue problems, in the order in which they are tried.
    pub formulations: Vec<Formulation>,
    /// The distance from this robot to the one on which solutions are polished, as a fraction of its reach and in rad. Zero if they are equal.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub within: f64,
    /// The unknowns that are set: angles, and values of the prismatic joints.
    pub joints: [JointValue; 6],
    /// The target: the position of the tip, then its rotation matrix by rows.
    pub target: [Operand; 12],
    /// The joints with given values between the six, from base to tip.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub given: Vec<GivenAxis>,
}

/// A joint with a given value between six joints that are found together.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GivenAxis {
    /// Its axis, at zero joint values.
    pub axis: GivenLine,
    /// Its value: the cosine and sine of its angle, or its displacement in the unit of the target and the constant 0.
    pub value: [Operand; 2],
}

/// The serialised form of a [`Rigid`].
#[derive(Serialize, Deserialize)]
#[serde(remote = "Rigid")]
struct RigidParts {
    rotation: [[f64; 3]; 3],
    translation: [f64; 3],
}

impl SixAxes {
    /// Makes the step.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a direction that is not of length one, a length that is not positive, or a joint value of the wrong type.
    /// [`ErrorKind::BadValue`] also for no formulation, or a formulation that does not exist for these joints.
    pub fn new(parts: SixAxesParts) -> Result<Self> {
        ensure(parts.lines.iter().all(Line::is_valid), "six axes: directions of length one are allowed")?;
        ensure(parts.length.is_finite() && parts.length > 0.0, "six axes: a positive length is allowed")?;
        ensure((0.0..=1.0).contains(&parts.within), "six axes: a tolerance from 0 to 1 is allowed")?;
        let suits = |(joint, slides): (&JointValue, &bool)| matches!(joint, JointValue::Plain(_)) == *slides;
        let suit = parts.joints.iter().zip(&parts.slides).all(suits);
        ensure(suit, "six axes: angles, and plain values of prismatic joints, are allowed")?;
        let count = parts.formulations.len();
        let known = (1..=Formulations::ROOM).contains(&count) && parts.formulations.iter().all(Formulation::is_valid);
        let suits = parts.given.len() <= Given::ROOM && parts.given.iter().all(|given| given.axis.is_valid());
        let text = "six axes: at most 8 given axes, each with a direction of length one after one of the first five joints, are allowed";
        ensure(suits, text)?;
        ensure(known, "six axes: 1 to 12 formulations, each of which hides one of joints 0 to 5, is allowed")?;
        let layout = Layout { lines: parts.lines, slides: parts.slides, length: parts.length };
        let chain = Chain { within: parts.within, ..layout.chain(&parts.tip, &parts.formulations) };
        Ok(SixAxes { parts, chain })
    }

    /// Its parts.
    pub fn parts(&self) -> &SixAxesParts {
        &self.parts
    }

    /// The chain in the types of the run time.
    #[doc(hidden)]
    pub fn chain(&self) -> Chain {
        self.chain
    }

    /// The given joints between the six, in the types of the run time.
    #[doc(hidden)]
    pub fn given(&self) -> Vec<Given> {
        self.parts.given.iter().map(|given| given.axis.scaled(self.parts.length)).collect()
    }

    /// The numbers that the run time needs: those of the target, then two for each given joint between the six.
    #[doc(hidden)]
    pub fn operands(&self) -> Vec<Operand> {
        let given = self.parts.given.iter().flat_map(|given| given.value);
        self.parts.target.into_iter().chain(given).collect()
    }

    /// Same step, for a robot at this distance, on which solutions are polished.
    ///
    /// # Errors
    /// As [`SixAxes::new`].
    pub fn within(&self, within: f64) -> Result<Self> {
        SixAxes::new(SixAxesParts { within, ..self.parts.clone() })
    }

    /// The step with other names of its unknowns and operands.
    pub(crate) fn renamed(
        &self,
        joint: impl Fn(JointValue) -> JointValue,
        operand: impl Fn(Operand) -> Operand,
    ) -> Self {
        let SixAxesParts { joints, target, given, .. } = self.parts.clone();
        let target = target.map(&operand);
        let given = given.into_iter().map(|given| GivenAxis { value: given.value.map(&operand), ..given }).collect();
        let parts = SixAxesParts { joints: joints.map(joint), target, given, ..self.parts.clone() };
        SixAxes { parts, ..self.clone() }
    }
}

impl TryFrom<SixAxesParts> for SixAxes {
    type Error = Error;

    fn try_from(parts: SixAxesParts) -> Result<Self> {
        SixAxes::new(parts)
    }
}

impl From<SixAxes> for SixAxesParts {
    fn from(step: SixAxes) -> Self {
        step.parts
    }
}

fn is_zero(within: &f64) -> bool {
    *within == 0.0
}

fn is_none(slides: &[bool; 6]) -> bool {
    *slides == [false; 6]
}

fn ensure(holds: bool, text: &str) -> Result<()> {
    if holds { Ok(()) } else { Err(Error::new(ErrorKind::BadValue, text)) }
}
