//! Whatever is asked for: a walk that keeps what it promises, or a refusal that says when and why.

use groebot::ErrorKind;
use groebot::gait::{Durations, Gait, Regular, Route, Side, Style};
use proptest::prelude::*;

use super::nao::feet_are_where_they_should_be;
use super::{request, robot, walk};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn a_walk_keeps_its_promises_or_is_refused(
        (length, turn, right) in (-0.05..0.07f64, -0.6..0.6f64, any::<bool>()),
        (lift, amplitude, ahead, torso_height) in (0.0..0.03f64, 0.03..0.07f64, -0.02..0.05f64, 0.27..0.33f64),
        (shift, swing, margin, preview) in (0.3..1.2f64, 0.25..0.8f64, 0.0..0.025f64, any::<bool>()),
    ) {
        let (nao, _) = robot();
        let first = if right { Side::Right } else { Side::Left };
        let mut asked = request(&Regular { steps: 4, length, aside: 0.0, turn, half_width: 0.05, first });
        asked.style = Style { lift, amplitude, ahead, torso_height, half_width: 0.05 };
        asked.margin = margin;
        asked.durations = Durations { rest: if preview { 1.5 } else { 0.2 }, shift, swing };
        asked.gait = if preview { Gait::Preview } else { Gait::Seed };
        match walk(&asked) {
            Err(error) => {
                prop_assert_eq!(error.kind(), ErrorKind::BadValue);
                prop_assert!(error.message().starts_with("t = "), "{}", error);
            }
            Ok(walk) => {
                feet_are_where_they_should_be(&walk);
                let postures = &walk.motion.postures;
                for (sample, balance) in walk.balances.iter().enumerate() {
                    prop_assert!(balance.margin >= margin && balance.support.signed_distance(&balance.zmp) >= margin);
                    for (joint, range) in nao.joints.iter().enumerate() {
                        let value = postures[sample].q[joint];
                        prop_assert!(range.limits.0 <= value && value <= range.limits.1);
                        let before = postures[sample.saturating_sub(1)].q[joint];
                        prop_assert!((value - before).abs() / 0.01 <= range.speed * asked.speed_share + 1e-12);
                    }
                }
                let Route { steps, .. } = &walk.schedule.route;
                prop_assert_eq!(steps.len(), 4);
            }
        }
    }
}
