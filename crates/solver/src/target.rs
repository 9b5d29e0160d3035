//! Targets of a program: its inputs by their meaning ([`Program::numbers`]).

use super::joint::Unit;
use super::program::{Condition, Program};
use super::tips::TipTask;
use crate::{Error, ErrorKind, Result};
use groebot_robot::kinematics::{Layout, Quantity, Target};

impl Program {
    /// The task of the only tip; `None` for a program of equations, and for several tips.
    pub fn tip(&self) -> Option<&TipTask> {
        match self.tasks.as_slice() {
            [tip] => Some(tip),
            _ => None,
        }
    }

    /// Describes the target, for example `pose`, `position, ElbowYaw given`, `left: pose; right: ray of [0, 0, 1]`, `its equations`.
    pub fn task_text(&self) -> String {
        let tasks: Vec<String> = self.tasks.iter().map(TipTask::to_string).collect();
        let tasks = if tasks.is_empty() { "its equations".to_owned() } else { tasks.join("; ") };
        let given = self.given_names().join(", ");
        if given.is_empty() { tasks } else { format!("{tasks}, {given} given") }
    }

    /// The names of the given joints, in the order of their inputs.
    pub fn given_names(&self) -> Vec<&str> {
        self.given_joints.iter().map(|given| self.joints[given.joint].name.as_str()).collect()
    }

    /// Whether the user gives the value of a joint.
    pub fn is_given(&self, joint: usize) -> bool {
        self.given_joints.iter().any(|given| given.joint == joint)
    }

    /// The inputs for a target of the only tip and the values of the given joints, in the order of their inputs.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a target of another task, and for another number of values.
    pub fn numbers(&self, target: &Target, given: &[f64]) -> Result<Vec<f64>> {
        TargetInputs::of(self).numbers(target, given)
    }
}

/// The inputs of a program by their meaning.
#[derive(Clone, Debug)]
pub(super) struct TargetInputs {
    names: Vec<String>,
    /// The layout of the only tip's task, and its first input.
    tip: Option<(Layout, usize)>,
    given: Vec<usize>,
}

impl TargetInputs {
    pub fn of(program: &Program) -> Self {
        TargetInputs {
            names: program.inputs.iter().map(|input| input.name.clone()).collect(),
            tip: program.tip().map(|tip| (tip.layout(), tip.first_input)),
            given: program.given_joints.iter().map(|given| given.input).collect(),
        }
    }

    /// Same as [`Program::numbers`].
    pub fn numbers(&self, target: &Target, given: &[f64]) -> Result<Vec<f64>> {
        let Some((layout, first)) = &self.tip else { return Err(self.refusal("a target of one tip")) };
        let values = layout.values(target)?;
        if given.len() != self.given.len() || values.len() + given.len() != self.names.len() {
            let what = format!("a target of {} numbers and {} given values", values.len(), given.len());
            return Err(self.refusal(&what));
        }
        let mut numbers = vec![0.0; self.names.len()];
        numbers[*first..first + values.len()].copy_from_slice(&values);
        self.given.iter().zip(given).for_each(|(&input, &value)| numbers[input] = value);
        Ok(numbers)
    }

    fn refusal(&self, what: &str) -> Error {
        Error::new(ErrorKind::BadValue, format!("{what}; the solver needs {}", self.names.join(", ")))
    }
}

/// The condition on the inputs of a task.
pub(super) fn condition(tip: &TipTask) -> Option<Condition> {
    let layout = tip.layout();
    let rotation = layout.rotation().map(|place| Condition::Rotation(tip.first_input + place));
    rotation.or(layout.direction().map(|place| Condition::Unit(tip.first_input + place)))
}

/// The fault in the tasks and the given joints of a program, if there is one.
pub(super) fn fault(program: &Program) -> Option<&'static str> {
    let count = program.inputs.len();
    let mut users = vec![0_usize; count];
    for tip in &program.tasks {
        let inputs = tip.inputs();
        if inputs.end > count {
            return Some("tasks: an input does not exist");
        }
        let fits = |(input, number): (usize, Quantity)| has(program.inputs[input].unit, number);
        let numbers = tip.layout().numbers().iter().map(|number| number.quantity());
        if !inputs.clone().zip(numbers).all(fits) {
            return Some("tasks: an input has another unit than the number of its task");
        }
        if condition(tip).is_some_and(|condition| !program.conditions.contains(&condition)) {
            return Some("tasks: the condition of a rotation or of a direction is missing");
        }
        if tip.direction.is_some() != tip.task.aims() {
            return Some("tasks: a direction is for the tasks `ray`, `direction` and `position_yaw`, which need one");
        }
        inputs.for_each(|input| users[input] += 1);
    }
    for given in &program.given_joints {
        let (Some(joint), Some(input)) = (program.joints.get(given.joint), program.inputs.get(given.input)) else {
            return Some("given_joints: a joint or an input does not exist");
        };
        if joint.unit != input.unit {
            return Some("given_joints: a joint and its input have different units");
        }
        users[given.input] += 1;
    }
    let joints = program.given_joints.iter().map(|given| given.joint);
    let is_repeated = |joint: usize| program.given_joints.iter().filter(|given| given.joint == joint).count() > 1;
    let is_shared = users.iter().any(|&users| users > 1) || joints.into_iter().any(is_repeated);
    is_shared.then_some("an input or a given joint is used twice by tasks and given joints")
}

fn has(unit: Unit, quantity: Quantity) -> bool {
    match quantity {
        Quantity::Length => matches!(unit, Unit::Metre | Unit::Millimetre),
        Quantity::Angle => unit == Unit::Radian,
        Quantity::Number => unit == Unit::One,
    }
}
