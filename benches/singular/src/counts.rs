//! Lost joint values: for each set, the number of joint vectors that are not among the solutions of their pose.

use groebot_runtime::mechanism::Inputs;
use groebot_runtime::{Solution, Solve};

use crate::path::{Answer, Chain};
use crate::poses::{Set, sets, stretched};

/// The sets of a robot.
pub fn sets_of<M: Solve>(name: &str, mechanism: &M, joints: &[&str], poses: usize) -> Vec<Set> {
    let mut sets = sets(&Chain(mechanism), joints, poses);
    if name.starts_with("ur5") {
        sets.push(stretched(poses));
    }
    if let Ok(part) = std::env::var("SETS") {
        sets.retain(|set| set.name.contains(&part));
    }
    sets
}

/// The solutions of a target.
pub fn answers<M: Solve>(mechanism: &M, target: &Inputs<M>, out: &mut [Solution<M>]) -> Vec<Answer> {
    let count = mechanism.solve(target, out).expect("a pose is a target");
    let all = out[..count].iter();
    all.map(|answer| Answer { q: answer.q.as_ref().to_vec(), free: answer.free }).collect()
}

pub fn head() {
    println!("robot,set,poses,lost,wrong,isolated,free");
}

pub fn print<M: Solve>(name: &str, mechanism: &M, joints: &[&str], poses: usize) {
    let chain = Chain(mechanism);
    let mut out = vec![Solution::empty(mechanism); mechanism.facts().capacity];
    for set in sets_of(name, mechanism, joints, poses) {
        let (mut lost, mut wrong, mut isolated, mut free) = (0, 0, 0, 0);
        for q in &set.joints {
            let target = mechanism.forward(&chain.row(q)).expect("a chain has forward kinematics");
            let found = answers(mechanism, &target, &mut out);
            let reported = chain.is_reported(q, &found);
            lost += usize::from(!reported);
            wrong += usize::from(found.iter().any(|answer| chain.missed(q, answer) > 1e-11));
            isolated += found.iter().filter(|answer| answer.free == 0).count();
            free += found.iter().filter(|answer| answer.free != 0).count();
            if !reported && std::env::var_os("SHOW_LOST").is_some() {
                eprintln!("{name},{},{q:?}", set.name);
            }
        }
        println!("{name},\"{}\",{},{lost},{wrong},{isolated},{free}", set.name, set.joints.len());
    }
}
