//! The solution nearest to reference joint values at singular poses: on the self-motion, not only its listed member.

#![allow(clippy::duplicate_mod)]

use std::f64::consts::{FRAC_PI_2, PI};

use groebot_runtime::mechanism::Inputs;
use groebot_runtime::storage::Array;
use groebot_runtime::{Mechanism, Solution, Solve};

use super::random;

#[rustfmt::skip]
#[path = "../../derivations/puma/5_solver.rs"]
mod puma;
#[rustfmt::skip]
#[path = "../../derivations/ur5/5_solver.rs"]
mod ur5;
#[rustfmt::skip]
#[path = "../../derivations/irb120/5_solver.rs"]
mod irb120;
#[rustfmt::skip]
#[path = "../../derivations/irb4600_rounded/5_solver.rs"]
mod irb4600_rounded;
#[rustfmt::skip]
#[path = "../../derivations/puma560/5_solver.rs"]
mod puma560;

fn probe<M: Mechanism>(m: &M, name: &str, make: impl Fn(&mut dyn FnMut() -> f64) -> [f64; 6], sure: f64) {
    let n = 500;
    let mut random = random();
    let mut out = vec![Solution::empty(m); m.facts().capacity];
    let weights = Array::by(6, |_| 1.0);
    let limits = Array::by(6, |_| [-PI, PI]);
    let (mut good, mut worst, mut isolated, mut none, mut listed) = (0, 0.0_f64, 0, 0, 0);
    let start = std::time::Instant::now();
    let mut bad = None;
    for _ in 0..n {
        let q0 = make(&mut random);
        let q = Array::by(6, |i| q0[i]);
        let target: Inputs<M> = m.forward(&q).unwrap();
        match m.nearest_to(&target, &q, &weights, &limits, &mut out) {
            Ok(Some((found, distance))) => {
                worst = worst.max(distance.sqrt());
                good += usize::from(distance.sqrt() <= sure);
                if distance.sqrt() > sure && bad.is_none() { bad = Some((q0, found.clone())); }
                isolated += usize::from(found.free == 0);
            }
            other => { none += 1; if bad.is_none() { println!("{other:?}"); } }
        }
        let count = m.solve(&target, &mut out).unwrap();
        if let Some((_, q)) = m.nearest(&out[..count], &q, &weights, &limits) {
            let d: f64 = q.as_ref().iter().zip(q0).map(|(a, b)| (a - b) * (a - b)).sum();
            listed += usize::from(d.sqrt() <= sure);
        }
    }
    println!("{name}: {good}/{n} worst {worst:e} isolated {isolated} none {none} listed {listed} {:?} each", start.elapsed() / n);
    if let Some((q0, found)) = bad { println!("   {q0:?} {found:?}"); }
}

fn any(r: &mut dyn FnMut() -> f64) -> [f64; 6] {
    [(); 6].map(|()| PI * (2.0 * r() - 1.0))
}

fn round(r: &mut dyn FnMut() -> f64) -> [f64; 6] {
    [(); 6].map(|()| PI / 12.0 * ((24.0 * r()).floor() - 11.0))
}

#[test]
fn probing() {
    for (name, five) in [("exact", 0.0), ("1e-10", 1e-10), ("1e-9", 1e-9), ("1e-8", 1e-8), ("1e-7", 1e-7), ("1e-6", 1e-6), ("1e-5", 1e-5), ("ordinary", 0.5)] {
        let with = |q5: f64| move |r: &mut dyn FnMut() -> f64| { let mut q = any(r); q[4] = q5; q };
        probe(&puma::Solver, &format!("puma {name}"), with(FRAC_PI_2 + five), 1e-6);
        probe(&puma560::Solver, &format!("puma560 {name}"), with(five), 1e-6);
        probe(&ur5::Solver, &format!("ur5 {name}"), with(five), 1e-6);
        probe(&irb120::Solver, &format!("irb120 {name}"), with(five), 1e-6);
        probe(&irb4600_rounded::Solver, &format!("irb4600_rounded {name}"), with(five), 1e-6);
    }
    probe(&puma::Solver, "puma round", round, 1e-6);
    probe(&puma560::Solver, "puma560 round", round, 1e-6);
    probe(&ur5::Solver, "ur5 round", round, 1e-6);
    probe(&irb120::Solver, "irb120 round", round, 1e-6);
    probe(&irb4600_rounded::Solver, "irb4600 round", round, 1e-6);
}
