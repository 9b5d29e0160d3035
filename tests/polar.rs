//! The polar robot of RH0 2.7: exponentials and Denavit-Hartenberg parameters give the same robot, but (2-66) gives one solution of four.

use std::f64::consts::{FRAC_PI_2, PI};

use groebot::robots;
use groebot::spatial::angle;
use nalgebra::Vector3;
use proptest::prelude::*;

#[path = "../benches/polar/denavit_hartenberg.rs"]
mod denavit_hartenberg;
#[path = "../benches/polar/exponentials.rs"]
mod exponentials;

use denavit_hartenberg::LENGTH;
use exponentials::Polar;

/// Joint values of an arm of the length `length`, which is LENGTH when its prismatic joint is at zero.
fn joints(length: std::ops::Range<f64>) -> impl Strategy<Value = [f64; 3]> {
    (-PI..PI, -PI..PI, length).prop_map(|(yaw, pitch, length)| [yaw, pitch, length - LENGTH])
}

fn tool(q: &[f64; 3]) -> Vector3<f64> {
    robots::polar().forward(q).unwrap().translation.vector
}

/// The four solutions for one position: with the arm over the top, and with the arm drawn through to the other side.
fn all_four([yaw, pitch, slide]: [f64; 3]) -> [[f64; 3]; 4] {
    let through = -slide - 2.0 * LENGTH;
    [[yaw, pitch, slide], [yaw + PI, PI - pitch, slide], [yaw + PI, -pitch, through], [yaw, pitch + PI, through]]
}

fn same(a: &[f64; 3], b: &[f64; 3]) -> bool {
    let turned = (0..2).all(|i| angle::difference(a[i], b[i]).abs() < 1e-7);
    turned && (a[2] - b[2]).abs() < 1e-9
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn both_formulations_are_one_robot(q in joints(-1.0..1.0)) {
        let by_table = denavit_hartenberg::forward(&q);
        let by_exponentials = Polar::new().forward(&q).to_homogeneous();
        prop_assert!((by_table - by_exponentials).norm() < 1e-14);
        prop_assert!((denavit_hartenberg::forward_by_hand(&q) - by_exponentials).norm() < 1e-14);
    }

    #[test]
    fn the_jacobian_of_derivatives_is_the_jacobian_of_twists(q in joints(-1.0..1.0)) {
        let (derivatives, twists) = (denavit_hartenberg::jacobian(&q), Polar::new().jacobian(&q));
        for j in 0..3 {
            let (v, w) = (twists.fixed_view::<3, 1>(0, j), twists.fixed_view::<3, 1>(3, j));
            let velocity = v + w.cross(&tool(&q));
            prop_assert!((velocity - derivatives.fixed_view::<3, 1>(0, j)).norm() < 1e-14);
            prop_assert!((w - derivatives.fixed_view::<3, 1>(3, j)).norm() < 1e-14);
        }
    }

    #[test]
    fn the_jacobian_is_the_limit_of_differences(q in joints(-1.0..1.0), j in 0usize..3) {
        let step = 1e-6;
        let (mut ahead, mut after) = (q, q);
        ahead[j] += step;
        after[j] -= step;
        let slope = (tool(&ahead) - tool(&after)) / (2.0 * step);
        prop_assert!((slope - denavit_hartenberg::jacobian(&q).fixed_view::<3, 1>(0, j)).norm() < 1e-8);
    }

    #[test]
    fn the_printed_pitch_is_a_quarter_turn_too_large(q in joints(0.1..1.0)) {
        let printed = denavit_hartenberg::inverse_as_printed(&denavit_hartenberg::forward(&q));
        prop_assert!((tool(&printed) - tool(&q)).norm() > 0.1, "{printed:?}");
        let repaired = [printed[0], printed[1] - FRAC_PI_2, printed[2]];
        prop_assert!((tool(&repaired) - tool(&q)).norm() < 1e-14);
    }

    #[test]
    fn three_solutions_of_four_are_lost(q in joints(0.1..1.0)) {
        prop_assume!(q[1].cos().abs() > 1e-3);
        let given = denavit_hartenberg::inverse(&denavit_hartenberg::forward(&q));
        let all = all_four(q);
        for solution in &all {
            prop_assert!((tool(solution) - tool(&q)).norm() < 1e-14, "{solution:?} is a solution");
        }
        let found: Vec<bool> = all.iter().map(|solution| same(solution, &given)).collect();
        let ahead = q[1].cos() > 0.0;
        prop_assert_eq!(found, [ahead, !ahead, false, false]);
    }

    #[test]
    fn screws_give_all_four(q in joints(0.1..1.0)) {
        prop_assume!(q[1].cos().abs() > 1e-3);
        let given = Polar::new().inverse(&tool(&q).into());
        prop_assert_eq!(given.len(), 4);
        for solution in all_four(q) {
            prop_assert!(given.iter().any(|given| same(given, &solution)), "{:?} is not among {:?}", solution, given);
        }
    }
}

/// Numeric example: the tool is 0.4 m in front of the intersection of the axes and 0.3 m above it, and the arm is 0.5 m
/// long.
#[test]
fn a_robot_that_looks_back_is_not_found() {
    let after = [PI, PI - 0.6_f64.asin(), 0.3];
    assert!((tool(&after) - Vector3::new(0.4, 0.66 + 0.3, 0.0)).norm() < 1e-15);
    let given = denavit_hartenberg::inverse(&denavit_hartenberg::forward(&after));
    assert!(same(&given, &[0.0, 0.6_f64.asin(), 0.3]) && !same(&given, &after));
}
