//! The reduced Groebner basis, a [`Basis`], from any Groebner basis.

use super::tracked::{Tracked, monic, reduce};
use crate::number::Field;
use crate::poly::{Polynomial, PolynomialRing, Width};
use crate::{Result, Watch};

/// A reduced Groebner basis: monic, sorted by leading monomial from the smallest. It is unique for an ideal and an
/// order.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis<F: Field> {
    /// The ring and its order. Its lanes are wider than those of the given ring when the basis needs it.
    pub ring: PolynomialRing<F>,
    /// The basis; empty for the zero ideal, `[1]` for the unit ideal.
    pub polynomials: Vec<Polynomial<F::Element>>,
    /// With [`Options::cofactors`](super::Options::cofactors):
    /// `polynomials[i] = sum over j of cofactors[i][j] * generators[j]`, else empty.
    pub cofactors: Vec<Vec<Polynomial<F::Element>>>,
}

impl<F: Field> Basis<F> {
    /// Same basis, but with exponent lanes of `width`.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Overflow`] when a degree does not fit.
    pub fn with_width(self, width: Width) -> Result<Self> {
        let ring = self.ring.with_width(width);
        let transfer = |list: &[Polynomial<F::Element>]| -> Result<Vec<_>> {
            list.iter().map(|f| self.ring.transfer(f, &ring)).collect()
        };
        let polynomials = transfer(&self.polynomials)?;
        let cofactors = self.cofactors.iter().map(|row| transfer(row)).collect::<Result<_>>()?;
        Ok(Basis { ring, polynomials, cofactors })
    }

    /// Whether the ideal is the unit ideal: the equations have no solution in any extension field.
    pub fn is_unit_ideal(&self) -> bool {
        self.polynomials.iter().any(|f| self.ring.as_constant(f).is_some_and(|c| !self.ring.field().is_zero(&c)))
    }
}

/// Reduces a given Groebner basis. Cofactors, one row for each polynomial, are transformed too.
///
/// # Errors
/// [`crate::ErrorKind::Overflow`] when a degree overflows the ring's lanes; the error with which `watch` stops the
/// work.
pub fn reduced_basis<'w, F: Field>(
    ring: &PolynomialRing<F>,
    polynomials: Vec<Polynomial<F::Element>>,
    cofactors: Vec<Vec<Polynomial<F::Element>>>,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Basis<F>> {
    let watch = Watch::or_none(watch);
    let elements = polynomials.into_iter().zip(cofactors);
    let elements = elements.map(|(polynomial, cofactors)| Tracked { polynomial, cofactors }).collect();
    let reduced = interreduce(ring, elements, watch)?;
    let (polynomials, cofactors) = reduced.into_iter().map(|e| (e.polynomial, e.cofactors)).unzip();
    Ok(Basis { ring: ring.clone(), polynomials, cofactors })
}

/// Removes elements whose leading monomial another one divides, reduces the tails, makes all monic and sorts from the
/// smallest.
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

/// Whether the leading monomial of `a` divides that of `b`.
fn leads_divide<F: Field>(ring: &PolynomialRing<F>, a: &Polynomial<F::Element>, b: &Polynomial<F::Element>) -> bool {
    let leads = a.leading().zip(b.leading());
    leads.is_some_and(|(a, b)| ring.layout().divides(&a.monomial, &b.monomial))
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
