//! Processor time of each call.

use groebot_runtime::redundant::{Arc, Criterion, Q, Redundant, Target, Within, any_within, arcs, best};

use crate::arm::Arm;
use crate::clock::timed;
use crate::vectors::{Random, anywhere, random};

const ROOM: usize = 256;
/// Of random poses anywhere, at most so many times the poses are drawn until enough of them have no solution within limits.
const DRAWN: usize = 100;

/// Times of a call, us, with the number of solutions or arcs.
type Rows = Vec<(f64, usize)>;

pub fn head() {
    println!("arm,call,poses,us_median,us_90,us_99,us_worst,count_mean");
}

/// Median times of each call at poses of random joint vectors within limits, and at poses without a solution within limits.
pub fn print(arm: &Arm, poses: usize) {
    let (data, mut source) = (arm.solver.arm_data(), Random::new(1));
    let vectors: Vec<Q> = (0..poses).map(|_| random(&data.limits, data.count, &mut source)).collect();
    let [any, all, most] = calls(arm, &vectors);
    let (mut none, mut none_arcs) = (Rows::new(), Rows::new());
    let mut out = vec![Arc::NONE; ROOM];
    for _ in 0..DRAWN * poses {
        if none.len() == poses {
            break;
        }
        let target = arm.target(&anywhere(data.count, &mut source));
        let (time, found) = timed(|| any_within(&arm.solver, &target, &data.limits));
        if matches!(found, Ok(Within::Solution(_))) {
            continue;
        }
        none.push((time, 0));
        let (time, count) = timed(|| number_of_arcs(arm, &target, &mut out));
        none_arcs.push((time, count));
    }
    let rows = [("any_within", any), ("arcs", all), ("arcs and best", most)];
    for (call, rows) in rows.into_iter().chain([("any_within: none", none), ("arcs: none", none_arcs)]) {
        summary(&arm.name, call, rows);
    }
}

/// The rows of each call at each pose, in the format of scripts/redundant/peers.py.
pub fn each(arm: &Arm, vectors: &[Q]) {
    for (call, rows) in ["any_within", "arcs", "arcs and best"].iter().zip(calls(arm, vectors)) {
        for (pose, (us, count)) in rows.iter().enumerate() {
            println!("{call},{pose},{us:.2},{count}");
        }
    }
}

/// The times of any_within, arcs, and arcs with the best margin.
fn calls(arm: &Arm, vectors: &[Q]) -> [Rows; 3] {
    let (robot, data) = (&arm.solver, arm.solver.arm_data());
    let mut out = vec![Arc::NONE; ROOM];
    let mut rows = [Rows::new(), Rows::new(), Rows::new()];
    for q in vectors {
        let target = arm.target(q);
        let (time, found) = timed(|| any_within(robot, &target, &robot.arm().limits));
        rows[0].push((time, usize::from(matches!(found, Ok(Within::Solution(_))))));
        rows[1].push(timed(|| number_of_arcs(arm, &target, &mut out)));
        rows[2].push(timed(|| {
            let count = number_of_arcs(arm, &target, &mut out);
            let criterion = Criterion::Margin { is_relative: false };
            let found = best(data, &target, &data.limits, &out[..count], &criterion);
            usize::from(matches!(found, Ok(Some(_))))
        }));
    }
    rows
}

fn number_of_arcs(arm: &Arm, target: &Target, out: &mut [Arc]) -> usize {
    arcs(&arm.solver, target, &arm.solver.arm_data().limits, out).map_or(0, |outcome| outcome.count.min(ROOM))
}

fn summary(arm: &str, call: &str, mut rows: Rows) {
    if rows.is_empty() {
        return;
    }
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let share = |share: f64| rows[((rows.len() - 1) as f64 * share).round() as usize].0;
    let mean = rows.iter().map(|row| row.1).sum::<usize>() as f64 / rows.len() as f64;
    println!(
        "{arm},{call},{},{:.1},{:.1},{:.1},{:.1},{mean:.1}",
        rows.len(),
        share(0.5),
        share(0.9),
        share(0.99),
        share(1.0)
    );
}
