//! The request for a solver beyond the description: the links of a robot, a task, joints with given values. Main type: [`Ends`].
//!
//! In a mechanism's folder, the file [`TASK_NAME`] stores the request:
//!
//! ```toml
//! base = "torso"
//! tip = "l_hand"
//! given = ["LElbowYaw"]
//!
//! [task]
//! kind = "ray"
//! direction = [1, 0, 0]
//! ```
//!
//! Every key is optional. `task` and `given` are as in [`chain.toml`](mod@groebot_robot::kinematics::chain_toml). `snap = 1e-5` sets the tolerance of the
//! search for the ideal robot. `redundant = true` with one given joint derives the solvers with each joint given. `snap = 0` uses every digit. See [`Chain::ideal_within`].

use std::path::Path;

use num_traits::ToPrimitive;

use crate::derive::planner::Choice;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits::{RUN_TIME_FILES, check_name};
use groebot_algebra::number::BigRational;
use groebot_robot::document::{Document, TEXT_LIMIT, read_text, shown, word};
use groebot_robot::kinematics::chain_toml::{read_given, read_task};
use groebot_robot::kinematics::ideal::{Report, TOLERANCE};
use groebot_robot::kinematics::{Chain, ChainParts, ExactVector, Plane, Task};

/// The name of the file in a mechanism's folder with the request for its input.
pub const TASK_NAME: &str = "0_task.toml";

/// The request for a chain: its end links, its task and options.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Ends {
    /// The link where the chain starts; by default the root.
    pub base: Option<String>,
    /// The link where the chain ends; by default the only leaf.
    pub tip: Option<String>,
    /// The task of the tip; by default the task of the description.
    pub task: Option<Task>,
    /// The direction in the tip frame that the task orients; by default that of the description, else z.
    pub direction: Option<ExactVector>,
    /// The joints whose values the user gives. If empty, those that the description names.
    pub given: Vec<String>,
    /// Whether the planner chooses any number of joints to give: [`Ends::AUTO`].
    pub chooses: bool,
    /// Whether the solver finds all solutions within limits of a chain with one redundant joint: one solver for each joint as the given one. The joint in `given`
    /// is that of the main solver.
    pub redundant: bool,
    /// The name of the solver and of its files. By default the name of the description, and the files are numbered stages.
    pub name: Option<String>,
    /// The tolerance for the ideal robot: in radians, and as a fraction of the reach. By default [`TOLERANCE`].
    pub snap: Option<BigRational>,
}

impl Ends {
    /// The name that requests the planner's choice instead of a given joint.
    pub const AUTO: &'static str = "auto";

    /// Reads the request from the file at `path`.
    ///
    /// # Errors
    /// As [`read_text`] and [`Ends::from_toml`], with the file.
    pub fn read(path: &Path) -> Result<Ends> {
        Ends::from_toml(&read_text(path, TEXT_LIMIT)?).map_err(|error| error.in_file(path))
    }

    /// Reads the request from `text`.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for text that is not TOML; [`ErrorKind::UnknownKey`]; [`ErrorKind::BadValue`] for a wrong type or value. All have a line.
    pub fn from_toml(text: &str) -> Result<Ends> {
        let document = Document::parse(text)?;
        let root = document.root();
        root.deny_unknown(&["base", "tip", "given", "name", "snap", "redundant", "task"])?;
        let name = |key| root.optional(key).map(|node| node.text().map(str::to_owned)).transpose();
        let mut ends = Ends { base: name("base")?, tip: name("tip")?, given: read_given(root)?, ..Ends::default() };
        ends.name = root
            .optional("name")
            .map(|node| solver_name(node.text()?).map_err(|error| node.place(error)))
            .transpose()?;
        ends.redundant = root.optional("redundant").map(|node| node.boolean()).transpose()?.unwrap_or(false);
        ends.snap = root.optional("snap").map(|node| node.exact()).transpose()?;
        if let Some(node) = root.optional("task") {
            let table = node.table()?;
            let (task, direction) = read_task(table)?;
            (ends.task, ends.direction) = (Some(task), table.optional("direction").map(|_| direction));
        }
        Ok(ends)
    }

