//! Self-motions are each reported: disconnected ones of one branch, and those of robots with rounded numbers.

use groebot_ik::Watch;
use groebot_ik::derive::Derivation;
use groebot_ik::witness::{ByScrews, Solver};
use groebot_robot::kinematics::{Chain, Solution};

/// The axes of Unitree's Z1. The second, third and fourth are parallel; the others are perpendicular to them.
const Z1: &str = r#"
name = "z1"
source = "z1_description of Unitree Robotics, in example-robot-data"
task = { kind = "pose" }
tip = { point = [0.0382, 0, 0.1605] }
joint = [
    { name = "joint1", type = "revolute", axis = [0, 0, 1], point = [0, 0, 0.0585] },
    { name = "joint2", type = "revolute", axis = [0, 1, 0], point = [0, 0, 0.1035] },
    { name = "joint3", type = "revolute", axis = [0, 1, 0], point = [-0.35, 0, 0.1035] },
    { name = "joint4", type = "revolute", axis = [0, 1, 0], point = [-0.132, 0, 0.1605] },
    { name = "joint5", type = "revolute", axis = [0, 0, 1], point = [-0.062, 0, 0.1605] },
    { name = "joint6", type = "revolute", axis = [1, 0, 0], point = [-0.0128, 0, 0.1605] },
]
"#;

/// A leg similar to that of Fourier's GR-2, with an error of 0.1 micrometres in its hip. With the knee straight and the ankle's roll at a right angle, the
/// third axis and the last are exactly one line.
const LEG: &str = r#"
name = "leg"
source = "made for this test after the leg of Fourier's GR-2"
task = { kind = "pose" }
tip = { point = [0, 0.14, -0.944] }
joint = [
    { name = "pitch", type = "revolute", axis = [0, 1, 0], point = [0, 0.05513, -0.1600001] },
    { name = "roll", type = "revolute", axis = [1, 0, 0], point = [-0.0855, 0.14, -0.16] },
    { name = "yaw", type = "revolute", axis = [0, 0, 1], point = [0, 0.14, -0.16] },
    { name = "knee", type = "revolute", axis = [0, 1, 0], point = [0, 0.14, -0.538] },
    { name = "ankle_roll", type = "revolute", axis = [1, 0, 0], point = [0, 0.14, -0.944] },
    { name = "ankle_pitch", type = "revolute", axis = [0, 1, 0], point = [0, 0.14, -0.944] },
]
"#;

/// Forward kinematics: position, then rotation by rows.
fn pose(chain: &Chain, q: &[f64]) -> Vec<f64> {
    let pose = chain.forward(q).unwrap();
    let matrix = pose.rotation.to_rotation_matrix();
    let rotation = (0..9).map(|k| matrix[(k / 3, k % 3)]);
    pose.translation.vector.iter().copied().chain(rotation).collect()
}

fn miss(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// With the wrist centre on the axis of the first joint, this joint is free on two closed curves. Each covers a quarter of the circle, and they are pi apart,
/// with equal cases and roots. They have the fifth joint on different sides, and screw theory finds members of both.
#[test]
fn two_self_motions_of_one_branch_are_both_reported() {
    let chain = Chain::from_toml(Z1).unwrap();
    let derived = Derivation::sequentially(&chain, &Watch::none()).unwrap();
    let screws = ByScrews::new(&chain).unwrap();
    let target = [
        0.05248093419756742,
        -0.07143784858083764,
        -0.5571452032359341,
        0.5237618183389962,
        -0.17947418330350007,
        0.8327440033874579,
        -0.7129525806470829,
        0.44266879397243347,
        0.5438225414523165,
        -0.46623189015649025,
        -0.8785404693982705,
        0.10389643030717421,
    ];
    let found = derived.program().solver().solve_numbers(&target).unwrap();
    let expected = screws.solve(&target).unwrap();
    let sides = |list: &[Solution]| [1.0, -1.0].map(|side| list.iter().any(|answer| side * answer.q[4] > 0.5));
    assert_eq!(sides(&expected), [true, true], "{expected:?}");
    assert_eq!(sides(&found), [true, true], "{found:?}");
    assert!(found.iter().all(|answer| answer.free == [0] && miss(&pose(&chain, &answer.q), &target) < 1e-13));
}

/// The formulas are those of a leg whose hip axes meet. They give single joint vectors of a self-motion of the described leg, which is reported as one
/// self-motion instead of many isolated solutions. (With its hip rotated to the other side, the leg is too short by less than a micrometre.)
#[test]
fn a_self_motion_of_a_robot_in_rounded_numbers_is_reported_as_one() {
    use std::f64::consts::FRAC_PI_2;
    let chain = Chain::from_toml(LEG).unwrap();
    let proved = groebot_ik::derive(&chain).unwrap();
    assert!(proved.program().nearby, "the answers of the ideal leg are polished");
    let solver = proved.program().solver();
    for (q, side) in
        [([-0.92, 0.73, 0.31, 0.0, -FRAC_PI_2, -1.44], 1.0), ([-2.26, -1.13, -1.91, 0.0, FRAC_PI_2, 1.03], -1.0)]
    {
        let target = pose(&chain, &q);
        let moved = |by: f64| [q[0], q[1], q[2] + by, q[3], q[4], q[5] + side * by];
        for by in [0.4, 1.9, -2.5] {
            assert!(miss(&pose(&chain, &moved(by)), &target) < 1e-14, "{q:?} is of a self-motion");
        }
        let found = solver.solve_numbers(&target).unwrap();
        assert_eq!(found.len(), 1, "{q:?}: {found:?}");
        assert!(found.iter().all(|answer| answer.free == [5]), "{q:?}: {found:?}");
        assert!(found.iter().all(|answer| miss(&pose(&chain, &answer.q), &target) < 1e-13), "{q:?}: {found:?}");
        assert!(miss(&found[0].q[..2], &q[..2]) < 1e-6, "{q:?}: {found:?}");
    }
}
