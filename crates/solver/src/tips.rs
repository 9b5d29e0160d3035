//! The meaning of a program's inputs: the tasks of its tips ([`TipTask`]), and its given joints ([`GivenJoint`]).

use std::fmt;
use std::ops::Range;

use serde::{Deserialize, Serialize};

use groebot_robot::kinematics::{Chain, ExactVector, Layout, Stated, TargetNumber, Task, exact_serde};

/// The task of a tip. Its numbers are consecutive inputs of a program, in the order of [`Task::layout`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TipTask {
    /// The name of the tip's chain, in a program of several chains.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub chain: Option<String>,
    /// The task.
    pub task: Task,
    /// The direction in the tip frame, for a task that [orients one](Task::aims).
    #[serde(default, skip_serializing_if = "Option::is_none", with = "exact_serde::optional_vector")]
    pub direction: Option<ExactVector>,
    /// The index of the input that is the first number of the task.
    pub first_input: usize,
}

/// A joint whose value the user gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GivenJoint {
    /// The index of the joint.
    pub joint: usize,
    /// The index of the input that is its value.
    pub input: usize,
}

impl TipTask {
    /// The task of the tip of `chain`, whose numbers are the first inputs.
    pub fn of(chain: &Chain) -> Self {
        let direction = chain.task().aims().then(|| chain.direction().clone());
        TipTask { chain: None, task: chain.task(), direction, first_input: 0 }
    }

    /// The numbers of the task.
    pub fn layout(&self) -> Layout {
        self.task.layout()
    }

    /// The indices of the inputs that are its numbers.
    pub fn inputs(&self) -> Range<usize> {
        self.first_input..self.first_input.saturating_add(self.layout().numbers().len())
    }

    /// The index of the input that is a number of the task.
    pub fn input(&self, number: TargetNumber) -> Option<usize> {
        self.layout().place(number).map(|place| self.first_input + place)
    }
}

/// The task with its chain, such as `pose` or `right: ray of [0, 0, 1]`.
impl fmt::Display for TipTask {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.chain.as_ref().map_or(Ok(()), |chain| write!(f, "{chain}: "))?;
        write!(f, "{}", Stated { task: self.task, direction: self.direction.as_ref() })
    }
}
