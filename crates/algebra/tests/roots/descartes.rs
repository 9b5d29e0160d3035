//! Descartes' method compared with Sturm's and with known roots; refinement and signs at roots.

use std::cmp::Ordering;

use groebot_algebra::number::{BigInt, BigRational};
use groebot_algebra::roots::{
    Interval, RealRoot, Sturm, gcd, isolate_square_free, real_roots_of, refine, sign_at_root, square_free_parts,
};
use groebot_algebra::{ErrorKind, Watch};
use num_traits::{One, Pow};
use proptest::prelude::*;

use super::{even_polynomials, integers, product, rational, with_roots};

fn roots_of(p: &[BigRational]) -> Vec<RealRoot> {
    real_roots_of(p, &Watch::none()).unwrap()
}

fn whole(p: &[BigRational]) -> Vec<BigInt> {
    p.iter().map(|c| c.to_integer()).collect()
}

/// The roots of Sturm's method are in the intervals, one in each, and the intervals are disjoint.
fn assert_agrees_with_sturm(p: &[BigRational]) -> Vec<RealRoot> {
    let sturm = Sturm::new(p).unwrap();
    let found = roots_of(p);
    assert_eq!(found.len(), sturm.count(), "{p:?}");
    for RealRoot { interval, .. } in &found {
        if interval.is_point() {
            assert_eq!(
                sturm.count_between(&(interval.low() - rational(1, 1)), interval.low())
                    - sturm.count_between(&(interval.low() - rational(1, 1)), &(interval.low() - tiny())),
                1
            );
        } else {
            assert_eq!(sturm.count_between(interval.low(), interval.high()), 1);
        }
    }
    assert!(found.windows(2).all(|pair| pair[0].interval.high() <= pair[1].interval.low()));
    found
}

fn tiny() -> BigRational {
    BigRational::new(BigInt::one(), BigInt::one() << 400)
}

fn polynomial(largest: i64) -> impl Strategy<Value = Vec<BigRational>> {
    prop::collection::vec(-largest..=largest, 1..14).prop_map(|c| integers(&c))
}

