//! Pseudo-division: it multiplies by leading coefficients instead of dividing by them, so coefficients stay
//! polynomials.

use crate::Result;
use crate::groebner::normal_form;
use crate::number::{Field, Ring};
use crate::poly::{Fraction, Fractions, Monomial, Polynomial, PolynomialRing, Term};

type Unknowns<F> = PolynomialRing<Fractions<F>>;
type Coefficient<F> = Fraction<<F as Ring>::Element>;
type Parametric<F> = Polynomial<Coefficient<F>>;

/// The leading term of a basis element.
pub(super) fn lead<E>(f: &Polynomial<E>) -> &Term<E> {
    f.leading().expect("a basis element is not zero")
}

/// `b f - a n g` for the leading coefficient `b` of `g` and the coefficient `a` of `term`. `term` is a term of `f`, `n`
/// times the leading monomial of `g`.
pub(super) fn cancelled<F: Field>(
    ring: &Unknowns<F>,
    f: &Parametric<F>,
    term: &Term<Coefficient<F>>,
    g: &Parametric<F>,
    n: &Monomial,
) -> Result<Parametric<F>> {
    ring.sub_mul_term(&ring.scale(f, &lead(g).coefficient), &term.coefficient, n, g)
}

/// `f` with the normal forms of its coefficients by the basis `closure`.
pub(super) fn modulo<F: Field>(
    ring: &Unknowns<F>,
    f: &Parametric<F>,
    closure: &[Polynomial<F::Element>],
) -> Result<Parametric<F>> {
    let field = ring.field();
    ring.map_into(f, ring, |c| Ok(field.embed(&normal_form(field.ring(), c.numerator(), closure)?)))
}
