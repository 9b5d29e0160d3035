//! The part of a task's JSON that is not the walk. Main type: [`TaskRecord`].

use serde::{Deserialize, Serialize};

use super::interior::{Interior, Piece};
use crate::{Error, ErrorKind, Result};

/// The room of a task and the paths through it, as `groebot task` writes them under `task`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct TaskRecord {
    /// The initial room.
    pub scene: Interior,
    /// The paths, each with the changes before it: at least one.
    pub stages: Vec<RecordedStage>,
}

/// A path that was found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct RecordedStage {
    /// The time of the walk at which it was found \[s\].
    pub from: f64,
    /// The number of steps taken before.
    pub steps: usize,
    /// Its goal: x, y \[m\], and the heading \[rad\] if one is requested.
    pub goal: Vec<f64>,
    /// Its corners \[m\].
    #[serde(alias = "way")]
    pub path: Vec<[f64; 2]>,
    /// The furniture at that time.
    pub pieces: Vec<Piece>,
    /// The time to find it \[ms\].
    pub milliseconds: f64,
}

#[derive(Deserialize)]
struct File {
    #[serde(default)]
    task: Option<TaskRecord>,
}

impl TaskRecord {
    /// Reads the record in the JSON of a task; `None` where there is none.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for an invalid `task`, with the line; [`ErrorKind::BadValue`] for one without a path, or
    /// with a goal that does not have two or three numbers.
    pub fn from_json(text: &str) -> Result<Option<Self>> {
        let read: std::result::Result<File, _> = serde_json::from_str(text);
        let task = read.map(|file| file.task).map_err(|error| {
            let line = error.line().max(1);
            Error::new(ErrorKind::Syntax, format!("`task` does not have the format of groebot: {error}")).at_line(line)
        })?;
        let is_whole = |task: &TaskRecord| {
            !task.stages.is_empty() && task.stages.iter().all(|stage| matches!(stage.goal.len(), 2 | 3))
        };
        match task {
            Some(task) if !is_whole(&task) => {
                let text = "`task` has no path, or a goal that is not x, y and optionally a heading; `groebot task` writes both";
                Err(Error::new(ErrorKind::BadValue, text))
            }
            task => Ok(task),
        }
    }
}