fn known_roots() -> impl Strategy<Value = Vec<(BigRational, usize)>> {
    prop::collection::btree_map((-40i64..40, 1i64..9).prop_map(|(n, d)| rational(n, d)), 1usize..4, 0..6)
        .prop_map(|map| map.into_iter().collect())
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn both_methods_agree_on_random_polynomials(p in polynomial(40), q in polynomial(3)) {
        let p = product(&[p, q.clone(), q]);
        prop_assume!(p.iter().any(|c| *c != rational(0, 1)));
        assert_agrees_with_sturm(&p);
    }

    #[test]
    fn known_roots_have_their_multiplicities(roots in known_roots(), pairs in 0usize..2, scale in 1i64..99) {
        let repeated: Vec<_> = roots.iter().flat_map(|(root, times)| vec![root.clone(); *times]).collect();
        let complex = vec![integers(&[2, 1, 1]); pairs];
        let p = product(&[complex, vec![with_roots(&repeated), vec![rational(-scale, 7)]]].concat());
        let found = roots_of(&p);
        prop_assert_eq!(found.len(), roots.len());
        for (found, (root, times)) in found.iter().zip(&roots) {
            prop_assert!(found.interval.low() <= root && root <= found.interval.high());
            prop_assert_eq!(found.multiplicity, *times);
        }
    }

    #[test]
    fn refinement_keeps_the_root(roots in known_roots(), bits in 0u64..500) {
        let roots: Vec<_> = roots.into_iter().map(|(root, _)| root).collect();
        let p = whole(&with_roots(&roots).iter().map(|c| c * rational(2520i64.pow(3), 1) * rational(2520i64.pow(3), 1)).collect::<Vec<_>>());
        let width = BigRational::new(BigInt::one(), BigInt::one() << bits);
        for (interval, root) in isolate_square_free(&p, &Watch::none()).unwrap().iter().zip(&roots) {
            let narrow = refine(&p, interval, bits, &Watch::none()).unwrap();
            prop_assert!(narrow.low() <= root && root <= narrow.high() && narrow.width() <= width);
        }
    }

    #[test]
    fn signs_at_rational_roots_are_those_of_the_values(roots in known_roots(), other in polynomial(9)) {
        let roots: Vec<_> = roots.into_iter().map(|(root, _)| root).collect();
        let p = whole(&with_roots(&roots).iter().map(|c| c * rational(2520i64.pow(3), 1) * rational(2520i64.pow(3), 1)).collect::<Vec<_>>());
        for (interval, root) in isolate_square_free(&p, &Watch::none()).unwrap().iter().zip(&roots) {
            let value = other.iter().rev().fold(rational(0, 1), |value, c| value * root + c);
            let sign = sign_at_root(&p, interval, &whole(&other), &Watch::none()).unwrap();
            prop_assert_eq!(sign, value.cmp(&rational(0, 1)));
        }
    }

    #[test]
    fn the_square_free_parts_multiply_to_the_polynomial(p in polynomial(9), q in polynomial(5), n in 1usize..4) {
        let p = product(&[vec![p], vec![q; n]].concat());
        prop_assume!(p.iter().any(|c| *c != rational(0, 1)));
        let p = whole(&p);
        let parts = square_free_parts(&p);
        let rational_part = |part: &Vec<BigInt>| part.iter().map(|c| BigRational::from_integer(c.clone())).collect::<Vec<_>>();
        let factors: Vec<_> = parts.iter().flat_map(|(m, part)| vec![rational_part(part); *m]).collect();
        let whole_again = product(&factors);
        let trimmed = p.iter().rposition(|c| *c != BigInt::from(0)).unwrap() + 1;
        prop_assert_eq!(whole_again.len(), trimmed);
        let factor = BigRational::new(p[trimmed - 1].clone(), whole_again[trimmed - 1].to_integer());
        for (c, d) in p.iter().zip(&whole_again) {
            prop_assert_eq!(BigRational::from_integer(c.clone()), d * &factor);
        }
        for (i, (_, a)) in parts.iter().enumerate() {
            prop_assert!(parts[..i].iter().all(|(_, b)| gcd(a, b).len() == 1));
        }
    }
}

#[test]
fn even_polynomials_are_solved() {
    for (p, roots) in even_polynomials() {
        let found = assert_agrees_with_sturm(&p);
        assert_eq!(found.len(), roots.len());
    }
    let (double, _) = even_polynomials()[2].clone();
    assert!(roots_of(&double).iter().all(|root| root.multiplicity == 2));
}

#[test]
fn wilkinson_has_twenty_roots_and_its_perturbation_ten() {
    let wilkinson = with_roots(&(1..=20).map(|n| rational(n, 1)).collect::<Vec<_>>());
    assert_eq!(assert_agrees_with_sturm(&wilkinson).len(), 20);
    // Wilkinson, "The evaluation of the zeros of ill-conditioned polynomials" (1959): with -210 - 2^-23 at x^19 it has
    // ten real roots.
    let mut perturbed = wilkinson;
    perturbed[19] -= rational(1, 1 << 23);
    assert_eq!(assert_agrees_with_sturm(&perturbed).len(), 10);
}

/// Mignotte's `x^n - 2 (a x - 1)^2` has two roots within `2 a^(-(n + 2) / 2)` of `1/a`; for even n there is one negative root
/// and a large positive one.
#[test]
fn roots_of_mignotte_are_distinguished() {
    for n in [10, 20, 31] {
        let mut p = vec![rational(0, 1); n + 1];
        p[n] = rational(1, 1);
        for (target, c) in p.iter_mut().zip([-2, 400, -20_000]) {
            *target += rational(c, 1);
        }
        let found = assert_agrees_with_sturm(&p);
        assert_eq!(found.len(), if n % 2 == 0 { 4 } else { 3 });
        let near =
            |root: &&RealRoot| *root.interval.low() < rational(1, 50) && *root.interval.high() > rational(1, 200);
        assert_eq!(found.iter().filter(near).count(), 2);
    }
}

