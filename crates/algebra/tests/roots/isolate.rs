//! Sturm's method compared with polynomials with known roots.

use groebot_algebra::ErrorKind;
use groebot_algebra::number::{BigInt, BigRational};
use groebot_algebra::roots::{Sturm, isolate, rounded_roots};
use proptest::prelude::*;

use super::{even_polynomials, integers, product, rational, with_roots};

/// Distinct rationals, ascending, each with a multiplicity of one to three.
fn known_roots() -> impl Strategy<Value = Vec<(BigRational, usize)>> {
    prop::collection::btree_map((-40i64..40, 1i64..9).prop_map(|(n, d)| rational(n, d)), 1usize..4, 0..5)
        .prop_map(|map| map.into_iter().collect())
}

fn repeated(roots: &[(BigRational, usize)]) -> Vec<BigRational> {
    roots.iter().flat_map(|(root, times)| vec![root.clone(); *times]).collect()
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn every_known_root_is_isolated(roots in known_roots(), pairs in 0usize..2, scale in 1i64..99) {
        let complex = vec![integers(&[2, 1, 1]); pairs];
        let p = product(&[complex, vec![with_roots(&repeated(&roots)), vec![rational(-scale, 7)]]].concat());
        let sturm = Sturm::new(&p).unwrap();
        let intervals = sturm.intervals();
        prop_assert_eq!(sturm.count(), roots.len());
        prop_assert_eq!(intervals.len(), roots.len());
        prop_assert_eq!(sturm.square_free_part().len(), roots.len() + 1 + 2 * pairs);
        let width = rational(1, 1_000_000);
        for (interval, (root, _)) in intervals.iter().zip(&roots) {
            for place in [interval.clone(), sturm.refine(interval, &width).unwrap()] {
                prop_assert!(place.low() <= root && root <= place.high());
                prop_assert_eq!(place.is_point(), place.low() == root || place.high() == root);
            }
            prop_assert!(sturm.refine(interval, &width).unwrap().width() <= width);
        }
        prop_assert!(intervals.windows(2).all(|pair| pair[0].high() <= pair[1].low()));
    }

    #[test]
    fn half_open_intervals_count_their_upper_end(roots in known_roots(), low in -40i64..40, length in 0i64..40) {
        let sturm = Sturm::new(&with_roots(&repeated(&roots))).unwrap();
        let mut ends = vec![(rational(low, 3), rational(low + length, 3))];
        ends.extend(roots.windows(2).map(|pair| (pair[0].0.clone(), pair[1].0.clone())));
        for (low, high) in ends {
            let expected = roots.iter().filter(|(root, _)| &low < root && root <= &high).count();
            prop_assert_eq!(sturm.count_between(&low, &high), expected);
            prop_assert_eq!(sturm.count_between(&high, &low), 0);
        }
    }

    #[test]
    fn rounding_is_that_of_ieee_division(n in -(1i64 << 50)..1 << 50, d in 1i64..1 << 50) {
        prop_assert_eq!(rounded_roots(&integers(&[-n, d])).unwrap(), vec![n as f64 / d as f64]);
    }

    #[test]
    fn rounding_is_that_of_the_ieee_square_root(n in 1i64..1 << 52) {
        let root = (n as f64).sqrt();
        prop_assert_eq!(rounded_roots(&integers(&[-n, 0, 1])).unwrap(), vec![-root, root]);
    }
}

#[test]
fn even_polynomials_are_solved() {
    for (p, roots) in even_polynomials() {
        assert_eq!(rounded_roots(&p).unwrap(), roots);
    }
}

#[test]
fn roots_with_the_same_double_are_distinguished() {
    let tiny = BigRational::new(1.into(), BigInt::from(1) << 70);
    let p = with_roots(&[rational(1, 3), rational(1, 3) + &tiny, rational(1, 3) - tiny]);
    assert_eq!(isolate(&p).unwrap().len(), 3);
    assert_eq!(rounded_roots(&p).unwrap(), vec![1.0 / 3.0; 3]);
}

#[test]
fn rounding_is_right_at_ties_and_at_the_ends_of_the_range() {
    let power = |n: usize| BigRational::from_integer(BigInt::from(1) << n);
    let one = rational(1, 1);
    let cases = [
        (&one + power(53).recip(), 1.0),
        (&one + power(53).recip() * rational(3, 1), 1.0 + 2.0 * f64::EPSILON),
        (power(1074).recip(), f64::from_bits(1)),
        (power(1080).recip(), 0.0),
        (power(1023), 2f64.powi(1023)),
        (power(1024), f64::INFINITY),
        (rational(0, 1), 0.0),
    ];
    for (root, expected) in cases {
        assert_eq!(rounded_roots(&with_roots(&[root])).unwrap(), vec![expected]);
    }
}

#[test]
fn wilkinson_of_degree_twenty_is_exact() {
    let roots: Vec<BigRational> = (1..=20).map(|n| rational(n, 1)).collect();
    let expected: Vec<f64> = (1..=20).map(f64::from).collect();
    assert_eq!(rounded_roots(&with_roots(&roots)).unwrap(), expected);
}

#[test]
fn constants_have_no_roots_and_zero_is_refused() {
    assert_eq!(isolate(&integers(&[5, 0, 0])).unwrap(), vec![]);
    for zero in [&[][..], &[0, 0]] {
        assert_eq!(isolate(&integers(zero)).unwrap_err().kind(), ErrorKind::BadValue);
    }
    let sturm = Sturm::new(&integers(&[-2, 0, 1])).unwrap();
    let error = sturm.refine(&sturm.intervals()[0], &rational(0, 1)).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::BadValue);
}
