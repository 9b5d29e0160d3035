//! Chinese remaindering and rational reconstruction compared with big integers.

use groebot_algebra::ErrorKind;
use groebot_algebra::number::{BigInt, BigRational, Chinese, Field, Zp, primes_below, reconstruct, residue};
use num_integer::Integer;
use proptest::prelude::*;

fn primes(count: usize) -> Vec<u32> {
    primes_below(1 << 31).take(count).map(|p| p as u32).collect()
}

/// An integer of at most `32 * top` bits, of either sign.
fn integers(top: usize) -> impl Strategy<Value = BigInt> {
    let digits = prop::collection::vec(any::<u32>(), 0..=top);
    (digits, any::<bool>()).prop_map(|(digits, negative)| {
        let n = BigInt::from(num_bigint::BigUint::new(digits));
        if negative { -n } else { n }
    })
}

fn residues(n: &BigInt, primes: &[u32]) -> Vec<u32> {
    primes.iter().map(|&p| u32::try_from(n.mod_floor(&BigInt::from(p))).unwrap()).collect()
}

/// Computes the residues of a fraction modulo each prime and lifts them.
fn image(q: &BigRational, chinese: &Chinese) -> BigInt {
    let field = |p: u32| Zp::new(u64::from(p)).unwrap();
    let residues: Vec<u32> =
        chinese.primes().iter().map(|&p| field(p).from_rational(q).expect("a unit") as u32).collect();
    chinese.lift(&residues, chinese.factors())
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn an_integer_is_its_residues(n in integers(12), count in 0usize..26) {
        let primes = primes(count);
        let chinese = Chinese::new(&primes).unwrap();
        let lifted = chinese.lift(&residues(&n, &primes), chinese.factors());
        prop_assert!((&lifted - &n).is_multiple_of(chinese.modulus()));
        prop_assert!(&lifted * 2 <= *chinese.modulus() && &lifted * -2 <= *chinese.modulus());
        prop_assert_eq!(primes.iter().map(|&p| residue(&n, p)).collect::<Vec<_>>(), residues(&n, &primes));
    }

    #[test]
    fn a_multiple_is_lifted_from_the_residues_of_the_fraction(n in integers(3), d in integers(3)) {
        prop_assume!(d != BigInt::from(0));
        let q = BigRational::new(n, d);
        let chinese = Chinese::new(&primes(13)).unwrap();
        let field = |p: u32| Zp::new(u64::from(p)).unwrap();
        let residues: Vec<u32> = chinese.primes().iter().map(|&p| field(p).from_rational(&q).unwrap() as u32).collect();
        prop_assert_eq!(&chinese.lift(&residues, &chinese.factors_times(q.denom())), q.numer());
    }

    #[test]
    fn a_fraction_is_its_residue(n in integers(20), d in integers(20)) {
        prop_assume!(d != BigInt::from(0));
        let q = BigRational::new(n, d);
        let chinese = Chinese::new(&primes(44)).unwrap();
        prop_assert_eq!(reconstruct(&image(&q, &chinese), chinese.modulus(), 40), Some(q));
    }

    #[test]
    fn what_is_reconstructed_is_congruent_and_small(u in integers(9), words in 1usize..12, surplus in 0u32..12) {
        let chinese = Chinese::new(&primes(words)).unwrap();
        let modulus = chinese.modulus();
        if let Some(q) = reconstruct(&u, modulus, surplus) {
            prop_assert!((q.numer() - q.denom() * &u).is_multiple_of(modulus));
            let height = BigInt::from(q.numer().magnitude() * q.denom().magnitude());
            prop_assert!((height << surplus) < *modulus);
            prop_assert_eq!(q.numer().gcd(q.denom()), BigInt::from(1));
        }
    }
}

/// Small remainders and quotients of all kinds: every residue of a small modulus compared with a search.
#[test]
fn small_moduli_are_searched_through() {
    for p in [101i64, 1009] {
        for u in 0..p {
            for surplus in 0..6 {
                let fits =
                    |n: i64, d: i64| (n - d * u) % p == 0 && (n.abs() * d) << (surplus + 2) < p && n.gcd(&d) == 1;
                let exists = (1..p).any(|d| [d * u % p, d * u % p - p].iter().any(|&n| fits(n, d)));
                let found = reconstruct(&BigInt::from(u), &BigInt::from(p), surplus);
                assert!(found.is_some() || !exists, "{u} modulo {p}");
            }
        }
    }
}

#[test]
fn the_ends_of_the_range_are_exact() {
    let primes = primes(5);
    let chinese = Chinese::new(&primes).unwrap();
    let half: BigInt = (chinese.modulus() - BigInt::from(1)) / 2;
    for n in [half.clone(), -half.clone(), &half - 1, 1 - &half, BigInt::from(0), BigInt::from(-1)] {
        assert_eq!(chinese.lift(&residues(&n, &primes), chinese.factors()), n);
    }
}

#[test]
fn bad_moduli_are_refused() {
    for list in [vec![7, 11, 7], vec![9], vec![0], vec![1], vec![4_294_967_291]] {
        assert_eq!(Chinese::new(&list).unwrap_err().kind(), ErrorKind::BadValue, "{list:?}");
    }
}

#[test]
fn primes_descend_without_a_gap() {
    let found: Vec<u64> = primes_below(100).collect();
    let known = [97, 89, 83, 79, 73, 71, 67, 61, 59, 53, 47, 43, 41, 37, 31, 29, 23, 19, 17, 13, 11, 7, 5, 3, 2];
    assert_eq!(found, known);
    assert!(primes_below(2).next().is_none());
}
