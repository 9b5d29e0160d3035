//! The fields satisfy their axioms, and decimals are parsed exactly.

mod extension;
mod modular;

use groebot_algebra::ErrorKind;
use groebot_algebra::number::{BigInt, BigRational, Field, Rationals, Ring, Zp, laws, parse_rational};
use proptest::prelude::*;

fn rational(n: i64, d: i64) -> BigRational {
    BigRational::new(BigInt::from(n), BigInt::from(d))
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn rationals_are_a_field(a in any::<(i64, i32)>(), b in any::<(i32, i32)>()) {
        let samples = [rational(a.0, i64::from(a.1) * 2 + 1), rational(b.0.into(), i64::from(b.1) * 2 + 1)];
        laws::field_axioms(&Rationals, &samples);
    }

    #[test]
    fn prime_fields_are_fields(a in any::<u64>(), b in any::<u64>(), c in any::<u64>()) {
        for p in [2, 3, 32003, 2_147_483_647, 2_305_843_009_213_693_921] {
            let field = Zp::new(p).unwrap();
            laws::field_axioms(&field, &[a % p, b % p, c % p]);
        }
    }

    #[test]
    fn the_map_to_a_prime_field_is_a_homomorphism(a in any::<(i64, i16)>(), b in any::<(i64, i16)>()) {
        let field = Zp::new(2_147_483_647).unwrap();
        let x = rational(a.0, i64::from(a.1) * 2 + 1);
        let y = rational(b.0, i64::from(b.1) * 2 + 1);
        let map = |q: &BigRational| field.from_rational(q).unwrap();
        prop_assert_eq!(map(&(&x + &y)), field.add(&map(&x), &map(&y)));
        prop_assert_eq!(map(&(&x * &y)), field.mul(&map(&x), &map(&y)));
    }

    #[test]
    fn decimals_of_any_length_are_exact(digits in -999_999_999i64..999_999_999, places in 0u32..9) {
        let sign = if digits < 0 { "-" } else { "" };
        let text = format!("{:0width$}", digits.unsigned_abs(), width = places as usize + 1);
        let (whole, fraction) = text.split_at(text.len() - places as usize);
        let decimal = format!("{sign}{whole}.{fraction}");
        prop_assert_eq!(parse_rational(&decimal).unwrap(), rational(digits, 10i64.pow(places)));
    }
}

#[test]
fn a_decimal_is_a_fraction() {
    for (text, n, d) in [
        ("0.1029", 1029, 10000),
        ("102.9", 1029, 10),
        ("-3/4", -3, 4),
        ("1.5e-3", 15, 10000),
        (".5", 1, 2),
        ("2E2", 200, 1),
        ("+7", 7, 1),
        ("0.5/0.25", 2, 1),
    ] {
        assert_eq!(parse_rational(text).unwrap(), rational(n, d), "{text}");
    }
}

#[test]
fn what_is_no_number_is_refused() {
    for text in ["", "nan", "inf", "1/0", "1e99999", "--1", "1.2.3", "0x10", "1_000", "é", "1e", "/", "."] {
        assert_eq!(parse_rational(text).unwrap_err().kind(), ErrorKind::Syntax, "{text}");
    }
}

/// By trial division: the first numbers, those around 2^32, and strong pseudoprimes to the bases 2, to 7, and to 2, 3, 5 and 7.
#[test]
fn primes_are_those_of_trial_division() {
    let is_prime = |n: u64| n > 1 && (2..).take_while(|d| d * d <= n).all(|d: u64| !n.is_multiple_of(d));
    let numbers = (0..1 << 12).chain((1 << 32) - 50..(1 << 32) + 50);
    for n in numbers.chain([314_821, 3_215_031_751]) {
        assert_eq!(Zp::new(n).is_ok(), is_prime(n), "{n}");
    }
}

#[test]
fn composite_moduli_are_refused() {
    for n in [0, 1, 4, 561, 3_215_031_751, u64::MAX, 1 << 62, 2_305_843_009_213_693_951 - 2] {
        assert_eq!(Zp::new(n).unwrap_err().kind(), ErrorKind::BadValue, "{n}");
    }
}
