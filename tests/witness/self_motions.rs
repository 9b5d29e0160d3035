//! Self-motions, each told: those of one branch that no motion joins, those of robots in rounded numbers, and double solutions, which are none.

use groebot::Watch;
use groebot::derive::Proved;
use groebot::derive::sequential::Derived;
use groebot::kinematics::{Chain, Solution};
use groebot::witness::Options;
use groebot::witness::chain::{ByScrews, Check, Solver};

/// The axes of Unitree's Z1: the second, third and fourth are parallel, the others cross them.
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

/// A leg like that of Fourier's GR-2, its hip off by a tenth of a micron: with the knee straight and the ankle's roll at a right angle the
/// third axis and the last are one line, exactly.
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

/// Three axes that turn a hand: the first and the last are nearest to one line, a millionth of a radian off it, with the second at zero.
const WRIST: &str = r#"
name = "wrist"
source = "made for this test"
task = { kind = "rotation" }
tip = { point = [0, 0, 0] }
joint = [
    { name = "first", type = "revolute", axis = [0, 0, 1], point = [0, 0, 0] },
    { name = "second", type = "revolute", axis = [1, 0, 0], point = [0, 0, 0] },
    { name = "third", type = "revolute", axis = [0.000001, 0, 1], point = [0, 0, 0] },
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

/// With the wrist's centre on the axis of the first joint this one is free on two closed curves, a quarter of the circle each and half a turn apart, of the same cases and roots. One
/// has the fifth joint to one side, the other to the other, and by screws there are members of both.
#[test]
fn two_self_motions_of_one_branch_are_both_told() {
    let chain = Chain::from_toml(Z1).unwrap();
    let derived = Derived::of_chain(&chain, &Watch::none()).unwrap();
    let screws = ByScrews::new(&chain).unwrap();
    let target = [
        5.2480934197567421e-2,
        -7.1437848580837640e-2,
        -5.5714520323593408e-1,
        5.2376181833899615e-1,
        -1.7947418330350007e-1,
        8.3274400338745791e-1,
        -7.1295258064708289e-1,
        4.4266879397243347e-1,
        5.4382254145231645e-1,
        -4.6623189015649025e-1,
        -8.7854046939827046e-1,
        1.0389643030717421e-1,
    ];
    let found = derived.program.solver().solve_numbers(&target).unwrap();
    let expected = screws.solve(&target).unwrap();
    let sides = |list: &[Solution]| [1.0, -1.0].map(|side| list.iter().any(|answer| side * answer.q[4] > 0.5));
    assert_eq!(sides(&expected), [true, true], "{expected:?}");
    assert_eq!(sides(&found), [true, true], "{found:?}");
    assert!(found.iter().all(|answer| answer.free == [0] && miss(&pose(&chain, &answer.q), &target) < 1e-13));
}

/// The formulas are those of a leg whose hip axes meet, and lead to single joint vectors of a self-motion that the leg as described has: it is told as one,
/// and not as many isolated answers. (With its hip turned to the other side the leg is too short, by less than a micron.)
#[test]
fn a_self_motion_of_a_robot_in_rounded_numbers_is_told_as_one() {
    use std::f64::consts::FRAC_PI_2;
    let chain = Chain::from_toml(LEG).unwrap();
    let proved = Proved::of_chain(&chain, &Watch::none()).unwrap();
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

/// Where two axes all but coincide there is a double solution, next to which the target is missed by a trillionth of the square of the way: no
/// self-motion, and the check does not ask for one.
#[test]
fn a_double_solution_next_to_a_self_motion_is_none() {
    let chain = Chain::from_toml(WRIST).unwrap();
    let derived = Derived::of_chain(&chain, &Watch::none()).unwrap();
    let options = Options { targets: 96, oracle: 0, exact: 0, seed: 3, ..Options::default() };
    let report = Check::run(&chain, &derived.program, None, &options, &Watch::none()).unwrap();
    let failures: Vec<String> = report.failures().map(|row| format!("{row}; from {:?}", row.joints)).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(report.rows.iter().any(|row| row.is_singular));
}
