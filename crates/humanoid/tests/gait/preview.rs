//! Preview control of the zero moment point (ZMP), Kajita 2003.

use groebot_humanoid::gait::{Durations, GRAVITY, Gait, Preview, Regular, Request, Summary};

use super::nao::feet_are_where_they_should_be;
use super::{regular, request, robot, walk};

fn dynamic() -> Request {
    let mut request = request(&Regular { steps: 8, length: 0.05, ..regular() });
    request.gait = Gait::Preview;
    request.style.lift = 0.03;
    request.durations = Durations { rest: 1.5, shift: 0.24, swing: 0.56, lower: None };
    request
}

#[test]
fn a_step_of_the_reference_is_followed_from_before_it_happens() {
    let (height, tick) = (0.26, 0.01);
    let preview = Preview::new(height, tick).unwrap();
    let reference: Vec<f64> = (0..600).map(|sample| if sample < 300 { 0.0 } else { 0.1 }).collect();
    let positions = preview.follow(&reference);
    assert!(positions[150].abs() < 1e-4 && positions[290] > 0.005, "it moves before the step");
    assert!((positions[599] - 0.1).abs() < 1e-5);
    let zmp = |k: usize| {
        let acceleration = (positions[k + 1] - 2.0 * positions[k] + positions[k - 1]) / (tick * tick);
        positions[k] - height / GRAVITY * acceleration
    };
    for sample in (1..599usize).filter(|sample| sample.abs_diff(300) > 25) {
        assert!((zmp(sample) - reference[sample]).abs() < 2e-3, "{sample}: {}", zmp(sample));
    }
}

#[test]
fn who_is_to_stay_stays() {
    let preview = Preview::new(0.3, 0.01).unwrap();
    // The reference beyond the horizon of 2 s is neglected: a relative error of e^(-2 w) with w^2 = g / h.
    let forgotten = 0.07 * (-2.0 * (GRAVITY / 0.3).sqrt()).exp();
    assert!(preview.follow(&[0.07; 300]).iter().all(|x| (x - 0.07).abs() < 2.0 * forgotten));
    assert!(preview.follow(&[]).is_empty());
    for (height, tick) in [(0.0, 0.01), (0.3, -0.01), (f64::NAN, 0.01), (0.3, f64::INFINITY)] {
        assert!(Preview::new(height, tick).is_err());
    }
}

#[test]
fn nao_walks_dynamically_at_5_cm_a_second() {
    let request = dynamic();
    let walk = walk(&request).unwrap();
    let summary = Summary::of(&robot().0, &walk);
    assert!(summary.speed >= 0.05, "{}", summary.speed);
    assert_eq!(summary.slowed.0, 0);
    assert!(walk.balances.iter().all(|balance| balance.margin >= request.margin));
    assert!(
        summary.static_margin.value < summary.margin.value,
        "its centre of mass does not rest over the feet, RH0 (3-3)"
    );
    feet_are_where_they_should_be(&walk);
}

#[test]
fn it_turns_too() {
    let mut request = dynamic();
    request.route =
        groebot_humanoid::gait::Route::regular(&Regular { steps: 6, length: 0.02, turn: 0.4, ..regular() }).unwrap();
    let walk = walk(&request).unwrap();
    assert!((Summary::of(&robot().0, &walk).turn - 0.4).abs() < 1e-12);
    assert!(walk.balances.iter().all(|balance| balance.margin >= request.margin));
    feet_are_where_they_should_be(&walk);
}
