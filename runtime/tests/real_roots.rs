//! Real roots of polynomials with known ones.

use groebot_runtime::roots::{Roots, real_roots};
use groebot_runtime::{Lanes, Number};

/// The coefficients of the monic polynomial with these roots, constant term first.
fn with_roots(roots: &[f64]) -> Vec<f64> {
    let mut polynomial = vec![1.0];
    for root in roots {
        polynomial.insert(0, 0.0);
        (1..polynomial.len()).for_each(|k| polynomial[k - 1] -= root * polynomial[k]);
    }
    polynomial
}

#[test]
fn roots_are_found_in_ascending_order() {
    let mut next = super::random();
    for count in 1..=8 {
        for _ in 0..200 {
            let mut expected: Vec<f64> = (0..count).map(|k| f64::from(k) * 0.4 - 1.3 + 0.2 * next()).collect();
            expected.sort_by(f64::total_cmp);
            let roots: Roots<f64, 8> = real_roots(&with_roots(&expected), 1.0);
            assert_eq!(roots.count(), expected.len(), "{expected:?} {:?}", roots.as_slice());
            for (root, expected) in roots.as_slice().iter().zip(&expected) {
                assert!((root - expected).abs() < 1e-9, "{expected:?} {:?}", roots.as_slice());
            }
        }
    }
}

#[test]
fn double_roots_are_one_and_are_doubted() {
    let roots: Roots<f64, 4> = real_roots(&with_roots(&[-0.5, 0.3, 0.3, 1.0]), 1.0);
    assert_eq!(roots.count(), 3, "{:?}", roots.as_slice());
    assert!((0..3).all(|index| roots.doubt(index)));
    let none: Roots<f64, 2> = real_roots(&[1.0, 0.0, 1.0], 1.0);
    assert_eq!(none.count(), 0);
}

#[test]
fn squares_miss_by_little_or_have_no_root() {
    assert_eq!(f64::square_roots(-4.0, 1.0).as_slice(), [-2.0, 2.0]);
    assert_eq!(f64::square_roots(1e-12, 1.0).as_slice(), [0.0]);
    assert_eq!(f64::square_roots(1e-6, 1.0).count(), 0);
    assert_eq!(f64::grazing_roots(1e-7, 1.0).as_slice(), [0.0]);
    assert!(f64::square_roots(-1e-12, 1.0).doubt(0) && !f64::square_roots(-1.0, 1.0).doubt(0));
}

#[test]
fn the_first_polynomial_that_leads_is_solved() {
    let roots: Roots<f64, 2> = f64::real_roots(&[&[1.0, 1.0, 1e-12], &[-2.0, 1.0]], 1.0);
    assert_eq!(roots.as_slice(), [2.0]);
    let lanes: Roots<Lanes<2>, 2> =
        Lanes::real_roots(&[&[Lanes([-1.0, 1.0]), Lanes::of(0.0), Lanes::of(1.0)]], Lanes::of(1.0));
    assert_eq!([lanes.as_slice()[0].0[0], lanes.as_slice()[1].0[0]], [-1.0, 1.0]);
}
