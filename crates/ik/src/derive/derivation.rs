//! The whole way from a system to its proved solver.

use super::compile::compile;
use super::tree::Node;
use super::{Orders, System, derive_tree};
use crate::solver::Program;
use crate::{Result, Watch};
use groebot_algebra::groebner::Basis;

/// What a derivation gives: every stage as plain data.
#[derive(Clone, Debug, PartialEq)]
pub struct Derivation {
    /// The equations.
    pub system: System,
    /// The strata in the order that the system asks for: its first basis is what the source prints.
    pub requested: Node,
    /// The strata in the orders whose formulas break down least, when they differ: what the program is made of.
    pub searched: Option<Node>,
    /// The solver.
    pub program: Program,
}

impl Derivation {
    /// Derives, proves and compiles `system`.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Inconsistent`], [`crate::ErrorKind::PositiveDimensional`] (naming the free joints),
    /// [`crate::ErrorKind::Unsupported`] for what a program cannot hold, and what `watch` stops with.
    pub fn new(system: System, watch: &Watch) -> Result<Self> {
        let requested = derive_tree(&system, Orders::Requested, watch)?;
        let searched = derive_tree(&system, Orders::Searched, watch)?;
        let searched = (searched != requested).then_some(searched);
        Derivation::assemble(system, requested, searched)
    }

    /// The derivation of proved trees.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Unsupported`] for what a program cannot hold.
    pub(super) fn assemble(system: System, requested: Node, searched: Option<Node>) -> Result<Self> {
        let program = compile(&system, searched.as_ref().unwrap_or(&requested))?;
        Ok(Derivation { system, requested, searched, program })
    }

    /// The number of complex solutions at a generic target: the dimension of the quotient ring.
    pub fn dimension(&self) -> Option<usize> {
        let solved = self.requested.solved()?;
        let (ring, polynomials) = (solved.triangular.ring.clone(), solved.certified.basis.clone());
        Basis { ring, polynomials, cofactors: Vec::new() }.quotient_dimension()
    }

    /// The tree that the program is made of.
    pub fn solving(&self) -> &Node {
        self.searched.as_ref().unwrap_or(&self.requested)
    }
}
