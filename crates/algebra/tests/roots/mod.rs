//! Real roots: exact isolation compared with known roots, the numeric method compared with exact isolation.

mod descartes;
mod isolate;
mod numeric;

use groebot_algebra::number::{BigInt, BigRational, Rationals, Ring};
use groebot_algebra::poly::univariate::UnivariateRing;

fn rational(n: i64, d: i64) -> BigRational {
    BigRational::new(BigInt::from(n), BigInt::from(d))
}

fn integers(coefficients: &[i64]) -> Vec<BigRational> {
    coefficients.iter().map(|&c| rational(c, 1)).collect()
}

fn product(factors: &[Vec<BigRational>]) -> Vec<BigRational> {
    let ring = UnivariateRing::new(Rationals, "x");
    let multiply = |product, factor: &Vec<BigRational>| ring.mul(&product, &ring.polynomial(factor.clone()));
    factors.iter().fold(ring.one(), multiply).coefficients
}

/// The monic polynomial with these roots.
fn with_roots(roots: &[BigRational]) -> Vec<BigRational> {
    product(&roots.iter().map(|root| vec![-root, rational(1, 1)]).collect::<Vec<_>>())
}

/// Polynomials for which eigenvalue methods fail, with their real roots: `x^6 - 1`, `x^8 + 1`, `(x^2 - 1)^2 (x^2 -
/// 4)^2`.
fn even_polynomials() -> [(Vec<BigRational>, Vec<f64>); 3] {
    let (one, two) = (integers(&[-1, 0, 1]), integers(&[-4, 0, 1]));
    [
        (integers(&[-1, 0, 0, 0, 0, 0, 1]), vec![-1.0, 1.0]),
        (integers(&[1, 0, 0, 0, 0, 0, 0, 0, 1]), vec![]),
        (product(&[one.clone(), one, two.clone(), two]), vec![-2.0, -1.0, 1.0, 2.0]),
    ]
}
