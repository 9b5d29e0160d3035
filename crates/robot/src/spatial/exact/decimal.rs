//! Recognition of decimals that approximate exact numbers.

use num_traits::{One, Signed};

use groebot_algebra::number::BigRational;

/// Minimum number of decimals of a rounded multiple of pi/4 or pi/6 that is replaced by the exact one.
const DECIMALS: usize = 4;
/// Maximum number of decimals that are compared.
const MOST_DECIMALS: usize = 40;

/// Whether `given` is within 1e-15 of `exact`.
pub(super) fn is_double_of(given: &BigRational, exact: &BigRational) -> bool {
    (given - exact).abs() * integer(1_000_000_000_000_000) <= integer(1)
}

/// Whether `given` is within 1e-15 of `exact`, or is its rounded or truncated decimal with enough decimals.
pub(super) fn is_decimal_of(given: &BigRational, exact: &BigRational) -> bool {
    if is_double_of(given, exact) {
        return true;
    }
    let mut shift = BigRational::one();
    for decimals in 0..=MOST_DECIMALS {
        let digits = given * &shift;
        if digits.is_integer() {
            let wanted = exact * shift;
            return decimals >= DECIMALS && (digits == wanted.round() || digits == wanted.trunc());
        }
        shift *= integer(10);
    }
    false
}

/// An integer.
pub(super) fn integer(n: i64) -> BigRational {
    BigRational::from_integer(n.into())
}
