//! Algebraic extensions are fields.

use groebot_algebra::ErrorKind;
use groebot_algebra::number::{BigInt, BigRational, Extension, Field, Rationals, Ring, Style, Zp, laws};
use proptest::prelude::*;

/// 2 is not a square modulo 11; t^3 + t + 1 has no root modulo 5, so it is irreducible.
fn finite() -> [Extension<Zp>; 2] {
    let field = |p, low| Extension::new(Zp::new(p).unwrap(), "t", low).unwrap();
    [field(11, vec![9, 0]), field(5, vec![1, 1, 0])]
}

fn root_of_two() -> Extension<Rationals> {
    let number = |n: i64| BigRational::from_integer(BigInt::from(n));
    Extension::new(Rationals, "w", vec![number(-2), number(0)]).unwrap()
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn extensions_are_fields(a in any::<[u16; 6]>(), b in any::<(i32, i32)>()) {
        for field in finite() {
            let p = field.characteristic();
            let element = |k: usize| (0..field.degree()).map(|i| u64::from(a[k + i]) % p).collect::<Vec<_>>();
            laws::field_axioms(&field, &[element(0), element(1), element(3)]);
        }
        let number = |n: i32| BigRational::from_integer(BigInt::from(n));
        laws::field_axioms(&root_of_two(), &[vec![number(b.0), number(b.1)], vec![number(b.1), number(3)]]);
    }
}

/// The multiplicative group has one element less than the field, and the Frobenius map fixes exactly the base field.
#[test]
fn the_group_of_units_has_its_order() {
    for field in finite() {
        let p = field.characteristic();
        let order = p.pow(field.degree() as u32);
        let t = field.generator("t").unwrap();
        assert!(field.is_one(&field.pow(&t, order as u32 - 1)));
        assert_ne!(field.pow(&t, p as u32), t);
        assert_eq!(field.pow(&field.embed(&3), p as u32), field.embed(&3));
    }
}

#[test]
fn a_root_satisfies_its_equation() {
    let field = root_of_two();
    let w = field.generator("w").unwrap();
    assert_eq!(field.mul(&w, &w), field.from_integer(&BigInt::from(2)));
    assert_eq!(field.format(&field.add(&w, &field.one()), Style::Text), "1 + (1)*w^1");
    assert_eq!(field.format(&field.zero(), Style::Text), "0");
}

/// t^2 - 1 is reducible: t - 1 divides zero.
#[test]
fn what_is_no_field_shows() {
    let ring = Extension::new(Zp::new(11).unwrap(), "t", vec![10, 0]).unwrap();
    assert_eq!(ring.inverse(&vec![10, 1]), None);
    assert_eq!(Extension::new(Rationals, "t", Vec::new()).unwrap_err().kind(), ErrorKind::BadValue);
}
