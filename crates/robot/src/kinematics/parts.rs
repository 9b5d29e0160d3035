//! What a serial chain is made of, with exact numbers: joints, tip, and what is asked of it. Main type: [`ChainParts`].

use num_traits::{One, ToPrimitive, Zero};
use serde::{Deserialize, Serialize};

use super::task::Task;
use super::{ExactMatrix, ExactVector, LengthUnit, Mimic, exact_serde};
use groebot_algebra::number::BigRational;

/// What holds within this is meant, unless another tolerance is asked for: radians, and shares of the reach.
pub const TOLERANCE: f64 = 1e-6;
/// The greatest tolerance that may be asked for.
pub const WIDEST: f64 = 0.1;

/// How a joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JointKind {
    /// It turns about its axis, right-handed, by an angle in radians.
    Revolute,
    /// It slides along the unit vector of its axis by a distance in the chain's length unit.
    Prismatic,
}

/// One joint: a screw in the base frame at the zero configuration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Joint {
    /// The name in the robot's own documents; unique in the chain.
    pub name: String,
    /// What follows c, s or d in the names of its unknowns; ASCII letters and digits, unique in the chain.
    pub symbol: String,
    /// How it moves.
    pub kind: JointKind,
    /// The direction of the axis as given: not zero, of any length.
    #[serde(with = "exact_serde::vector")]
    pub axis: ExactVector,
    /// A point on the axis.
    #[serde(with = "exact_serde::vector")]
    pub point: ExactVector,
    /// Least and greatest value, in radians (revolute) or the chain's length unit (prismatic).
    pub limits: Option<(f64, f64)>,
    /// The joint of the chain that it follows, if it does.
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

/// The axes and the tip that a description's rounded numbers mean, 1.5708 for a quarter turn, where these differ from what they say.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Meant {
    /// The joints: those of the chain, but for axes and points.
    pub joints: Vec<Joint>,
    /// The tip.
    pub tip: Tip,
}

/// Which root of a quadratic is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Root {
    /// (-b - sqrt(b^2 - 4ac)) / (2a), as in NAO (6.7.9) and (6.7.20).
    Minus,
    /// (-b + sqrt(b^2 - 4ac)) / (2a).
    Plus,
}

/// A choice among the solutions: one root of the quadratic in one unknown.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Choice {
    /// The unknown whose quadratic it is.
    pub unknown: String,
    /// The root that is taken.
    pub root: Root,
}

/// The plain data of a [`Chain`](super::Chain), not yet checked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChainParts {
    /// The name of the mechanism.
    pub name: String,
    /// What it is.
    pub description: Option<String>,
    /// Where its figures come from.
    pub source: Option<String>,
    /// The unit of every length.
    pub length_unit: LengthUnit,
    /// The joints from base to tip, 1 to 12 of them.
    pub joints: Vec<Joint>,
    /// The tip frame.
    pub tip: Tip,
    /// What joints and tip mean, where that is something else than they say: what [`Chain::ideal`](super::Chain::ideal) begins with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub meant: Option<Box<Meant>>,
    /// What is asked of the tip.
    pub task: Task,
    /// The direction in the tip frame that the tasks `ray` and `direction` aim: not zero, of any length.
    #[serde(with = "exact_serde::vector", default = "along_z")]
    pub direction: ExactVector,
    /// The names of the joints whose values the user gives: each once, and not all of them.
    #[serde(default)]
    pub given: Vec<String>,
    /// All unknowns from the greatest to the smallest, when a term order is asked for.
    pub order: Option<Vec<String>>,
    /// The root that is taken, when one is chosen.
    pub choice: Option<Choice>,
}

/// The direction that is aimed when none is named: the tip's z axis.
pub fn along_z() -> ExactVector {
    [BigRational::zero(), BigRational::zero(), BigRational::one()]
}

impl Meant {
    /// `joints` and `tip`, unless they are those of the description.
    pub(super) fn unless_told(joints: Vec<Joint>, tip: Tip, told: (&[Joint], &Tip)) -> Option<Box<Meant>> {
        (joints != told.0 || tip != *told.1).then(|| Box::new(Meant { joints, tip }))
    }
}

/// `[1/2, 0, 1]`.
pub(super) fn show(vector: &ExactVector) -> String {
    let [x, y, z] = vector.each_ref().map(|entry| match entry.to_string() {
        short if short.len() <= 24 => short,
        _ => entry.to_f64().unwrap_or(f64::NAN).to_string(),
    });
    format!("[{x}, {y}, {z}]")
}
