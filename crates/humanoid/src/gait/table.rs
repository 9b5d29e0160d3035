//! Tables of a walk: its trajectory, CSV and JSON.

use nalgebra::{Point2, Point3};
use serde_json::{Value, json};

use super::balance::Balance;
use super::biped::Biped;
use super::footprint::{Footprint, Side};
use super::plan::Walk;
use super::request::Gait;
use super::schedule::Action;
use super::summary::{Extreme, Summary};
use groebot_robot::motion::{Contact, Figure, JointTrack, Track, Trajectory};

impl Walk {
    /// The walk as a trajectory. Its base is the root link and its contacts are the soles `left` and `right`. Its points
    /// are the centre of mass `com` and the zero moment points of the multibody, `zmp`, and of the pendulum,
    /// `pendulum`. Its figures are `static_margin` and `margin` \[m\].
    pub fn trajectory(&self, biped: &Biped) -> Trajectory {
        let joint = |range: &super::JointRange| JointTrack {
            name: range.name.clone(),
            slides: false,
            limits: Some(range.limits).filter(|(low, high)| low.is_finite() && high.is_finite()),
            speed: Some(range.speed).filter(|speed| speed.is_finite()),
        };
        let contact = |side: Side| Contact {
            name: side.name().to_owned(),
            poses: self.references.iter().map(|reference| reference.world_from_soles[side as usize]).collect(),
            stands: self.references.iter().map(|reference| reference.stands[side as usize]).collect(),
        };
        let floor = |name: &str, point: fn(&Balance) -> Point2<f64>| Track {
            name: name.to_owned(),
            at: self.balances.iter().map(point).map(|point| Point3::new(point.x, point.y, 0.0)).collect(),
        };
        let figure = |name: &str, value: fn(&Balance) -> f64| Figure {
            name: name.to_owned(),
            unit: "m".to_owned(),
            values: self.balances.iter().map(value).collect(),
        };
        let postures = &self.motion.postures;
        Trajectory {
            robot: biped.name.clone(),
            joints: biped.joints.iter().map(joint).collect(),
            times: (0..self.balances.len()).map(|sample| self.time(sample)).collect(),
            q: postures.iter().map(|posture| posture.q.clone()).collect(),
            base: postures.iter().map(|posture| posture.world_from_torso * biped.torso_from_root).collect(),
            contacts: vec![contact(Side::Left), contact(Side::Right)],
            points: vec![
                Track { name: "com".to_owned(), at: self.motion.centres.clone() },
                floor("zmp", |balance| balance.zmp),
                floor("pendulum", |balance| balance.pendulum),
            ],
            figures: vec![
                figure("static_margin", |balance| balance.static_margin),
                figure("margin", |balance| balance.margin),
            ],
        }
    }

    /// The walk's trajectory as CSV: [`groebot_robot::motion::table`].
    pub fn to_csv(&self, biped: &Biped) -> String {
        self.trajectory(biped).to_csv()
    }

    /// The walk's trajectory as JSON, with additional data under `walk`: the time between two samples, footsteps,
    /// phases, summary, and the support polygons.
    pub fn to_json(&self, biped: &Biped) -> String {
        self.json_of(biped, &self.trajectory(biped))
    }

    /// Same as [`Walk::to_json`], but with another trajectory of this walk: [`Walk::trajectory_with_forces`].
    pub fn json_of(&self, biped: &Biped, trajectory: &Trajectory) -> String {
        self.json_value(biped, trajectory).to_string() + "\n"
    }

    /// The JSON value that [`Walk::json_of`] writes.
    pub fn json_value(&self, biped: &Biped, trajectory: &Trajectory) -> Value {
        let route = &self.schedule.route;
        let steps = route.steps.iter().map(|step| {
            let mut value = print(&step.print);
            value["foot"] = step.side.name().into();
            value
        });
        let support = |balance: &Balance| -> Value {
            balance.support.corners().iter().map(|corner| json!([corner.x, corner.y])).collect()
        };
        let mut value = trajectory.to_json();
        value["walk"] = json!({
            "tick": self.schedule.tick,
            "start": { "left": print(&route.start[0]), "right": print(&route.start[1]) },
            "steps": steps.collect::<Vec<_>>(),
            "phases": self.phases(),
            "summary": Summary::of(biped, self).to_json(),
            "support": self.balances.iter().map(support).collect::<Vec<_>>(),
        });
        value
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
}

fn print(print: &Footprint) -> Value {
    json!({ "x": print.x, "y": print.y, "yaw": print.yaw })
}

impl Summary {
    /// Converts the figures to JSON, for the report of a walk and for its motion file: metres, radians, seconds. The
    /// keys are those of the entry `walk` in `docs/cli_schema.json`, from `robot` to `slowed_phases`.
    pub fn to_json(&self) -> Value {
        let extreme = |extreme: &Extreme| json!({ "value": extreme.value, "time": extreme.time });
        let ([nearest, fastest], [room, ratio]) =
            ([&self.nearest_limit.0, &self.fastest.0], [&self.nearest_limit.1, &self.fastest.1]);
        let collision = |(links, depth): &([String; 2], Extreme)| json!({ "links": links, "depth": depth.value, "time": depth.time });
        json!({
            "robot": self.robot,
            "gait": match self.gait {
                Gait::Sine => "sine",
                Gait::Preview => "preview control",
                Gait::OneStep(_) => "one step goal",
            },
            "steps": self.steps,
            "duration": self.duration,
            "stepping_duration": self.stepping,
            "point_mass": self.is_point_mass,
            "distance": self.distance,
            "turn": self.turn,
            "torso_height": self.torso_height,
            "speed": self.speed,
            "zmp_margin": extreme(&self.margin),
            "static_margin": extreme(&self.static_margin),
            "pendulum_zmp_error": extreme(&self.pendulum_error),
            "nearest_limit": { "joint": nearest, "distance": room.value, "time": room.time },
            "greatest_velocity": { "joint": fastest, "fraction": ratio.value, "time": ratio.time },
            "collisions": self.touching.iter().map(collision).collect::<Vec<_>>(),
            "sole_tilt": extreme(&self.tilt),
            "slowed_phases": { "count": self.slowed.0, "factor": self.slowed.1 },
        })
    }
}
