//! The proof of a representation over Q.
//!
//! 1. `sum form[v] g_v = T f' - deg(f) f`: the form has the value `t` at the point of the root `t`, so the points are
//!    distinct.
//! 2. Every generator, made homogeneous and evaluated at `(g, f')` in exact integers, is divisible by `f`: each point
//!    is a solution.
//! 3. If there are as many points as the dimension of the quotient ring, there is no further point, and all are simple.
//!    Otherwise `f(t)` and `f'(t) x_v - g_v(t)` are shown to be nilpotent in the quotient ring: they vanish modulo
//!    primes whose product exceeds a bound on the numerators of their powers. So every solution is one of the points.
//!
//! `f` is square-free and the multiplicities are correct, because a lucky prime shows both: distinct roots modulo `p`
//! are images of distinct roots, and the characteristic polynomial of `t` keeps their multiplicities.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::lift::residue;
use super::modular::QuotientModulo;
use super::residues::trim;
use super::staircase::{Border, Row, Staircase};
use super::substitute::Substitution;
use super::{UnivariateRepresentation, integral, primes};
use crate::groebner::Basis;
use crate::number::{BigRational, Rationals};
use crate::poly::Polynomial;
use crate::{Result, Watch};

/// Whether `representation` represents the solutions of `generators`.
///
/// # Errors
/// [`crate::ErrorKind::Overflow`]; the error with which `watch` stops the work.
pub(super) fn holds(
    representation: &UnivariateRepresentation,
    basis: &Basis<Rationals>,
    generators: &[Polynomial<BigRational>],
    staircase: &Staircase,
    watch: &Watch,
) -> Result<bool> {
    let simple = representation.count() == staircase.dimension();
    Ok(form_is_the_parameter(representation)
        && classes_multiply_to_the_polynomial(representation)
        && generators_vanish(representation, basis, generators, watch)?
        && (simple || no_further_point(representation, staircase, watch)?))
}

fn form_is_the_parameter(representation: &UnivariateRepresentation) -> bool {
    let f = &representation.polynomial.coefficients;
    let mut difference = vec![BigInt::zero()];
    difference.extend(integral::derivative(f));
    integral::add_scaled(&mut difference, &-BigInt::from(f.len() - 1), f);
    for (&factor, numerator) in representation.form.iter().zip(&representation.numerators) {
        integral::add_scaled(&mut difference, &-BigInt::from(factor), &numerator.coefficients);
    }
    difference.iter().all(Zero::is_zero)
}

fn classes_multiply_to_the_polynomial(representation: &UnivariateRepresentation) -> bool {
    let factors = representation.multiplicities.iter().map(|(_, factor)| &factor.coefficients);
    let product = factors.fold(vec![BigInt::one()], |product, factor| integral::product(&product, factor));
    product == integral::primitive(&representation.polynomial.coefficients)
}

fn generators_vanish(
    representation: &UnivariateRepresentation,
    basis: &Basis<Rationals>,
    generators: &[Polynomial<BigRational>],
    watch: &Watch,
) -> Result<bool> {
    let f = integral::primitive(&representation.polynomial.coefficients);
    let slope = representation.slope();
    let numerators = representation.numerators.iter().map(|g| g.coefficients.as_slice());
    let mut substitution = Substitution::new(numerators, &slope.coefficients);
    for generator in generators {
        let (value, _) = substitution.apply(&basis.ring, generator, watch)?;
        if !integral::divides(&f, &value, watch)? {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Whether every solution of the ideal is a point of the representation.
fn no_further_point(representation: &UnivariateRepresentation, staircase: &Staircase, watch: &Watch) -> Result<bool> {
    let border = staircase.border(0..staircase.variables())?;
    let power = representation.multiplicities.iter().map(|(multiplicity, _)| *multiplicity).max().unwrap_or(1);
    let bits = power as u64 * element_bits(representation, staircase, &border, watch)? + 2;
    let mut proved = 0;
    for prime in primes() {
        if proved > bits {
            return Ok(true);
        }
        watch.check()?;
        watch.report("no further solution", proved as usize, bits.saturating_sub(proved) as usize);
        let Some(quotient) = QuotientModulo::new(staircase, &border, prime, watch)? else { continue };
        let reduce = |f: &[BigInt]| trim(f.iter().map(|c| residue(c, prime)).collect());
        let f = reduce(&representation.polynomial.coefficients);
        let slope = reduce(&representation.slope().coefficients);
        let numerators: Vec<_> = representation.numerators.iter().map(|g| reduce(&g.coefficients)).collect();
        if !quotient.are_nilpotent(&representation.form, &f, &slope, &numerators, power) {
            return Ok(false);
        }
        proved += u64::from(prime.ilog2());
    }
    Ok(false)
}

/// A bound on the bits of `d^r f(t)` and `d^r (f'(t) x_v - g_v(t))` as integer matrices, in the column-sum norm. `r` is
/// the degree of `f`, and `d` is a common denominator of the multiplication matrices.
fn element_bits(
    representation: &UnivariateRepresentation,
    staircase: &Staircase,
    border: &Border,
    watch: &Watch,
) -> Result<u64> {
    let largest = multiplication_norm(staircase, border, watch)?;
    let form: u64 = representation.form.iter().map(|c| c.unsigned_abs()).sum();
    let per_degree = (largest * form.max(1)).bits();
    let f = integral::norm(&representation.polynomial.coefficients);
    let numerators = representation.numerators.iter().map(|g| integral::norm(&g.coefficients)).max();
    let slope = integral::norm(&representation.slope().coefficients);
    let coefficients = f.max(slope + numerators.unwrap_or_default());
    Ok(coefficients.bits() + representation.count() as u64 * per_degree)
}

/// The largest column sum of absolute values in the multiplication matrices of all variables, made integral by one
/// denominator.
fn multiplication_norm(staircase: &Staircase, border: &Border, watch: &Watch) -> Result<BigInt> {
    let lead = |row: &Row| {
        let mut form = vec![BigRational::zero(); staircase.dimension()];
        for (place, coefficient) in &row.tail {
            form[*place] = -BigRational::new(coefficient.clone(), row.lead.clone());
        }
        form
    };
    let leads: Vec<_> = staircase.rows.iter().map(lead).collect();
    let add_scaled = |target: &mut [BigRational], factor: &BigRational, row: &[BigRational]| {
        target.iter_mut().zip(row).for_each(|(sum, entry)| *sum += factor * entry);
    };
    let forms = border.normal_forms(&leads, [BigRational::zero(), BigRational::one()], add_scaled, watch)?;
    let denominator = forms.iter().flatten().fold(BigInt::one(), |lcm, entry| lcm.lcm(entry.denom()));
    let norm = |form: &Vec<BigRational>| -> BigInt {
        form.iter().map(|entry| entry.numer().abs() * (&denominator / entry.denom())).sum()
    };
    Ok(forms.iter().map(norm).max().unwrap_or_default().max(denominator.clone()))
}
