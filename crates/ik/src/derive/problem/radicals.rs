//! Square roots of constants. Each must be real and positive, and independent of the others.

use num_rational::BigRational;
use num_traits::{One, Signed};

use crate::derive::problem::system_parts::{Parameter, ParameterSource};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::Rationals;
use groebot_algebra::poly::{Expression, rational_root};

/// The maximum number of square roots of rational numbers in one system.
pub(in crate::derive) const MAX_ROOTS: usize = groebot_algebra::limits::SYSTEM_ROOTS;

/// The maximum bits of a root's square, numerator and denominator together.
const MAX_BITS: u64 = groebot_algebra::limits::CONSTANT_BITS;

/// Checks the last of `parameters` against the earlier ones.
///
/// Square roots of k rationals generate a field of degree 2^k exactly when no product of some of the squares is a square. Roots of expressions in other roots
/// are only checked for their sign.
pub(in crate::derive) fn check_root(parameters: &[Parameter]) -> Result<()> {
    let Some((last, earlier)) = parameters.split_last() else { return Ok(()) };
    let Some(square) = constant_square(last) else { return Ok(()) };
    match rational(square) {
        Some(value) => check_rational(last, &value?, earlier),
        None => check_sign(last, &value_of(square, earlier)),
    }
}

/// The square of `parameter`, if it is a square root.
fn constant_square(parameter: &Parameter) -> Option<&Expression> {
    parameter.square.as_ref().filter(|_| parameter.source == ParameterSource::SquareRoot)
}

fn rational(square: &Expression) -> Option<Result<BigRational>> {
    square.names().is_empty().then(|| square.evaluate(&Rationals))
}

fn check_sign(parameter: &Parameter, square: &Option<f64>) -> Result<()> {
    match square {
        Some(value) if !(*value > 0.0 && value.is_finite()) => {
            let text = format!("`{}`: its square is {value}; give a positive one", parameter.name);
            Err(Error::new(ErrorKind::BadValue, text))
        }
        _ => Ok(()),
    }
}

/// The value of `expression`, whose roots must be constant. `None` if it depends on an input.
fn value_of(expression: &Expression, roots: &[Parameter]) -> Option<f64> {
    let value = |name: &str| {
        let i = roots.iter().position(|root| root.name == name)?;
        value_of(constant_square(&roots[i])?, &roots[..i]).map(f64::sqrt)
    };
    expression.evaluate_f64(&value).ok()
}

fn check_rational(parameter: &Parameter, value: &BigRational, earlier: &[Parameter]) -> Result<()> {
    let bad = |text: String| Err(Error::new(ErrorKind::BadValue, format!("`{}`: {text}", parameter.name)));
    if !value.is_positive() {
        return bad("its square is not positive; give a positive one".to_owned());
    }
    if value.numer().bits() + value.denom().bits() > MAX_BITS {
        let text =
            format!("`{}`: its square has more than {MAX_BITS} binary digits; give a shorter one", parameter.name);
        return Err(Error::new(ErrorKind::Overflow, text));
    }
    let others = earlier.iter().filter_map(|other| Some((other, rational(constant_square(other)?)?.ok()?)));
    let others: Vec<_> = others.collect();
    if others.len() >= MAX_ROOTS {
        let text = format!("more than {MAX_ROOTS} square roots of numbers; express them by fewer");
        return Err(Error::new(ErrorKind::Unsupported, text));
    }
    for subset in 0..1u32 << others.len() {
        let chosen = || others.iter().enumerate().filter(|(i, _)| subset >> i & 1 == 1).map(|(_, other)| other);
        let product = chosen().fold(BigRational::one(), |product, (_, square)| product * square);
        let Some(root) = rational_root(&(value * &product)) else { continue };
        let relation = chosen().fold(format!("{}/{product}", root), |text, (other, _)| text + "*" + &other.name);
        return bad(format!("it depends on earlier roots; replace it by the expression {relation}"));
    }
    Ok(())
}
