//! Arbitrary requests: the result is a walk that fulfils all conditions, or an error with the time and the reason.

use groebot_humanoid::gait::{Durations, Gait, GaitDefaults, Laws, Measures, Regular, Route, Side, Style, plan};
use groebot_humanoid::walkers::{NAO_ONE_STEP, RH0_GENERIC, TEO_ONE_STEP};
use groebot_humanoid::{ErrorKind, Watch};
use nalgebra::Point2;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

use super::nao::feet_are_where_they_should_be;
use super::{request, robot, walk};

/// This number of values of a strategy, equal in every run, so that the number of successful walks can be tested.
fn values<S: Strategy>(strategy: S, count: usize) -> impl Iterator<Item = S::Value> {
    let mut runner = TestRunner::deterministic();
    (0..count).map(move |_| strategy.new_tree(&mut runner).unwrap().current())
}

#[test]
fn a_walk_keeps_its_promises_or_is_refused() {
    let steps = (-0.05..0.07f64, -0.6..0.6f64, any::<bool>());
    let style = (0.0..0.03f64, 0.03..0.07f64, -0.02..0.05f64, 0.27..0.33f64);
    let times = (0.3..1.2f64, 0.25..0.8f64, 0.0..0.025f64, any::<bool>());
    let mut walked = [0; 2];
    for ((length, turn, right), (lift, amplitude, ahead, torso_height), (shift, swing, margin, preview)) in
        values((steps, style, times), 48)
    {
        let (nao, _) = robot();
        let first = if right { Side::Right } else { Side::Left };
        let mut requested = request(&Regular { steps: 4, length, aside: 0.0, turn, half_width: 0.05, first });
        requested.style = Style { lift, amplitude, ahead, torso_height, half_width: 0.05 };
        requested.margin = margin;
        requested.durations = Durations { rest: if preview { 1.5 } else { 0.2 }, shift, swing, lower: None };
        requested.gait = if preview { Gait::Preview } else { Gait::Sine };
        match walk(&requested) {
            Err(error) => {
                assert_eq!(error.kind(), ErrorKind::BadValue);
                assert!(error.message().contains(" (t = "), "{}", error);
            }
            Ok(walk) => {
                walked[usize::from(preview)] += 1;
                feet_are_where_they_should_be(&walk);
                let postures = &walk.motion.postures;
                for (sample, balance) in walk.balances.iter().enumerate() {
                    assert!(balance.margin >= margin && balance.support.signed_distance(&balance.zmp) >= margin);
                    for (joint, range) in nao.joints.iter().enumerate() {
                        let value = postures[sample].q[joint];
                        assert!(range.limits.0 <= value && value <= range.limits.1);
                        let before = postures[sample.saturating_sub(1)].q[joint];
                        assert!((value - before).abs() / 0.01 <= range.speed * requested.speed_share + 1e-12);
                    }
                }
                let Route { steps, .. } = &walk.schedule.route;
                assert_eq!(steps.len(), 4);
            }
        }
    }
    assert!(walked[0] >= 2 && walked[1] >= 5, "{walked:?} of 48");
}

type OneStepCase = ((usize, bool, f64, f64), (f64, f64, f64, f64), (f64, f64, f64, bool));

/// Goals beside the robot: the arc to them would miss, so the walk turns on the spot.
const ONCE_FAILED: [OneStepCase; 2] = [
    ((2, false, 1.0, 0.0), (0.0, -0.13493199218350077, 0.03, 0.0), (0.3, 0.0, 1.0, false)),
    ((0, false, 1.0, 0.0), (0.0, 0.02898547189591927, 0.04, 0.0), (0.3, 0.0, 2.869413256592946, false)),
];

/// The test for walks by one step goal, for all robots that have them, with both versions of its laws.
#[test]
fn one_step_goal_keeps_its_promises_or_is_refused() {
    let laws = (0usize..3, any::<bool>(), 1.0..5.0f64, 0.0..0.01f64);
    let steps = (-0.05..0.1f64, -0.08..0.08f64, 0.04..0.2f64, 0.0..0.1f64);
    let style = (0.3..1.0f64, 0.0..0.06f64, 2.0..5.0f64, any::<bool>());
    let mut walked = 0;
    for ((robot, rh0_laws, power, dip), (x, y, length, lift), (share, lower, period, crouched)) in
        ONCE_FAILED.into_iter().chain(values((laws, steps, style), 12))
    {
        let (walker, defaults) = [("nao", NAO_ONE_STEP), ("rh0", RH0_GENERIC), ("teo", TEO_ONE_STEP)][robot].clone();
        let (humanoid, legs) = super::built(walker);
        let Gait::OneStep(mut one_step) = defaults.gait else { unreachable!("one step goal") };
        one_step.dip = dip;
        if rh0_laws {
            one_step.laws = Laws::Rh0 { power };
        }
        let amplitude = share * defaults.amplitude;
        let requested =
            GaitDefaults { gait: Gait::OneStep(one_step), length, lift, amplitude, period, ..defaults.clone() };
        let requested = if crouched { requested } else { requested.from_upright(&humanoid) };
        let measures = Measures { length, half_width: humanoid.half_width(), most_turn: defaults.most_turn };
        let route = Route::towards(&Point2::new(x, y), None, Side::Right, &measures).unwrap();
        let request = requested.request(&humanoid, route, defaults.hip_heights[0] - lower);
        match plan(&humanoid, &legs, &request, &Watch::none()) {
            Err(error) => {
                assert_eq!(error.kind(), ErrorKind::BadValue);
                assert!(error.message().contains(" (t = "), "{}", error);
            }
            Ok(walk) => {
                walked += 1;
                super::one_step::feet_are_on_their_prints(&humanoid, &walk);
                for (sample, balance) in walk.balances.iter().enumerate() {
                    assert!(balance.margin >= defaults.margin);
                    let (q, before) =
                        (&walk.motion.postures[sample].q, &walk.motion.postures[sample.saturating_sub(1)].q);
                    for (joint, range) in humanoid.joints.iter().enumerate() {
                        assert!(range.limits.0 <= q[joint] && q[joint] <= range.limits.1);
                        let most = range.speed * defaults.speed_share * defaults.tick;
                        assert!((q[joint] - before[joint]).abs() <= most + 1e-12);
                    }
                }
            }
        }
    }
    assert!(walked >= 2, "{walked} of 14");
}
