//! The exact number of distinct real solutions at a rational target.
//!
//! Let t be a linear form of the unknowns whose minimal polynomial has the dimension of the quotient ring as its degree. It has a different value at every
//! complex solution (the shape lemma; Cox, Little, O'Shea, "Using Algebraic Geometry", 2.4). Its value is real exactly at the real solutions, so Sturm's count
//! of the polynomial's real roots is their number.

use crate::derive::{ParameterSource, System};
use crate::{Result, Watch};
use groebot_algebra::groebner::{Basis, Options, Quotient, Strategy, basis};
use groebot_algebra::number::{BigInt, BigRational, Rationals, Ring};
use groebot_algebra::poly::{Order, PolynomialRing};
use groebot_algebra::roots::Sturm;

/// The number of linear forms that are tried.
const FORMS: i64 = 3;

/// The number of distinct real solutions of `system` at `target`. Its doubles are converted to exactly equal rationals. `None` if a parameter is not an input
/// itself, if there are infinitely many solutions, or if no tried form separates them.
///
/// # Errors
/// The error of `watch` if it stops the count; [`crate::ErrorKind::Overflow`].
pub(super) fn count(system: &System, target: &[f64], watch: &Watch) -> Result<Option<usize>> {
    let Some(values) = rational_parameters(system, target) else { return Ok(None) };
    for form in 1..=FORMS {
        if let Some(count) = count_by(system, &values, form, watch)? {
            return Ok(Some(count));
        }
    }
    Ok(None)
}

type Named<'a> = (&'a str, BigRational);

fn rational_parameters<'a>(system: &'a System, target: &[f64]) -> Option<Vec<Named<'a>>> {
    let value = |parameter: &'a crate::derive::Parameter| match parameter.source {
        ParameterSource::Input(index) => {
            BigRational::from_float(target[index]).map(|value| (parameter.name.as_str(), value))
        }
        _ => None,
    };
    system.parameters.iter().map(value).collect()
}

fn count_by(system: &System, values: &[Named<'_>], form: i64, watch: &Watch) -> Result<Option<usize>> {
    let taken = |name: &str| system.order.iter().any(|unknown| unknown == name);
    let mut separating = "t".to_owned();
    while taken(&separating) {
        separating.push('t');
    }
    let names: Vec<&str> = system.order.iter().map(String::as_str).chain([separating.as_str()]).collect();
    let ring = PolynomialRing::new(Rationals, &names, Order::GrevLex)?;
    let value = |name: &str| values.iter().find(|(known, _)| *known == name).map(|(_, q)| ring.constant(q.clone()));
    let mut generators = Vec::new();
    for equation in &system.equations {
        generators.push(equation.expression.evaluate_with(&ring, &value)?);
    }
    let last = names.len() - 1;
    let combination = (0..last).fold(ring.variable(last), |sum, v| {
        let weight = ring.from_integer(&BigInt::from((v as i64 + 1).pow(2) * form + v as i64));
        ring.sub(&sum, &ring.mul(&weight, &ring.variable(v)))
    });
    generators.push(combination);
    let options = Options { strategy: Strategy::Normal, cofactors: false };
    let graded = basis(&ring, &generators, &options, watch)?;
    match graded.independent_variables() {
        None => Ok(Some(0)),
        Some(free) if !free.is_empty() => Ok(None),
        Some(_) => count_separated(&graded, &names, watch),
    }
}

/// The count by the linear form with the last name, if it separates the solutions.
fn count_separated(graded: &Basis<Rationals>, names: &[&str], watch: &Watch) -> Result<Option<usize>> {
    let quotient = Quotient::new(graded)?;
    let ring = PolynomialRing::new(Rationals, names, Order::Lex)?;
    let lex = quotient.basis_in(&ring, watch)?;
    let last = names.len() - 1;
    let eliminant = lex.polynomials.iter().find(|f| (0..last).all(|v| ring.degree_in(f, v) == 0));
    let Some(eliminant) = eliminant else { return Ok(None) };
    if ring.degree_in(eliminant, last) as usize != quotient.dimension() {
        return Ok(None);
    }
    let coefficients: Option<Vec<BigRational>> =
        ring.coefficients_in(eliminant, last).iter().map(|c| ring.as_constant(c)).collect();
    coefficients.map(|coefficients| Ok(Sturm::new(&coefficients)?.count())).transpose()
}
