//! Chains of six joints, some of them prismatic.

use groebot_ik::Watch;
use groebot_ik::derive::{Derivation, eigenvalue};
use groebot_robot::kinematics::Chain;
use groebot_runtime::six_axes::{self, Answers};

use super::{Random, found, random_chain_of, residual};

/// The distance between `q` and the nearest solution; displacements in metres.
fn nearest(answers: &Answers, q: &[f64; 6], sliding: &[usize]) -> f64 {
    let turn = std::f64::consts::TAU;
    let difference = |joint: usize, a: f64, b: f64| match sliding.contains(&joint) {
        true => (a - b).abs(),
        false => (a - b - turn * ((a - b) / turn).round()).abs(),
    };
    let far = |a: &[f64; 6]| (0..6).map(|joint| difference(joint, a[joint], q[joint])).fold(0.0, f64::max);
    found(answers).iter().map(|answer| far(&answer.q)).fold(f64::INFINITY, f64::min)
}

fn values(random: &mut Random, sliding: &[usize]) -> [f64; 6] {
    let mut q = random.angles();
    sliding.iter().for_each(|joint| q[*joint] = random.number());
    q
}

/// The number of generating joint vectors that are not found at random targets, and the largest residual.
fn misses(solver: &six_axes::Chain, random: &mut Random, sliding: &[usize], targets: usize) -> (usize, f64) {
    let (mut misses, mut worst) = (0, 0.0_f64);
    for _ in 0..targets {
        let q = values(random, sliding);
        let target = solver.forward(&q);
        let answers = solver.solve(&target);
        misses += usize::from(nearest(&answers, &q, sliding) > 1e-6);
        worst = worst.max(residual(solver, &answers, &target));
    }
    (misses, worst)
}

#[test]
fn one_joint_may_slide_anywhere() {
    let mut random = Random::new(31);
    for joint in 0..6 {
        for _ in 0..3 {
            let solver = eigenvalue::solver(&random_chain_of(&mut random, &[joint])).unwrap();
            let (misses, worst) = misses(&solver, &mut random, &[joint], 300);
            assert!(misses == 0 && worst <= 1e-12, "joint {joint}: {misses} misses, {worst:e}");
        }
    }
}

#[test]
fn two_joints_may_slide_anywhere() {
    let mut random = Random::new(36);
    for first in 0..6 {
        for second in first + 1..6 {
            let sliding = [first, second];
            let solver = eigenvalue::solver(&random_chain_of(&mut random, &sliding)).unwrap();
            let (misses, worst) = misses(&solver, &mut random, &sliding, 200);
            assert!(misses == 0 && worst <= 1e-12, "{sliding:?}: {misses} misses, {worst:e}");
        }
    }
}

/// Prints rows of `benches/record/*-six-axes-sliding.csv`: `cargo test --release two_sliding_measured -- --ignored --nocapture`.
#[test]
#[ignore = "a hundred and twenty thousand targets"]
fn two_sliding_measured() {
    for sliding in (0..6).flat_map(|first| (first + 1..6).map(move |second| [first, second])) {
        let mut random = Random::new(38);
        let (mut lost, mut runs, mut doubted, mut count, mut refused, mut targets) = (0, 0, 0, 0, 0, 0_u32);
        let mut worst = 0.0_f64;
        for _ in 0..8 {
            let Ok(solver) = eigenvalue::solver(&random_chain_of(&mut random, &sliding)) else {
                refused += 1;
                continue;
            };
            for _ in 0..1000 {
                let q = values(&mut random, &sliding);
                let target = solver.forward(&q);
                let answers = solver.solve(&target);
                targets += 1;
                lost += usize::from(nearest(&answers, &q, &sliding) > 1e-6);
                doubted += usize::from(answers.accuracy.is_none());
                (runs, count) = (runs + answers.runs, count + found(&answers).len());
                worst = worst.max(residual(&solver, &answers, &target));
            }
        }
        let letters: String = (0..6).map(|joint| if sliding.contains(&joint) { 'P' } else { 'R' }).collect();
        let each = |sum: usize| sum as f64 / f64::from(targets);
        println!(
            "{letters},{targets},{lost},{:.3},{doubted},{:.3},{worst:.1e},{refused} of 8 refused",
            each(runs),
            each(count)
        );
    }
}

