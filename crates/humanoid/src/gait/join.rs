//! Concatenation of walks.

use super::plan::Walk;
use super::schedule::Phase;
use crate::{Error, ErrorKind, Result};

impl Walk {
    /// Appends another walk, which begins where this one ends. The request is that of this walk, except for the route.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when the footprints or the time between two samples differ.
    pub(crate) fn append(&mut self, next: Walk) -> Result<()> {
        let bad = |text: &str| Err(Error::new(ErrorKind::BadValue, text));
        if self.schedule.route.end() != next.schedule.route.start {
            return bad("the second walk does not start where the first one ends");
        }
        if self.schedule.tick != next.schedule.tick {
            return bad("the time between two samples differs between the walks");
        }
        let (phases, steps) = (self.schedule.phases.len(), self.schedule.route.steps.len());
        let phase = |phase: Phase| Phase { action: phase.action.with_step(|step| step + steps), ..phase };
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
