//! The proof that the basis of a stratum is a Groebner basis at each of its points.
//!
//! Every choice of representatives is taken where their leading coefficients are not zero. There it is enough that each is a
//! combination of the generators modulo the stratum's equations, and that generators and S-polynomials reduce to zero when
//! they are multiplied by leading coefficients on the way (Buchberger's criterion at every point at once).

use super::check::refused;
use super::flat::Flat;
use super::ideals::Ideals;
use super::{Region, Stratum};
use crate::groebner::normal_form;
use crate::number::{Field, Ring};
use crate::poly::{Fractions, Monomial, Polynomial, PolynomialRing, Term};
use crate::{Result, Watch};

type Parametric<F> = Polynomial<<Fractions<F> as Ring>::Element>;

/// What is to be proved: `stratum` has the right basis for the ideal of `generators`.
pub(super) struct Claims<'a, F: Field> {
    pub ring: &'a PolynomialRing<Fractions<F>>,
    pub generators: &'a [Parametric<F>],
    pub stratum: &'a Stratum<F>,
    pub watch: &'a Watch,
}

/// Proves the claims; the number of S-polynomials that were reduced.
pub(super) fn prove_basis<F: Field>(claims: &Claims<'_, F>) -> Result<usize> {
    let Claims { ring, stratum, watch, .. } = claims;
    let ideals = Ideals::new(ring.field().ring(), watch)?;
    for f in stratum.basis.iter().flat_map(|element| &element.representatives) {
        claims.is_combination(f)?;
    }
    let mut count = 0;
    for basis in choices(stratum) {
        let leads = basis.iter().filter_map(|f| f.leading()).map(|lead| vec![lead.coefficient.numerator().clone()]);
        let region = Region {
            equations: ideals.ideal(&stratum.region.equations)?,
            exclusions: stratum.region.exclusions.iter().cloned().chain(leads).collect(),
        };
        let Some(closure) = ideals.closure_of(&region, &[])? else { continue };
        let reduction = Reduction { ring, closure, basis };
        count += reduction.prove(claims.generators, watch)?;
    }
    Ok(count)
}

impl<F: Field> Claims<'_, F> {
    /// Whether `f` lies in the ideal of generators and equations of the stratum.
    fn is_combination(&self, f: &Parametric<F>) -> Result<()> {
        let flat = Flat::new(self.ring, self.generators)?;
        if flat.contains(&self.stratum.region.equations, f, self.watch)? {
            return Ok(());
        }
        let text = self.ring.format(f, crate::number::Style::Text);
        Err(refused(format!("{text} is no combination of the generators on the stratum")))
    }
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

/// Division by `basis` with coefficients modulo `closure`, leading coefficients being units.
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
        let mut rest = self.modulo_equations(f)?;
        while let Some(lead) = rest.leading() {
            watch.check()?;
            watch.check_terms(rest.terms().len())?;
            let divisor = self.basis.iter().find_map(|g| {
                let top = g.leading()?;
                Some((g, self.ring.layout().checked_div(&lead.monomial, &top.monomial)?))
            });
            let Some((g, factor)) = divisor else { return Ok(false) };
            rest = self.modulo_equations(&self.cancelled(&rest, &self.ring.layout().one(), g, &factor)?)?;
        }
        Ok(true)
    }

    fn s_polynomial(&self, f: &Parametric<F>, g: &Parametric<F>) -> Result<Parametric<F>> {
        let (a, b) = (lead(f), lead(g));
        let lcm = self.ring.lcm(&a.monomial, &b.monomial)?;
        let lift = |m: &Monomial| self.ring.layout().checked_div(&lcm, m).expect("a common multiple is divisible");
        self.cancelled(f, &lift(&a.monomial), g, &lift(&b.monomial))
    }

    /// `b m f - a n g`, where `a` and `b` are the leading coefficients of `f` and `g`.
    fn cancelled(&self, f: &Parametric<F>, m: &Monomial, g: &Parametric<F>, n: &Monomial) -> Result<Parametric<F>> {
        let first = self.ring.mul_term(f, &lead(g).coefficient, m)?;
        self.ring.sub_mul_term(&first, &lead(f).coefficient, n, g)
    }

    fn modulo_equations(&self, f: &Parametric<F>) -> Result<Parametric<F>> {
        let field = self.ring.field();
        self.ring.map_into(f, self.ring, |c| Ok(field.embed(&normal_form(field.ring(), c.numerator(), &self.closure)?)))
    }
}

fn lead<E>(f: &Polynomial<E>) -> &Term<E> {
    f.leading().expect("a basis element is not zero")
}
