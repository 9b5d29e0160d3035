//! The proof that the basis of a stratum is a Groebner basis at each of its points.
//!
//! Every choice of representatives is tested where their leading coefficients are not zero. Each must be a combination
//! of the generators modulo the stratum's equations. Generators and S-polynomials must reduce to zero by
//! pseudo-division with these leading coefficients. This is Buchberger's criterion for all points at once.

use super::emptiness::Regions;
use super::flat::Flat;
use super::ideals::Ideals;
use super::pseudo::{cancelled, lead, modulo};
use super::{Region, Stratum};
use crate::number::{Field, Ring};
use crate::poly::{Fractions, Monomial, Polynomial, PolynomialRing};
use crate::{Error, ErrorKind, Result, Watch};

type Parametric<F> = Polynomial<<Fractions<F> as Ring>::Element>;

/// The claim: `stratum` has a Groebner basis for the ideal of `generators`.
pub(super) struct Claims<'a, F: Field> {
    pub ring: &'a PolynomialRing<Fractions<F>>,
    pub generators: &'a [Parametric<F>],
    pub stratum: &'a Stratum<F>,
    pub watch: &'a Watch,
}

/// Proves the claims. Returns the number of reduced S-polynomials.
pub(super) fn prove_basis<F: Field>(claims: &Claims<'_, F>) -> Result<usize> {
    claims.representatives_belong()?;
    let Claims { ring, generators, stratum, watch } = claims;
    let ideals = Ideals::new(ring.field().ring(), watch)?;
    let mut count = 0;
    for basis in choices(stratum) {
        let leads = basis.iter().map(|f| vec![lead(f).coefficient.numerator().clone()]);
        let region = Region {
            equations: stratum.region.equations.clone(),
            exclusions: stratum.region.exclusions.iter().cloned().chain(leads).collect(),
        };
        let Some(closure) = ideals.closure_of(&region, &[])? else { continue };
        count += Reduction { ring, closure, basis }.prove(generators, watch)?;
    }
    Ok(count)
}

impl<F: Field> Claims<'_, F> {
    /// Checks that each representative belongs to the ideal at each point of the stratum: some nonzero multiple of it
    /// does.
    fn representatives_belong(&self) -> Result<()> {
        let flat = Flat::new(self.ring, self.generators)?;
        let regions = Regions { ring: self.ring.field().ring(), watch: self.watch };
        for f in self.stratum.basis.iter().flat_map(|element| &element.representatives) {
            let mut failure = self.stratum.region.clone();
            failure.equations.extend(flat.multipliers(&self.stratum.region.equations, f, self.watch)?);
            if !regions.is_empty(&failure)? {
                let text = self.ring.format(f, crate::number::Style::Text);
                return Err(refused(format!("{text} is not everywhere in the ideal")));
            }
        }
        Ok(())
    }
}

/// Builds the error for a claim that fails.
pub(super) fn refused(text: impl Into<String>) -> Error {
    Error::new(ErrorKind::Certificate, text)
}

/// Every choice of one representative for each element.
fn choices<F: Field>(stratum: &Stratum<F>) -> Vec<Vec<Parametric<F>>> {
    stratum.basis.iter().fold(vec![Vec::new()], |choices, element| {
        let longer = |choice: &Vec<Parametric<F>>| {
            let next = element.representatives.iter().map(|f| [choice.as_slice(), std::slice::from_ref(f)].concat());
            next.collect::<Vec<_>>()
        };
        choices.iter().flat_map(longer).collect()
    })
}

/// Division by `basis` with coefficients modulo `closure`. Leading coefficients are units.
struct Reduction<'a, F: Field> {
    ring: &'a PolynomialRing<Fractions<F>>,
    closure: Vec<Polynomial<F::Element>>,
    basis: Vec<Parametric<F>>,
}

impl<F: Field> Reduction<'_, F> {
    fn prove(&self, generators: &[Parametric<F>], watch: &Watch) -> Result<usize> {
        for f in generators {
            if !self.reduces_to_zero(f, watch)? {
                return Err(refused("a generator does not reduce to zero"));
            }
        }
        let mut count = 0;
        for (index, g) in self.basis.iter().enumerate() {
            for f in &self.basis[..index] {
                if !self.reduces_to_zero(&self.s_polynomial(f, g)?, watch)? {
                    return Err(refused("an S-polynomial does not reduce to zero"));
                }
                count += 1;
            }
        }
        Ok(count)
    }

    fn reduces_to_zero(&self, f: &Parametric<F>, watch: &Watch) -> Result<bool> {
        let mut rest = modulo(self.ring, f, &self.closure)?;
        while let Some(top) = rest.leading().cloned() {
            watch.check()?;
            watch.check_terms(rest.terms().len())?;
            let factor = |g: &Parametric<F>| self.ring.layout().checked_div(&top.monomial, &lead(g).monomial);
            let Some((g, factor)) = self.basis.iter().find_map(|g| Some((g, factor(g)?))) else { return Ok(false) };
            rest = modulo(self.ring, &cancelled(self.ring, &rest, &top, g, &factor)?, &self.closure)?;
        }
        Ok(true)
    }

    fn s_polynomial(&self, f: &Parametric<F>, g: &Parametric<F>) -> Result<Parametric<F>> {
        let (a, b) = (&lead(f).monomial, &lead(g).monomial);
        let lcm = self.ring.lcm(a, b)?;
        let lift = |m: &Monomial| self.ring.layout().checked_div(&lcm, m).expect("a common multiple is divisible");
        let first = self.ring.mul_term(f, &lead(g).coefficient, &lift(a))?;
        self.ring.sub_mul_term(&first, &lead(f).coefficient, &lift(b), g)
    }
}
