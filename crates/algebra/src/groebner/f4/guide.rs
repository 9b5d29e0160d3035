//! What a caller decides while a computation is learned.

use crate::Result;

/// Bounds a computation by what it is worth, and tells when and with which elements it may end.
pub(in crate::groebner) trait Guide {
    /// Fails when so many terms are more than the computation is worth.
    fn allow(&mut self, _terms: usize) -> Result<()> {
        Ok(())
    }

    /// The computation may end as soon as each of these vectors begins the exponents of a leading monomial. `None`: when no pair is
    /// left.
    fn goal(&self) -> Option<&[Vec<u32>]> {
        None
    }

    /// Whether the tails of the elements are wanted, too.
    fn wants_tails(&self) -> bool {
        true
    }

    /// Which of the elements with leading monomials of these exponents, smallest first, are wanted.
    fn wanted(&self, leads: &[Vec<u32>]) -> Vec<usize> {
        (0..leads.len()).collect()
    }
}

/// The guide to the whole basis, at any price.
pub(super) struct Whole;

impl Guide for Whole {}

/// The guide to the leading monomials alone.
pub(super) struct Leads;

impl Guide for Leads {
    fn wants_tails(&self) -> bool {
        false
    }
}
