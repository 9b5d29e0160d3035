//! Groebner bases over the rational functions of parameters, by one of four methods with equal results: [`basis`].
//!
//! The methods work directly over the field of fractions, or with the parameters as variables of a lowest block, over Q
//! or modulo primes. The fourth evaluates at many points modulo primes and interpolates the coefficients.
//! `docs/parametric_bases.md` explains the methods and the choice between them.

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

/// Method for a parametric basis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Buchberger's algorithm over the rational functions: the reference.
    Direct,
    /// One basis over Q with the parameters as variables of the lowest block.
    Variables,
    /// Same as `Variables`, but modulo primes, by F4. The coefficients are reconstructed.
    Modular,
    /// Evaluation at many points modulo primes, and interpolation of each coefficient. Parameters must have no
    /// relations.
    Interpolation,
}

/// Below this number of terms, the computation modulo a prime is cheaper than an estimate.
const FEW_TERMS: usize = 2_000;
/// Cost ratio: this many terms at single points cost as much as one term with the parameters as variables. Points are
/// computed eight at a time. The other computation processes monomials and reconstructs numbers.
const TERMS_OF_POINTS: usize = 16;

/// Options of [`basis`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The method. `None` selects the computation modulo primes with the parameters as variables, if parameters have
    /// relations. It is also selected if it takes no more terms than the points of an interpolation. Else the basis is
    /// interpolated. If the coefficients are too dense for that, the direct method is used.
    pub method: Option<Method>,
}

/// A basis over the rational functions, with the method that computed it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Parametric {
    /// The reduced basis, for generic values of the parameters.
    pub basis: Basis<Fractions<Rationals>>,
    /// The method that was used.
    pub method: Method,
    /// Whether every step was exact. An interpolated or reconstructed basis is not exact: it was tested modulo another
    /// prime.
    pub exact: bool,
}

/// The input of all methods.
struct Ideal<'a> {
    ring: &'a Ring,
    generators: &'a [Poly],
}

/// Computes the reduced Groebner basis of `generators` over the rational functions of the parameters, in the order of
/// `ring`.
///
/// # Errors
/// [`ErrorKind::Unsupported`] when interpolation is requested and parameters have relations, or when the coefficients
/// are too dense for it; those of [`super::basis`]; the error with which `watch` stops the work.
pub fn basis<'w>(
    ring: &Ring,
    generators: &[Poly],
    options: &Options,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Parametric> {
    let watch = Watch::or_none(watch);
    let generators: Vec<Poly> = generators.iter().filter(|f| !f.is_zero()).cloned().collect();
    let ideal = Ideal { ring, generators: &generators };
    match options.method {
        Some(method) => by_method(&ideal, method, watch),
        None if ring.field().ring().variables().is_empty() => by_method(&ideal, Method::Variables, watch),
        None => by_the_fastest(&ideal, watch),
    }
}

/// Computes the basis modulo primes where that takes few terms, else by interpolation. The exact methods are the
/// fallback.
fn by_the_fastest(ideal: &Ideal<'_>, watch: &Watch) -> Result<Parametric> {
    let free = is_free(ideal);
    let outcome = if free { by_points_or_modular(ideal, watch) } else { by_method(ideal, Method::Modular, watch) };
    let is_refused = ends_with(&outcome, ErrorKind::Unsupported) || ends_with(&outcome, ErrorKind::Overflow);
    if is_refused { by_method(ideal, if free { Method::Direct } else { Method::Variables }, watch) } else { outcome }
}

/// Tries [`Method::Modular`] within its limit of terms, else [`Method::Interpolation`].
fn by_points_or_modular(ideal: &Ideal<'_>, watch: &Watch) -> Result<Parametric> {
    let mut pilot = Pilot::bounded(ideal, watch);
    let outcome = modular::rebuilt_basis(ideal, &mut pilot, watch);
    let (basis, method) = match pilot.into_refused() {
        Some(system) => (at_points(ideal, &system, watch)?, Method::Interpolation),
        None => (outcome?, Method::Modular),
    };
    Ok(Parametric { basis, method, exact: false })
}

fn ends_with(outcome: &Result<Parametric>, kind: ErrorKind) -> bool {
    outcome.as_ref().is_err_and(|error| error.kind() == kind)
}

fn by_method(ideal: &Ideal<'_>, method: Method, watch: &Watch) -> Result<Parametric> {
    let found = match method {
        Method::Direct => super::basis(ideal.ring, ideal.generators, &super::Options::default(), watch),
        Method::Variables => variables::basis_with_variables(ideal, watch),
        Method::Modular => modular::rebuilt_basis(ideal, &mut Pilot::unbounded(ideal, watch), watch),
        Method::Interpolation => interpolated(ideal, watch),
    };
    Ok(Parametric { basis: found?, method, exact: matches!(method, Method::Direct | Method::Variables) })
}

/// Whether there are parameters without relations.
fn is_free(ideal: &Ideal<'_>) -> bool {
    let field = ideal.ring.field();
    let count = field.ring().variables().len();
    count > 0 && !(0..count).any(|v| field.is_algebraic(v))
}

/// The basis with interpolated coefficients.
fn interpolated(ideal: &Ideal<'_>, watch: &Watch) -> Result<Basis<Fractions<Rationals>>> {
    if !is_free(ideal) {
        let text = "interpolation needs parameters without relations; use another method";
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
