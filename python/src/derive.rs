//! Derivation of a proved solver from a description: `groebot.derive`.

use std::path::PathBuf;
use std::time::Duration;

use groebot::derive::{Derivation, Ends, Source};
use groebot::{Error, Result, Watch};
use pyo3::prelude::*;
use pyo3::types::PyString;

use crate::errors::{bad_value, raised};
use crate::origin::{Origin, elsewhere};
use crate::robot::Robot;
use crate::solver::Solver;
use crate::stored::Stored;
use crate::work::{threads as threads_of, watched};

/// The longest time budget \[s\].
const MAX_SECONDS: f64 = 1e9;

/// Derives the solver of a robot between its links `base` and `tip`, with a proof.
///
/// `robot` is a `Robot`, or the path of a description: URDF, chain, DH table, equations, or the folder of a mechanism. `task` is pose, position, ray,
/// direction, rotation, position_pitch_roll, position_yaw, planar_position or planar_pose. The last two need `plane`: xy, xz or yz of the base. `direction` is
/// the direction in the tip frame for ray, direction and position_yaw. `axis` (x, y, z) is the base axis of the angle of position_yaw. `given` are the names of
/// joints whose values are inputs of the solver. If the chain has too many joints and none is given, the planner chooses them. `snap` is the tolerance of the
/// idealisation; 0 uses every digit. `time` \[s\] is a budget. `progress(stage, done, open)` is called periodically. A keyboard interrupt ends the work.
#[pyfunction]
#[pyo3(signature = (robot, task=None, given=None, *, plane=None, axis=None, direction=None, name=None, snap=None, time=None, progress=None, threads=None))]
#[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
pub fn derive(
    py: Python<'_>,
    robot: &Bound<'_, PyAny>,
    task: Option<&str>,
    given: Option<&Bound<'_, PyAny>>,
    plane: Option<&str>,
    axis: Option<&str>,
    direction: Option<&Bound<'_, PyAny>>,
    name: Option<&str>,
    snap: Option<f64>,
    time: Option<f64>,
    progress: Option<&Bound<'_, PyAny>>,
    threads: Option<i64>,
) -> PyResult<Solver> {
    let options = TaskOptions {
        task,
        plane,
        axis,
        direction: direction.map(decimals).transpose()?,
        given: names(given)?,
        name,
        snap,
    };
    let time = time.map(budget).transpose()?;
    let (description, mut ends) = match robot.cast::<Robot>() {
        Ok(robot) => {
            let robot = robot.get();
            (Described::Text(robot.origin()), robot.ends())
        }
        Err(_) => (Described::Path(robot.extract::<PathBuf>()?), Ends::default()),
    };
    options.put(&mut ends).map_err(|error| raised(&error))?;
    let stored = watched(py, progress, threads_of(threads)?, |watch| {
        let watch = time.map_or_else(|| watch.clone(), |time| watch.clone().with_time(time));
        description.derived(&ends, &watch)
    })?;
    Ok(Solver::of(stored))
}

/// The description of the robot.
enum Described {
    Text(Origin),
    Path(PathBuf),
}

impl Described {
    fn derived(&self, ends: &Ends, watch: &Watch) -> Result<Stored> {
        let derived = |mut source: Source| {
            source.choose_given(watch)?;
            let proved = Derivation::of(&source, watch)?.about(&source);
            Stored::derived(&source, proved)
        };
        match self {
            Described::Path(path) => derived(Source::read_between(path, ends)?),
            Described::Text(origin) => origin.source_between(ends).and_then(derived).map_err(|error| elsewhere(&error)),
        }
    }
}

/// The options task and options.
struct TaskOptions<'a> {
    task: Option<&'a str>,
    plane: Option<&'a str>,
    axis: Option<&'a str>,
    direction: Option<Vec<String>>,
    given: Vec<String>,
    name: Option<&'a str>,
    snap: Option<f64>,
}

impl TaskOptions<'_> {
    /// Adds the options to `ends` in the format of a task file, which has the same names.
    fn put(&self, ends: &mut Ends) -> Result<()> {
        let quoted = |text: &str| serde_json::Value::from(text).to_string();
        let mut text = String::new();
        if let Some(name) = self.name {
            text += &format!("name = {}\n", quoted(name));
        }
        if let Some(snap) = self.snap {
            text += &format!("snap = {}\n", quoted(&format!("{snap:e}")));
        }
        let given: Vec<String> =
            self.given.iter().filter(|joint| *joint != Ends::AUTO).map(|joint| quoted(joint)).collect();
        if !given.is_empty() {
            text += &format!("given = [{}]\n", given.join(", "));
        }
        if self.task.is_some() || self.plane.is_some() || self.axis.is_some() || self.direction.is_some() {
            text += "[task]\n";
        }
        for (key, value) in [("kind", self.task), ("plane", self.plane), ("axis", self.axis)] {
            text += &value.map(|value| format!("{key} = {}\n", quoted(value))).unwrap_or_default();
        }
        if let Some(direction) = &self.direction {
            text += &format!("direction = [{}]\n", direction.join(", "));
        }
        let options = Ends::from_toml(&text).map_err(|error| Error::new(error.kind(), error.message()))?;
        ends.task = options.task;
        ends.direction = options.direction;
        ends.given = options.given;
        ends.name = options.name;
        ends.snap = options.snap;
        ends.chooses = self.given.iter().any(|joint| joint == Ends::AUTO);
        Ok(())
    }
}

/// The names of given joints: a name, or a list of names.
fn names(given: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<String>> {
    match given {
        None => Ok(Vec::new()),
        Some(one) if one.is_instance_of::<PyString>() => Ok(vec![one.extract()?]),
        Some(list) => list.extract(),
    }
}

/// Three numbers as decimals.
fn decimals(direction: &Bound<'_, PyAny>) -> PyResult<Vec<String>> {
    let numbers = crate::arrays::Numbers::of(direction)?;
    if numbers.shape() != [3] {
        return Err(bad_value("`direction` takes three numbers"));
    }
    let list = numbers.to_vec()?;
    crate::arrays::finite(&list, 3, "direction")?;
    Ok(list.iter().map(|number| format!("\"{number}\"")).collect())
}

fn budget(seconds: f64) -> PyResult<Duration> {
    let is_allowed = seconds > 0.0 && seconds <= MAX_SECONDS;
    let bad = || bad_value(format!("`time` is {seconds}; give seconds greater than 0 and at most {MAX_SECONDS:e}"));
    is_allowed.then(|| Duration::from_secs_f64(seconds)).ok_or_else(bad)
}
