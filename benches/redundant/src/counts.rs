//! Counts of lost, unsure and wrong results at poses of joint vectors within limits.

use groebot_runtime::redundant::{
    Arc, Criterion, MOST_JOINTS, Outcome, Q, Redundant, Within, any_within, arcs, best, sample,
};

use crate::arm::Arm;
use crate::clock::now;
use crate::vectors::{Random, random, round};

/// The greatest distance of a joint vector to its arc \[rad\].
const NEAR: f64 = 1e-6;
/// The greatest miss of a pose.
const MISS: f64 = 1e-7;
/// The number of samples of each arc that are compared with the pose.
const SAMPLES: usize = 9;
const ROOM: usize = 256;

#[derive(Default)]
struct Counts {
    poses: usize,
    /// No arc; `any_within` has no solution.
    none: usize,
    absent: usize,
    /// The vector is on no arc; those of them whose outcome is not unsure.
    lost: usize,
    silent: usize,
    surfaces: usize,
    unsure: usize,
    /// A point of an arc or the solution of `any_within` misses the pose or exceeds limits.
    wrong: usize,
    refused: usize,
    arcs: usize,
    closed: usize,
}

pub fn head() {
    println!(
        "arm,vectors,poses,no_arc,no_solution,lost,lost_not_unsure,surface,unsure,wrong,refused,arcs_mean,closed,seconds"
    );
}

pub fn print(arm: &Arm, randoms: usize, rounds: usize) {
    let (data, mut source) = (arm.solver.arm_data(), Random::new(0));
    for (kind, number) in [("random", randoms), ("round", rounds)] {
        if number == 0 {
            continue;
        }
        let (start, mut counts) = (now(), Counts::default());
        for _ in 0..number {
            let draw = if kind == "random" { random } else { round };
            counts.add(arm, &draw(&data.limits, data.count, &mut source));
        }
        let c = &counts;
        println!(
            "{},{kind},{},{},{},{},{},{},{},{},{},{:.2},{},{:.1}",
            arm.name,
            c.poses,
            c.none,
            c.absent,
            c.lost,
            c.silent,
            c.surfaces,
            c.unsure,
            c.wrong,
            c.refused,
            c.arcs as f64 / c.poses as f64,
            c.closed,
            (now() - start) * 1e-6
        );
    }
}

impl Counts {
    fn add(&mut self, arm: &Arm, q: &Q) {
        let (robot, target) = (&arm.solver, arm.target(q));
        let (pose, limits) = (arm.pose(q), robot.arm().limits);
        let mut out = vec![Arc::NONE; ROOM];
        self.poses += 1;
        let Ok(outcome) = arcs(robot, &target, &limits, &mut out) else {
            self.refused += 1;
            return show("refused", arm, q, None);
        };
        let found = &out[..outcome.count.min(ROOM)];
        self.arcs += outcome.count;
        self.closed += outcome.closed;
        self.unsure += usize::from(outcome.is_unsure);
        self.surfaces += usize::from(outcome.is_surface);
        if found.is_empty() {
            self.none += 1;
            show("none", arm, q, Some(&outcome));
        } else if !outcome.is_surface && !is_held(arm, &target, found, q) {
            self.lost += 1;
            self.silent += usize::from(!outcome.is_unsure);
            show("lost", arm, q, Some(&outcome));
        } else if outcome.is_unsure {
            show("unsure", arm, q, Some(&outcome));
        }
        let is_right = |q: &Q| arm.is_within(q) && arm.missed(&pose, q) <= MISS;
        let mut list = [[0.0; MOST_JOINTS]; SAMPLES];
        let is_wrong = |arc: &Arc| {
            sample(robot.arm(), &target, &limits, arc, &mut list).expect("limits in order");
            !list.iter().all(&is_right)
        };
        let mut is_any_wrong = found.iter().any(is_wrong);
        match any_within(robot, &target, &limits) {
            Ok(Within::Solution(any)) => is_any_wrong |= !is_right(&any),
            _ => self.absent += 1,
        }
        if is_any_wrong {
            self.wrong += 1;
            show("wrong", arm, q, Some(&outcome));
        }
    }
}

/// Whether joint values are on an arc.
fn is_held(arm: &Arm, target: &[f64; 12], found: &[Arc], q: &Q) -> bool {
    let data = arm.solver.arm_data();
    let criterion = Criterion::Nearest { q0: *q, weights: [1.0; MOST_JOINTS] };
    let nearest = best(data, target, &data.limits, found, &criterion).expect("limits in order");
    nearest.is_some_and(|best| best.value > -NEAR)
}

/// With `SHOW=lost` or another kind, prints the joint vectors of this kind.
fn show(kind: &str, arm: &Arm, q: &Q, outcome: Option<&Outcome>) {
    if std::env::var("SHOW").is_ok_and(|shown| shown.split(',').any(|shown| shown == kind)) {
        eprintln!("{kind} {} {q:?} {outcome:?}", arm.name);
    }
}
