//! Exact vectors for the geometry of axes.

use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use groebot_algebra::number::{BigInt, BigRational};
use groebot_algebra::poly::rational_root;
use groebot_robot::kinematics::ExactVector;

pub use groebot_robot::spatial::exact::vector::{add, cross, dot, identity, is_zero, scale, sub, turn, unit, zero};

/// The limit above which an integer coordinate counts as long.
const LONG: i64 = 100;

/// Whether `a` and `b` are parallel. No fraction is reduced.
pub fn parallel(a: &ExactVector, b: &ExactVector) -> bool {
    let product = |i: usize, j: usize| a[i].numer() * b[j].numer() * (a[j].denom() * b[i].denom());
    [(0, 1), (1, 2), (2, 0)].into_iter().all(|(i, j)| product(i, j) == product(j, i))
}

/// The unit vector along `a` if it is rational, else as [`tidy`].
pub fn normalised(a: &ExactVector) -> ExactVector {
    let square = dot(a, a);
    match rational_root(&square) {
        Some(length) if !length.is_zero() => scale(a, &length.abs().recip()),
        _ => tidy(a),
    }
}

/// The vector along `a` whose coordinates are coprime integers.
pub fn primitive(a: &ExactVector) -> ExactVector {
    let common = a.iter().fold(BigInt::one(), |common, entry| common.lcm(entry.denom()));
    let divisor =
        a.iter().fold(BigInt::zero(), |divisor, entry| divisor.gcd(&(entry.numer() * (&common / entry.denom()))));
    if divisor.is_zero() { a.clone() } else { scale(a, &BigRational::new(common, divisor)) }
}

/// The vector along `a` of coprime integers. If these are long, the vector whose greatest coordinate is 1.
pub fn tidy(a: &ExactVector) -> ExactVector {
    let whole = primitive(a);
    let greatest = whole.iter().map(Signed::abs).max().unwrap_or_default();
    if greatest > BigRational::from_integer(LONG.into()) { scale(&whole, &greatest.recip()) } else { whole }
}

/// A vector perpendicular to `a` and to the coordinate axis with the greatest angle to `a`.
pub fn perpendicular(a: &ExactVector) -> ExactVector {
    let least = (0..3).min_by_key(|&k| a[k].abs()).unwrap_or(0);
    tidy(&cross(a, &unit(least)))
}

/// Three independent directions: along `a`, and two perpendicular to it and to each other.
pub fn frame(a: &ExactVector) -> [ExactVector; 3] {
    let across = perpendicular(a);
    let third = cross(a, &across);
    [a.clone(), across, third]
}
