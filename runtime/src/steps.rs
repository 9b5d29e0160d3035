//! Limit on the polishing work for a target: [`Steps`].

use crate::counters::Event;
use crate::mechanism::Mechanism;
use crate::solution::{Error, Solution};

/// The remaining steps of a target ([`crate::MOST_STEPS`]).
pub(crate) struct Steps {
    left: usize,
}

impl Steps {
    /// At most `most` steps. They are used up with the next one, which shows that they did not suffice.
    pub fn at_most(most: usize) -> Self {
        Steps { left: most.saturating_add(1) }
    }

    /// Uses one step.
    #[inline(always)]
    pub fn take(&mut self, event: Event) {
        event.count();
        self.left = self.left.saturating_sub(1);
    }

    /// Whether no step is left: candidates that have not been polished are then kept unchanged.
    #[inline(always)]
    pub fn are_spent(&self) -> bool {
        self.left == 0
    }
}

/// Marks all solutions of a target as not settled if its steps are used up, and returns their number.
#[inline(always)]
pub(crate) fn settle<M: Mechanism>(steps: &Steps, answers: &mut [Solution<M>]) -> Result<usize, Error> {
    let are_settled = !steps.are_spent();
    answers.iter_mut().for_each(|answer| answer.settled = are_settled);
    if are_settled || !answers.is_empty() { Ok(answers.len()) } else { Err(Error::Unsettled) }
}
