//! The known Hilbert series of a running computation, which identifies pairs that reduce to zero.

use num_traits::ToPrimitive;

use super::hilbert::{HilbertSeries, excess, numerator};
use super::pairs::Head;
use crate::number::Field;
use crate::poly::PolynomialRing;
use crate::{Error, ErrorKind, Result};

/// The known Hilbert series of a running computation that processes pairs by degree.
#[derive(Debug)]
pub(super) struct Goal<'a> {
    series: &'a HilbertSeries,
    /// The current degree, and the number of elements with which it is complete.
    stage: Option<(u32, usize)>,
}

impl<'a> Goal<'a> {
    pub fn new(series: &'a HilbertSeries) -> Self {
        Goal { series, stage: None }
    }

    /// Whether all leading monomials of `degree` are found. Each new element adds one.
    pub fn is_full<F: Field>(&mut self, ring: &PolynomialRing<F>, heads: &[Head], degree: u32) -> Result<bool> {
        let size = match self.stage {
            Some((at, size)) if at == degree => size,
            _ => heads.len().saturating_add(self.missing(ring, heads, degree)?),
        };
        self.stage = Some((degree, size));
        Ok(heads.len() >= size)
    }

    fn missing<F: Field>(&self, ring: &PolynomialRing<F>, heads: &[Head], degree: u32) -> Result<usize> {
        let leads = heads.iter().map(|head| ring.layout().exponents(&head.monomial)).collect();
        let current = HilbertSeries { numerator: numerator(leads), variables: ring.variables().len() };
        let missing = excess(&current, self.series, degree as usize).ok_or_else(another_series)?;
        Ok(missing.to_usize().unwrap_or(usize::MAX))
    }
}

/// The error for a series that contradicts the computation.
pub(super) fn another_series() -> Error {
    Error::new(
        ErrorKind::BadValue,
        "the Hilbert series is not that of the ideal; compute it from a basis of the same ideal",
    )
}
