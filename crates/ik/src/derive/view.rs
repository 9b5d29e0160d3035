//! A derivation as its reports and checks read it: [`View`].

use crate::solver::Program;

/// A problem, the method that solves it, and the solver: what a [`Derivation`](super::Derivation) stores, with its types known.
#[derive(Debug)]
pub struct View<'a, P, M> {
    /// What is solved.
    pub problem: &'a P,
    /// How it is solved, proved.
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
