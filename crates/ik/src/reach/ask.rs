//! What a map is to tell. Main type: [`Ask`].

use super::grid::Grid;
use crate::solver::Program;
use crate::{Error, ErrorKind, Result};

/// What is counted at each place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Measure {
    /// The orientations with an answer, and all answers.
    #[default]
    Count,
    /// Of these, those within limits.
    Limits,
    /// Beside both, how well the arm moves: of each orientation the answer with the greatest manipulability.
    Manipulability,
}

impl Measure {
    /// All of them by name.
    pub const NAMES: [(&'static str, Measure); 3] =
        [("count", Measure::Count), ("limits", Measure::Limits), ("manipulability", Measure::Manipulability)];

    /// The one with that name.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for others.
    pub fn of(name: &str) -> Result<Self> {
        let found = Measure::NAMES.iter().find(|(own, _)| *own == name);
        found.map(|(_, measure)| *measure).ok_or_else(|| {
            let text = format!(
                "`{}` is no measure; count, limits and manipulability are",
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

/// A question: which poses, and what is counted of their answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Ask {
    /// The places, in the solver's unit of length; one on each axis that its task does not ask for.
    pub grid: Grid,
    /// How many orientations there are at each place, spread evenly over all that the task tells apart. Where it asks for none there is one.
    pub orientations: usize,
    /// With a seed, the orientations of each place are turned by a rotation of its own, which depends on the seed and the place's number alone.
    pub seed: Option<u64>,
    /// The values of the joints that are given with each target.
    pub given: Vec<f64>,
    /// What is counted.
    pub measure: Measure,
    /// By joint, its least and greatest value, where only answers with a turn within are counted. [`Measure::Limits`] takes the described ones where these are none.
    pub limits: Option<Vec<[f64; 2]>>,
}

impl Ask {
    /// One orientation at each place, whose answers are counted.
    pub fn new(grid: Grid) -> Self {
        Ask { grid, orientations: 1, seed: None, given: Vec::new(), measure: Measure::Count, limits: None }
    }

    /// The limits that a program's source describes, infinite where it tells none.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] where it tells none at all.
    pub fn described(program: &Program) -> Result<Vec<[f64; 2]>> {
        let limits = program.limits();
        if limits.iter().flatten().all(|limit| limit.is_infinite()) {
            let text = format!("of {} no limits are described; give some", program.name);
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        Ok(limits)
    }
}
