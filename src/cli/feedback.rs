//! The stabiliser as the script of the simulation calls it: lines of numbers become states, targets become lines.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use serde::Deserialize;

use crate::{Error, ErrorKind, Result};
use groebot_humanoid::gait::{Biped, Walker};
use groebot_humanoid::stabilizer::{SoleForce, Stabilizer, State};
use groebot_robot::motion::Trajectory;

/// The time between two states \[s\].
const PERIOD: f64 = 0.005;
/// The answer of a stabiliser that finds no posture: the robot falls.
const LOST: &str = "lost\n";

/// The motors of the simulation.
#[derive(Deserialize)]
struct Motors {
    joints: Vec<String>,
    stiffness: Vec<f64>,
}

/// A stabiliser and the joints of the simulation.
#[derive(Clone)]
pub struct Feedback {
    stabilizer: Stabilizer,
    walker: Walker,
    /// For each joint of the simulation its place among those of the walker.
    joints: Vec<Option<usize>>,
}

impl Feedback {
    /// The feedback for a walk of `walker`.
    ///
    /// # Errors
    /// As [`Stabilizer::new`].
    pub fn new(walker: &Walker, walk: &Trajectory) -> Result<Self> {
        let stabilizer = Stabilizer::new(walker.clone(), walk)?;
        Ok(Feedback { stabilizer, walker: walker.clone(), joints: Vec::new() })
    }

    /// The biped that walks.
    pub fn biped(&self) -> &Biped {
        &self.walker.biped
    }

    /// The arguments of the script.
    pub fn arguments(&self) -> Vec<String> {
        let biped = &self.walker.biped;
        let frames = biped.feet.iter().flat_map(|foot| {
            let (_, torso_from_link) = biped.model.link(foot.link);
            let frame = torso_from_link.inv_mul(&foot.torso_from_sole);
            let (at, turn) = (frame.translation.vector, frame.rotation.coords);
            [at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w]
        });
        vec![format!("--feedback={PERIOD}"), format!("--soles={}", listed(&frames.collect::<Vec<_>>()))]
    }

    /// Reads the simulation's joints and the stiffness of their motors.
    pub fn start(&mut self, line: &str) -> Result<()> {
        let motors: Motors = serde_json::from_str(line).map_err(|error| {
            Error::new(ErrorKind::Syntax, format!("the output of the simulation is not understood: {error}"))
        })?;
        self.joints = motors.joints.iter().map(|name| self.walker.biped.joint(name).ok()).collect();
        // Joints without a motor follow others.
        let mut stiffness = vec![f64::INFINITY; self.walker.biped.joints.len()];
        for (joint, value) in self.joints.iter().zip(motors.stiffness) {
            if let Some(joint) = joint {
                stiffness[*joint] = value;
            }
        }
        self.stabilizer = self.stabilizer.clone().joint_stiffness(stiffness)?;
        Ok(())
    }

    /// The targets for a state, as lines.
    pub fn answer(&mut self, line: &str) -> Result<String> {
        let bad = || Error::new(ErrorKind::Syntax, "a state of the simulation is not understood");
        let numbers: Vec<f64> =
            line.split_whitespace().map(str::parse).collect::<std::result::Result<_, _>>().map_err(|_| bad())?;
        let count = self.joints.len();
        let (Some(time), Some(own), Some(rest)) =
            (numbers.first(), numbers.get(1..=count), numbers.get(count + 1..).filter(|rest| rest.len() == 19))
        else {
            return Err(bad());
        };
        let mut q = vec![0.0; self.walker.biped.joints.len()];
        for (value, joint) in own.iter().zip(&self.joints) {
            if let Some(joint) = joint {
                q[*joint] = *value;
            }
        }
        let vector = |at: usize| Vector3::new(rest[at], rest[at + 1], rest[at + 2]);
        let state = State {
            time: *time,
            q,
            orientation: UnitQuaternion::new_normalize(Quaternion::new(rest[3], rest[0], rest[1], rest[2])),
            angular_velocity: vector(4),
            soles: [7, 13].map(|at| SoleForce { force: vector(at), moment: vector(at + 3) }),
        };
        let targets = match self.stabilizer.step(&state) {
            Err(error) if error.kind() == ErrorKind::BadValue => return Ok(LOST.to_owned()),
            targets => targets?,
        };
        let of = |values: &[f64]| -> Vec<String> {
            self.joints.iter().map(|joint| joint.map_or(0.0, |joint| values[joint]).to_string()).collect()
        };
        Ok([of(&targets.positions), of(&targets.velocities)].concat().join(" ") + "\n")
    }
}

/// Numbers as an argument of the script.
pub fn listed(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(",")
}
