//! One stratum: a region of parameters, and the basis that holds there.

use super::{Cover, Region};
use crate::groebner::{Basis, reduced_basis};
use crate::number::{BigRational, Field};
use crate::poly::{Fraction, Fractions, Monomial, Polynomial, PolynomialRing};
use crate::{Error, ErrorKind, Result, Watch};

/// A region of parameters on which the leading monomials of the reduced basis stay the same.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Stratum<F: Field> {
    /// Where it is.
    pub region: Region<F::Element>,
    /// Equations of parts that together make the closure of the region, as far as factors split it; mostly one.
    pub parts: Vec<Vec<Polynomial<F::Element>>>,
    /// The basis, one element a leading monomial; empty where the equations say nothing.
    pub basis: Vec<Element<F>>,
    /// What the equations amount to there.
    pub kind: Kind,
    /// What is known of its real points.
    pub real: RealPoints,
}

/// A basis element on a stratum: at every point some representative keeps its leading monomial, and each that does, divided
/// by its leading coefficient, may stand for the element.
#[derive(Clone, Debug, PartialEq)]
pub struct Element<F: Field> {
    /// The leading monomial, of the unknowns.
    pub leading: Monomial,
    /// Polynomials in the unknowns with that leading monomial, simplest first; mostly one, whose leading coefficient
    /// is then zero nowhere on the stratum.
    pub representatives: Vec<Polynomial<Fraction<F::Element>>>,
}

/// What the equations amount to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// No solution, in no extension field: the unit ideal.
    Inconsistent,
    /// So many solutions over an algebraically closed field, counted with multiplicity.
    Finite(usize),
    /// Infinitely many solutions; the ideal has this dimension.
    Family(usize),
}

/// What is known of the real points of a stratum.
#[derive(Clone, Debug, PartialEq)]
pub enum RealPoints {
    /// There is none, for this reason.
    None(String),
    /// This rational point lies on it, one value a parameter.
    At(Vec<BigRational>),
    /// There are some, for this reason.
    Some(String),
    /// Neither was asked or neither was found.
    Unknown,
}

impl Kind {
    /// What an ideal with these leading monomials has.
    pub(super) fn of<F: Field>(ring: &PolynomialRing<F>, leading: &[&Monomial]) -> Kind {
        let leads = leading.iter().map(|&monomial| ring.term(ring.field().one(), monomial.clone()));
        let basis = Basis { ring: ring.clone(), polynomials: leads.collect(), cofactors: Vec::new() };
        match (basis.independent_variables(), basis.quotient_dimension()) {
            (None, _) => Kind::Inconsistent,
            (Some(_), Some(count)) => Kind::Finite(count),
            (Some(free), None) => Kind::Family(free.len()),
        }
    }
}

impl<F: Field> Cover<F> {
    /// The stratum of `point`, one value a parameter; `None` when the point lies outside of the cover's space. `embed` takes the
    /// numbers of the cover to the field of the point.
    pub fn at<G: Field>(
        &self,
        field: &G,
        point: &[G::Element],
        embed: &impl Fn(&F::Element) -> G::Element,
    ) -> Option<&Stratum<F>> {
        let parameters = self.ring.field().ring();
        self.strata.iter().find(|stratum| stratum.region.contains(parameters, field, point, embed))
    }
}

impl<F: Field> Stratum<F> {
    /// The reduced basis at `point` (one value a parameter of `ring`) in `target`, whose variables are the unknowns and whose
    /// field may be larger than that of the parameters: `embed` takes numbers there.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when the point does not lie on the stratum, as far as the leading coefficients show;
    /// [`ErrorKind::Overflow`].
    pub fn specialise<G: Field>(
        &self,
        ring: &PolynomialRing<Fractions<F>>,
        point: &[G::Element],
        target: &PolynomialRing<G>,
        embed: &impl Fn(&F::Element) -> G::Element,
    ) -> Result<Basis<G>> {
        let polynomials = self.basis.iter().map(|element| element.specialise(ring, point, target, embed));
        let polynomials = polynomials.collect::<Result<Vec<_>>>()?;
        let cofactors = vec![Vec::new(); polynomials.len()];
        let reduced = reduced_basis(target, polynomials, cofactors, &Watch::none())?;
        Ok(Basis { cofactors: Vec::new(), ..reduced })
    }
}

impl<F: Field> Element<F> {
    fn specialise<G: Field>(
        &self,
        ring: &PolynomialRing<Fractions<F>>,
        point: &[G::Element],
        target: &PolynomialRing<G>,
        embed: &impl Fn(&F::Element) -> G::Element,
    ) -> Result<Polynomial<G::Element>> {
        let (parameters, field) = (ring.field().ring(), target.field());
        let value = |c: &Fraction<F::Element>| parameters.substitute(c.numerator(), field, point, embed);
        for f in &self.representatives {
            let lead = f.leading().expect("a basis element is not zero");
            if !field.is_zero(&value(&lead.coefficient)) {
                return ring.map_into(f, target, |c| Ok(value(c)));
            }
        }
        let text = "the point is not on this stratum: a leading coefficient is zero there";
        Err(Error::new(ErrorKind::BadValue, text))
    }
}
