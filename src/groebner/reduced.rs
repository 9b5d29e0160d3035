//! From a Groebner basis to the reduced one.

use super::Basis;
use super::engine::{Tracked, leads_divide, monic, reduce};
use crate::number::Field;
use crate::poly::{Polynomial, PolynomialRing};
use crate::{Result, Watch};

/// The reduced basis of a Groebner basis that came about elsewhere, its cofactors (one row a polynomial) carried along.
///
/// # Errors
/// [`crate::ErrorKind::Overflow`] when a degree outgrows the ring's lanes; what `watch` stops with.
pub fn reduced_basis<F: Field>(
    ring: &PolynomialRing<F>,
    polynomials: Vec<Polynomial<F::Element>>,
    cofactors: Vec<Vec<Polynomial<F::Element>>>,
    watch: &Watch,
) -> Result<Basis<F>> {
    let elements = polynomials.into_iter().zip(cofactors);
    let elements = elements.map(|(polynomial, cofactors)| Tracked { polynomial, cofactors }).collect();
    let reduced = interreduce(ring, elements, watch)?;
    let (polynomials, cofactors) = reduced.into_iter().map(|e| (e.polynomial, e.cofactors)).unzip();
    Ok(Basis { ring: ring.clone(), polynomials, cofactors })
}

/// Drops elements whose leading monomial another divides, reduces the tails, makes monic and sorts from the smallest.
pub(super) fn interreduce<F: Field>(
    ring: &PolynomialRing<F>,
    elements: Vec<Tracked<F::Element>>,
    watch: &Watch,
) -> Result<Vec<Tracked<F::Element>>> {
    let mut minimal: Vec<Tracked<F::Element>> = Vec::new();
    let mut sorted = elements;
    sorted.retain(|element| !element.polynomial.is_zero());
    sorted.sort_by(|a, b| compare_leads(ring, a, b));
    for element in sorted {
        if !minimal.iter().any(|kept| leads_divide(ring, &kept.polynomial, &element.polynomial)) {
            minimal.push(element);
        }
    }
    for index in 0..minimal.len() {
        let element = minimal.remove(index);
        let element = monic(ring, reduce(ring, element, &minimal, watch)?)?;
        minimal.insert(index, element);
    }
    Ok(minimal)
}

fn compare_leads<F: Field>(
    ring: &PolynomialRing<F>,
    a: &Tracked<F::Element>,
    b: &Tracked<F::Element>,
) -> std::cmp::Ordering {
    match (a.polynomial.leading(), b.polynomial.leading()) {
        (Some(x), Some(y)) => ring.layout().compare(&x.monomial, &y.monomial),
        (x, y) => x.is_some().cmp(&y.is_some()),
    }
}
