//! A typed view of a derivation, for reports and checks: [`View`].

use crate::solver::Program;

/// The problem, the method and the solver of a [`Derivation`](super::Derivation), with their types.
#[derive(Debug)]
pub struct View<'a, P, M> {
    /// The problem that is solved.
    pub problem: &'a P,
    /// The method that solves it, proved.
    pub method: &'a M,
    /// The solver.
    pub program: &'a Program,
}

impl<P, M> Clone for View<'_, P, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P, M> Copy for View<'_, P, M> {}
