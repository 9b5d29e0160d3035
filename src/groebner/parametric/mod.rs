//! Bases over the rational functions of parameters, by one of three ways that agree: [`basis`] is the entry.
//!
//! Directly over the field of fractions; with the parameters as the variables of a lowest block; or by evaluation at many points
//! modulo primes and interpolation of the coefficients. `docs/parametric_bases.md` tells how they work and how one is chosen.

mod learn;
mod lift;
mod line;
mod pattern;
mod prime;
mod sequence;
mod system;
mod variables;

use super::Basis;
use crate::number::{BigRational, Rationals, Ring as _};
use crate::poly::{Fraction, Fractions, Polynomial, PolynomialRing, Term};
use crate::{Error, ErrorKind, Result, Watch};

type Ring = PolynomialRing<Fractions<Rationals>>;
type Poly = Polynomial<Fraction<BigRational>>;

/// A way to the basis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Buchberger's algorithm over the rational functions: the reference.
    Direct,
    /// One basis over Q with the parameters as variables of the lowest block.
    Variables,
    /// Evaluation at many points modulo primes, and interpolation of each coefficient. Parameters must be free of relations.
    Interpolation,
}

/// How [`basis`] works.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The way to take. `None`: interpolation where parameters have no relations, directly should they be too dense for it; else with
    /// the parameters as variables.
    pub way: Option<Way>,
}

/// A basis over the rational functions and how it came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Parametric {
    /// The reduced basis, for generic values of the parameters.
    pub basis: Basis<Fractions<Rationals>>,
    /// The way that was taken.
    pub way: Way,
    /// Whether every step was exact. An interpolated basis is not: it has passed the test at a random point modulo another prime.
    pub exact: bool,
}

/// The input of all ways.
struct Ideal<'a> {
    ring: &'a Ring,
    generators: &'a [Poly],
}

/// The reduced Groebner basis of `generators` over the rational functions of the parameters, in the order of `ring`.
///
/// # Errors
/// [`ErrorKind::Unsupported`] when interpolation is asked for and parameters have relations, or when the coefficients are too
/// dense for it; those of [`super::basis`]; what `watch` stops with.
pub fn basis(ring: &Ring, generators: &[Poly], options: &Options, watch: &Watch) -> Result<Parametric> {
    let generators: Vec<Poly> = generators.iter().filter(|f| !f.is_zero()).cloned().collect();
    let ideal = Ideal { ring, generators: &generators };
    match options.way {
        Some(way) => by_way(&ideal, way, watch),
        None if !is_free(&ideal) => by_way(&ideal, Way::Variables, watch),
        None => match by_way(&ideal, Way::Interpolation, watch) {
            Err(error) if error.kind() == ErrorKind::Unsupported => by_way(&ideal, Way::Direct, watch),
            outcome => outcome,
        },
    }
}

fn by_way(ideal: &Ideal<'_>, way: Way, watch: &Watch) -> Result<Parametric> {
    let found = match way {
        Way::Direct => super::basis(ideal.ring, ideal.generators, &super::Options::default(), watch),
        Way::Variables => variables::basis_with_variables(ideal, watch),
        Way::Interpolation => interpolated(ideal, watch),
    };
    Ok(Parametric { basis: found?, way, exact: way != Way::Interpolation })
}

/// Whether there are parameters, and no relations between them.
fn is_free(ideal: &Ideal<'_>) -> bool {
    let field = ideal.ring.field();
    let count = field.ring().variables().len();
    count > 0 && !(0..count).any(|v| field.is_algebraic(v))
}

/// The basis whose coefficients are interpolated.
fn interpolated(ideal: &Ideal<'_>, watch: &Watch) -> Result<Basis<Fractions<Rationals>>> {
    if !is_free(ideal) {
        let text = "interpolation needs parameters, and none with a relation; take another way";
        return Err(Error::new(ErrorKind::Unsupported, text));
    }
    let system = system::System::new(ideal, watch)?;
    let (ring, field) = (ideal.ring, ideal.ring.field());
    let mut coefficients = lift::interpolate(&system, field, watch)?.into_iter();
    let polynomials = system.supports.iter().map(|support| {
        let values = std::iter::once(field.one()).chain(coefficients.by_ref().take(support.len() - 1));
        let terms = support.iter().zip(values).map(|(m, coefficient)| Term { coefficient, monomial: m.clone() });
        ring.collect(terms.collect::<Vec<_>>())
    });
    Ok(Basis { ring: ring.clone(), polynomials: polynomials.collect(), cofactors: Vec::new() })
}
