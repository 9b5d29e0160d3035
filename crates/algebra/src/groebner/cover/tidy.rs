//! Simplification of a stratum's basis: reduces the tails and removes common factors that are nowhere zero.

use super::Element;
use super::ideals::Ideals;
use super::pseudo::{cancelled, lead, modulo};
use super::region::Region;
use crate::Result;
use crate::number::{Field, Ring};
use crate::poly::{Fractions, Polynomial, PolynomialRing, gcd};

type Unknowns<F> = PolynomialRing<Fractions<F>>;
type Parametric<F> = Polynomial<<Fractions<F> as Ring>::Element>;

/// Simplifies a basis on `region`.
pub(super) fn tidy<F: Field>(
    ideals: &Ideals<'_, F>,
    ring: &Unknowns<F>,
    region: &Region<F::Element>,
    mut basis: Vec<Element<F>>,
) -> Result<Vec<Element<F>>> {
    for index in 0..basis.len() {
        let others = basis.iter().enumerate().filter(|(other, _)| *other != index);
        let divisors: Vec<_> = others.filter_map(|(_, element)| single(element)).cloned().collect();
        let mut tidied = Vec::new();
        for f in &basis[index].representatives {
            let reduced = reduce_tail(ideals, ring, region, f, &divisors)?;
            tidied.push(without_content(ideals, ring, region, reduced)?);
        }
        basis[index].representatives = tidied;
    }
    Ok(basis)
}

/// The polynomial of an element that has only one: its leading coefficient is nowhere zero.
fn single<F: Field>(element: &Element<F>) -> Option<&Parametric<F>> {
    match element.representatives.as_slice() {
        [f] => Some(f),
        _ => None,
    }
}

/// Reduces every term of `f` but the first by `divisors`.
fn reduce_tail<F: Field>(
    ideals: &Ideals<'_, F>,
    ring: &Unknowns<F>,
    region: &Region<F::Element>,
    f: &Parametric<F>,
    divisors: &[Parametric<F>],
) -> Result<Parametric<F>> {
    let mut f = f.clone();
    loop {
        ideals.watch.check()?;
        ideals.watch.check_terms(f.terms().len())?;
        let step = f.terms().iter().skip(1).find_map(|term| {
            let factor = |g| ring.layout().checked_div(&term.monomial, &lead(g).monomial);
            divisors.iter().find_map(|g| Some((term, g, factor(g)?)))
        });
        let Some((term, g, factor)) = step else { return Ok(f) };
        f = modulo(ring, &cancelled(ring, &f, term, g, &factor)?, &region.equations)?;
        f = without_content(ideals, ring, region, f)?;
    }
}

/// Divides `f` by the common factor of its coefficients, if that is nowhere zero on `region`, and by its numeric
/// content.
fn without_content<F: Field>(
    ideals: &Ideals<'_, F>,
    ring: &Unknowns<F>,
    region: &Region<F::Element>,
    f: Parametric<F>,
) -> Result<Parametric<F>> {
    let ground = ring.field().ring();
    let mut coefficients: Vec<_> = f.terms().iter().map(|term| term.coefficient.numerator()).collect();
    coefficients.sort_by_key(|coefficient| coefficient.terms().len());
    let content = coefficients.iter().fold(ground.zero(), |common, coefficient| gcd(ground, &common, coefficient));
    let constant = ground.as_constant(&content).is_some();
    let divisible = constant || ideals.misses(region, std::slice::from_ref(&content))?;
    let content = if divisible { content } else { ground.one() };
    let number = &lead(lead(&f).coefficient.numerator()).coefficient;
    let divisor = ring.constant(ring.field().embed(&ground.scale(&content, number)));
    Ok(ring.exact_div(&f, &divisor).expect("a content divides"))
}
