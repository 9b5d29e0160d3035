//! Multivariate division, normal forms and S-polynomials.

use crate::number::{Field, Ring, Style};
use crate::poly::{Polynomial, PolynomialRing, Term};
use crate::{Error, ErrorKind, Result, Watch};

/// Result of a division: `f = sum quotients[k] * divisors[k] + remainder`. No term of the remainder is divisible by a
/// leading monomial.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Division<E> {
    /// One quotient for each divisor.
    pub quotients: Vec<Polynomial<E>>,
    /// The normal form of `f`. It is unique when the divisors are a Groebner basis.
    pub remainder: Polynomial<E>,
}

/// Divides `f` by `divisors`. The first divisor whose leading monomial divides is used. Zero divisors are skipped.
///
/// # Errors
/// [`crate::ErrorKind::Overflow`] when a degree overflows the ring's lanes.
pub fn divide<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    divisors: &[Polynomial<F::Element>],
) -> Result<Division<F::Element>> {
    divide_by(ring, f.clone(), &divisors.iter().collect::<Vec<_>>(), &Watch::none())
}

/// Same as [`divide`], but under a watch, since the division of one polynomial can take long.
pub(super) fn divide_by<F: Field>(
    ring: &PolynomialRing<F>,
    f: Polynomial<F::Element>,
    divisors: &[&Polynomial<F::Element>],
    watch: &Watch,
) -> Result<Division<F::Element>> {
    let mut quotients = vec![Vec::new(); divisors.len()];
    let mut remainder = Vec::new();
    let mut rest = f;
    while let Some(lead) = rest.leading() {
        match find_divisor(ring, lead, divisors) {
            Some((index, factor)) => {
                watch.check()?;
                rest = ring.sub_mul_term(&rest, &factor.coefficient, &factor.monomial, divisors[index])?;
                watch.check_terms(rest.terms().len())?;
                quotients[index].push(factor);
            }
            None => remainder.extend(rest.take_leading()),
        }
    }
    let quotients = quotients.into_iter().map(|terms| ring.collect(terms)).collect();
    Ok(Division { quotients, remainder: ring.collect(remainder) })
}

/// The first divisor whose leading monomial divides `lead`, and `lead` divided by its leading term.
fn find_divisor<F: Field>(
    ring: &PolynomialRing<F>,
    lead: &Term<F::Element>,
    divisors: &[&Polynomial<F::Element>],
) -> Option<(usize, Term<F::Element>)> {
    divisors.iter().enumerate().find_map(|(index, divisor)| {
        let top = divisor.leading()?;
        let monomial = ring.layout().checked_div(&lead.monomial, &top.monomial)?;
        let coefficient = ring.field().checked_div(&lead.coefficient, &top.coefficient)?;
        Some((index, Term { coefficient, monomial }))
    })
}

/// The normal form: the remainder of [`divide`]. If `basis` is a Groebner basis, it is zero exactly for elements of the
/// ideal.
///
/// # Errors
/// Those of [`divide`].
pub fn normal_form<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    basis: &[Polynomial<F::Element>],
) -> Result<Polynomial<F::Element>> {
    Ok(divide(ring, f, basis)?.remainder)
}

/// The S-polynomial of two nonzero polynomials (NAO 6.3.1); zero when one of them is zero.
///
/// # Errors
/// Those of [`divide`]; [`ErrorKind::BadValue`] when a leading coefficient has no inverse.
pub fn s_polynomial<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    g: &Polynomial<F::Element>,
) -> Result<Polynomial<F::Element>> {
    match s_factors(ring, f, g)? {
        None => Ok(ring.zero()),
        Some((left, right)) => {
            let first = ring.mul_term(f, &left.coefficient, &left.monomial)?;
            ring.sub_mul_term(&first, &right.coefficient, &right.monomial, g)
        }
    }
}

type Lifts<E> = (Term<E>, Term<E>);

/// The two terms that lift the leading terms of `f` and `g` to their least common multiple.
pub(super) fn s_factors<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    g: &Polynomial<F::Element>,
) -> Result<Option<Lifts<F::Element>>> {
    let (Some(a), Some(b)) = (f.leading(), g.leading()) else { return Ok(None) };
    let lcm = ring.lcm(&a.monomial, &b.monomial)?;
    let lift = |term: &Term<F::Element>| {
        let monomial = ring.layout().checked_div(&lcm, &term.monomial).expect("a common multiple is divisible");
        Ok(Term { coefficient: inverse(ring, &term.coefficient)?, monomial })
    };
    Ok(Some((lift(a)?, lift(b)?)))
}

/// The inverse of a nonzero coefficient.
///
/// # Errors
/// [`ErrorKind::BadValue`] when it has none: the coefficients are not a field (see
/// [`crate::poly::Fractions::with_square`]).
pub(super) fn inverse<F: Field>(ring: &PolynomialRing<F>, coefficient: &F::Element) -> Result<F::Element> {
    ring.field().inverse(coefficient).ok_or_else(|| {
        let text = ring.field().format(coefficient, Style::Text);
        let text = format!("the coefficient {text} has no inverse; a relation may only take the root of a non-square");
        Error::new(ErrorKind::BadValue, text)
    })
}
