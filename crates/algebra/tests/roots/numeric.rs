//! The run time's roots compared with known roots and with exact isolation.

use groebot_algebra::number::{BigRational, Rationals};
use groebot_algebra::poly::univariate::UnivariateRing;
use groebot_algebra::roots::{MAX_DEGREE, Sturm, TANGENT, rounded_roots};
use groebot_runtime::roots::{self, Roots};
use num_traits::ToPrimitive;
use proptest::prelude::*;

use super::{integers, product, rational, with_roots};

fn real_roots(coefficients: &[f64], scale: f64) -> Roots<f64, MAX_DEGREE> {
    roots::real_roots(coefficients, scale)
}

fn floats(p: &[BigRational]) -> Vec<f64> {
    p.iter().map(|c| c.to_f64().unwrap()).collect()
}

/// `p(x)`, `p'(x)` and `sum |a_i x^i|`.
fn evaluate(p: &[f64], x: f64) -> (f64, f64, f64) {
    let power = |i: usize| x.powi(i as i32);
    let value = p.iter().enumerate().map(|(i, c)| c * power(i)).sum();
    let slope = p.iter().enumerate().skip(1).map(|(i, c)| i as f64 * c * power(i - 1)).sum();
    let size = p.iter().enumerate().map(|(i, c)| (c * power(i)).abs()).sum();
    (value, slope, size)
}

/// Whether `p` stays a hundred times further from the axis at its critical points than near a tangency.
fn is_well_separated(p: &[BigRational]) -> bool {
    is_separated(p, 0.0)
}

/// Same as `is_well_separated`, but for an unknown of this typical size.
fn is_separated(p: &[BigRational], scale: f64) -> bool {
    let ring = UnivariateRing::new(Rationals, "x");
    let derivative = ring.derivative(&ring.polynomial(p.to_vec())).coefficients;
    let Ok(critical) = rounded_roots(&derivative) else { return true };
    let coefficients = floats(p);
    critical.iter().all(|&x| {
        let value = evaluate(&coefficients, x).0;
        let size: f64 = coefficients.iter().enumerate().map(|(i, c)| c.abs() * x.abs().max(scale).powi(i as i32)).sum();
        value.abs() > 100.0 * TANGENT * size
    })
}

/// Asserts equal numbers of roots, and errors within the conditioning of each simple root.
fn assert_matches(p: &[BigRational], expected: &[f64]) {
    assert_found(p, expected, 0.0);
}

/// Same as `assert_matches`, but for an unknown of this typical size.
fn assert_found(p: &[BigRational], expected: &[f64], scale: f64) {
    let coefficients = floats(p);
    let roots = real_roots(&coefficients, scale);
    assert_eq!(roots.as_slice().len(), expected.len(), "{coefficients:?}: {roots:?}, not {expected:?}");
    for (root, exact) in roots.as_slice().iter().zip(expected) {
        let (_, slope, size) = evaluate(&coefficients, *exact);
        // A zero root has no magnitude: a root that is negligible relative to the unknown's typical size is zero.
        let nothing = f64::EPSILON * f64::EPSILON * scale;
        let bound = 1e-14 * size / slope.abs() + 4.0 * f64::EPSILON * exact.abs() + nothing;
        assert!((root - exact).abs() <= bound, "{root} is not {exact} within {bound}");
    }
}

fn assert_near(coefficients: &[f64], expected: &[f64], relative: f64) {
    let roots = real_roots(coefficients, 0.0);
    assert_eq!(roots.as_slice().len(), expected.len(), "{coefficients:?}: {roots:?}, not {expected:?}");
    for (root, exact) in roots.as_slice().iter().zip(expected) {
        assert!((root - exact).abs() <= relative * exact.abs(), "{root} is not {exact}");
    }
}

fn integer_polynomial(largest: i64) -> impl Strategy<Value = Vec<BigRational>> {
    prop::collection::vec(-largest..=largest, 1..10).prop_map(|c| integers(&c))
}

