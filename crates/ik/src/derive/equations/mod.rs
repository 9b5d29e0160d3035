//! The proved solution of equations as one block: [`Equations`].

pub(super) mod assemble;
pub(super) mod certificate;
pub(crate) mod certify;
pub mod compile;
mod generic;
pub(super) mod grow;
pub mod plan;
pub(super) mod prover;
pub mod setting;
pub(crate) mod strata;
pub mod tree;
pub mod triangular;

use crate::derive::equations::compile::compile;
use crate::derive::equations::tree::Node;
use crate::derive::view::View;
use crate::derive::{Orders, System, derive_tree};
use crate::solver::Program;
use crate::{Result, Watch};
use groebot_algebra::groebner::Basis;

/// The proved solution of equations as one block.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Equations {
    /// The strata in the order that the system requests. Its first basis is the one that the source prints.
    pub requested: Node,
    /// The strata in the orders with the fewest singularities, if they differ. The program is compiled from these.
    pub searched: Option<Node>,
}

/// The view of equations that are solved as one block.
pub type EquationsView<'a> = View<'a, System, Equations>;

impl Equations {
    /// Derives and proves the solution of `system`, and compiles its solver.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Inconsistent`]; [`crate::ErrorKind::PositiveDimensional`] with the free joints; [`crate::ErrorKind::Unsupported`] for a solution
    /// that a program cannot represent. The error of `watch` if it stops the derivation.
    pub(super) fn derive(system: &System, watch: &Watch) -> Result<(Self, Program)> {
        let requested = derive_tree(system, Orders::Requested, watch)?;
        let searched = derive_tree(system, Orders::Searched, watch)?;
        let searched = (searched != requested).then_some(searched);
        Equations { requested, searched }.compiled(system)
    }

    /// Adds the compiled solver of `system`.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Unsupported`] for a solution that a program cannot represent.
    pub(super) fn compiled(self, system: &System) -> Result<(Self, Program)> {
        let program = compile(system, self.solving())?;
        Ok((self, program))
    }

    /// The number of complex solutions at a generic target: the dimension of the quotient ring.
    pub fn dimension(&self) -> Option<usize> {
        let solved = self.requested.solved()?;
        let (ring, polynomials) = (solved.triangular.ring.clone(), solved.certified.basis.clone());
        Basis { ring, polynomials, cofactors: Vec::new() }.quotient_dimension()
    }

    /// The tree from which the program is compiled.
    pub fn solving(&self) -> &Node {
        self.searched.as_ref().unwrap_or(&self.requested)
    }

    /// The trees with their titles: the requested order, then the solver's own order if it differs.
    pub fn trees(&self) -> Vec<(&'static str, &Node)> {
        let mut trees = vec![("requested order", &self.requested)];
        trees.extend(self.searched.iter().map(|node| ("order of the solver", node)));
        trees
    }
}
