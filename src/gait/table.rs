//! A walk as a table, CSV or JSON.

use std::fmt::Write;

use serde_json::{Value, json};

use super::biped::Biped;
use super::footprint::Footprint;
use super::plan::{Gait, Walk};
use super::schedule::Action;
use super::summary::Summary;

/// The columns behind the joints.
const COLUMNS: [&str; 26] = [
    "torso_x",
    "torso_y",
    "torso_z",
    "torso_qx",
    "torso_qy",
    "torso_qz",
    "torso_qw",
    "left_x",
    "left_y",
    "left_z",
    "left_yaw",
    "left_stands",
    "right_x",
    "right_y",
    "right_z",
    "right_yaw",
    "right_stands",
    "com_x",
    "com_y",
    "com_z",
    "zmp_x",
    "zmp_y",
    "pendulum_x",
    "pendulum_y",
    "static_margin",
    "margin",
];

impl Walk {
    /// The walk as CSV, a row a sample: `time` \[s\], the joints by name \[rad\], the pose of the torso with its quaternion xyzw, for each
    /// foot its sole's position and heading and whether it stands (1 or 0), the centre of mass, the zero moment points of the multibody
    /// and of the pendulum, the static and the dynamic margin \[m\]. Nine decimals.
    pub fn to_csv(&self, biped: &Biped) -> String {
        let joints = biped.joints.iter().map(|joint| joint.name.as_str());
        let mut text = ["time"].into_iter().chain(joints).chain(COLUMNS).collect::<Vec<_>>().join(",");
        text.push('\n');
        for sample in 0..self.balances.len() {
            // Writing to a string cannot fail.
            let _ = write!(text, "{}", self.time(sample));
            for value in self.motion.postures[sample].q.iter().chain(&self.figures(sample)) {
                let _ = write!(text, ",{}", decimal(*value));
            }
            text.push('\n');
        }
        text
    }

    /// The figures of [`COLUMNS`].
    fn figures(&self, sample: usize) -> Vec<f64> {
        let (posture, balance, reference) =
            (&self.motion.postures[sample], &self.balances[sample], &self.references[sample]);
        let (at, turn) = (posture.world_from_torso.translation.vector, posture.world_from_torso.rotation.coords);
        let mut figures = vec![at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w];
        for (sole, stands) in reference.world_from_soles.iter().zip(reference.stands) {
            let (at, yaw) = (sole.translation.vector, sole.rotation.euler_angles().2);
            figures.extend([at.x, at.y, at.z, yaw, f64::from(u8::from(stands))]);
        }
        let centre = self.motion.centres[sample];
        figures.extend([centre.x, centre.y, centre.z, balance.zmp.x, balance.zmp.y]);
        figures.extend([balance.pendulum.x, balance.pendulum.y, balance.static_margin, balance.margin]);
        figures
    }

    /// The walk as JSON: robot, joints with limits and speeds, footsteps, phases, summary, and the samples as in [`Walk::to_csv`].
    pub fn to_json(&self, biped: &Biped) -> String {
        let joints = biped.joints.iter().map(
            |joint| json!({ "name": joint.name, "low": joint.limits.0, "high": joint.limits.1, "speed": joint.speed }),
        );
        let route = &self.schedule.route;
        let steps = route.steps.iter().map(|step| {
            let mut value = print(&step.print);
            value["foot"] = step.side.name().into();
            value
        });
        let value = json!({
            "robot": biped.name,
            "tick": self.schedule.tick,
            "joints": joints.collect::<Vec<_>>(),
            "start": { "left": print(&route.start[0]), "right": print(&route.start[1]) },
            "steps": steps.collect::<Vec<_>>(),
            "phases": self.phases(),
            "summary": summary(&Summary::of(biped, self)),
            "samples": (0..self.balances.len()).map(|sample| self.sample(sample)).collect::<Vec<_>>(),
        });
        value.to_string() + "\n"
    }

    fn phases(&self) -> Vec<Value> {
        let mut start = 0;
        let phase = |phase: &super::Phase| {
            let (action, step) = match phase.action {
                Action::Rest => ("rest", None),
                Action::Shift(step) => ("shift", Some(step + 1)),
                Action::Swing(step) => ("swing", Some(step + 1)),
                Action::Balance(step) => ("balance", Some(step + 1)),
                Action::Lower => ("lower", None),
                Action::Rise => ("rise", None),
            };
            let from = self.time(start);
            start += phase.samples;
            json!({ "action": action, "step": step, "from": from, "to": self.time(start), "slowed": phase.slowed })
        };
        self.schedule.phases.iter().map(phase).collect()
    }

    fn sample(&self, sample: usize) -> Value {
        let balance = &self.balances[sample];
        let mut value = json!({ "time": self.time(sample), "q": self.motion.postures[sample].q });
        for (name, figure) in COLUMNS.into_iter().zip(self.figures(sample)) {
            value[name] = figure.into();
        }
        value["support"] = balance.support.corners().iter().map(|corner| json!([corner.x, corner.y])).collect();
        value
    }
}

/// Nine decimals, without a negative zero.
pub(super) fn decimal(value: f64) -> String {
    let text = format!("{value:.9}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

fn print(print: &Footprint) -> Value {
    json!({ "x": print.x, "y": print.y, "yaw": print.yaw })
}

fn summary(summary: &Summary) -> Value {
    let extreme = |extreme: &super::Extreme| json!({ "value": extreme.value, "time": extreme.time });
    let joint = |(name, figure): &(String, super::Extreme)| json!({ "joint": name, "value": figure.value, "time": figure.time });
    json!({
        "gait": match summary.gait { Gait::Seed => "seed", Gait::Preview => "preview", Gait::OneStep(_) => "osg" },
        "steps": summary.steps,
        "duration": summary.duration,
        "stepping": summary.stepping,
        "point_mass": summary.is_point_mass,
        "distance": summary.distance,
        "turn": summary.turn,
        "torso_height": summary.torso_height,
        "speed": summary.speed,
        "margin": extreme(&summary.margin),
        "static_margin": extreme(&summary.static_margin),
        "pendulum_error": extreme(&summary.pendulum_error),
        "nearest_limit": joint(&summary.nearest_limit),
        "fastest": joint(&summary.fastest),
        "slowed_phases": summary.slowed.0,
        "slowest_factor": summary.slowed.1,
    })
}
