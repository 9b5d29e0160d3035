//! Rational functions are a field, with and without square roots, and equal elements are equal data.

use groebot_algebra::ErrorKind;
use groebot_algebra::number::{BigInt, BigRational, Field, Rationals, Ring, Style, Zp, laws};
use groebot_algebra::poly::{Fractions, gcd, parse};
use proptest::prelude::*;

use super::sparse::{Sparse, build, quotient, sparse, with_roots};

fn axioms<F: Field>(field: &Fractions<F>, parts: &[(Sparse, Sparse)]) {
    let samples: Vec<_> = parts.iter().map(|(top, bottom)| quotient(field, top, bottom)).collect();
    laws::field_axioms(field, &samples);
}

fn parts(variables: usize, count: usize) -> impl Strategy<Value = Vec<(Sparse, Sparse)>> {
    prop::collection::vec((sparse(variables, 3, 2), sparse(variables, 2, 2)), count)
}

proptest! {
    #![proptest_config(crate::cases(32))]

    #[test]
    fn rational_functions_are_a_field(parts in parts(2, 2)) {
        axioms(&Fractions::new(Rationals, &["p", "q"]).unwrap(), &parts);
        for p in [2, 3, 32003] {
            axioms(&Fractions::new(Zp::new(p).unwrap(), &["p", "q"]).unwrap(), &parts);
        }
    }

    #[test]
    fn they_are_a_field_with_square_roots(parts in parts(3, 2)) {
        axioms(&with_roots(Rationals), &parts);
        // 2 is not a square modulo 5.
        axioms(&with_roots(Zp::new(5).unwrap()), &parts);
    }

    #[test]
    fn equal_fractions_are_equal_data(f in sparse(3, 3, 2), g in sparse(3, 2, 2), h in sparse(3, 2, 2)) {
        let field = with_roots(Rationals);
        let [f, g, h] = [f, g, h].map(|f| build(field.ring(), &f));
        let times = |f| field.ring().mul(f, &h);
        let widened = field.fraction(&times(&f), &times(&g));
        prop_assert_eq!(widened.is_none(), field.reduce(&g).is_zero() || field.reduce(&h).is_zero());
        if let Some(widened) = widened {
            prop_assert_eq!(Some(widened.clone()), field.fraction(&f, &g));
            prop_assert!((1..3).all(|root| field.ring().degree_in(widened.denominator(), root) == 0));
            prop_assert!((1..3).all(|root| field.ring().degree_in(widened.numerator(), root) < 2));
        }
    }

    #[test]
    fn a_fraction_is_in_lowest_terms(f in sparse(2, 3, 2), g in sparse(2, 2, 2), h in sparse(2, 2, 2)) {
        let field = Fractions::new(Rationals, &["p", "q"]).unwrap();
        let ring = field.ring();
        let [f, g, h] = [f, g, h].map(|f| build(ring, &f));
        prop_assume!(!g.is_zero() && !h.is_zero());
        let a = field.fraction(&ring.mul(&f, &h), &ring.mul(&g, &h)).unwrap();
        prop_assert_eq!(ring.mul(a.numerator(), &g), ring.mul(&f, a.denominator()));
        prop_assert_eq!(&ring.monic(a.denominator()), a.denominator());
        prop_assert!(ring.is_one(&gcd(ring, a.numerator(), a.denominator())));
    }
}

#[test]
fn roots_obey_their_relations() {
    let field = with_roots(Rationals);
    let value = |text: &str| parse(text).unwrap().evaluate(&field).unwrap();
    for (left, right) in [
        ("s^2 + c^2", "1"),
        ("1/h", "2*h"),
        ("1/s", "s/(1 - c^2)"),
        ("1/(c + s)", "(c - s)/(2*c^2 - 1)"),
        ("(c + s)/(c*s)", "((c*s)/(c + s))^0 / ((c*s)/(c + s))"),
        ("(s/(1 - c))*(s/(1 + c))", "1"),
        ("1/(1 + 2*h)", "2*h - 1"),
    ] {
        assert_eq!(value(left), value(right), "{left} = {right}");
    }
    assert!(parse("1/(c^2 + s^2 - 2*h^2)").unwrap().evaluate(&field).is_err(), "a hidden zero has no inverse");
    assert_eq!(field.as_constant(&value("4*h^2 + s^2 + c^2")), Some(BigRational::from_integer(3.into())));
    assert_eq!(field.as_constant(&value("s*h")), None);
    assert!(field.is_algebraic(1) && field.is_algebraic(2) && !field.is_algebraic(0));
}

#[test]
fn a_malformed_relation_is_refused() {
    let fractions = || Fractions::new(Rationals, &["c", "s", "h"]).unwrap();
    let ring = fractions().ring().clone();
    let (c, s) = (ring.variable(0), ring.variable(1));
    let kind = |result: groebot_algebra::Result<Fractions<Rationals>>| result.unwrap_err().kind();
    for (variable, square) in [(1, &s), (0, &s), (1, &ring.zero()), (3, &c), (usize::MAX, &c)] {
        assert_eq!(kind(fractions().with_square(variable, square)), ErrorKind::BadValue, "{variable}");
    }
    let second = fractions().with_square(1, &c).unwrap();
    assert_eq!(kind(second.clone().with_square(1, &c)), ErrorKind::BadValue);
    assert_eq!(kind(second.clone().with_square(0, &ring.one())), ErrorKind::BadValue);
    let hidden_zero = ring.sub(&ring.mul(&s, &s), &c);
    assert_eq!(kind(second.with_square(2, &hidden_zero)), ErrorKind::BadValue);
    assert_eq!(kind(Fractions::new(Rationals, &["c", "c"])), ErrorKind::DuplicateName);
}

#[test]
fn a_root_of_a_square_gives_elements_without_inverse() {
    let fractions = Fractions::new(Rationals, &["v"]).unwrap();
    let four = fractions.ring().constant(BigRational::from_integer(BigInt::from(4)));
    let field = fractions.with_square(0, &four).unwrap();
    let v_minus_two = parse("v - 2").unwrap().evaluate(&field).unwrap();
    assert!(field.inverse(&v_minus_two).is_none());
    assert_eq!(field.format(&v_minus_two, Style::Text), "v - 2");
}
