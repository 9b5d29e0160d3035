//! What the JSON of a task says beside its walk. Main type: [`TaskRecord`].

use serde::{Deserialize, Serialize};

use super::interior::{Interior, Piece};
use crate::{Error, ErrorKind, Result};

/// The room of a task and the ways through it, as `groebot task` writes them under `task`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TaskRecord {
    /// The room at first.
    pub scene: Interior,
    /// The ways, each with what changed: at least one.
    pub stages: Vec<RecordedStage>,
}

/// A way that was found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordedStage {
    /// When it was found \[s\].
    pub from: f64,
    /// How many steps had been taken.
    pub steps: usize,
    /// Where it leads: x, y \[m\], and the heading there \[rad\] if it is asked for.
    pub goal: Vec<f64>,
    /// Its corners \[m\].
    pub way: Vec<[f64; 2]>,
    /// The furniture then.
    pub pieces: Vec<Piece>,
    /// How long it took to find \[ms\].
    pub milliseconds: f64,
}

#[derive(Deserialize)]
struct File {
    #[serde(default)]
    task: Option<TaskRecord>,
}

impl TaskRecord {
    /// The record in the JSON of a task; nothing where there is none.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for another `task`, with the line; [`ErrorKind::BadValue`] for one without a way or with a goal of another count of numbers than two or three.
    pub fn from_json(text: &str) -> Result<Option<Self>> {
        let read: std::result::Result<File, _> = serde_json::from_str(text);
        let task = read.map(|file| file.task).map_err(|error| {
            let line = error.line().max(1);
            Error::new(ErrorKind::Syntax, format!("`task` is not what groebot writes: {error}")).at_line(line)
        })?;
        let is_whole = |task: &TaskRecord| {
            !task.stages.is_empty() && task.stages.iter().all(|stage| matches!(stage.goal.len(), 2 | 3))
        };
        match task {
            Some(task) if !is_whole(&task) => {
                let text =
                    "`task` has no way, or a goal that is not x, y and perhaps a heading; `groebot task` writes both";
                Err(Error::new(ErrorKind::BadValue, text))
            }
            task => Ok(task),
        }
    }
}
