//! One stratum: a region of parameters and its basis.

use super::{Cover, Region};
use crate::groebner::{Basis, reduced_basis};
use crate::number::{BigRational, Field};
use crate::poly::{Fraction, Fractions, Monomial, Polynomial, PolynomialRing};
use crate::{Error, ErrorKind, Result, Watch};

/// A region of parameters with constant leading monomials of the reduced basis.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Stratum<F: Field> {
    /// The region.
    pub region: Region<F::Element>,
    /// Equations of parts whose union is the closure of the region, as far as factors split it; usually one part.
    pub parts: Vec<Vec<Polynomial<F::Element>>>,
    /// The basis, one element for each leading monomial; empty where the equations are trivial.
    pub basis: Vec<Element<F>>,
    /// The solutions of the equations: none, finitely many, or a family.
    pub kind: Kind,
    /// Facts about its real points.
    pub real: RealPoints,
}

/// A basis element on a stratum. At every point some representative keeps its leading monomial. Each that does, divided
/// by its leading coefficient, is the element there.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Element<F: Field> {
    /// The leading monomial, of the unknowns.
    pub leading: Monomial,
    /// Polynomials in the unknowns with that leading monomial, simplest first. Usually there is one, and its leading
    /// coefficient is nowhere zero on the stratum.
    pub representatives: Vec<Polynomial<Fraction<F::Element>>>,
}

/// Number of solutions of the equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// No solution in any extension field: the unit ideal.
    Inconsistent,
    /// This many solutions over an algebraically closed field, counted with multiplicity.
    Finite(usize),
    /// Infinitely many solutions. The ideal has this dimension.
    Family(usize),
}

/// Facts about the real points of a stratum.
#[derive(Clone, Debug, PartialEq)]
pub enum RealPoints {
    /// There are none, for this reason.
    None(String),
    /// This rational point belongs to it; one value for each parameter.
    At(Vec<BigRational>),
    /// There are real points, for this reason.
    Some(String),
    /// Not computed, or no result.
    Unknown,
}

impl Kind {
    /// The kind of an ideal with these leading monomials.
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
    /// The stratum that contains `point`, with one value for each parameter; `None` when the point is outside the
    /// cover's space. `embed` maps the numbers of the cover to the field of the point.
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
    /// Computes the reduced basis at `point`, with one value for each parameter of `ring`. The variables of `target`
    /// are the unknowns. Its field may be larger than that of the parameters; `embed` maps numbers to it.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when the leading coefficients show that the point is not on the stratum;
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