proptest! {
    #![proptest_config(crate::cases(500))]

    #[test]
    fn random_polynomials_have_the_roots_that_sturm_counts(p in integer_polynomial(1000)) {
        prop_assume!(p.iter().any(|c| *c != rational(0, 1)) && is_well_separated(&p));
        let exact = rounded_roots(&p).unwrap();
        assert_matches(&p, &exact);
    }

    #[test]
    fn simple_rational_roots_are_found(roots in prop::collection::btree_set(-64i64..64, 1..9), d in 1i64..20) {
        let roots: Vec<BigRational> = roots.into_iter().map(|n| rational(n, d)).collect();
        let p = with_roots(&roots);
        prop_assume!(is_well_separated(&p));
        assert_matches(&p, &floats(&roots));
    }

    #[test]
    fn ordinary_quartics_have_the_roots_that_sturm_counts(c in prop::collection::vec(-1000i64..=1000, 5)) {
        let p = integers(&c);
        prop_assume!(c[4] != 0 && is_separated(&p, 1.0));
        assert_found(&p, &rounded_roots(&p).unwrap(), 1.0);
    }

    #[test]
    fn quartics_with_roots_next_to_each_other_have_the_roots_that_sturm_counts(
        centres in prop::array::uniform2(-64i64..64), apart in prop::array::uniform2(1i64..4096),
        signs in prop::array::uniform2(any::<bool>()),
    ) {
        // Two pairs of roots, real or complex, each 1/65536 to 1/16 from its centre.
        let pair = |i: usize| {
            let square = rational(apart[i], 65536) * rational(apart[i], 65536);
            let centre = rational(centres[i], 64);
            let constant = &centre * &centre + if signs[i] { square } else { -square };
            vec![constant, rational(-centres[i], 32), rational(1, 1)]
        };
        let p = product(&[pair(0), pair(1)]);
        prop_assume!(is_separated(&p, 1.0));
        assert_found(&p, &rounded_roots(&p).unwrap(), 1.0);
    }

    #[test]
    fn no_root_is_lost_whatever_its_multiplicity(
        roots in prop::collection::btree_map(-12i64..12, 1usize..4, 1..4), d in 1i64..9, pair in any::<bool>(),
    ) {
        let factor = |n: i64, times| vec![vec![rational(-n, d), rational(1, 1)]; times];
        let mut factors: Vec<_> = roots.iter().flat_map(|(&n, &times)| factor(n, times)).collect();
        if pair {
            factors.push(integers(&[2, 1, 1]));
        }
        let coefficients = floats(&product(&factors));
        let found = real_roots(&coefficients, 0.0);
        for n in roots.keys() {
            let exact = *n as f64 / d as f64;
            let near = found.as_slice().iter().any(|x| (x - exact).abs() < 1e-3 / d as f64);
            prop_assert!(near, "{exact} is lost: {found:?}");
        }
        prop_assert!(found.as_slice().len() < coefficients.len());
    }

    #[test]
    fn double_roots_survive_rounding_of_the_coefficients(
        roots in prop::collection::btree_set(-12i64..12, 1..5), noise in prop::collection::vec(-1e-13..1e-13, 9),
    ) {
        let roots: Vec<BigRational> = roots.into_iter().map(|n| rational(n, 4)).collect();
        let p = with_roots(&[roots.clone(), roots.clone()].concat());
        let coefficients: Vec<f64> = floats(&p).iter().zip(&noise).map(|(c, e)| c * (1.0 + e)).collect();
        let found = real_roots(&coefficients, 0.0);
        let roots = floats(&roots);
        for exact in &roots {
            let others = roots.iter().filter(|other| *other != exact);
            let half_curvature: f64 = others.map(|other| (exact - other).powi(2)).product();
            let (_, _, size) = evaluate(&coefficients, *exact);
            let bound = 3.0 * (1e-13 * size / half_curvature).sqrt();
            let near = found.as_slice().iter().any(|x| (x - exact).abs() <= bound);
            prop_assert!(near, "{exact} is lost: {found:?}");
        }
    }

    #[test]
    fn roots_scale_with_the_variable_and_ignore_the_factor(
        p in integer_polynomial(50), scale in -30i32..30, factor in -200i32..200,
    ) {
        prop_assume!(p.iter().any(|c| *c != rational(0, 1)) && is_well_separated(&p));
        let coefficients = floats(&p);
        let scaled: Vec<f64> = coefficients.iter().enumerate()
            .map(|(i, c)| c * 2f64.powi(factor - scale * i as i32)).collect();
        let expected: Vec<f64> = rounded_roots(&p).unwrap().iter().map(|x| x * 2f64.powi(scale)).collect();
        let found = real_roots(&scaled, 0.0);
        prop_assert_eq!(found.as_slice().len(), expected.len());
        for (root, exact) in found.as_slice().iter().zip(expected) {
            prop_assert!((root - exact).abs() <= 1e-7 * exact.abs());
        }
    }

    #[test]
    fn any_input_gives_finite_ascending_roots(p in prop::collection::vec(any::<f64>(), 0..20)) {
        let found = real_roots(&p, 0.0);
        prop_assert!(found.as_slice().iter().all(|x| x.is_finite()));
        prop_assert!(found.as_slice().is_sorted());
        prop_assert!(found.as_slice().len() < p.len().max(1));
    }

    #[test]
    fn quadratics_touch_on_both_sides(x in -50.0..50.0f64, a in 0.1..10.0f64, offset in -1e-11..1e-11f64) {
        let size = a * x * x;
        let found = real_roots(&[size + offset * size, -2.0 * a * x, a], 0.0);
        prop_assert!(!found.as_slice().is_empty());
        for root in found.as_slice() {
            prop_assert!((root - x).abs() <= 1e-5 * x.abs());
        }
    }
}

#[test]
fn wilkinson_of_degree_ten_is_solved() {
    let roots: Vec<BigRational> = (1..=10).map(|n| rational(n, 1)).collect();
    assert_matches(&with_roots(&roots), &floats(&roots));
    assert_near(&floats(&with_roots(&roots)), &floats(&roots), 1e-8);
}

#[test]
fn the_highest_degree_is_solved() {
    let roots: Vec<BigRational> = (-8..8).map(|n| rational(2 * n + 1, 8)).collect();
    assert_eq!(roots.len(), MAX_DEGREE);
    assert_matches(&with_roots(&roots), &floats(&roots));
}

#[test]
fn multiple_roots_are_reported_once_and_sharply() {
    for (root, times) in [(3, 2), (3, 3), (3, 4), (-7, 5), (0, 6)] {
        let p = with_roots(&vec![rational(root, 2); times]);
        assert_near(&floats(&p), &[root as f64 / 2.0], 1e-14);
    }
}

#[test]
fn sturm_agrees_that_a_near_miss_is_no_root_and_the_method_still_reports_it() {
    let near_miss = vec![rational(1_000_000_000_001, 1_000_000_000_000), rational(-2, 1), rational(1, 1)];
    assert_eq!(Sturm::new(&near_miss).unwrap().count(), 0);
    assert_near(&floats(&near_miss), &[1.0], 1e-15);
    let lifted = product(&[near_miss, integers(&[-5, 1])]);
    assert_eq!(Sturm::new(&lifted).unwrap().count(), 1);
    assert_near(&floats(&lifted), &[1.0, 5.0], 1e-11);
}
