//! Cosines, sines and arc tangents against those of the standard library.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use groebot_runtime::angles::angle;
use groebot_runtime::trigonometry::{cosine, sine, wrap};
use groebot_runtime::{Lanes, Number};

/// The difference of two numbers, in units of the last place of 1.
fn steps(a: f64, b: f64) -> f64 {
    (a - b).abs() / f64::EPSILON
}

fn odd() -> Vec<f64> {
    let mut angles = vec![0.0, 1e-300, 1e-9, 0.5, FRAC_PI_2, PI, TAU, 3.0 * FRAC_PI_2, 1e3, 1e6, 12345.678];
    for k in 0..=40 {
        angles.extend([f64::from(k) * FRAC_PI_2, f64::from(k) * FRAC_PI_2 + 1e-12, f64::from(k) * 0.25 * PI]);
    }
    angles.iter().flat_map(|&angle| [angle, -angle]).collect()
}

#[test]
fn cosines_and_sines_are_those_of_the_standard_library() {
    let mut next = super::random();
    let random = (0..100_000).map(|k| (next() - 0.5) * [7.0, 100.0, 1e5][k % 3]);
    for angle in random.chain(odd()) {
        assert!(steps(cosine(angle), angle.cos()) <= 1.0, "cos {angle}: {} {}", cosine(angle), angle.cos());
        assert!(steps(sine(angle), angle.sin()) <= 1.0, "sin {angle}: {} {}", sine(angle), angle.sin());
    }
}

#[test]
fn angles_are_those_of_the_standard_library() {
    let mut next = super::random();
    let random = (0..100_000).map(|_| (next() - 0.5) * 6.4);
    for turn in random.chain(odd()) {
        let (c, s) = (turn.cos(), turn.sin());
        let expected = if s.atan2(c) == -PI { PI } else { s.atan2(c) };
        assert!((angle(c, s) - expected).abs() <= 5e-16, "{turn}: {} {expected}", angle(c, s));
    }
    assert_eq!(angle(1.0, -0.0).to_bits(), 0);
    assert_eq!([angle(-1.0, -0.0), angle(-1.0, 0.0)], [PI, PI]);
    assert!(angle(0.0, 0.0).is_nan());
}

#[test]
fn lanes_are_single_numbers_to_the_last_bit() {
    let mut next = super::random();
    for _ in 0..1000 {
        let numbers: [f64; 4] = std::array::from_fn(|_| (next() - 0.5) * 20.0);
        let (c, s) = (Lanes(numbers).cos(), Lanes(numbers).sin());
        let angles = angle(c, s);
        for (lane, number) in numbers.into_iter().enumerate() {
            assert_eq!((c.0[lane], s.0[lane]), (cosine(number), sine(number)));
            assert_eq!(angles.0[lane].to_bits(), angle(cosine(number), sine(number)).to_bits());
        }
    }
}

#[test]
fn whole_turns_are_taken_off() {
    for (angle, expected) in [(PI, PI), (-PI, PI), (3.0 * PI, PI), (0.5, 0.5), (TAU + 0.5, 0.5), (-TAU - 0.5, -0.5)] {
        assert!((wrap(angle) - expected).abs() < 1e-15, "{angle}: {}", wrap(angle));
    }
    assert!(wrap(f64::NAN).is_nan());
}
