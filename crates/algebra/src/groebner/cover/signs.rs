//! Signs of polynomials with rational coefficients: sums of squares, and polynomials without real zeros.

use crate::number::{BigInt, BigRational, Rationals, Ring};
use crate::poly::univariate::{Univariate, UnivariateRing};
use crate::poly::{Polynomial, PolynomialRing};

type Ground = PolynomialRing<Rationals>;
type Poly = Polynomial<BigRational>;

/// Polynomials that vanish at all real zeros of `f`, if `f` provably keeps its sign where the `positive` variables are
/// positive. The constant 1 means that there are no real zeros.
pub fn forced_zeros(ring: &Ground, f: &Poly, positive: &[bool]) -> Option<Vec<Poly>> {
    if let Some(g) = univariate(ring, f)
        && has_no_real_root(&g)
    {
        return Some(vec![ring.one()]);
    }
    let lead = f.leading()?;
    let sign = if is_positive(&lead.coefficient) { f.clone() } else { ring.neg(f) };
    squares(ring, &sign, positive)
}

fn is_positive(q: &BigRational) -> bool {
    *q > Rationals.zero()
}

/// Polynomials whose common real zeros are those of `f`, if `f` is a positive combination of squares. The square is
/// completed in one variable after the other until only even terms remain.
fn squares(ring: &Ground, f: &Poly, positive: &[bool]) -> Option<Vec<Poly>> {
    if let Some(zeros) = even_terms(ring, f, positive) {
        return Some(zeros);
    }
    (0..ring.variables().len()).filter(|&v| ring.degree_in(f, v) == 2).find_map(|v| {
        let parts = ring.coefficients_in(f, v);
        let lead = ring.as_constant(&parts[2]).filter(is_positive)?;
        let half = ring.scale(&parts[1], &(Rationals.one() / (&lead + &lead)));
        let root = ring.add(&ring.variable(v), &half);
        let rest = ring.sub(f, &ring.scale(&ring.mul(&root, &root), &lead));
        let mut zeros = if rest.is_zero() { Vec::new() } else { squares(ring, &rest, positive)? };
        zeros.push(root);
        Some(zeros)
    })
}

/// The terms of `f`, if all have positive coefficients and even powers of the variables that are not `positive`. Such a
/// sum vanishes only where each term does.
fn even_terms(ring: &Ground, f: &Poly, positive: &[bool]) -> Option<Vec<Poly>> {
    let exponents: Vec<Vec<u32>> = f.terms().iter().map(|term| ring.layout().exponents(&term.monomial)).collect();
    let even = exponents.iter().all(|e| e.iter().zip(positive).all(|(power, positive)| *positive || power % 2 == 0));
    let adds = f.terms().iter().all(|term| is_positive(&term.coefficient));
    let product = |e: &Vec<u32>| {
        let used = (0..e.len()).filter(|&v| e[v] > 0 && !positive[v]);
        used.fold(ring.one(), |product, v| ring.mul(&product, &ring.variable(v)))
    };
    (even && adds).then(|| exponents.iter().map(product).collect())
}

/// `f` as a polynomial in its only variable.
fn univariate(ring: &Ground, f: &Poly) -> Option<Univariate<BigRational>> {
    let mut used = (0..ring.variables().len()).filter(|&v| ring.degree_in(f, v) > 0);
    let (v, None) = (used.next()?, used.next()) else { return None };
    let coefficients = ring.coefficients_in(f, v);
    let coefficients = coefficients.iter().map(|c| ring.as_constant(c)).collect::<Option<_>>()?;
    Some(UnivariateRing::new(Rationals, "x").polynomial(coefficients))
}

/// Whether `f` has no real root, by Sturm's theorem on the whole line.
fn has_no_real_root(f: &Univariate<BigRational>) -> bool {
    let ring = UnivariateRing::new(Rationals, "x");
    let mut chain = vec![f.clone(), ring.derivative(f)];
    while let [.., a, b] = chain.as_slice() {
        match ring.div_rem(a, b) {
            Some((_, rest)) if !ring.is_zero(&rest) => chain.push(ring.neg(&rest)),
            _ => break,
        }
    }
    let variations = |negative: bool| {
        let sign = |g: &Univariate<BigRational>| {
            let odd = g.degree().is_some_and(|degree| degree % 2 == 1);
            g.leading().is_some_and(is_positive) != (negative && odd)
        };
        chain.windows(2).filter(|pair| sign(&pair[0]) != sign(&pair[1])).count()
    };
    variations(true) == variations(false)
}

/// Whether `f` has both signs at points with small coordinates.
pub(super) fn changes_sign(ring: &Ground, f: &Poly) -> bool {
    const VALUES: [i64; 8] = [0, 1, -1, 2, 10, -10, 1000, -1000];
    const POINTS: usize = 4096;
    let count = ring.variables().len();
    let total = VALUES.len().saturating_pow(count as u32).min(POINTS);
    let value = |index: usize| {
        let digit = |v: usize| VALUES[index / VALUES.len().saturating_pow(v as u32) % VALUES.len()];
        let point: Vec<_> = (0..count).map(|v| BigRational::from_integer(BigInt::from(digit(v)))).collect();
        ring.substitute(f, &Rationals, &point, BigRational::clone)
    };
    let zero = Rationals.zero();
    let (mut above, mut below) = (false, false);
    for index in 0..total {
        let value = value(index);
        above = above || value > zero;
        below = below || value < zero;
        if above && below {
            return true;
        }
    }
    false
}
