//! Modular greatest common divisors: several primes, unlucky primes, small fields, many terms.

use groebot_algebra::number::{Field, Rationals, Ring, Zp};
use groebot_algebra::poly::{Order, Polynomial, PolynomialRing, gcd};
use proptest::prelude::*;

use super::factors::gcd_laws;
use super::sparse::sparse;
use crate::corpus::read;

fn ring_over<F: Field>(field: F) -> PolynomialRing<F> {
    PolynomialRing::new(field, &["x", "y", "z", "w"], Order::GrevLex).unwrap()
}

/// The gcd of `a h` and `b h` for coprime `a` and `b` is `h`.
fn finds_the_common_factor<F: Field>(ring: &PolynomialRing<F>, a: &str, b: &str, h: &str) {
    let [a, b, h] = [a, b, h].map(|text| read(ring, text));
    let times = |f: &Polynomial<F::Element>| ring.mul(f, &h);
    assert_eq!(gcd(ring, &times(&a), &times(&b)), ring.monic(&h));
}

#[test]
fn several_primes_rebuild_large_coefficients() {
    let h = "123456789012345678901234567890*x^2*y - 98765432109876543210987654321*z^3 + 1/7*w + 10^40";
    finds_the_common_factor(&ring_over(Rationals), "x + y*z - 1/3", "x^2 - 10^30*w + 5", h);
}

#[test]
fn unlucky_primes_are_seen() {
    // Modulo 2^61 - 1, the first prime of the engine, the two cofactors are equal, or lose their leading terms.
    let p = "(2^61 - 1)";
    let ring = ring_over(Rationals);
    finds_the_common_factor(&ring, &format!("x + {p}"), &format!("x + 2*{p}"), "y + 1");
    finds_the_common_factor(&ring, &format!("{p}*x + y"), "x*y + 1", "x*z + w^2 - 1");
    finds_the_common_factor(&ring, "y + 3", "z - 2", &format!("{p}*x^3 + y*z*w + {p}*{p}"));
}

#[test]
fn leading_coefficients_and_contents_are_kept() {
    let contents = ("(x*y + 1)*(z + w)", "(x*z - 3)*(w^2 + 2)", "(y^2 + w)*(x*y*z - z^2 + w)*(w + 5)");
    let leads = ("(y*z + w)*x^2 + 1", "(y*z + w)*x^3 - y", "(y*z + w)*x^2 + (z - w)*x + 7");
    for (a, b, h) in [contents, leads] {
        finds_the_common_factor(&ring_over(Rationals), a, b, h);
        for p in [7, 32003, 2147483647, 2305843009213693951] {
            finds_the_common_factor(&ring_over(Zp::new(p).unwrap()), a, b, h);
        }
    }
}

#[test]
fn a_small_field_is_extended_for_long_polynomials() {
    let h = "(x + y + z + w + 1)^3 + x*y*z";
    for p in [2, 3, 7] {
        finds_the_common_factor(&ring_over(Zp::new(p).unwrap()), "(x*y + z*w + 1)^2 + x", "(x + y*z + w^2)^2 + y", h);
    }
}

proptest! {
    #![proptest_config(crate::cases(24))]

    #[test]
    fn long_products_have_their_gcd(f in sparse(4, 9, 3), g in sparse(4, 9, 3), h in sparse(4, 12, 3)) {
        gcd_laws(&ring_over(Rationals), &[&f, &g, &h]);
        for p in [7, 32003, 2147483647] {
            gcd_laws(&ring_over(Zp::new(p).unwrap()), &[&f, &g, &h]);
        }
    }
}
