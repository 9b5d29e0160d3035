//! Expressions: text round trips, evaluation as a homomorphism, names, substitution, bounds.

use super::trees::{rational, tree};
use groebot_algebra::ErrorKind;
use groebot_algebra::number::{BigInt, BigRational, Field, Rationals, Ring, Zp};
use groebot_algebra::poly::{Expression, parse};
use proptest::prelude::*;

const P: u64 = 2_305_843_009_213_693_951;

/// A value for each name of the random trees.
fn point(name: &str) -> Option<BigRational> {
    let (a, b) = match name {
        "x" => (3, 7),
        "c4" => (-5, 2),
        "py" => (11, 13),
        "a_1" => (2, 1),
        "L12" => (1029, 10),
        _ => return None,
    };
    Some(BigRational::new(BigInt::from(a), BigInt::from(b)))
}

fn at_point(tree: &Expression) -> groebot_algebra::Result<BigRational> {
    tree.evaluate_with(&Rationals, &point)
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn text_reads_back_as_an_equal_expression(tree in tree(true)) {
        let text = tree.to_string();
        let read = parse(&text).unwrap_or_else(|e| panic!("{text}: {e}"));
        prop_assert_eq!(at_point(&read).ok(), at_point(&tree).ok(), "{}", text);
        prop_assert_eq!(read.to_string(), parse(&read.to_string()).unwrap().to_string());
        prop_assert_eq!(parse(&read.to_string()).unwrap(), read);
    }

    #[test]
    fn numbers_read_back_exactly(q in rational(), exponent in -80i32..80) {
        let q = q * BigRational::from_integer(BigInt::from(10)).pow(exponent);
        let read = parse(&Expression::Number(q.clone()).to_string()).unwrap();
        prop_assert_eq!(read.evaluate(&Rationals).unwrap(), q);
    }

    #[test]
    fn evaluation_commutes_with_reduction_modulo_a_prime(tree in tree(true)) {
        let field = Zp::new(P).unwrap();
        let reduced = |name: &str| point(name).and_then(|q| field.from_rational(&q));
        if let Ok(exact) = at_point(&tree)
            && let (Some(image), Ok(value)) = (field.from_rational(&exact), tree.evaluate_with(&field, &reduced))
        {
            prop_assert_eq!(image, value);
        }
    }

    #[test]
    fn evaluation_is_a_homomorphism(a in tree(false), b in tree(false), n in 0u32..5) {
        let (ring, x, y) = (Rationals, at_point(&a).unwrap(), at_point(&b).unwrap());
        let value = |tree: Expression| at_point(&tree).unwrap();
        prop_assert_eq!(value(Expression::Sum(vec![a.clone(), b.clone()])), ring.add(&x, &y));
        prop_assert_eq!(value(Expression::Product(vec![a.clone(), b.clone()])), ring.mul(&x, &y));
        prop_assert_eq!(value(a.clone().negated()), ring.neg(&x));
        prop_assert_eq!(value(a.clone().power(n)), ring.pow(&x, n));
        let quotient = Expression::Product(vec![a, Expression::Inverse(Box::new(b))]);
        prop_assert_eq!(at_point(&quotient).ok(), ring.checked_div(&x, &y));
    }

    #[test]
    fn substitution_commutes_with_evaluation(tree in tree(false), inner in tree(false)) {
        let replaced = tree.substitute(&|name| (name == "x").then(|| inner.clone()));
        let value = at_point(&inner).unwrap();
        let values = |name: &str| if name == "x" { Some(value.clone()) } else { point(name) };
        prop_assert_eq!(at_point(&replaced).unwrap(), tree.evaluate_with(&Rationals, &values).unwrap());
    }

    #[test]
    fn the_expansion_bound_holds_for_numbers(tree in tree(true)) {
        let number = tree.substitute(&|name| point(name).map(Expression::Number));
        if let Ok(value) = number.evaluate(&Rationals) {
            let bits = (value.numer().bits() + value.denom().bits()) as f64;
            let bound = number.expansion_bound();
            prop_assert!(bound.terms >= 1.0 || value == Rationals.zero());
            prop_assert!(bits <= 2.0 + bound.bits, "{} > {:?}", bits, bound);
        }
    }

    #[test]
    fn serde_goes_through_text(tree in tree(true)) {
        let json = serde_json::to_string(&tree).unwrap();
        prop_assert_eq!(&json, &format!("\"{tree}\""));
        prop_assert_eq!(serde_json::from_str::<Expression>(&json).unwrap(), parse(&tree.to_string()).unwrap());
    }
}

#[test]
fn decimals_stay_decimal() {
    for text in ["102.9", "0.5", "-0.0015", "12", "-(-3)", "2*(-x)", "a - (b - c)", "(x + 1)^2*3/(4*y)", "1e4096"] {
        assert_eq!(parse(text).unwrap().to_string(), text);
    }
    assert_eq!(parse("1.5e-3").unwrap().to_string(), "0.0015");
    let third = BigRational::new(BigInt::from(-1), BigInt::from(3));
    let product = Expression::Product(vec![Expression::Number(third), Expression::name("x")]);
    assert_eq!(product.to_string(), "(-1/3)*x");
}

#[test]
fn numbers_at_the_limits_read_back() {
    for text in
        ["1000e4096", "1e-4096", "123456789e4000", "9e-4000", &"7".repeat(4096), &format!("1{}", "0".repeat(4000))]
    {
        let tree = parse(text).unwrap();
        assert_eq!(parse(&tree.to_string()).unwrap(), tree, "{}", &text[..9]);
    }
}

#[test]
fn names_come_in_order_of_appearance() {
    assert_eq!(parse("z*a + (b - z)^2/a + c").unwrap().names(), ["z", "a", "b", "c"]);
    assert!(parse("1 + 2").unwrap().names().is_empty());
}

#[test]
fn what_has_no_value_is_refused() {
    let kind = |text: &str| parse(text).unwrap().evaluate(&Rationals).unwrap_err().kind();
    assert_eq!(kind("1 + q"), ErrorKind::UnknownName);
    assert_eq!(kind("1/(2 - 2)"), ErrorKind::BadValue);
    assert_eq!(parse("q").unwrap().evaluate_f64(&|_| None).unwrap_err().kind(), ErrorKind::UnknownName);
    let seven = Zp::new(7).unwrap();
    assert_eq!(parse("0.5").unwrap().evaluate(&seven).unwrap(), 4);
    let number = Expression::Number(BigRational::new(BigInt::from(1), BigInt::from(7)));
    assert_eq!(number.evaluate(&seven).unwrap_err().kind(), ErrorKind::BadValue);
    assert!(parse("1/0").unwrap().evaluate_f64(&|_| None).unwrap().is_infinite());
}

#[test]
fn hopeless_expansions_have_large_bounds() {
    let bound = |text: &str| parse(text).unwrap().expansion_bound();
    assert!(bound("((2^1000)^1000)^1000").bits >= 1e9);
    assert!(bound("(a + b + c + d)^1000").terms >= 167_668_501.0);
    assert!(bound("(((a + b)^1000)^1000)^1000").terms > 1e9);
    assert_eq!(bound("(a + b)*(c + d)").terms, 4.0);
    assert_eq!(bound("(a + b)^4").terms, 5.0);
    assert!(bound("(1/3 + 1/5)^100").bits > 100.0 * 15f64.log2());
    let tall = Expression::name("x").power(u32::MAX).expansion_bound();
    assert!(tall.terms == 1.0 && tall.bits < 10.0);
}
