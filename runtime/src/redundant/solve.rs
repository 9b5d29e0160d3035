//! The functions of an arm with its solvers as methods: [`SolveRedundant`].

use super::along::{at, sample};
use super::arcs::{Arc, Outcome, arcs};
use super::arm::{Limits, MOST_JOINTS, Q, Redundant, Target};
use super::best::{Best, Criterion, best, optima};
use super::within::{Within, any_within};
use crate::solution::Error;

/// The functions of this module as methods of an arm with its solvers.
pub trait SolveRedundant: Redundant {
    /// Same as [`any_within`](fn@super::any_within), for this arm.
    ///
    /// # Errors
    ///
    /// Those of [`any_within`](fn@super::any_within).
    fn any_within(&self, target: &Target, limits: &Limits) -> Result<Within, Error>
    where
        Self: Sized,
    {
        any_within(self, target, limits)
    }

    /// Same as [`arcs`](fn@super::arcs), for this arm.
    ///
    /// # Errors
    ///
    /// Those of [`arcs`](fn@super::arcs).
    fn arcs(&self, target: &Target, limits: &Limits, out: &mut [Arc]) -> Result<Outcome, Error>
    where
        Self: Sized,
    {
        arcs(self, target, limits, out)
    }

    /// Same as [`at`](fn@super::at), for this arm.
    ///
    /// # Errors
    ///
    /// [`Error::Limits`].
    fn arc_at(&self, target: &Target, limits: &Limits, arc: &Arc, s: f64) -> Result<Q, Error> {
        at(self.arm(), target, limits, arc, s)
    }

    /// Same as [`sample`](fn@super::sample), for this arm.
    ///
    /// # Errors
    ///
    /// [`Error::Limits`].
    fn arc_sample(&self, target: &Target, limits: &Limits, arc: &Arc, out: &mut [Q]) -> Result<(), Error> {
        sample(self.arm(), target, limits, arc, out)
    }

    /// Same as [`best`](fn@super::best), for this arm.
    ///
    /// # Errors
    ///
    /// [`Error::Limits`].
    fn best(
        &self,
        target: &Target,
        limits: &Limits,
        arcs: &[Arc],
        criterion: &Criterion,
    ) -> Result<Option<Best>, Error> {
        best(self.arm(), target, limits, arcs, criterion)
    }

    /// Same as [`optima`](fn@super::optima), for this arm.
    ///
    /// # Errors
    ///
    /// [`Error::Limits`].
    fn optima(
        &self,
        target: &Target,
        limits: &Limits,
        on: (&[Arc], &Criterion),
        out: &mut [Best],
    ) -> Result<usize, Error> {
        optima(self.arm(), target, limits, on, out)
    }

    /// Same as [`SolveRedundant::best`], for the least distance to joint values `q0`, all of which count alike.
    ///
    /// # Errors
    ///
    /// [`Error::Limits`].
    fn nearest_on_arcs(&self, target: &Target, limits: &Limits, arcs: &[Arc], q0: &Q) -> Result<Option<Best>, Error> {
        let criterion = Criterion::Nearest { q0: *q0, weights: [1.0; MOST_JOINTS] };
        best(self.arm(), target, limits, arcs, &criterion)
    }
}

impl<R: Redundant> SolveRedundant for R {}
