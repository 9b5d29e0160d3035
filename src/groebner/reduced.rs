//! From a Groebner basis to the reduced one.

use super::engine::{Tracked, leads_divide, monic, reduce};
use crate::number::Field;
use crate::poly::PolynomialRing;
use crate::{Result, Watch};

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