/// All roots of the Chebyshev polynomials are real, simple, and cosines.
#[test]
fn chebyshev_polynomials_have_all_their_roots() {
    let (mut previous, mut current) = (integers(&[1]), integers(&[0, 1]));
    for n in 2..=40 {
        let mut next = vec![rational(0, 1)];
        next.extend(current.iter().map(|c| c * rational(2, 1)));
        next.iter_mut().zip(&previous).for_each(|(target, c)| *target -= c);
        (previous, current) = (current, next);
        if n % 13 == 1 {
            let found = roots_of(&current);
            assert_eq!(found.len(), n);
            for (k, root) in found.iter().rev().enumerate() {
                let cosine = (std::f64::consts::PI * (2 * k + 1) as f64 / (2 * n) as f64).cos();
                let narrow = refine(&whole(&current), &root.interval, 60, &Watch::none()).unwrap();
                assert!((num_traits::ToPrimitive::to_f64(narrow.low()).unwrap() - cosine).abs() < 1e-14);
            }
        }
    }
}

/// The square root of two to ten thousand bits, against the integer square root.
#[test]
fn refinement_reaches_any_precision() {
    let p = whole(&integers(&[-2, 0, 1]));
    let intervals = isolate_square_free(&p, &Watch::none()).unwrap();
    let narrow = refine(&p, &intervals[1], 10_000, &Watch::none()).unwrap();
    let root = (BigInt::from(2) << 20_000u32).sqrt();
    let scale = BigInt::from(2).pow(10_000u32);
    assert!(narrow.width() <= BigRational::new(BigInt::one(), scale.clone()));
    assert!(
        *narrow.low() <= BigRational::new(&root + 1, scale.clone()) && *narrow.high() >= BigRational::new(root, scale)
    );
}

#[test]
fn a_common_root_gives_sign_zero_and_a_near_one_does_not() {
    let p = whole(&product(&[integers(&[-2, 0, 1]), integers(&[-3, 1])]));
    let intervals: Vec<Interval> = isolate_square_free(&p, &Watch::none()).unwrap();
    let signs = |other: &[BigInt]| -> Vec<Ordering> {
        intervals.iter().map(|i| sign_at_root(&p, i, other, &Watch::none()).unwrap()).collect()
    };
    assert_eq!(signs(&whole(&integers(&[-2, 0, 1]))), [Ordering::Equal, Ordering::Equal, Ordering::Greater]);
    // 10^400 x - floor(10^400 sqrt 2) is positive at sqrt 2, by less than one.
    let power = BigInt::from(10).pow(400u32);
    let near = (&power * &power * BigInt::from(2)).sqrt();
    assert_eq!(signs(&[-near, power]), [Ordering::Less, Ordering::Greater, Ordering::Greater]);
    assert_eq!(signs(&[]), [Ordering::Equal; 3]);
}

#[test]
fn constants_have_no_roots_and_zero_is_refused() {
    assert!(roots_of(&integers(&[7])).is_empty());
    for zero in [&[][..], &[rational(0, 1)]] {
        assert_eq!(real_roots_of(zero, &Watch::none()).unwrap_err().kind(), ErrorKind::BadValue);
    }
}

#[test]
fn multiple_roots_and_foreign_intervals_are_refused() {
    for p in [&[9, -6, 1][..], &[0, 0, 1], &[0], &[]] {
        assert_eq!(isolate_square_free(&whole(&integers(p)), &Watch::none()).unwrap_err().kind(), ErrorKind::BadValue);
    }
    assert_eq!(isolate_square_free(&whole(&integers(&[-3, 1, 0, 0])), &Watch::none()).unwrap().len(), 1);
    let [p, other] = [[-2, 0, 1], [2, 0, 1]].map(|c| whole(&integers(&c)));
    let intervals = isolate_square_free(&p, &Watch::none()).unwrap();
    assert_eq!(refine(&other, &intervals[0], 99, &Watch::none()).unwrap_err().kind(), ErrorKind::BadValue);
}