    /// The request as TOML. [`Ends::from_toml`] reads the same request from it.
    pub fn to_toml(&self) -> String {
        let quoted = |text: &str| serde_json::Value::from(text).to_string();
        let mut page = String::new();
        for (key, name) in [("base", &self.base), ("tip", &self.tip), ("name", &self.name)] {
            page += &name.as_ref().map(|name| format!("{key} = {}\n", quoted(name))).unwrap_or_default();
        }
        if !self.given.is_empty() {
            let names: Vec<String> = self.given.iter().map(|name| quoted(name)).collect();
            page += &format!("given = [{}]\n", names.join(", "));
        }
        page += if self.redundant { "redundant = true\n" } else { "" };
        page += &self.snap.as_ref().map(|snap| format!("snap = {}\n", quoted(&snap.to_string()))).unwrap_or_default();
        if let Some(task) = self.task {
            let plane = task.plane().map(Plane::name).map(|plane| format!("plane = {}\n", quoted(plane)));
            let axis = task.axis().map(|axis| format!("axis = {}\n", quoted(axis.name())));
            let of = plane.or(axis).unwrap_or_default();
            page += &format!("\n[task]\nkind = {}\n{of}", quoted(task.name()));
        }
        if let Some(direction) = &self.direction {
            let numbers = direction.each_ref().map(|entry| quoted(&entry.to_string()));
            page += &format!("direction = [{}]\n", numbers.join(", "));
        }
        page
    }

    /// This request, completed by `other`. A direction of `other` is used only with a task that orients a direction.
    #[must_use]
    pub fn or(&self, other: &Ends) -> Ends {
        let first = |mine: &Option<String>, yours: &Option<String>| mine.clone().or_else(|| yours.clone());
        let task = self.task.or(other.task);
        let direction = self.direction.clone().or_else(|| other.direction.clone());
        Ends {
            base: first(&self.base, &other.base),
            tip: first(&self.tip, &other.tip),
            task,
            direction: direction.filter(|_| self.direction.is_some() || task.is_none_or(Task::aims)),
            given: if self.given.is_empty() { other.given.clone() } else { self.given.clone() },
            chooses: self.chooses || other.chooses,
            redundant: self.redundant || self.given.is_empty() && !self.chooses && other.redundant,
            name: first(&self.name, &other.name),
            snap: self.snap.clone().or_else(|| other.snap.clone()),
        }
    }

    /// The tolerance for the ideal robot: in radians, and as a fraction of the reach.
    pub fn tolerance(&self) -> f64 {
        self.snap.as_ref().map_or(TOLERANCE, |snap| snap.to_f64().unwrap_or(f64::NAN))
    }

    /// The ideal robot of `chain`, and a report of the idealised values.
    ///
    /// # Errors
    /// As [`Chain::ideal_within`].
    pub fn ideal(&self, chain: &Chain) -> Result<(Chain, Report)> {
        chain.ideal_within(self.tolerance())
    }

    /// `chain` with the name, the task, the direction and the given joints of this request.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a direction if the task orients none; as [`Chain::with_task`].
    pub fn apply_to(&self, chain: Chain) -> Result<Chain> {
        let chain = match &self.name {
            Some(name) => Chain::new(ChainParts { name: name.clone(), ..chain.into() })?,
            None => chain,
        };
        if self.task.is_none() && self.direction.is_none() && self.given.is_empty() {
            return Ok(chain);
        }
        let task = self.task.unwrap_or(chain.task());
        if self.direction.is_some() && !task.aims() {
            let text = format!(
                "the task `{}` orients no direction; omit `direction`, or choose `ray`, `direction` or `position_yaw`",
                task.name()
            );
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let keeps = task.axis().is_none() || task == chain.task();
        let usual = || if keeps { chain.direction().clone() } else { task.usual_direction() };
        let direction = self.direction.clone().unwrap_or_else(usual);
        let given = if self.given.is_empty() { chain.parts().given.clone() } else { self.given.clone() };
        chain.with_task(task, direction, given)
    }
}

/// Checks the name of a solver and of its files.
///
/// # Errors
/// As [`check_name`]; [`ErrorKind::BadValue`] for the name of a file of the run time.
pub fn solver_name(name: &str) -> Result<String> {
    check_name("solver", name)?;
    if RUN_TIME_FILES.iter().any(|own| word(name).eq_ignore_ascii_case(own)) {
        let text = format!("the run time has files called `{}`; give the solver another name", shown(name));
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    Ok(name.to_owned())
}

/// The error for a chain with several redundant joints. It names the joints that may be given.
pub(crate) fn proposed(chain: &Chain, choice: &Choice) -> Error {
    let last = choice.candidates.iter().find(|candidate| choice.given.contains(&candidate.joint));
    let share = last.map(|last| format!(", with solutions on {:.0} % of the last one's range", 100.0 * last.share));
    let options: Vec<String> = choice.given.iter().map(|joint| format!("--given {joint}")).collect();
    let text = format!(
        "{} joints must be given: the `{}` task determines {} of the {}; `--given {}` takes {}{}",
        choice.given.len(),
        chain.task().name(),
        chain.task().freedoms(),
        chain.independent().len() + chain.given_inputs().len(),
        Ends::AUTO,
        options.join(" "),
        share.unwrap_or_default()
    );
    Error::new(ErrorKind::PositiveDimensional, text)
}
