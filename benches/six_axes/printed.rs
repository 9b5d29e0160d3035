// Measures one generated solver: see printed.py, which inserts its path and the prismatic joints.
#[path = "SOLVER"]
mod solver;

use solver::{Solve, Solver};
use std::f64::consts::{PI, TAU};
use std::time::Instant;

/// Processor time of this process [us].
fn processor() -> f64 {
    let text = std::fs::read_to_string("/proc/self/schedstat").unwrap();
    text.split(' ').next().unwrap().parse::<f64>().unwrap() * 1e-3
}

fn main() {
    let poses: usize = std::env::args().nth(1).unwrap().parse().unwrap();
    let mut word = 88_172_645_463_325_252_u64;
    let mut random = || {
        word ^= word << 13;
        word ^= word >> 7;
        word ^= word << 17;
        (word >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let slides = |joint: usize| (SLIDES as u64) >> joint & 1 == 1;
    let joints: Vec<[f64; 6]> =
        (0..poses).map(|_| core::array::from_fn(|k| if slides(k) { random() } else { PI * random() })).collect();
    let targets: Vec<_> = joints.iter().map(|q| Solver.forward(q).unwrap()).collect();
    let mut out = [solver::EMPTY; solver::CAPACITY];
    let (mut times, mut answers, mut lost) = (Vec::with_capacity(poses), 0, 0);
    let before = processor();
    for (q, target) in joints.iter().zip(&targets) {
        let start = Instant::now();
        let count = Solver.solve(target, &mut out).unwrap_or(0);
        times.push(start.elapsed().as_secs_f64() * 1e6);
        answers += count;
        let gap = |k: usize, a: f64| if slides(k) { a - q[k] } else { a - q[k] - TAU * ((a - q[k]) / TAU).round() };
        let is_near = |answer: &solver::Solution| (0..6).all(|k| gap(k, answer.q[k]).abs() <= 1e-6);
        if !out[..count].iter().any(is_near) {
            lost += 1;
            eprintln!("lost: {q:?}");
        }
    }
    let mean = (processor() - before) / poses as f64;
    times.sort_by(f64::total_cmp);
    let at = |share: f64| times[(share * (poses - 1) as f64) as usize];
    let each = answers as f64 / poses as f64;
    println!("{lost},{each:.2},{mean:.1},{:.1},{:.1},{:.1},{:.0}", at(0.1), at(0.5), at(0.9), at(0.999));
}
