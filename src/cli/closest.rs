//! The closest joint values of a target without a solution, in the output of `groebot solve --closest`. Main type: [`Search`].

use crate::Result;
use groebot_ik::solver::{Closest, ClosestOptions, Solver};
use groebot_robot::kinematics::Solution;

/// The names of the columns after those of all answers; the second is an angle.
pub const COLUMNS: [&str; 2] = ["closest_distance", "closest_angle"];

/// Whether the closest joint values were requested, and found.
#[derive(Clone, Debug)]
pub enum Search {
    /// They were not requested.
    Off,
    /// The target has solutions.
    Needless,
    /// The closest joint values.
    Found(Box<Closest>),
}

impl Search {
    /// Searches for `target`, in radians, unless it has solutions.
    ///
    /// # Errors
    /// As [`Solver::closest_numbers`].
    pub fn run(solver: &Solver, target: &[f64], options: &ClosestOptions) -> Result<Search> {
        let found = solver.closest_numbers(target, options)?;
        Ok(if found.reachable { Search::Needless } else { Search::Found(Box::new(found)) })
    }

    /// The closest joint values.
    pub fn found(&self) -> Option<&Closest> {
        match self {
            Search::Found(closest) => Some(closest),
            _ => None,
        }
    }

    /// The same joint values after a change by `moved`.
    #[must_use]
    pub fn moved(mut self, moved: impl FnOnce(Solution) -> Solution) -> Self {
        if let Search::Found(closest) = &mut self {
            closest.q = moved(solution(closest)).q;
        }
        self
    }

    pub fn is_on(&self) -> bool {
        !matches!(self, Search::Off)
    }
}

/// The joint values as a solution without branch.
pub fn solution(closest: &Closest) -> Solution {
    Solution { q: closest.q.clone(), ..Solution::default() }
}