/// Three prismatic joints leave three angles for the rotation. Blocks find them for any position of the prismatic joints in the chain.
#[test]
fn blocks_solve_chains_with_three_sliding_joints() {
    let mut random = Random::new(37);
    for sliding in [[0, 1, 2], [0, 2, 4], [1, 2, 5], [0, 3, 5], [3, 4, 5]] {
        let chain = random_chain_of(&mut random, &sliding);
        let derived = Derivation::sequentially(&chain, &Watch::none()).unwrap();
        let solver = derived.program().solver();
        for _ in 0..20 {
            let q = values(&mut random, &sliding);
            let target = solver.reached(&q).unwrap();
            let near = |found: &[f64]| found.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-9);
            let solutions = solver.solve_numbers(&target).unwrap();
            assert_eq!(solutions.iter().filter(|solution| near(&solution.q)).count(), 1, "{sliding:?} {q:?}");
        }
    }
}

/// Run by `cargo test --release sliding -- --ignored --nocapture`.
#[test]
#[ignore = "a hundred thousand targets"]
fn a_hundred_thousand_targets_with_a_sliding_joint() {
    let mut random = Random::new(32);
    for joint in 0..6 {
        let (mut lost, mut worst) = (0, 0.0_f64);
        for _ in 0..20 {
            let solver = eigenvalue::solver(&random_chain_of(&mut random, &[joint])).unwrap();
            let (misses, residual) = misses(&solver, &mut random, &[joint], 835);
            (lost, worst) = (lost + misses, worst.max(residual));
        }
        println!("joint {}: {lost} misses in 16700 targets, worst residual {worst:e}", joint + 1);
    }
}

#[test]
fn answers_reach_the_target_by_the_chains_own_kinematics() {
    let mut random = Random::new(33);
    for joint in [0, 2, 5] {
        let chain = random_chain_of(&mut random, &[joint]);
        let solver = eigenvalue::solver(&chain).unwrap();
        for _ in 0..20 {
            let q = values(&mut random, &[joint]);
            let target = chain.forward(&q).unwrap();
            for answer in found(&solver.solve(&solver.forward(&q))) {
                let reached = chain.forward(&answer.q).unwrap();
                assert!((reached.translation.vector - target.translation.vector).norm() < 1e-11);
                assert!(reached.rotation.angle_to(&target.rotation) < 1e-11);
            }
        }
    }
}

/// An angle of pi and a displacement of zero are not special.
#[test]
fn half_a_turn_beside_a_sliding_joint() {
    let mut random = Random::new(34);
    let mut targets = 0;
    for joint in 0..6 {
        let solver = eigenvalue::solver(&random_chain_of(&mut random, &[joint])).unwrap();
        for joints in 1..64 {
            let mut q = values(&mut random, &[joint]);
            for k in (0..6).filter(|k| joints >> k & 1 == 1) {
                q[k] = if k == joint { 0.0 } else { std::f64::consts::PI };
            }
            let answers = solver.solve(&solver.forward(&q));
            assert!(nearest(&answers, &q, &[joint]) <= 1e-6, "{q:?}");
            targets += 1;
        }
    }
    assert_eq!(targets, 378);
}

fn derived(chain: &Chain) -> Derivation {
    Derivation::by_eigenvalues(chain, &Watch::none()).unwrap()
}

/// Sixteen complex solutions, a certificate that proves the derivation again, and a program that is unchanged after JSON.
#[test]
fn a_derivation_with_a_sliding_joint_is_certified() {
    let chain = random_chain_of(&mut Random::new(35), &[3]);
    let derived = derived(&chain);
    assert_eq!(derived.dimension(), Some(16));
    assert!(
        derived
            .eigenvalue()
            .unwrap()
            .method
            .formulations
            .iter()
            .all(|regular| regular.determinants.iter().all(|d| d.value != 0))
    );
    assert_eq!(Derivation::prove(&chain, &derived.certificate().unwrap()).unwrap(), derived);
    let again = groebot_ik::solver::Program::from_json(&derived.program().to_json()).unwrap();
    assert_eq!(&again, derived.program());
}
