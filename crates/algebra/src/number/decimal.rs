//! Exact parser of decimal text: `0.1029` is 1029/10000, never a rounded binary number.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Pow;

use crate::limits;
use crate::{Error, ErrorKind, Result};

/// The largest exponent and number of digits of a number.
const MAX_EXPONENT: i64 = limits::EXPONENT;

/// Parses `-12`, `3/4`, `0.1029`, `.5` or `1.5e-3` as an exact rational.
///
/// # Errors
/// [`ErrorKind::Syntax`] for anything else (NaN and infinities included), an exponent beyond +-4096 or a zero
/// denominator.
pub fn parse_rational(text: &str) -> Result<BigRational> {
    let text = text.trim();
    let fail = || {
        let shown: String = text.chars().take(40).collect();
        let allowed = "an integer, a fraction such as 3/4 or a decimal such as 0.1029 or 1.5e-3";
        Error::new(ErrorKind::Syntax, format!("`{shown}` is not an exact number; give {allowed}"))
    };
    match text.split_once('/') {
        Some((numerator, denominator)) => {
            let bottom = parse_decimal(denominator.trim()).ok_or_else(fail)?;
            let top = parse_decimal(numerator.trim()).ok_or_else(fail)?;
            if bottom.numer().bits() == 0 { Err(fail()) } else { Ok(top / bottom) }
        }
        None => parse_decimal(text).ok_or_else(fail),
    }
}

fn parse_decimal(text: &str) -> Option<BigRational> {
    let (negative, text) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i64>().ok()?),
        None => (text, 0),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = format!("{whole}{fraction}");
    let plain = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
    let shift = exponent.checked_sub(i64::try_from(fraction.len()).ok()?)?;
    if !plain || shift.abs() > MAX_EXPONENT || digits.len() > limits::DIGITS {
        return None;
    }
    let value = BigRational::from_integer(digits.parse::<BigInt>().ok()?);
    let power = BigRational::from_integer(BigInt::from(10).pow(shift.unsigned_abs()));
    let value = if shift < 0 { value / power } else { value * power };
    Some(if negative { -value } else { value })
}
