//! Preview control of the zero moment point (ZMP), Kajita 2003.

use groebot_humanoid::Watch;
use groebot_humanoid::gait::{
    Durations, GRAVITY, Gait, GaitDefaults, Preview, Regular, Request, Route, Side, Summary, Walk, Walker, plan_at,
};
use groebot_humanoid::walkers::{Outline, walker};

use super::nao::feet_are_where_they_should_be;
use super::{regular, request, robot, walk};

/// A straight walk of this number of steps by the default parameters of a robot's preview control.
fn straight(walker: &Walker, steps: usize) -> Walk {
    let defaults: &GaitDefaults = &walker.gaits.iter().find(|(name, _)| *name == "preview").unwrap().1;
    let half_width = defaults.half_width(&walker.biped);
    let request = |height, ease| {
        let length = defaults.clone().eased(ease).length;
        let regular = Regular { steps, length, aside: 0.0, turn: 0.0, half_width, first: Side::Left };
        Ok(defaults.request(&walker.biped, Route::regular(&regular)?, height))
    };
    plan_at((&walker.biped, &walker.legs), None, &defaults.hip_heights, request, &Watch::none()).unwrap()
}

fn known(name: &str) -> Walker {
    walker(name, Outline::Measured).unwrap().unwrap()
}

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
    // The whole future of the reference counts: only the rounding of the gains is left.
    assert!(preview.follow(&[0.07; 300]).iter().all(|x| (x - 0.07).abs() < 1e-8));
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
fn nao_walks_8_cm_a_second_by_default() {
    let nao = known("nao");
    let walk = straight(&nao, 8);
    let summary = Summary::of(&nao.biped, &walk);
    assert!(summary.speed >= 0.08, "{}", summary.speed);
    assert_eq!(summary.slowed.0, 0);
    // The zero moment point is near the middles of the soles, which are 89 mm wide.
    assert!(summary.margin.value >= 0.035, "{}", summary.margin.value);
}

#[test]
fn walks_start_and_end_at_rest() {
    for name in ["nao", "rh0", "teo"] {
        let walker = known(name);
        let walk = straight(&walker, 4);
        let last = walk.balances.len() - 1;
        for sample in [0, 1, last - 1, last] {
            let balance = &walk.balances[sample];
            let off = (balance.zmp - balance.pressure).norm();
            assert!(off < 5e-3, "{name}: the zero moment point is {off} m from the centre of mass at sample {sample}");
        }
    }
}

/// A long walk is planned with the factors of a shortened one.
#[test]
fn equal_steps_of_long_walks_are_equally_slow() {
    let rh0 = known("rh0");
    let [short, long] = [14, 41].map(|steps| straight(&rh0, steps));
    let factors = |walk: &Walk| walk.schedule.phases.iter().map(|phase| phase.slowed).collect::<Vec<_>>();
    let (short, long) = (factors(&short), factors(&long));
    assert!(short.iter().any(|factor| *factor > 1.0), "a test of slower walks needs one");
    // Rest and both phases of six steps at the start; two, the last shift and the rest at the end.
    assert_eq!(long[..13], short[..13]);
    assert_eq!(long[long.len() - 6..], short[short.len() - 6..]);
    for phase in 13..long.len() - 10 {
        assert_eq!(long[phase], long[phase - 4], "phase {phase}");
    }
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
