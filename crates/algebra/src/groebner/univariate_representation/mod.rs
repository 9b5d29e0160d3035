//! The rational univariate representation of a zero-dimensional ideal over Q: [`UnivariateRepresentation`].
//!
//! F. Rouillier, "Solving zero-dimensional systems through the rational univariate representation", AAECC 9 (1999); A.
//! Bostan, B. Salvy, E. Schost, "Fast algorithms for zero-dimensional polynomial systems using duality", AAECC 14
//! (2003).
//!
//! It is computed modulo primes, lifted, then proved over Q ([`certify`]). The proof assumes that the dimension of the
//! quotient ring by the basis is correct. For ideals with multiple points it assumes that the basis is correct.

mod certify;
mod integral;
mod lift;
mod modular;
mod residues;
mod shape;
mod staircase;
mod substitute;

use num_bigint::BigInt;

use self::lift::Lift;
use self::modular::{Modular, QuotientModulo};
use self::shape::Shape;
use self::staircase::{Border, Staircase};
use super::Basis;
use crate::number::{BigRational, Rationals, primes_below};
use crate::poly::univariate::Univariate;
use crate::poly::{Polynomial, PolynomialRing};
use crate::{Error, ErrorKind, Result, Watch};

/// The distinct complex solutions of a zero-dimensional system as `x_v = g_v(t) / f'(t)` for the roots `t` of `f`.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct UnivariateRepresentation {
    /// The names of the unknowns.
    pub variables: Vec<String>,
    /// The separating linear form: `t = sum form[v] x_v` has a different value at each solution.
    pub form: Vec<i64>,
    /// The polynomial `f`: square-free, with the number of distinct complex solutions as its degree.
    pub polynomial: Univariate<BigInt>,
    /// The numerators `g_v`, one for each variable, of degree below that of `f`.
    pub numerators: Vec<Univariate<BigInt>>,
    /// Primitive polynomials whose product is `f` up to a constant, each with the multiplicity of the solutions at its roots.
    pub multiplicities: Vec<(usize, Univariate<BigInt>)>,
}

/// Computes the rational univariate representation of the solutions of `generators`. `basis` is the reduced Groebner
/// basis of their ideal, in any order.
///
/// It is proved over Q that the generators vanish at `g / f'` modulo `f`, that the points are distinct, and that there
/// is no further one.
///
/// # Errors
/// [`ErrorKind::Inconsistent`] for the unit ideal, [`ErrorKind::PositiveDimensional`]; [`ErrorKind::BadValue`] when the
/// basis does not belong to the generators; [`ErrorKind::Overflow`]; the error with which `watch` stops the work.
pub fn univariate_representation<'w>(
    basis: &Basis<Rationals>,
    generators: &[Polynomial<BigRational>],
    watch: impl Into<Option<&'w Watch>>,
) -> Result<UnivariateRepresentation> {
    let watch = Watch::or_none(watch);
    let staircase = Staircase::new(basis)?;
    let (form, shape) = separating_form(&staircase, watch)?;
    let border = staircase.border((0..form.len()).filter(|&v| form[v] != 0))?;
    let mut refuted = 0;
    let mut lift = Lift::new(shape);
    for prime in primes() {
        watch.check()?;
        watch.report("univariate representation", lift.primes(), 0);
        let Some(modular) = modulo(&staircase, &border, prime, &form, watch)? else { continue };
        let Some(residues) = lift.lucky_residues(&modular) else { continue };
        if let Some(values) = lift.confirmed(&residues, prime) {
            let representation = lift.shape().assemble(basis.ring.variables(), &form, &values);
            if certify::holds(&representation, basis, generators, &staircase, watch)? {
                return Ok(representation);
            }
            refuted += 1;
        }
        if refuted == MAX_REFUTED {
            break;
        }
        lift.add(prime, &residues);
    }
    Err(foreign_basis())
}

/// Maximum number of candidates that agree with a new prime but fail the proof. More are not due to chance.
const MAX_REFUTED: usize = 3;

