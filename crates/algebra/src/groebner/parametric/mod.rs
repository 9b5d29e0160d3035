//! Bases over the rational functions of parameters, by one of four ways that agree: [`basis`] is the entry.
//!
//! Directly over the field of fractions; with the parameters as the variables of a lowest block, over Q or modulo primes; or by
//! evaluation at many points modulo primes and interpolation of the coefficients. `docs/parametric_bases.md` tells how they work and how one is chosen.

mod assemble;
mod estimate;
mod flat;
mod fresh;
mod learn;
mod lift;
mod line;
mod modular;
mod on_a_line;
mod pattern;
mod pilot;
mod prime;
mod sequence;
mod system;
mod variables;

pub use variables::lift;

use super::Basis;
use crate::number::{BigRational, Rationals, Ring as _};
use crate::poly::{Fraction, Fractions, Polynomial, PolynomialRing, Term};
use crate::{Error, ErrorKind, Result, Watch};
use pilot::Pilot;

type Ring = PolynomialRing<Fractions<Rationals>>;
type Poly = Polynomial<Fraction<BigRational>>;

/// A way to the basis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Buchberger's algorithm over the rational functions: the reference.
    Direct,
    /// One basis over Q with the parameters as variables of the lowest block.
    Variables,
    /// The same modulo primes, by F4; its coefficients are rebuilt.
    Modular,
    /// Evaluation at many points modulo primes, and interpolation of each coefficient. Parameters must be free of relations.
    Interpolation,
}

/// Below this many terms the computation modulo a prime costs less than to think about it.
const FEW_TERMS: usize = 2_000;
/// As many terms at single points, eight of which are computed at once, cost as much as one term of the computation with the parameters as
/// variables, which looks at monomials and whose numbers are rebuilt.
const TERMS_OF_POINTS: usize = 16;

/// How [`basis`] works.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The way to take. `None`: modulo primes with the parameters as variables, as long as that takes no more terms than the
    /// bases at single points that interpolation would ask for, or where parameters have relations; else interpolation; directly should
    /// the coefficients be too dense for it.
    pub way: Option<Way>,
}

/// A basis over the rational functions and how it came about.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Parametric {
    /// The reduced basis, for generic values of the parameters.
    pub basis: Basis<Fractions<Rationals>>,
    /// The way that was taken.
    pub way: Way,
    /// Whether every step was exact. A basis that was interpolated or rebuilt is not: it has passed the test modulo another prime.
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
        None if ring.field().ring().variables().is_empty() => by_way(&ideal, Way::Variables, watch),
        None => by_the_fastest(&ideal, watch),
    }
}

/// Modulo primes where that takes few terms, else by interpolation; the exact ways stand behind them.
fn by_the_fastest(ideal: &Ideal<'_>, watch: &Watch) -> Result<Parametric> {
    let free = is_free(ideal);
    let outcome = if free { by_points_or_modular(ideal, watch) } else { by_way(ideal, Way::Modular, watch) };
    let is_refused = ends_with(&outcome, ErrorKind::Unsupported) || ends_with(&outcome, ErrorKind::Overflow);
    if is_refused { by_way(ideal, if free { Way::Direct } else { Way::Variables }, watch) } else { outcome }
}

/// [`Way::Modular`] within the terms that it is worth, else [`Way::Interpolation`].
fn by_points_or_modular(ideal: &Ideal<'_>, watch: &Watch) -> Result<Parametric> {
    let mut pilot = Pilot::bounded(ideal, watch);
    let outcome = modular::rebuilt_basis(ideal, &mut pilot, watch);
    let (basis, way) = match pilot.into_refused() {
        Some(system) => (at_points(ideal, &system, watch)?, Way::Interpolation),
        None => (outcome?, Way::Modular),
    };
    Ok(Parametric { basis, way, exact: false })
}

fn ends_with(outcome: &Result<Parametric>, kind: ErrorKind) -> bool {
    outcome.as_ref().is_err_and(|error| error.kind() == kind)
}

fn by_way(ideal: &Ideal<'_>, way: Way, watch: &Watch) -> Result<Parametric> {
    let found = match way {
        Way::Direct => super::basis(ideal.ring, ideal.generators, &super::Options::default(), watch),
        Way::Variables => variables::basis_with_variables(ideal, watch),
        Way::Modular => modular::rebuilt_basis(ideal, &mut Pilot::unbounded(ideal, watch), watch),
        Way::Interpolation => interpolated(ideal, watch),
    };
    Ok(Parametric { basis: found?, way, exact: matches!(way, Way::Direct | Way::Variables) })
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
    at_points(ideal, &system::System::new(ideal, watch)?, watch)
}

/// The basis of a system that has been learned.
fn at_points(ideal: &Ideal<'_>, system: &system::System, watch: &Watch) -> Result<Basis<Fractions<Rationals>>> {
    let (ring, field) = (ideal.ring, ideal.ring.field());
    let mut coefficients = lift::interpolate(system, field, watch)?.into_iter();
    let polynomials = system.supports.iter().map(|support| {
        let values = std::iter::once(field.one()).chain(coefficients.by_ref().take(support.len() - 1));
        let terms = support.iter().zip(values).map(|(m, coefficient)| Term { coefficient, monomial: m.clone() });
        ring.collect(terms.collect::<Vec<_>>())
    });
    Ok(Basis { ring: ring.clone(), polynomials: polynomials.collect(), cofactors: Vec::new() })
}
