//! Buchberger's algorithm exactly as printed in NAO section 6.3: the reference for the other engines.

use super::division::{normal_form, s_polynomial};
use crate::number::Field;
use crate::poly::{Polynomial, PolynomialRing};
use crate::{Result, Watch};

/// Computes a Groebner basis of the ideal of `generators` by the ten lines of NAO section 6.3. It is neither minimal
/// nor reduced.
///
/// # Errors
/// [`crate::ErrorKind::Overflow`] when a degree overflows the ring's lanes; the error with which `watch` stops the
/// work.
pub fn buchberger<'w, F: Field>(
    ring: &PolynomialRing<F>,
    generators: &[Polynomial<F::Element>],
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Vec<Polynomial<F::Element>>> {
    let watch = Watch::or_none(watch);
    let mut basis: Vec<_> = generators.iter().filter(|f| !f.is_zero()).cloned().collect();
    loop {
        let before = basis.clone();
        for (index, p) in before.iter().enumerate() {
            for q in &before[index + 1..] {
                watch.check()?;
                let remainder = normal_form(ring, &s_polynomial(ring, p, q)?, &before)?;
                if !remainder.is_zero() && !basis.contains(&remainder) {
                    basis.push(remainder);
                }
            }
        }
        watch.report("Buchberger", before.len(), basis.len() - before.len());
        if basis.len() == before.len() {
            return Ok(basis);
        }
    }
}

/// Buchberger's criterion (NAO 6.2.3): whether all S-polynomials of `basis` reduce to zero by it.
///
/// # Errors
/// [`crate::ErrorKind::Overflow`] when a degree overflows the ring's lanes.
pub fn is_groebner_basis<F: Field>(ring: &PolynomialRing<F>, basis: &[Polynomial<F::Element>]) -> Result<bool> {
    for (index, p) in basis.iter().enumerate() {
        for q in &basis[index + 1..] {
            if !normal_form(ring, &s_polynomial(ring, p, q)?, basis)?.is_zero() {
                return Ok(false);
            }
        }
    }
    Ok(true)
}
