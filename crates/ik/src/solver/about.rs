//! What a program says of its source: [`About`].

use serde::{Deserialize, Serialize};

use groebot_robot::kinematics::Mimic;

/// What is known of a program's source, for people and for the heads of printed solvers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct About {
    /// What is asked of the tip: `pose`, `planar_pose in xz`, `position, ElbowYaw given`.
    pub task: String,
    /// The link where the chain starts, when the source names it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base: Option<String>,
    /// The link where the chain ends, when the source names it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tip: Option<String>,
    /// The number of complex solutions of a generic reachable target, where it was counted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solutions: Option<usize>,
    /// A hash of the source, in hexadecimal digits.
    pub hash: String,
    /// By joint: its least and greatest value in its unit, where the source says them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub limits: Vec<Option<(f64, f64)>>,
    /// By joint: how it follows another one; empty where none does.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub follows: Vec<Option<Mimic>>,
}
