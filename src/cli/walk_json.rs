//! The JSON output of `groebot walk`.

use serde_json::{Value, json};

use super::json::FORMAT;
use groebot_humanoid::gait::{Difference, Greatest, Summary};

/// The quantities of a walk that are reported.
pub struct WalkReport<'a> {
    pub summary: &'a Summary,
    /// The greatest torque of each joint, if forces were computed.
    pub torques: Option<Vec<Greatest>>,
    /// The differences between two chains and the whole multibody, if they were computed.
    pub chains: Option<Difference>,
    pub notes: &'a [String],
}

impl WalkReport<'_> {
    /// The report as JSON: metres, radians, seconds, N and N m.
    pub fn json(&self) -> Value {
        let mut value = self.summary.to_json();
        value["format"] = FORMAT.into();
        if let Some(torques) = &self.torques {
            value["torques"] = torques.iter().map(torque).collect();
        }
        if let Some(found) = &self.chains {
            value["chains"] = chains(found);
        }
        value["notes"] = self.notes.into();
        value
    }
}

fn torque(greatest: &Greatest) -> Value {
    json!({ "joint": greatest.joint, "torque": greatest.torque, "time": greatest.time, "effort": greatest.effort })
}

fn chains(found: &Difference) -> Value {
    let [force, moment] = found.between;
    json!({
        "greatest_difference": { "joint": found.joint, "torque": found.torque, "time": found.time },
        "swing_foot_force": found.swinging,
        "trunk_force": force,
        "trunk_moment": moment,
        "rounding_error": found.rounding,
    })
}
