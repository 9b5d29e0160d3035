//! Walks one behind the other.

use super::plan::Walk;
use super::schedule::{Action, Phase};
use crate::{Error, ErrorKind, Result};

impl Walk {
    /// Lets another walk follow, which begins where this one ends. What both ask for but for the way is that of the first.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when the feet stand elsewhere, or samples are another time apart.
    pub fn append(&mut self, next: Walk) -> Result<()> {
        let bad = |text: &str| Err(Error::new(ErrorKind::BadValue, text));
        if self.schedule.route.end() != next.schedule.route.start {
            return bad("the second walk does not start where the first one ends");
        }
        if self.schedule.tick != next.schedule.tick {
            return bad("the samples of two walks are not the same time apart");
        }
        let (phases, steps) = (self.schedule.phases.len(), self.schedule.route.steps.len());
        let phase = |phase: Phase| Phase { action: later(phase.action, steps), ..phase };
        self.schedule.phases.extend(next.schedule.phases.into_iter().map(phase));
        for route in [&mut self.schedule.route, &mut self.request.route] {
            route.steps.extend(&next.schedule.route.steps);
            route.rests.extend(next.schedule.route.rests.iter().skip(1));
        }
        // The first instant of the second walk is the last one of the first.
        let references = next.references.into_iter().skip(1);
        self.references.extend(references.map(|own| super::Reference { phase: own.phase + phases, ..own }));
        self.motion.postures.extend(next.motion.postures.into_iter().skip(1));
        self.motion.centres.extend(next.motion.centres.into_iter().skip(1));
        self.balances.extend(next.balances.into_iter().skip(1));
        Ok(())
    }
}

/// The same about a step that has so many before it.
fn later(action: Action, steps: usize) -> Action {
    match action {
        Action::Rest | Action::Lower | Action::Rise => action,
        Action::Shift(step) => Action::Shift(step + steps),
        Action::Swing(step) => Action::Swing(step + steps),
        Action::Balance(step) => Action::Balance(step + steps),
    }
}
