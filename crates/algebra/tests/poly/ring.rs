//! Polynomial rings satisfy the ring axioms over every field and in every order. Their maps are homomorphisms.

use groebot_algebra::ErrorKind;
use groebot_algebra::number::{BigInt, BigRational, Field, Rationals, Ring, Zp, laws};
use groebot_algebra::poly::{Fractions, Order, Polynomial, PolynomialRing, Width};
use proptest::prelude::*;

use super::sparse::{Sparse, build, orders, quotient, sparse};

const NAMES: [&str; 3] = ["x", "y", "z"];

fn ring<F: Field>(field: F, order: Order) -> PolynomialRing<F> {
    PolynomialRing::new(field, &NAMES, order).expect("distinct names")
}

fn rational_ring() -> PolynomialRing<Rationals> {
    ring(Rationals, Order::GrevLex)
}

fn axioms_over<F: Field>(field: &F, samples: &[Sparse]) {
    for order in orders() {
        let ring = ring(field.clone(), order);
        let samples: Vec<_> = samples.iter().map(|sample| build(&ring, sample)).collect();
        laws::ring_axioms(&ring, &samples);
        assert!(samples.iter().all(|f| ring.is_well_formed(f) && ring.is_well_formed(&ring.mul(f, f))));
    }
}

proptest! {
    #![proptest_config(crate::cases(48))]

    #[test]
    fn they_are_rings(samples in prop::collection::vec(sparse(3, 4, 3), 3)) {
        axioms_over(&Rationals, &samples);
        for p in [2, 7, 32003] {
            axioms_over(&Zp::new(p).unwrap(), &samples);
        }
    }

    #[test]
    fn they_are_rings_over_rational_functions(
        parts in prop::collection::vec((sparse(2, 2, 2), sparse(2, 2, 2), sparse(3, 1, 2)), 4),
    ) {
        let field = Fractions::new(Rationals, &["p", "q"]).unwrap();
        let ring = ring(field.clone(), Order::Lex);
        let scaled = |(top, bottom, f): &(Sparse, Sparse, Sparse)| ring.scale(&build(&ring, f), &quotient(&field, top, bottom));
        let samples: Vec<_> = parts.iter().map(scaled).collect();
        let sums: Vec<_> = samples.windows(2).map(|pair| ring.add(&pair[0], &pair[1])).collect();
        laws::ring_axioms(&ring, &sums);
    }

    #[test]
    fn a_product_divides_exactly(f in sparse(3, 5, 4), g in sparse(3, 4, 3), h in sparse(3, 2, 2)) {
        for order in orders() {
            let ring = ring(Rationals, order);
            let (f, g, h) = (build(&ring, &f), build(&ring, &g), build(&ring, &h));
            prop_assume!(!g.is_zero());
            let product = ring.mul(&f, &g);
            prop_assert_eq!(ring.exact_div(&product, &g), Some(f));
            if let Some(quotient) = ring.exact_div(&ring.add(&product, &h), &g) {
                prop_assert_eq!(ring.mul(&quotient, &g), ring.add(&product, &h));
            }
        }
    }

    #[test]
    fn substitution_is_a_homomorphism(f in sparse(3, 5, 4), g in sparse(3, 5, 4), at in prop::array::uniform3(-9i64..9)) {
        let ring = rational_ring();
        let (f, g) = (build(&ring, &f), build(&ring, &g));
        let point: Vec<_> = at.iter().map(|&n| BigRational::from_integer(n.into())).collect();
        let value = |f: &Polynomial<BigRational>| ring.substitute(f, &Rationals, &point, Clone::clone);
        prop_assert_eq!(value(&ring.mul(&f, &g)), value(&f) * value(&g));
        prop_assert_eq!(value(&ring.add(&f, &g)), value(&f) + value(&g));
        prop_assert_eq!(value(&ring.variable(1)), point[1].clone());
    }

    #[test]
    fn a_derivative_obeys_the_product_rule(f in sparse(3, 5, 4), g in sparse(3, 5, 4), v in 0usize..3) {
        let ring = ring(Zp::new(5).unwrap(), Order::Lex);
        let (f, g) = (build(&ring, &f), build(&ring, &g));
        let left = ring.derivative(&ring.mul(&f, &g), v);
        let right = ring.add(&ring.mul(&ring.derivative(&f, v), &g), &ring.mul(&f, &ring.derivative(&g, v)));
        prop_assert_eq!(left, right);
        prop_assert_eq!(ring.derivative(&ring.variable(v), v), ring.one());
    }

    #[test]
    fn coefficients_in_a_variable_put_the_polynomial_together(f in sparse(3, 6, 4), v in 0usize..3) {
        let ring = rational_ring();
        let f = build(&ring, &f);
        let parts = ring.coefficients_in(&f, v);
        prop_assert_eq!(parts.len(), ring.degree_in(&f, v) as usize + 1);
        prop_assert!(parts.iter().all(|part| ring.degree_in(part, v) == 0));
        let x = ring.variable(v);
        prop_assert_eq!(parts.iter().rev().fold(ring.zero(), |sum, part| ring.add(&ring.mul(&sum, &x), part)), f);
    }

    #[test]
    fn a_transfer_there_and_back_changes_nothing(f in sparse(3, 6, 9), g in sparse(3, 6, 9)) {
        let home = rational_ring();
        let (f, g) = (build(&home, &f), build(&home, &g));
        for order in [Order::Lex, Order::elimination(3, 5)] {
            for width in [Width::Bits8, Width::Bits16, Width::Bits32] {
                let away = PolynomialRing::new(Rationals, &["w", "z", "x", "u", "y"], order.clone()).unwrap().with_width(width);
                let there = |f| home.transfer(f, &away).unwrap();
                prop_assert!(away.is_well_formed(&there(&f)));
                prop_assert_eq!(away.transfer(&away.mul(&there(&f), &there(&g)), &home).unwrap(), home.mul(&f, &g));
            }
        }
    }
}

