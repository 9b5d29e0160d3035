//! The JSON output of `groebot walk`.

use serde_json::{Value, json};

use super::json::FORMAT;
use groebot_humanoid::gait::{Difference, Extreme, Gait, Greatest, Summary};

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
        let mut value = figures(self.summary);
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

fn figures(summary: &Summary) -> Value {
    let ([nearest, fastest], [room, ratio]) =
        ([&summary.nearest_limit.0, &summary.fastest.0], [&summary.nearest_limit.1, &summary.fastest.1]);
    let collision =
        |(links, depth): &([String; 2], Extreme)| json!({ "links": links, "depth": depth.value, "time": depth.time });
    json!({
        "format": FORMAT,
        "robot": summary.robot,
        "gait": match summary.gait {
            Gait::Sine => "sine",
            Gait::Preview => "preview control",
            Gait::OneStep(_) => "one step goal",
        },
        "steps": summary.steps,
        "duration": summary.duration,
        "stepping_duration": summary.stepping,
        "point_mass": summary.is_point_mass,
        "distance": summary.distance,
        "turn": summary.turn,
        "torso_height": summary.torso_height,
        "speed": summary.speed,
        "zmp_margin": extreme(&summary.margin),
        "static_margin": extreme(&summary.static_margin),
        "pendulum_zmp_error": extreme(&summary.pendulum_error),
        "nearest_limit": { "joint": nearest, "distance": room.value, "time": room.time },
        "greatest_velocity": { "joint": fastest, "fraction": ratio.value, "time": ratio.time },
        "collisions": summary.touching.iter().map(collision).collect::<Vec<_>>(),
        "sole_tilt": extreme(&summary.tilt),
        "slowed_phases": { "count": summary.slowed.0, "factor": summary.slowed.1 },
    })
}

fn extreme(extreme: &Extreme) -> Value {
    json!({ "value": extreme.value, "time": extreme.time })
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
