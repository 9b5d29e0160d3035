//! Long walks: their phases are as slow as those of short walks, and no slower than necessary; equal steps are tried once.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

use groebot_humanoid::Watch;
use groebot_humanoid::gait::{Action, Durations, Gait, Laws, OneStep, Regular, Request, Walk, plan};

use super::{regular, request, robot, walk};

/// NAO in steps that are too fast at first.
fn hasty(steps: usize) -> Request {
    let mut hasty = request(&Regular { steps, ..regular() });
    hasty.durations = Durations { shift: 0.4, swing: 0.2, ..hasty.durations };
    hasty
}

/// The factors of a step's shift and swing.
fn factors(walk: &Walk, step: usize) -> Vec<f64> {
    let is_own = |action: Action| matches!(action, Action::Shift(own) | Action::Swing(own) if own == step);
    walk.schedule.phases.iter().filter(|phase| is_own(phase.action)).map(|phase| phase.slowed).collect()
}

#[test]
fn phases_of_long_walks_are_as_slow_as_those_of_short_ones() {
    let [short, long] = [6, 30].map(|steps| walk(&hasty(steps)).unwrap());
    for step in 0..4 {
        assert!(factors(&short, step).iter().any(|factor| *factor > 1.0), "step {step} is slowed down");
        assert_eq!(factors(&short, step), factors(&long, step), "step {step}");
    }
    for step in 4..28 {
        assert_eq!(factors(&long, step), factors(&long, 2 + step % 2), "step {step}");
    }
    assert_eq!(factors(&short, 5), factors(&long, 29), "the last step");
}

#[test]
fn phases_are_no_slower_than_necessary() {
    let mut requested = hasty(6);
    let walked = walk(&requested).unwrap();
    let greatest = walked.schedule.phases.iter().map(|phase| phase.slowed).fold(1.0, f64::max);
    assert!(greatest > 1.15 * 1.15, "{greatest}");
    // All phases are longer by one factor; none may be slowed down further.
    requested.slowest = 1.0;
    let Durations { shift, swing, .. } = requested.durations;
    for (factor, is_walked) in [(greatest, true), (greatest / 1.15, false)] {
        requested.durations = Durations { shift: factor * shift, swing: factor * swing, ..requested.durations };
        assert_eq!(walk(&requested).is_ok(), is_walked, "{factor}");
    }
}

/// The number of times that planning checks its watch: once for 64 samples that are solved.
fn checks(request: &Request) -> (usize, Walk) {
    let (biped, legs) = robot();
    let left = Arc::new(AtomicUsize::new(usize::MAX));
    let walk = plan(biped, legs, request, &Watch::none().with_patience(Arc::clone(&left))).unwrap();
    (usize::MAX - left.load(Ordering::Relaxed), walk)
}

#[test]
fn a_long_walk_is_solved_less_than_twice() {
    let one_step = Gait::OneStep(OneStep { laws: Laws::Generic, dip: 0.001, pitch: 0.0, upright: None });
    for gait in [Gait::Sine, one_step] {
        let mut requested = hasty(100);
        requested.gait = gait;
        requested.style.amplitude = if gait == Gait::Sine { 0.05 } else { 0.04 };
        let (checks, walk) = checks(&requested);
        assert!(walk.schedule.phases.iter().any(|phase| phase.slowed > 1.3));
        let samples = walk.references.len();
        assert!(checks < 2 * samples / 64, "{checks} checks for {samples} samples");
    }
}

#[test]
fn progress_is_reported() {
    let (biped, legs) = robot();
    let reported = Arc::new(Mutex::new(Vec::new()));
    let own = Arc::clone(&reported);
    let watch = Watch::none().with_listener(move |progress| own.lock().unwrap().push((progress.done, progress.open)));
    let walk = plan(biped, legs, &request(&Regular { steps: 20, ..regular() }), &watch).unwrap();
    let reported = reported.lock().unwrap();
    let samples = walk.references.len();
    let of_walk = reported.iter().filter(|(done, open)| done + open == samples).count();
    assert!(of_walk >= samples / 64, "{of_walk} reports of {samples} samples");
}

#[test]
fn equal_steps_elsewhere_and_in_other_directions_are_equal() {
    // The steps of a circle: no two of them have the same heading.
    let mut turning = request(&Regular { steps: 30, length: 0.02, turn: 2.0, ..regular() });
    turning.durations = Durations { shift: 0.5, swing: 0.3, ..turning.durations };
    let walked = walk(&turning).unwrap();
    for step in 3..27 {
        assert_eq!(factors(&walked, step), factors(&walked, 3 + (step + 1) % 2), "step {step}");
    }
}
