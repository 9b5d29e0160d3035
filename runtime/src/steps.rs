//! How much polishing a target may take: [`Steps`].

use crate::counters::Event;
use crate::mechanism::Mechanism;
use crate::solution::{Error, Solution};

/// What is left of the steps that a target may take ([`crate::tolerances::MOST_STEPS`]).
pub(crate) struct Steps {
    left: usize,
}

impl Steps {
    /// So many steps at most: they are spent with the next one, which tells that they are not enough.
    pub fn at_most(most: usize) -> Self {
        Steps { left: most.saturating_add(1) }
    }

    /// Takes one.
    #[inline(always)]
    pub fn take(&mut self, event: Event) {
        event.count();
        self.left = self.left.saturating_sub(1);
    }

    /// Whether none is left: what has not been polished stays as it is.
    #[inline(always)]
    pub fn are_spent(&self) -> bool {
        self.left == 0
    }
}

/// Marks all answers to a target that are not settled, for its steps are spent; their number.
#[inline(always)]
pub(crate) fn settle<M: Mechanism>(steps: &Steps, answers: &mut [Solution<M>]) -> Result<usize, Error> {
    let are_settled = !steps.are_spent();
    answers.iter_mut().for_each(|answer| answer.settled = are_settled);
    if are_settled || !answers.is_empty() { Ok(answers.len()) } else { Err(Error::Unsettled) }
}
