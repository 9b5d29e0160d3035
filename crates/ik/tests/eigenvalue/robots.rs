//! Chains that no sequence of blocks solves: wrists and legs with offsets, a calibrated arm.

use groebot_ik::Watch;
use groebot_ik::derive::eigenvalue;
use groebot_ik::witness::chain::check_chain;
use groebot_ik::witness::{Kind, Options};
use groebot_robot::kinematics::Chain;

use super::{Axes, Random, chain, nearest, rational, residual};

const X: [i64; 3] = [1_000_000, 0, 0];
const Y: [i64; 3] = [0, 1_000_000, 0];
const Z: [i64; 3] = [0, 0, 1_000_000];

/// An arm with an offset of 150 mm in its wrist, like FANUC's CRX-10iA/L (A. Abbes and G. Poisson, Robotics 13 (2024) 91).
pub const OFFSET_WRIST: Axes = [
    (Z, [0, 0, 0]),
    (Y, [0, 0, 0]),
    (Y, [0, 0, 5400]),
    (X, [0, 0, 5400]),
    (Y, [5400, 0, 5400]),
    (X, [5400, -1500, 5400]),
];

/// A wrist whose last axis has an offset of 76 mm, as in UFACTORY's xArm6.
pub const SIDE_WRIST: Axes = [
    (Z, [0, 0, 2670]),
    (Y, [0, 0, 2670]),
    (Y, [530, 0, 5515]),
    (Z, [1305, 0, 5515]),
    (Y, [1305, 0, 2090]),
    (Z, [2065, 0, 2090]),
];

/// A wrist whose axes have angles of 55 degrees and do not meet in a point, as in Kinova's Jaco 2.
const SLANTED_WRIST: Axes = [
    (Z, [0, 0, 2755]),
    (Y, [0, 0, 2755]),
    (Y, [0, 0, 6855]),
    (Z, [0, 98, 6855]),
    ([0, 819_152, -573_576], [0, 98, 9346]),
    ([0, 939_693, 342_020], [0, 796, 8861]),
];

/// A leg whose hip axes and ankle axes do not meet, similar to Booster's K1 and T1.
pub const OFFSET_LEG: Axes = [
    (Y, [0, 0, 0]),
    (X, [0, 0, -200]),
    (Z, [0, 0, -810]),
    (Y, [-140, 0, -2150]),
    (Y, [-140, 0, -4950]),
    (X, [-140, 0, -5070]),
];

/// A UR5 with errors in every axis, up to a thousandth of a radian and half a millimetre.
const CALIBRATED: Axes = [
    ([312, -541, 999_999], [1, -3, 0]),
    ([-713, 999_999, 254], [4, 0, 894]),
    ([422, 999_999, -631], [4252, -2, 888]),
    ([-275, 999_999, 816], [8169, 5, 895]),
    ([651, -333, -999_999], [8175, 1089, 3]),
    ([87, 999_999, -478], [8170, 2, -57]),
];

pub fn robot(axes: &Axes) -> Chain {
    let exact: Vec<_> = axes
        .iter()
        .map(|(axis, point)| (axis.map(|entry| rational(entry, 1_000_000)), point.map(|entry| rational(entry, 10_000))))
        .collect();
    chain(&exact)
}

fn misses(axes: &Axes, targets: usize) -> (usize, f64) {
    let solver = eigenvalue::solver(&robot(axes)).unwrap();
    let mut random = Random::new(14);
    let (mut misses, mut worst) = (0, 0.0_f64);
    for _ in 0..targets {
        let q = random.angles();
        let target = solver.forward(&q);
        let answers = solver.solve(&target);
        worst = worst.max(residual(&solver, &answers, &target));
        if nearest(&answers, &q) > 1e-6 {
            misses += 1;
            println!("missed: {q:?}");
        }
    }
    (misses, worst)
}

const ROBOTS: [(&str, &Axes); 5] = [
    ("offset wrist", &OFFSET_WRIST),
    ("side wrist", &SIDE_WRIST),
    ("slanted wrist", &SLANTED_WRIST),
    ("offset leg", &OFFSET_LEG),
    ("calibrated", &CALIBRATED),
];

#[test]
fn robots_without_blocks_are_solved() {
    for (name, axes) in ROBOTS {
        let (misses, worst) = misses(axes, 2000);
        assert!(misses == 0 && worst <= 1e-12, "{name}: {misses} misses, residual {worst:e}");
    }
}

/// Run by `cargo test --release hundred_thousand -- --ignored --nocapture`.
#[test]
#[ignore = "a hundred thousand targets of each robot"]
fn a_hundred_thousand_targets_of_each_robot() {
    for (name, axes) in ROBOTS {
        let (misses, worst) = misses(axes, 100_000);
        println!("{name}: {misses} misses in 100000, worst residual {worst:e}");
        assert!(misses <= 1 && worst <= 1e-12, "{name}");
    }
}

/// A described arm whose y axes are off by 3.7e-6 rad, because pi/2 is rounded to 1.5708. At its singular targets the ideal robot has two complex or two real
/// solutions, where the arm has one. The joint values that made each target are found.
#[test]
fn singular_targets_of_an_arm_in_rounded_numbers() {
    let rounded = OFFSET_WRIST.map(|(axis, point)| (if axis == Y { [0, 1_000_000, 4] } else { axis }, point));
    let described = robot(&rounded);
    let proved = groebot_ik::derive(&described).unwrap();
    assert!(proved.eigenvalue().is_some_and(|view| view.problem.truth.is_some()));
    let options = Options { targets: 72, oracle: 0, exact: 0, seed: 5, ..Options::default() };
    let report = check_chain(&described, proved.program(), None, &options, &Watch::none()).unwrap();
    let singular = |kind: &Kind| matches!(kind, Kind::Singular | Kind::Near(_));
    assert!(report.rows.iter().filter(|row| singular(&row.kind)).count() >= 20);
    let failures: Vec<String> = report.failures().map(|row| row.to_string()).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
