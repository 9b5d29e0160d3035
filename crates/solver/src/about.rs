//! Information about a program's source: [`About`].

use serde::{Deserialize, Serialize};

use groebot_robot::kinematics::Mimic;

/// Information about a program's source, for users and for the header comments of printed solvers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct About {
    /// The first link of the chain, if the source names it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base: Option<String>,
    /// The last link of the chain, if the source names it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tip: Option<String>,
    /// The number of complex solutions of a generic reachable target, if it was counted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solutions: Option<usize>,
    /// A hash of the source, in hexadecimal digits.
    pub hash: String,
    /// By joint, its least and greatest value in its unit, if the source gives them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub limits: Vec<Option<(f64, f64)>>,
    /// By joint, how it follows another one; empty where none does.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub follows: Vec<Option<Mimic>>,
}
