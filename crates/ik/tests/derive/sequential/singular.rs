//! Singular poses, exact and near: wrist straight, arm stretched, wrist above the shoulder.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use groebot_ik::derive::Derivation;
use groebot_robot::kinematics::{Chain, Solution};
use groebot_robot::robots;

use super::{Random, derive, distance, miss};

fn derived(name: &str) -> Derivation {
    derive(&robots::by_name(name).unwrap())
}

/// The chain that is solved.
fn chain_of(derived: &Derivation) -> &Chain {
    derived.sequential().unwrap().problem.measured()
}

/// The solutions at the pose of `q`. Checks that all of them reach it.
fn answers(derived: &Derivation, q: &[f64]) -> Vec<Solution> {
    let target = derived.reached(q).unwrap();
    let answers = derived.program().solve_numbers(&target).unwrap();
    for answer in &answers {
        assert!(miss(derived, &target, answer) <= 1e-12, "{q:?}: {answer:?}");
    }
    answers
}

/// The robot, the joint that aligns two axes at this angle, and the joints of these axes.
const WRISTS: [(&str, usize, f64, [usize; 2]); 5] = [
    ("puma", 4, FRAC_PI_2, [3, 5]),
    ("irb120", 4, FRAC_PI_2, [3, 5]),
    ("irb120", 4, -FRAC_PI_2, [3, 5]),
    ("nao_left_leg", 1, -FRAC_PI_4, [0, 2]),
    ("nao_right_leg", 1, FRAC_PI_4, [0, 2]),
];

#[test]
fn a_straight_wrist_leaves_one_joint_free_and_says_which() {
    for (name, joint, angle, pair) in WRISTS {
        let derived = derived(name);
        let mut random = Random(3);
        for _ in 0..25 {
            let mut q = random.joints(chain_of(&derived));
            q[joint] = angle;
            let found = answers(&derived, &q);
            let same = |a: &&Solution| distance(chain_of(&derived), &a.q, &q, &pair) < 1e-6;
            let self_motion: Vec<&Solution> = found.iter().filter(same).collect();
            assert_eq!(self_motion.len(), 1, "{name} {q:?}: {found:?}");
            let free = &self_motion[0].free;
            assert!(free.len() == 1 && pair.contains(&free[0]), "{name} {q:?}: {found:?}");
        }
    }
}

#[test]
fn nothing_is_lost_near_a_straight_wrist() {
    for (name, joint, angle, pair) in WRISTS {
        let derived = derived(name);
        let mut random = Random(4);
        for k in 1..=15 {
            let mut q = random.joints(chain_of(&derived));
            q[joint] = angle + 10f64.powi(-k);
            let found = answers(&derived, &q);
            // sigma is about 10^-k. The joints of the pair have an error of rounding over sigma.
            let ignored = if k > 6 { pair.to_vec() } else { Vec::new() };
            let nearest = found.iter().map(|a| distance(chain_of(&derived), &a.q, &q, &ignored)).fold(9.0, f64::min);
            assert!(nearest < 1e-7, "{name} 1e-{k} {q:?} {nearest:e}: {found:?}");
            let called = found.iter().filter(|a| !a.free.is_empty()).count();
            assert!(k > 10 || called == 0, "{name} 1e-{k}: no joint is free here: {found:?}");
        }
    }
}

/// With a straight elbow, two solutions become one. It is not lost by rounding.
#[test]
fn a_stretched_arm_keeps_its_answer() {
    for (name, elbow) in [("puma", 2), ("irb120", 2), ("rh0_right_leg", 3), ("nao_left_leg", 3), ("ur5", 2)] {
        let derived = derived(name);
        let mut random = Random(5);
        for bend in [0.0, 1e-12, 1e-9, 1e-6, 1e-3] {
            for _ in 0..20 {
                let mut q = random.joints(chain_of(&derived));
                q[elbow] = bend;
                let found = answers(&derived, &q);
                // A double root has an error of the square root of rounding.
                let nearest = found.iter().map(|a| distance(chain_of(&derived), &a.q, &q, &a.free)).fold(9.0, f64::min);
                assert!(nearest < 1e-6, "{name} {bend} {q:?} {nearest:e}: {found:?}");
            }
        }
    }
}

/// PUMA's wrist is on the axis of its first joint, which does not move it.
#[test]
fn the_wrist_above_the_shoulder_leaves_the_shoulder_free() {
    let derived = derived("puma");
    let mut random = Random(6);
    for _ in 0..25 {
        let mut q = random.joints(chain_of(&derived));
        // Both links are 0.432 m: RH0 A.2.
        q[2] = -2.0 * q[1];
        let found = answers(&derived, &q);
        let ignored = [0, 3, 4, 5];
        let self_motion = found.iter().filter(|a| distance(chain_of(&derived), &a.q, &q, &ignored) < 1e-6);
        assert!(self_motion.clone().count() >= 1, "{q:?}: {found:?}");
        assert!(self_motion.into_iter().all(|a| a.free == [0]), "{q:?}: {found:?}");
    }
}

/// NAO's arm is singular where the elbow is on the axis of ShoulderPitch (ShoulderRoll 1.4289 left, 1.7127 right, from atan(105/15)) and where the elbow is
/// straight. Near these poses all coefficients of the quartic are small.
#[test]
fn rays_of_nao_next_to_singular_ones_keep_the_joints_that_made_them() {
    let on_axis = (105.0f64 / 15.0).atan();
    let opposite = PI - on_axis;
    let poses = [
        ("nao_right_arm", [1.74858, 1.71059, -0.34923, 0.49150, -1.59690], 1e-9),
        ("nao_right_arm", [1.74858, opposite + 1e-6, -0.34923, 0.49150, -1.59690], 1e-6),
        ("nao_left_arm", [-0.17942, on_axis + 1e-3, 2.82315, -1.47571, -1.69547], 1e-9),
        ("nao_left_arm", [-0.17942, on_axis + 1e-6, 2.82315, -1.47571, -1.69547], 1e-6),
        ("nao_left_arm", [-0.17942, on_axis + 1e-9, 2.82315, -1.47571, -1.69547], 1e-3),
        ("nao_right_arm", [-1.28566, 1.24801, -0.61828, -1e-9, 2.83514], 1e-4),
    ];
    for (name, q, tolerance) in poses {
        let derived = derived(name);
        let found = answers(&derived, &q);
        // The joints have an error of the target's rounding, 1e-16, over the distance to the singular pose.
        let nearest = found.iter().map(|a| distance(chain_of(&derived), &a.q, &q, &a.free)).fold(9.0, f64::min);
        assert!(nearest < tolerance, "{name} {q:?} {nearest:e}: {found:?}");
        assert!(found.len() <= derived.dimension().unwrap(), "{name} {q:?}: {found:?}");
    }
}
