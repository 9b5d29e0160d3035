//! Real roots of polynomials with known roots.

use groebot_runtime::roots::{MAX_DEGREE, Roots, real_roots};
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

/// The tangent of half of 169 degrees: a double root that misses the axis by 1e-5 of the size of the terms there.
#[test]
fn the_tangent_of_half_an_angle_is_measured_where_it_is() {
    let mut raised = with_roots(&[-1.0, 0.5, 10.0, 10.0]);
    let size = raised.iter().rev().fold(0.0, |size: f64, a| size * 10.0 + a.abs());
    raised[0] += 1e-5 * size * 1.0_f64.copysign(raised[4]);
    let exact: Roots<f64, 4> = f64::half_angle_roots(&raised, 1.0);
    assert_eq!(exact.count(), 2, "{:?}", exact.as_slice());
    // 40^4 times the 1e-10 of rounding are 2.6e-4 of the greatest term.
    let spread: Roots<f64, 4> = f64::half_angle_roots(&raised, 40.0);
    assert!(
        spread.count() == 3 && spread.doubt(2) && (spread.as_slice()[2] - 10.0).abs() < 0.1,
        "{:?}",
        spread.as_slice()
    );
    let wide: Vec<Lanes<2>> = raised.iter().map(|a| Lanes([*a, *a])).collect();
    let lanes: Roots<Lanes<2>, 4> = Lanes::half_angle_roots(&wide, Lanes([1.0, 40.0]));
    assert_eq!(lanes.as_slice()[2].0[1], spread.as_slice()[2]);
    assert!(lanes.as_slice()[2].0[0].is_nan());
}

#[test]
fn the_first_polynomial_that_leads_is_solved() {
    let roots: Roots<f64, 2> = f64::real_roots(&[&[1.0, 1.0, 1e-12], &[-2.0, 1.0]], 1.0);
    assert_eq!(roots.as_slice(), [2.0]);
    let lanes: Roots<Lanes<2>, 2> =
        Lanes::real_roots(&[&[Lanes([-1.0, 1.0]), Lanes::of(0.0), Lanes::of(1.0)]], Lanes::of(1.0));
    assert_eq!([lanes.as_slice()[0].0[0], lanes.as_slice()[1].0[0]], [-1.0, 1.0]);
}

fn roots_of(coefficients: &[f64]) -> Roots<f64, MAX_DEGREE> {
    real_roots(coefficients, 0.0)
}

fn assert_near(coefficients: &[f64], expected: &[f64], relative: f64) {
    let roots = roots_of(coefficients);
    assert_eq!(roots.count(), expected.len(), "{coefficients:?}: {roots:?}, not {expected:?}");
    for (root, exact) in roots.as_slice().iter().zip(expected) {
        assert!((root - exact).abs() <= relative * exact.abs(), "{root} is not {exact}");
    }
}

/// Polynomials that break eigenvalue methods: `x^6 - 1`, `x^8 + 1`, `(x^2 - 1)^2 (x^2 - 4)^2`.
#[test]
fn even_polynomials_are_solved() {
    assert_near(&[-1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], &[-1.0, 1.0], 1e-14);
    assert_near(&[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], &[], 0.0);
    assert_near(&[16.0, 0.0, -40.0, 0.0, 33.0, 0.0, -10.0, 0.0, 1.0], &[-2.0, -1.0, 1.0, 2.0], 1e-14);
}

#[test]
fn a_degree_that_is_too_high_is_refused() {
    let mut beyond = [0.0; MAX_DEGREE + 2];
    (beyond[0], beyond[MAX_DEGREE + 1]) = (-1.0, 1.0);
    assert!(roots_of(&beyond).as_slice().is_empty());
}

#[test]
fn quadratics_keep_their_small_root() {
    assert_near(&[1.0, -1e9, 1.0], &[1e-9, 1e9], 1e-15);
    assert_near(&[-1.0, 0.0, 4.0], &[-0.5, 0.5], 0.0);
    assert_near(&[0.0, -3.0, 1.0], &[0.0, 3.0], 0.0);
    assert_near(&[9.0, -6.0, 1.0], &[3.0], 0.0);
    assert_near(&[1.0, 1.0, 1.0], &[], 0.0);
}

#[test]
fn scales_are_no_obstacle() {
    for scale in [1e-90, 1e-30, 1.0, 1e30, 1e90] {
        let cubic = [-6.0 * scale * scale * scale, 11.0 * scale * scale, -6.0 * scale, 1.0];
        assert_near(&cubic, &[scale, 2.0 * scale, 3.0 * scale], 1e-13);
    }
    assert_near(&[2e300, -3e300, 1e300], &[1.0, 2.0], 1e-15);
    assert_near(&[-1e-200, 0.0, 0.0, 1.0], &[1e-200f64.cbrt()], 1e-14);
    assert_near(&[-1.0, 0.0, 1.0, 1e-200], &[-1e200, -1.0, 1.0], 1e-14);
}

#[test]
fn negligible_leading_coefficients_are_dropped() {
    assert_near(&[-6.0, 2.0, 0.0, 0.0], &[3.0], 0.0);
    assert_near(&[-6.0, 2.0, 1e-300], &[3.0], 0.0);
    assert_near(&[-6.0, 2.0, 1e-20], &[-2e20, 3.0], 1e-15);
    assert_near(&[-1.0, 0.0, 1.0, 1e-18, 1e-18], &[-1.0, 1.0], 1e-15);
}

#[test]
fn what_has_no_roots_gives_none() {
    for p in
        [&[][..], &[0.0], &[0.0, 0.0, 0.0], &[4.0], &[f64::NAN, 1.0], &[1.0, f64::INFINITY], &[1.0, 0.0, 0.0, 0.0, 1.0]]
    {
        assert!(roots_of(p).as_slice().is_empty(), "{p:?}");
    }
}
