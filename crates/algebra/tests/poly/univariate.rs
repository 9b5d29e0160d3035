//! Univariate polynomials satisfy the ring axioms, with Euclidean division. The gcd, derivative and resultant satisfy
//! their laws.

use groebot_algebra::number::{BigInt, BigRational, Field, Rationals, Ring, Style, Zp, laws};
use groebot_algebra::poly::univariate::{Univariate, UnivariateRing};
use proptest::prelude::*;

type Polynomial = Univariate<BigRational>;

fn ring() -> UnivariateRing<Rationals> {
    UnivariateRing::new(Rationals, "x")
}

fn integers<F: Field>(ring: &UnivariateRing<F>, coefficients: &[i64]) -> Univariate<F::Element> {
    ring.polynomial(coefficients.iter().map(|&c| ring.field().from_integer(&BigInt::from(c))).collect())
}

/// The monic polynomial with these integer roots.
fn with_roots<F: Field>(ring: &UnivariateRing<F>, roots: &[i64]) -> Univariate<F::Element> {
    roots.iter().fold(ring.one(), |product, root| ring.mul(&product, &integers(ring, &[-root, 1])))
}

fn any_polynomial() -> impl Strategy<Value = Polynomial> {
    prop::collection::vec((-20i64..20, 1i64..5), 0..6).prop_map(|pairs| {
        ring().polynomial(pairs.into_iter().map(|(n, d)| BigRational::new(n.into(), d.into())).collect())
    })
}

fn few_roots() -> impl Strategy<Value = Vec<i64>> {
    prop::collection::vec(-9i64..9, 0..5)
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn they_are_a_ring(a in any_polynomial(), b in any_polynomial(), c in any_polynomial()) {
        laws::ring_axioms(&ring(), &[a, b, c]);
    }

    #[test]
    fn they_are_a_ring_over_prime_fields(
        a in prop::collection::vec(-9i64..9, 0..5),
        b in prop::collection::vec(-9i64..9, 0..5),
    ) {
        for p in [2, 7, 2_147_483_647] {
            let ring = UnivariateRing::new(Zp::new(p).unwrap(), "t");
            laws::ring_axioms(&ring, &[integers(&ring, &a), integers(&ring, &b)]);
        }
    }

    #[test]
    fn division_leaves_a_smaller_remainder(a in any_polynomial(), b in any_polynomial()) {
        let ring = ring();
        let Some((quotient, rest)) = ring.div_rem(&a, &b) else {
            prop_assert!(ring.is_zero(&b));
            return Ok(());
        };
        prop_assert_eq!(ring.add(&ring.mul(&quotient, &b), &rest), a.clone());
        prop_assert!(rest.degree() < b.degree());
        prop_assert_eq!(ring.checked_div(&ring.mul(&a, &b), &b), Some(a));
    }

    #[test]
    fn the_gcd_is_the_product_of_common_roots(a in few_roots(), b in few_roots()) {
        let ring = ring();
        let mut rest = b.clone();
        let mut common = Vec::new();
        for root in &a {
            if let Some(at) = rest.iter().position(|other| other == root) {
                common.push(rest.swap_remove(at));
            }
        }
        let scaled = ring.scale(&with_roots(&ring, &a), &BigRational::from_integer(6.into()));
        prop_assert_eq!(ring.gcd(&scaled, &with_roots(&ring, &b)), with_roots(&ring, &common));
    }

    #[test]
    fn the_derivative_obeys_the_product_rule(a in any_polynomial(), b in any_polynomial()) {
        let ring = ring();
        let product = ring.derivative(&ring.mul(&a, &b));
        let rule = ring.add(&ring.mul(&ring.derivative(&a), &b), &ring.mul(&a, &ring.derivative(&b)));
        prop_assert_eq!(product, rule);
    }

    #[test]
    fn the_square_free_part_has_each_root_once(mut roots in few_roots()) {
        let fields = UnivariateRing::new(Zp::new(101).unwrap(), "x");
        let (exact, modular) = (with_roots(&ring(), &roots), with_roots(&fields, &roots));
        roots.sort_unstable();
        roots.dedup();
        prop_assert_eq!(ring().square_free_part(&exact), Some(with_roots(&ring(), &roots)));
        prop_assert_eq!(fields.square_free_part(&modular), Some(with_roots(&fields, &roots)));
    }

    #[test]
    fn evaluation_is_a_homomorphism(a in any_polynomial(), b in any_polynomial(), n in -9i64..9) {
        let (ring, x) = (ring(), BigRational::new(n.into(), 4.into()));
        let product = ring.evaluate(&ring.mul(&a, &b), &x);
        prop_assert_eq!(product, ring.evaluate(&a, &x) * ring.evaluate(&b, &x));
    }

    #[test]
    fn the_resultant_is_the_product_of_root_differences(a in few_roots(), b in few_roots(), k in 1i64..5) {
        let ring = ring();
        let scaled = ring.scale(&with_roots(&ring, &a), &BigRational::from_integer(k.into()));
        let differences = a.iter().flat_map(|r| b.iter().map(move |s| BigInt::from(r - s)));
        let expected = differences.product::<BigInt>() * BigInt::from(k).pow(b.len() as u32);
        let resultant = ring.resultant(&scaled, &with_roots(&ring, &b));
        prop_assert_eq!(resultant, BigRational::from_integer(expected));
    }
}

#[test]
fn they_are_written_as_one_reads_them() {
    let ring = ring();
    let half = |n: i64| BigRational::new(n.into(), 2.into());
    let p = ring.polynomial(vec![half(-7), half(2), half(0), half(-3), half(-2)]);
    assert_eq!(ring.format(&p, Style::Text), "-x^4 - 3/2*x^3 + x - 7/2");
    assert_eq!(ring.format(&p, Style::Latex), "-x^{4} - \\frac{3}{2}x^{3} + x - \\frac{7}{2}");
    assert_eq!(ring.format(&ring.zero(), Style::Text), "0");
    assert_eq!(ring.generator("x"), Some(integers(&ring, &[0, 1])));
    assert_eq!(ring.generator("y"), None);
}

#[test]
fn what_has_no_answer_is_none() {
    let (ring, five) = (ring(), UnivariateRing::new(Zp::new(5).unwrap(), "x"));
    assert_eq!(ring.div_rem(&ring.one(), &ring.zero()), None);
    assert_eq!(ring.checked_div(&ring.one(), &integers(&ring, &[0, 1])), None);
    assert_eq!(five.square_free_part(&integers(&five, &[-1, 0, 0, 0, 0, 1])), None);
    assert_eq!(ring.gcd(&ring.zero(), &ring.zero()), ring.zero());
}
