//! The parts of a serial chain in exact numbers: joints, tip and task. Main type: [`ChainParts`].

use serde::{Deserialize, Serialize};

use super::task::Task;
use super::{ExactMatrix, ExactVector, LengthUnit, Mimic, exact_serde};
use crate::spatial::exact::vector::unit;

/// Default tolerance of the idealisation: radians, and fractions of the reach.
pub const TOLERANCE: f64 = 1e-6;
/// Maximum tolerance of the idealisation.
pub(crate) const WIDEST: f64 = 0.1;

/// Type of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JointKind {
    /// Rotates about its axis, right-handed, by an angle in radians.
    Revolute,
    /// Translates along the unit vector of its axis by a distance in the chain's length unit.
    Prismatic,
}

/// One joint: a screw in the base frame at the zero configuration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Joint {
    /// The joint's name in the robot's documents, unique in the chain.
    pub name: String,
    /// The suffix of c, s or d in the names of its unknowns: ASCII letters and digits, unique in the chain.
    pub symbol: String,
    /// The type of the joint.
    pub kind: JointKind,
    /// The direction of the axis as given: nonzero, of any length.
    #[serde(with = "exact_serde::vector")]
    pub axis: ExactVector,
    /// A point on the axis.
    #[serde(with = "exact_serde::vector")]
    pub point: ExactVector,
    /// Minimum and maximum value, in radians (revolute) or the chain's length unit (prismatic).
    pub limits: Option<(f64, f64)>,
    /// The leader of a mimic joint.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mimic: Option<Mimic>,
}

impl Joint {
    /// The names of its unknowns: c3, s3 (the cosine and sine of its angle) when revolute, d3 when prismatic.
    pub fn unknowns(&self) -> Vec<String> {
        let prefixes: &[&str] = match self.kind {
            JointKind::Revolute => &["c", "s"],
            JointKind::Prismatic => &["d"],
        };
        prefixes.iter().map(|prefix| format!("{prefix}{}", self.symbol)).collect()
    }
}

/// The tip frame in the base frame at the zero configuration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tip {
    /// Its origin.
    #[serde(with = "exact_serde::vector")]
    pub point: ExactVector,
    /// Its rotation matrix, base_from_tip: the columns are the tip's axes.
    #[serde(with = "exact_serde::matrix")]
    pub rotation: ExactMatrix,
}

/// The exact axes and tip that the rounded numbers of a description approximate, where these differ: 1.5708 means a
/// quarter turn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Meant {
    /// The joints. Only their axes and points differ from the chain's.
    pub joints: Vec<Joint>,
    /// The tip.
    pub tip: Tip,
}

/// Selection of a root of a quadratic equation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Root {
    /// (-b - sqrt(b^2 - 4ac)) / (2a), as in NAO (6.7.9) and (6.7.20).
    Minus,
    /// (-b + sqrt(b^2 - 4ac)) / (2a).
    Plus,
}

/// A selection among the solutions: one root of the quadratic equation in one unknown.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Choice {
    /// The unknown of the quadratic equation.
    pub unknown: String,
    /// The selected root.
    pub root: Root,
}

/// The plain data of a [`Chain`](super::Chain), not yet validated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChainParts {
    /// The name of the mechanism.
    pub name: String,
    /// Description of the mechanism.
    pub description: Option<String>,
    /// Source of its numbers.
    pub source: Option<String>,
    /// The unit of every length.
    pub length_unit: LengthUnit,
    /// The joints from base to tip, 1 to 12 of them.
    pub joints: Vec<Joint>,
    /// The tip frame.
    pub tip: Tip,
    /// The exact joints and tip, where they differ from the described ones. [`Chain::ideal`](super::Chain::ideal)
    /// starts from these.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub meant: Option<Box<Meant>>,
    /// The task of the tip.
    pub task: Task,
    /// The direction in the tip frame for the tasks `ray` and `direction`: nonzero, of any length.
    #[serde(with = "exact_serde::vector", default = "along_z")]
    pub direction: ExactVector,
    /// The names of the given joints: each once, and not all joints.
    #[serde(default)]
    pub given: Vec<String>,
    /// All unknowns from the greatest to the smallest, if a term order is requested.
    pub order: Option<Vec<String>>,
    /// The selected root, if one is selected.
    pub choice: Option<Choice>,
}

/// The default direction: the tip's z axis.
pub fn along_z() -> ExactVector {
    unit(2)
}

impl Meant {
    /// `joints` and `tip`, unless they are equal to the described ones.
    pub(super) fn unless_described(joints: Vec<Joint>, tip: Tip, described: (&[Joint], &Tip)) -> Option<Box<Meant>> {
        (joints != described.0 || tip != *described.1).then(|| Box::new(Meant { joints, tip }))
    }
}
