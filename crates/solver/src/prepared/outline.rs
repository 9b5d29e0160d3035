//! What a program says of its task and its joints. Main type: [`Outline`].

use crate::{Joint, Program, Unit};
use groebot_robot::kinematics::Task;

/// The task and the joints of a program.
#[derive(Clone, Debug)]
pub(crate) struct Outline {
    /// The task of the only tip; `None` for equations, and for several tips.
    pub task: Option<Task>,
    /// The number of inputs of the task, which come first.
    pub own: usize,
    /// The number of all inputs.
    pub inputs: usize,
    /// The typical length, in the unit of the inputs: the reach of a chain.
    pub scale: f64,
    pub joints: Vec<JointOutline>,
    /// Whether a step finds six joints together.
    pub eigenvalues: bool,
}

/// A joint of a program.
#[derive(Clone, Debug)]
pub(crate) struct JointOutline {
    pub is_angle: bool,
    /// The least and the greatest value, infinite for none.
    pub limits: [f64; 2],
    /// The input that is its value.
    pub given: Option<usize>,
    /// The index of its leader, the multiplier and the offset.
    pub follows: Option<(usize, [f64; 2])>,
}

impl Outline {
    pub fn new(program: &Program) -> Self {
        let (limits, follows) = (program.limits(), program.follows());
        let index = |name: &str| program.joints.iter().position(|joint| joint.name == name);
        let input =
            |place: usize| program.given_joints.iter().find(|given| given.joint == place).map(|given| given.input);
        let joint = |(place, joint): (usize, &Joint)| JointOutline {
            is_angle: joint.unit == Unit::Radian,
            limits: limits[place],
            given: input(place),
            follows: follows[place].and_then(|mimic| Some((index(&mimic.leader)?, mimic.law()))),
        };
        let tip = program.tip().filter(|tip| tip.first_input == 0);
        Outline {
            task: tip.map(|tip| tip.task),
            own: tip.map_or(0, |tip| tip.inputs().len()),
            inputs: program.inputs.len(),
            scale: program.scale,
            joints: program.joints.iter().enumerate().map(joint).collect(),
            eigenvalues: program.has_six_axes(),
        }
    }

    /// The joints that are neither given nor follow others.
    pub fn independent(&self) -> Vec<usize> {
        let is_free = |joint: &usize| self.joints[*joint].given.is_none() && self.joints[*joint].follows.is_none();
        (0..self.joints.len()).filter(is_free).collect()
    }

    /// Whether another joint follows this one.
    pub fn leads(&self, joint: usize) -> bool {
        self.joints.iter().any(|other| other.follows.is_some_and(|(leader, _)| leader == joint))
    }

    /// Sets the joints that follow others.
    pub fn follow(&self, q: &mut [f64]) {
        for (joint, outline) in self.joints.iter().enumerate() {
            if let Some((leader, [factor, offset])) = outline.follows.filter(|_| outline.given.is_none()) {
                q[joint] = factor * q[leader] + offset;
            }
        }
    }

    /// The sum of `rates` of the joints that follow `leader`, each times its multiplier.
    pub fn followed(&self, leader: usize, rates: &[f64]) -> f64 {
        let rate = |(joint, outline): (usize, &JointOutline)| match outline.follows {
            Some((own, [factor, _])) if own == leader && outline.given.is_none() => factor * rates[joint],
            _ => 0.0,
        };
        self.joints.iter().enumerate().map(rate).sum()
    }
}
