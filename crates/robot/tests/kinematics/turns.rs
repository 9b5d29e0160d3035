//! Joint values moved into limits by as few whole turns as possible.

use std::f64::consts::{PI, TAU};

use groebot_robot::kinematics::Placed;
use proptest::prelude::*;

#[test]
fn an_angle_is_turned_only_where_that_brings_it_within_its_limits() {
    let placed = |angle: f64, low: f64, high: f64| {
        let placed = Placed::turned(angle, Some((low, high)));
        (((placed.value - angle) / TAU).round(), placed.is_within)
    };
    assert_eq!(placed(-1.283, 0.39, 6.2), (1.0, true));
    assert_eq!(placed(0.2, 0.39, 6.2), (0.0, false), "0.2 and 6.48 are both outside");
    assert_eq!(placed(1.0, -6.2, 6.2), (0.0, true), "one of two places within limits");
    assert_eq!(placed(3.0, -4.0, -3.0), (-1.0, true));
    assert_eq!(placed(-PI, PI, 4.0), (1.0, true), "at the limit");
    assert_eq!(placed(2.0, 20.0, 25.0), (3.0, true));
    assert_eq!(Placed::turned(2.0, None), Placed { value: 2.0, is_within: true });
    assert_eq!(Placed::fixed(-1.283, Some((0.39, 6.2))), Placed { value: -1.283, is_within: false });
}

proptest! {
    #![proptest_config(crate::cases(500))]

    /// Compared with all relevant numbers of turns: within limits exactly where one of them is, then by one of the
    /// smallest numbers of turns.
    #[test]
    fn the_fewest_turns_are_taken(angle in -PI..PI, low in -20.0f64..20.0, span in 0.0f64..9.0) {
        let limits = (low, low + span);
        let inside = |turns: &i32| (limits.0..=limits.1).contains(&(angle + f64::from(*turns) * TAU));
        let fewest = (-5..=5).filter(inside).map(i32::abs).min();
        let placed = Placed::turned(angle, Some(limits));
        prop_assert_eq!(placed.is_within, fewest.is_some());
        let turns = (placed.value - angle) / TAU;
        prop_assert!((turns.abs() - f64::from(fewest.unwrap_or(0))).abs() < 1e-12, "{}", turns);
    }
}