#[test]
fn a_polynomial_without_a_place_is_refused() {
    let ring = rational_ring();
    let small = PolynomialRing::new(Rationals, &["x", "z"], Order::Lex).unwrap();
    assert_eq!(ring.transfer(&ring.variable(1), &small).unwrap_err().kind(), ErrorKind::UnknownName);
    assert_eq!(ring.transfer(&ring.variable(2), &small).unwrap(), small.variable(1));
    let high = ring.pow(&ring.variable(0), 128);
    assert_eq!(ring.transfer(&high, &ring.with_width(Width::Bits8)).unwrap_err().kind(), ErrorKind::Overflow);
}

#[test]
fn names_and_orders_must_fit() {
    let kind = |names: &[&str], order| PolynomialRing::new(Rationals, names, order).unwrap_err().kind();
    assert_eq!(kind(&["x", "y", "x"], Order::Lex), ErrorKind::DuplicateName);
    assert_eq!(kind(&["x", "y"], Order::elimination(1, 3)), ErrorKind::BadValue);
    let parameters = Fractions::new(Rationals, &["p"]).unwrap();
    assert_eq!(PolynomialRing::new(parameters, &["p"], Order::Lex).unwrap_err().kind(), ErrorKind::DuplicateName);
}

#[test]
fn a_product_beyond_the_lanes_is_an_error() {
    let ring = rational_ring().with_width(Width::Bits8);
    let f = ring.add(&ring.pow(&ring.variable(0), 64), &ring.one());
    let error = ring.checked_mul(&f, &f).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Overflow);
    assert!(error.message().contains("127"), "{error}");
    let x63 = ring.layout().pack(&[63, 0, 0]).unwrap();
    assert!(ring.mul_term(&f, &BigRational::from_integer(BigInt::from(1)), &x63).is_ok());
}

#[test]
fn a_polynomial_of_another_layout_is_not_well_formed() {
    let ring = ring(Zp::new(7).unwrap(), Order::GrevLex);
    for width in [Width::Bits8, Width::Bits32] {
        assert!(!ring.is_well_formed(&ring.with_width(width).variable(0)));
    }
}
