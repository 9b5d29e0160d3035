//! All solutions, for a comparison of two run times.

use groebot_runtime::{Solution, Solve};

use crate::counts::{answers, sets_of};
use crate::path::Chain;

pub fn print<M: Solve>(name: &str, mechanism: &M, joints: &[&str], poses: usize) {
    let mut out = vec![Solution::empty(mechanism); mechanism.facts().capacity];
    for set in sets_of(name, mechanism, joints, poses) {
        for (index, q) in set.joints.iter().enumerate() {
            let target = mechanism.forward(&Chain(mechanism).row(q)).expect("a chain has forward kinematics");
            println!("{name};{};{index};{q:?}", set.name);
            for answer in answers(mechanism, &target, &mut out) {
                println!(" {};{:?}", answer.free, answer.q);
            }
        }
    }
}
