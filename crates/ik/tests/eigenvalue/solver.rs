//! The solver compared with generating joints, and with the published manipulator that has sixteen real solutions.

use std::f64::consts::PI;

use groebot_ik::derive::eigenvalue;
use groebot_ik::solver::eigenvalue::{Formulation, Layout, Line};
use groebot_runtime::six_axes::{self, Rigid};
use num_traits::ToPrimitive;

use super::{Random, distance, found, nearest, random_chain, residual};
use crate::sixteen;

/// Statistics of many random targets.
#[derive(Default)]
struct Figures {
    misses: usize,
    targets: usize,
    worst: f64,
}

impl Figures {
    fn add(&mut self, solver: &six_axes::Chain, q: &[f64; 6]) {
        let target = solver.forward(q);
        let answers = solver.solve(&target);
        self.targets += 1;
        self.misses += usize::from(nearest(&answers, q) > 1e-6);
        self.worst = self.worst.max(residual(solver, &answers, &target));
    }
}

#[test]
fn random_targets_give_back_their_joints() {
    let (mut random, mut figures) = (Random::new(4), Figures::default());
    for _ in 0..20 {
        let solver = eigenvalue::solver(&random_chain(&mut random)).unwrap();
        (0..500).for_each(|_| figures.add(&solver, &random.angles()));
    }
    assert_eq!((figures.misses, figures.targets), (0, 10_000));
    assert!(figures.worst <= 1e-12, "{}", figures.worst);
}

/// Run by `cargo test --release hundred_thousand -- --ignored --nocapture`.
#[test]
#[ignore = "a hundred thousand targets"]
fn a_hundred_thousand_random_targets() {
    let (mut random, mut figures) = (Random::new(5), Figures::default());
    for _ in 0..100 {
        let solver = eigenvalue::solver(&random_chain(&mut random)).unwrap();
        (0..1000).for_each(|_| figures.add(&solver, &random.angles()));
    }
    println!("{} misses in {} targets, worst residual {:e}", figures.misses, figures.targets, figures.worst);
    assert!(figures.misses <= 1 && figures.worst <= 1e-12);
}

#[test]
fn half_a_turn_is_an_angle_like_any_other() {
    let (mut random, mut figures) = (Random::new(6), Figures::default());
    for _ in 0..10 {
        let solver = eigenvalue::solver(&random_chain(&mut random)).unwrap();
        for joints in 1..64 {
            let mut q = random.angles();
            (0..6).filter(|joint| joints >> joint & 1 == 1).for_each(|joint| q[joint] = PI);
            figures.add(&solver, &q);
        }
    }
    assert_eq!((figures.misses, figures.targets), (0, 630));
}

#[test]
fn answers_reach_the_target_by_the_chains_own_kinematics() {
    let mut random = Random::new(7);
    for _ in 0..5 {
        let chain = random_chain(&mut random);
        let solver = eigenvalue::solver(&chain).unwrap();
        for _ in 0..20 {
            let q = random.angles();
            let target = chain.forward(&q).unwrap();
            let answers = solver.solve(&solver.forward(&q));
            for answer in found(&answers) {
                let reached = chain.forward(&answer.q).unwrap();
                assert!((reached.translation.vector - target.translation.vector).norm() < 1e-11);
                assert!(reached.rotation.angle_to(&target.rotation) < 1e-11);
            }
        }
    }
}

#[test]
fn a_target_out_of_reach_has_no_answer() {
    let mut random = Random::new(8);
    let solver = eigenvalue::solver(&random_chain(&mut random)).unwrap();
    let mut far = solver.forward(&random.angles());
    far[0] += 100.0;
    assert_eq!(solver.solve(&far).as_slice().len(), 0);
}

/// The axes of the links in `crates/algebra/tests/real/sixteen.rs`, in the zero configuration.
pub fn lines_of(links: &[sixteen::Link<f64>; 6]) -> [Line; 6] {
    let frame = |count: usize| sixteen::chain(&vec![[1.0, 0.0]; count], &links[..count]);
    std::array::from_fn(|joint| match joint {
        0 => Line { direction: [0.0, 0.0, 1.0], point: [0.0; 3] },
        _ => {
            let frame = frame(joint);
            Line { direction: [0, 1, 2].map(|k| frame[k][2]), point: [0, 1, 2].map(|k| frame[k][3]) }
        }
    })
}

/// The links in doubles.
pub fn in_doubles(links: &[sixteen::Link<groebot_algebra::number::BigRational>; 6]) -> [sixteen::Link<f64>; 6] {
    links.each_ref().map(|link| sixteen::Link {
        length: link.length.to_f64().unwrap(),
        offset: link.offset.to_f64().unwrap(),
        twist: link.twist.each_ref().map(|entry| entry.to_f64().unwrap()),
    })
}

/// The frame of the last link in the zero configuration.
pub fn tip(links: &[sixteen::Link<f64>; 6]) -> Rigid {
    let frame = sixteen::chain(&[[1.0, 0.0]; 6], links);
    let rotation = std::array::from_fn(|i| std::array::from_fn(|j| frame[i][j]));
    Rigid { rotation, translation: [0, 1, 2].map(|k| frame[k][3]) }
}

/// The numbers of a target.
pub fn target(pose: &sixteen::Frame<f64>) -> [f64; 12] {
    std::array::from_fn(|k| if k < 3 { pose[k][3] } else { pose[k / 3 - 1][k % 3] })
}

#[test]
fn the_published_manipulator_has_its_sixteen_solutions() {
    let links = in_doubles(&sixteen::links());
    let pose = sixteen::pose().map(|row| row.map(|entry| entry.to_f64().unwrap()));
    let formulations = [2, 3, 5].map(|hidden| Formulation { hidden, second: false });
    let layout = Layout { lines: lines_of(&links), slides: [false; 6], length: 1.5 };
    let answers = found(&layout.chain(&tip(&links), &formulations).solve(&target(&pose)));
    assert_eq!(answers.len(), 16);
    for row in &sixteen::ANGLES {
        let wanted = row.map(f64::to_radians);
        let near = answers.iter().filter(|answer| distance(&answer.q, &wanted) < 0.1_f64.to_radians());
        assert_eq!(near.count(), 1, "{row:?}");
    }
}
