//! Singular poses: wrist straight, arm stretched, wrist above the shoulder; exactly, and near.

use groebot::derive::lift::Derived;
use groebot::kinematics::Chain;
use groebot::robots;

use super::{Random, derive, distance, miss};

/// The answers at the pose of `q`: all reach it, and one is `q` up to free joints that go along with one another.
fn answers(derived: &Derived, chain: &Chain, q: &[f64]) -> Vec<groebot::solver::Solution> {
    let target = derived.reached(q).unwrap();
    let answers = derived.program.solve(&target).unwrap();
    for answer in &answers {
        assert!(miss(derived, &target, answer) <= 1e-12, "{} {q:?}: {answer:?}", chain.name());
    }
    answers
}

/// Joint 5 of these arms at zero makes axes 4 and 6 one line: joint 4 or joint 6 is free and the other goes along.
#[test]
fn a_straight_wrist_leaves_a_joint_free() {
    let mut random = Random(3);
    for (name, wrist) in [("irb120", 4), ("nao_left_leg", 1), ("stanford", 4)] {
        let chain = robots::by_name(name).unwrap();
        let derived = derive(&chain);
        for _ in 0..20 {
            let mut q = random.joints(&chain);
            q[wrist] = 0.0;
            let found = answers(&derived, &chain, &q);
            println!("{name} {q:?}\n{found:?}");
        }
    }
}

/// The elbow straight: two answers become one, and none is lost by rounding.
#[test]
fn a_stretched_arm_keeps_its_answer() {
    let mut random = Random(5);
    for (name, elbow) in [("puma", 2), ("irb120", 2), ("rh0_right_leg", 3), ("nao_left_leg", 3), ("ur5", 2)] {
        let chain = robots::by_name(name).unwrap();
        let derived = derive(&chain);
        for bend in [0.0, 1e-9, 1e-6, 1e-3] {
            let mut lost = 0;
            for _ in 0..20 {
                let mut q = random.joints(&chain);
                q[elbow] = bend;
                let found = answers(&derived, &chain, &q);
                // A root of a square is uncertain by the square root of rounding.
                let nearest = found.iter().map(|a| distance(&chain, &a.q, &q, &a.free)).fold(9.0, f64::min);
                if nearest > 1e-6 {
                    lost += 1;
                    println!("{name} {bend} {q:?} nearest {nearest:e}\n{found:?}");
                }
            }
            assert_eq!(lost, 0, "{name} {bend}");
        }
    }
}
