//! Decisions of a caller during a learning run of F4.

use crate::Result;

/// Limits the cost of a computation, and decides when and with which elements it may end.
pub(in crate::groebner) trait Guide {
    /// Fails when a computation with this many terms is too expensive.
    fn allow(&mut self, _terms: usize) -> Result<()> {
        Ok(())
    }

    /// The computation may end as soon as each of these vectors is a prefix of the exponents of a leading monomial.
    /// `None`: when no pair is left.
    fn goal(&self) -> Option<&[Vec<u32>]> {
        None
    }

    /// Whether the tails of the elements are needed too.
    fn wants_tails(&self) -> bool {
        true
    }

    /// Selects the needed elements by the exponents of their leading monomials, smallest first.
    fn wanted(&self, leads: &[Vec<u32>]) -> Vec<usize> {
        (0..leads.len()).collect()
    }
}

/// Guide for the whole basis, without a limit.
pub(super) struct Whole;

impl Guide for Whole {}

/// Guide for the leading monomials only.
pub(super) struct Leads;

impl Guide for Leads {
    fn wants_tails(&self) -> bool {
        false
    }
}