/// Maximum number of primes without a separating form. More mean that the multiplications do not commute.
const MAX_SEARCH: usize = 16;

fn foreign_basis() -> Error {
    let text = "the basis is not a Groebner basis of the ideal of the generators; give the reduced one";
    Error::new(ErrorKind::BadValue, text)
}

/// The primes below `2^31`, greatest first.
fn primes() -> impl Iterator<Item = u32> {
    primes_below(1 << 31).map(|p| p as u32)
}

fn modulo(staircase: &Staircase, border: &Border, prime: u32, form: &[i64], watch: &Watch) -> Result<Option<Modular>> {
    match QuotientModulo::new(staircase, border, prime, watch)? {
        Some(quotient) => quotient.representation(form, watch),
        None => Ok(None),
    }
}

/// A linear form that separates the solutions modulo some prime, with the shape of its representation there. The
/// certificate of the representation proves that it separates the solutions over Q.
fn separating_form(staircase: &Staircase, watch: &Watch) -> Result<(Vec<i64>, Shape)> {
    let border = staircase.border(0..staircase.variables())?;
    let reduced = |prime| QuotientModulo::new(staircase, &border, prime, watch).transpose();
    for (attempt, quotient) in primes().filter_map(reduced).take(MAX_SEARCH).enumerate() {
        let quotient = quotient?;
        let mut points = None;
        for form in linear_forms(staircase.variables()).take(staircase.variables() + 8 * (attempt + 1)) {
            let Some(modular) = quotient.representation(&form, watch)? else { continue };
            let shape = Shape::of(&modular);
            if shape.degree == staircase.dimension() {
                return Ok((form, shape));
            }
            if points.is_none() {
                points = quotient.count_points(watch)?;
            }
            if Some(shape.degree) == points && quotient.represents(&form, &modular, watch)? {
                return Ok((form, shape));
            }
        }
    }
    Err(foreign_basis())
}

/// The candidate forms: single variables, the last one first, then small coefficients that grow slowly.
fn linear_forms(variables: usize) -> impl Iterator<Item = Vec<i64>> {
    let unit = move |v: usize| (0..variables).map(|w| i64::from(v == w)).collect();
    let mixed = move |k: usize| {
        let bound = 2 + k / 3;
        (0..variables).map(|v| ((7 * v * v + 5 * k * v + 3 * k) % (2 * bound + 1)) as i64 - bound as i64).collect()
    };
    (0..variables).rev().map(unit).chain((0..).map(mixed))
}

impl UnivariateRepresentation {
    /// The number of distinct complex solutions.
    pub fn count(&self) -> usize {
        self.polynomial.degree().unwrap_or(0)
    }

    /// `f'`, the common denominator of the coordinates.
    pub fn slope(&self) -> Univariate<BigInt> {
        univariate(integral::derivative(&self.polynomial.coefficients))
    }

    /// The integer polynomial `P` with `h = P(t) / (c f'(t)^d)` at the solutions. `d` is the total degree of `h`, and
    /// `c` is the returned positive integer. `ring` has the variables of the representation, in its order.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `ring` has other variables; the error with which `watch` stops the work.
    pub fn substitute<'w>(
        &self,
        ring: &PolynomialRing<Rationals>,
        h: &Polynomial<BigRational>,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<(Univariate<BigInt>, BigInt)> {
        let watch = Watch::or_none(watch);
        if ring.variables() != self.variables.as_slice() {
            let text = format!("the polynomial must be in the variables {}, in this order", self.variables.join(", "));
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let slope = self.slope();
        let numerators = self.numerators.iter().map(|g| g.coefficients.as_slice());
        let (value, denominator) =
            substitute::Substitution::new(numerators, &slope.coefficients).apply(ring, h, watch)?;
        Ok((univariate(value), denominator))
    }
}

fn univariate(coefficients: Vec<BigInt>) -> Univariate<BigInt> {
    Univariate { coefficients: integral::trim(coefficients) }
}
