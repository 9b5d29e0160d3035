//! Elimination of one revolute joint from two relations that rotate a vector, by the sum of their squares.
//!
//! Let `P c + Q s' + U = 0` and, after a multiple of it is added, `k (P s' - Q c/n) + V = 0`. The circle `c^2 + n s'^2 = 1` then gives `U^2 + n/k^2 V^2 = P^2 +
//! Q^2/n`, without the joint (Pieper 1968). This is a combination of the two relations and the circle with known cofactors.

use num_traits::Zero;

use groebot_algebra::number::{BigRational, Rationals, Ring};
use groebot_algebra::poly::{Polynomial, PolynomialRing};

type Poly = Polynomial<BigRational>;

/// A relation `p c + q s' + u`.
struct Linear {
    p: Poly,
    q: Poly,
    u: Poly,
}

/// The polynomial without the cosine and sine, variables `place` and the next, and its cofactors by `f`, `g` and the circle with `n`. `None` if no multiple of
/// `f` makes the two relations a rotation.
pub(super) fn by_squares(
    ring: &PolynomialRing<Rationals>,
    [f, g]: [&Poly; 2],
    n: &BigRational,
    place: usize,
) -> Option<(Poly, [Poly; 3])> {
    let (first, second) = (linear(ring, f, place)?, linear(ring, g, place)?);
    let (k, m) = turn(ring, &first, &second, n)?;
    let lambda = n / (&k * &k);
    let other = ring.add(g, &ring.scale(f, &m));
    let v = ring.add(&second.u, &ring.scale(&first.u, &m));
    let (pp, qq) = (ring.mul(&first.p, &first.p), ring.scale(&ring.mul(&first.q, &first.q), &n.recip()));
    let length = ring.add(&pp, &qq);
    let (uu, vv) = (ring.mul(&first.u, &first.u), ring.scale(&ring.mul(&v, &v), &lambda));
    let member = ring.sub(&ring.add(&uu, &vv), &length);
    // (f - U)^2 + l (g' - V)^2 = (P^2 + Q^2/n) (c^2 + n s'^2), with g' = g + m f.
    let twice = |x: &Poly| ring.add(x, x);
    let by_other = ring.scale(&ring.sub(&twice(&v), &other), &lambda);
    let by_first = ring.add(&ring.sub(&twice(&first.u), f), &ring.scale(&by_other, &m));
    Some((member, [by_first, by_other, length]))
}

fn linear(ring: &PolynomialRing<Rationals>, f: &Poly, place: usize) -> Option<Linear> {
    let part = |f: &Poly, v: usize| {
        let mut parts = ring.coefficients_in(f, v).into_iter();
        let low = parts.next().unwrap_or_else(|| ring.zero());
        let high = parts.next().unwrap_or_else(|| ring.zero());
        parts.next().is_none().then_some((low, high))
    };
    let (rest, p) = part(f, place)?;
    let (u, q) = part(&rest, place + 1)?;
    (ring.degree_in(&p, place + 1) == 0).then_some(Linear { p, q, u })
}

/// The numbers `k` and `m` with `q2 + m q1 = k p1` and `p2 + m p1 = -k q1 / n`.
fn turn(
    ring: &PolynomialRing<Rationals>,
    a: &Linear,
    b: &Linear,
    n: &BigRational,
) -> Option<(BigRational, BigRational)> {
    let minus = -n.recip();
    let rows = [(&a.p, &a.q, &b.q), (&ring.scale(&a.q, &minus), &a.p, &b.p)]
        .into_iter()
        .flat_map(|(k, m, right)| rows(ring, [k, m, right]))
        .collect::<Vec<_>>();
    let determinant = |x: &[BigRational; 3], y: &[BigRational; 3], i: usize, j: usize| &x[i] * &y[j] - &x[j] * &y[i];
    let first = rows.iter().find(|row| !(row[0].is_zero() && row[1].is_zero()))?;
    let second = rows.iter().find(|row| !determinant(first, row, 0, 1).is_zero())?;
    let bottom = determinant(first, second, 0, 1);
    let (k, m) = (determinant(first, second, 2, 1) / &bottom, determinant(first, second, 0, 2) / &bottom);
    let holds = rows.iter().all(|[x, y, right]| x * &k + y * &m == *right);
    (holds && !k.is_zero()).then_some((k, m))
}

/// For each monomial, the equation `k x - m y = right` as `[x, -y, right]`.
fn rows(ring: &PolynomialRing<Rationals>, [x, y, right]: [&Poly; 3]) -> Vec<[BigRational; 3]> {
    let mut monomials: Vec<_> =
        [x, y, right].iter().flat_map(|f| f.terms()).map(|term| term.monomial.clone()).collect();
    monomials.sort_by(|a, b| ring.layout().compare(a, b));
    monomials.dedup();
    let coefficient = |f: &Poly, monomial: &groebot_algebra::poly::Monomial| {
        let term = f.terms().iter().find(|term| term.monomial == *monomial);
        term.map_or_else(BigRational::zero, |term| term.coefficient.clone())
    };
    monomials
        .iter()
        .map(|monomial| [coefficient(x, monomial), -coefficient(y, monomial), coefficient(right, monomial)])
        .collect()
}
