//! Infeasible walks are rejected with the reason, or slowed down.

use groebot_humanoid::gait::{Gait, Laws, OneStep, Regular, Request, Route, Summary, plan};
use groebot_humanoid::{ErrorKind, Watch};

use super::{regular, request, robot, walk};

fn reason(change: impl FnOnce(&mut Request)) -> String {
    let mut request = request(&regular());
    change(&mut request);
    let error = walk(&request).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::BadValue, "{error}");
    error.message().to_owned()
}

#[test]
fn the_reason_names_remedy_time_and_place() {
    let contains = |text: String, words: &[&str]| {
        for word in words {
            assert!(text.contains(word), "`{word}` in: {text}");
        }
    };
    contains(reason(|request| request.style.torso_height = 0.35), &["t = 0.00 s", "out of reach", "lower the hip"]);
    let far = Route::regular(&Regular { length: 0.14, ..regular() }).unwrap();
    contains(reason(|request| request.route = far), &["t = ", "out of reach", "shorten the steps"]);
    contains(
        reason(|request| request.style.lift = 0.05),
        &["swing of step 1 (left foot)", "`LAnkleRoll`", "-22.79..44.06 deg"],
    );
    // The measured sole: 50 - 38.77 + 10 mm to 50 + 50.02 - 10 mm; -50.72 + 10 to 99.42 - 10 mm.
    contains(
        reason(|request| request.style.amplitude = 0.015),
        &["centre of mass is 3.8 mm inside", "amplitude of 0.0212..0.0900 m", "-0.0407..0.0894 m forward"],
    );
    let on_the_spot = Route::regular(&Regular { length: 0.0, ..regular() }).unwrap();
    let rearward = |request: &mut Request| {
        request.route = on_the_spot;
        (request.style.ahead, request.style.torso_height) = (-0.043, 0.29);
    };
    contains(reason(rearward), &["t = 0.00 s", "centre of mass is 7.7 mm inside", "forward of the ankles"]);
    contains(reason(|request| request.margin = 0.05), &["the sole allows a margin of 0.0444 m at most"]);
    contains(reason(|request| request.speed_share = 0.01), &["rad/s", "longer --period"]);
    let narrow = Route::regular(&Regular { half_width: 0.035, ..regular() }).unwrap();
    contains(reason(|request| request.route = narrow), &["t = 0.00 s", "feet come within 0.0 mm"]);
    let twisted = Route::regular(&Regular { turn: 4.0, ..regular() }).unwrap();
    contains(reason(|request| request.route = twisted), &["t = "]);
}

#[test]
fn figures_that_mean_nothing_are_refused() {
    for bad in [f64::NAN, f64::INFINITY, -1.0] {
        assert!(reason(|request| request.style.lift = bad).contains("lift"));
        assert!(reason(|request| request.style.amplitude = bad).contains("amplitude"));
        assert!(reason(|request| request.style.torso_height = bad).contains("torso height"));
        assert!(reason(|request| request.durations.swing = bad).contains("swing"));
        assert!(reason(|request| request.durations.shift = bad).contains("shift"));
        assert!(reason(|request| request.durations.rest = bad).contains("rest"));
        assert!(reason(|request| request.margin = bad).contains("margin"));
    }
    assert!(reason(|request| request.style.ahead = f64::NAN).contains("forward distance"));
    for long in [1e7, f64::MAX] {
        assert!(reason(|request| request.durations.rest = long).contains("would last"));
    }
}

#[test]
fn a_hasty_walk_is_slowed_down_until_it_is_stable() {
    let mut hasty = request(&regular());
    hasty.durations.shift = 0.4;
    hasty.durations.swing = 0.2;
    let walk = walk(&hasty).unwrap();
    let summary = Summary::of(&robot().0, &walk);
    assert!(summary.slowed.0 > 0 && summary.slowed.1 > 1.0);
    assert!(summary.margin.value >= hasty.margin && summary.fastest.1.value <= hasty.speed_share);
    assert!(summary.to_string().contains("slowed down"));
}

#[test]
fn the_caller_may_stop_it() {
    let watch = Watch::none().with_cancel(std::sync::Arc::new(true.into()));
    let (humanoid, legs) = robot();
    assert_eq!(plan(humanoid, legs, &request(&regular()), &watch).unwrap_err().kind(), ErrorKind::Cancelled);
}

#[test]
fn figures_of_one_step_goal_that_mean_nothing_are_refused() {
    let one_step = OneStep { laws: Laws::Generic, dip: 0.0, pitch: 0.0, upright: None };
    let with = |one_step: OneStep| reason(|request| request.gait = Gait::OneStep(one_step));
    assert!(with(OneStep { dip: -1.0, ..one_step }).contains("dip"));
    assert!(with(OneStep { pitch: f64::NAN, ..one_step }).contains("pitch"));
    assert!(with(OneStep { upright: Some(0.0), ..one_step }).contains("upright"));
    assert!(with(OneStep { laws: Laws::Rh0 { power: 0.5 }, ..one_step }).contains("power"));
    let wide = |request: &mut Request| {
        request.gait = Gait::OneStep(one_step);
        request.style.amplitude = 0.06;
    };
    assert!(reason(wide).contains("circle of support"));
}
