//! Programs as JSON: format 3, and format 2, which describes the target as text ([`Program::from_json`]).

use serde::{Deserialize, Serialize};

use super::program::{Input, Program};
use super::target::condition;
use super::tips::{GivenJoint, TipTask};
use crate::Result;
use groebot_algebra::number::parse_rational;
use groebot_robot::document::{JsonFormat, json_text};
use groebot_robot::kinematics::{ExactVector, Stated, Task};

const FORMAT: JsonFormat =
    JsonFormat { what: "program", oldest: 2, number: 3, renew: "`groebot derive` on its folder writes it again" };

impl Program {
    /// Reads a program from JSON of format 2 or 3 and validates it.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Syntax`] with the line; [`crate::ErrorKind::Unsupported`] for JSON of another format, such
    /// as that of an older groebot, with the command that updates it; [`crate::ErrorKind::BadValue`] as
    /// [`Program::validate`].
    pub fn from_json(text: &str) -> Result<Self> {
        let (format, mut program): (u32, Program) = FORMAT.read_version(text)?;
        if format == 2 {
            let described: Described = FORMAT.read_version(text)?.1;
            program.interpret(described.about.and_then(|about| about.task).as_deref());
        }
        program.validate()?;
        Ok(program)
    }

    /// The program as JSON of format 3 ([`json_text`]).
    pub fn to_json(&self) -> String {
        #[derive(Serialize)]
        struct Written<'a> {
            format: u32,
            #[serde(flatten)]
            program: &'a Program,
        }
        json_text(&Written { format: FORMAT.number, program: self })
    }
}

/// The description of the target in format 2.
#[derive(Deserialize)]
struct Described {
    about: Option<AboutTask>,
}

#[derive(Deserialize)]
struct AboutTask {
    /// Text such as `pose`, `ray of [1, 0, 0], A3 given`, `left: pose; right: position`, `its equations`.
    task: Option<String>,
}

impl Program {
    /// Sets the tasks and the given joints of a program of format 2.
    ///
    /// Each task of `described` is assigned to the inputs with the names of its numbers. Other inputs are given joints with the same name. Without a
    /// description, the task is the one with the most numbers that match the first inputs.
    fn interpret(&mut self, described: Option<&str>) {
        let tasks = match described {
            Some(text) => text.split("; ").filter_map(|text| self.described_task(text)).collect(),
            None => {
                let fits = Task::all().into_iter().filter(|task| self.is_at(*task, 0, None));
                let most = fits.max_by_key(|task| task.layout().numbers().len());
                let direction = |task: Task| task.aims().then(|| task.usual_direction());
                let tip = |task| TipTask { chain: None, task, direction: direction(task), first_input: 0 };
                most.map(tip).into_iter().collect()
            }
        };
        self.tasks = tasks;
        let is_free = |input: &usize| !self.tasks.iter().any(|tip| tip.inputs().contains(input));
        let given = |input: usize| {
            let joint = self.joints.iter().position(|joint| joint.name == self.inputs[input].name)?;
            Some(GivenJoint { joint, input })
        };
        let given: Vec<GivenJoint> = (0..self.inputs.len()).filter(is_free).filter_map(given).collect();
        let is_whole =
            self.tasks.iter().map(|tip| tip.inputs().len()).sum::<usize>() + given.len() == self.inputs.len();
        if is_whole { self.given_joints = given } else { self.tasks.clear() }
    }

    /// The task of a text such as `ray of [1, 0, 0], A3 given` or `right: position`.
    fn described_task(&self, text: &str) -> Option<TipTask> {
        let (chain, text) = text.split_once(": ").map_or((None, text), |(chain, text)| (Some(chain), text));
        let stated = Task::all().into_iter().find_map(|task| {
            let rest = text.strip_prefix(&Stated { task, direction: None }.to_string())?;
            let direction = rest.strip_prefix(" of ").and_then(vector);
            (rest.is_empty() || rest.starts_with(", ") || direction.is_some()).then_some((task, direction))
        });
        let (task, direction) = stated?;
        let places = if chain.is_some() { self.inputs.len() } else { 1 };
        let first_input = (0..places).find(|first| self.is_at(task, *first, chain))?;
        let direction = task.aims().then(|| direction.unwrap_or_else(|| task.usual_direction()));
        Some(TipTask { chain: chain.map(str::to_owned), task, direction, first_input })
    }

    /// Whether the inputs from `first` on have the names and the condition of the numbers of `task`. In a program of several chains, the names have the chain's
    /// name as prefix.
    fn is_at(&self, task: Task, first: usize, chain: Option<&str>) -> bool {
        let layout = task.layout();
        let Some(inputs) = self.inputs.get(first..first + layout.numbers().len()) else { return false };
        let is_named = |name: &str, number: &str| match chain {
            None => name == number,
            Some(chain) => name.strip_prefix(chain).is_some_and(|rest| rest.trim_start_matches('_') == number),
        };
        let is_number = |(input, number): (&Input, String)| is_named(&input.name, &number);
        let named = inputs.iter().zip(layout.names()).all(is_number);
        let tip = TipTask { chain: None, task, direction: None, first_input: first };
        named && condition(&tip).is_none_or(|condition| self.conditions.contains(&condition))
    }
}

/// The vector at the start of a text such as `[1/2, 0, 1]`.
fn vector(text: &str) -> Option<ExactVector> {
    let (inner, _) = text.strip_prefix('[')?.split_once(']')?;
    let entries: Option<Vec<_>> = inner.split(", ").map(|entry| parse_rational(entry).ok()).collect();
    entries?.try_into().ok()
}
