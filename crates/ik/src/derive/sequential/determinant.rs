//! Elimination of an angle from two equations that are linear and homogeneous in its cosine and sine, by their determinant.

use groebot_algebra::number::{BigRational, Rationals, Ring};
use groebot_algebra::poly::{Polynomial, PolynomialRing};

type Poly = Polynomial<BigRational>;

/// The determinant `D = X W - Y Z` of `f = X c + Y s` and `g = Z c + W s`, and its cofactors for f, g and the circle.
///
/// c and s are the first two variables, with `c^2 + n s^2 = 1` and `square` n. The cofactors are those in `D = c (W f - Y g) + n s (X g - Z f) - D (c^2 + n s^2
/// - 1)`. `None` if the equations do not have this form.
pub(super) fn by_determinant(
    ring: &PolynomialRing<Rationals>,
    [f, g]: [&Poly; 2],
    square: &BigRational,
) -> Option<(Poly, [Poly; 3])> {
    let [x, y] = parts(ring, f)?;
    let [z, w] = parts(ring, g)?;
    let determinant = ring.sub(&ring.mul(&x, &w), &ring.mul(&y, &z));
    let (cosine, sine) = (ring.variable(0), ring.scale(&ring.variable(1), square));
    let of_f = ring.sub(&ring.mul(&cosine, &w), &ring.mul(&sine, &z));
    let of_g = ring.sub(&ring.mul(&sine, &x), &ring.mul(&cosine, &y));
    let of_circle = ring.neg(&determinant);
    Some((determinant, [of_f, of_g, of_circle]))
}

/// The coefficients of c and s in a polynomial that is linear and homogeneous in them.
fn parts(ring: &PolynomialRing<Rationals>, f: &Poly) -> Option<[Poly; 2]> {
    let by_cosine = ring.coefficients_in(f, 0);
    let [rest, cosine] = by_cosine.as_slice() else { return None };
    let by_sine = ring.coefficients_in(rest, 1);
    let [none, sine] = by_sine.as_slice() else { return None };
    (none.is_zero() && ring.degree_in(cosine, 1) == 0).then(|| [cosine.clone(), sine.clone()])
}
