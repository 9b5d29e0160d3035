//! Options of a map. Main type: [`Request`].

use super::grid::Grid;
use crate::solver::Program;
use crate::{Error, ErrorKind, Result};

/// The quantities that are counted at each place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Measure {
    /// The orientations with a solution, and all solutions.
    #[default]
    Count,
    /// Only solutions within joint limits. Of a redundant arm without the value of its given joint, the targets with a solution within limits.
    Limits,
    /// In addition, the manipulability: for each orientation that of the best solution.
    Manipulability,
}

impl Measure {
    /// All measures by name.
    pub const NAMES: [(&'static str, Measure); 3] =
        [("count", Measure::Count), ("limits", Measure::Limits), ("manipulability", Measure::Manipulability)];

    /// The measure with this name.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for other names.
    pub fn of(name: &str) -> Result<Self> {
        let found = Measure::NAMES.iter().find(|(own, _)| *own == name);
        found.map(|(_, measure)| *measure).ok_or_else(|| {
            let text = format!(
                "`{}` is not a measure; give count, limits or manipulability",
                groebot_robot::document::shown(name)
            );
            Error::new(ErrorKind::UnknownName, text)
        })
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        Measure::NAMES[self as usize].0
    }
}

/// Options of a map: the poses, and the quantities that are counted.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// The places, in the solver's unit of length. An axis without a coordinate in the task has one place.
    pub grid: Grid,
    /// Number of orientations at each place, spread evenly over all orientations that the task distinguishes. It is one if the task has no orientation.
    pub orientations: usize,
    /// If there is a seed, each place has its own rotation of all orientations. It depends only on the seed and the index of the place.
    pub seed: Option<u64>,
    /// The values of the joints that are inputs of each target. Of a redundant arm, they may be omitted with [`Measure::Limits`].
    pub given: Vec<f64>,
    /// The quantities that are counted.
    pub measure: Measure,
    /// By joint, its least and greatest value. If given, only solutions with a turn within them are counted. [`Measure::Limits`] uses the limits of the
    /// description if these are not given. Those of a redundant arm without given values narrow the described ones.
    pub limits: Option<Vec<[f64; 2]>>,
}

impl Request {
    /// Options for one orientation at each place, with its solutions counted.
    pub fn new(grid: Grid) -> Self {
        Request { grid, orientations: 1, seed: None, given: Vec::new(), measure: Measure::Count, limits: None }
    }

    /// Whether the program has a redundancy, and no value of its given joints is specified.
    pub(super) fn lacks_given(&self, program: &Program) -> bool {
        program.redundancy.is_some() && self.given.is_empty()
    }

    /// The limits in the description of a program's source, infinite for joints without limits.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] if the description has no limits at all.
    pub fn described(program: &Program) -> Result<Vec<[f64; 2]>> {
        let redundancy = program.redundancy.as_deref();
        let limits = redundancy.map_or_else(|| program.limits(), |redundancy| redundancy.limit_pairs());
        if limits.iter().flatten().all(|limit| limit.is_infinite()) {
            let text = format!("{}: no limits are described; give limits", program.name);
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        Ok(limits)
    }
}
