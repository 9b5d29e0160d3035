//! Many targets at once, and the removal of one excess solution.

use std::f64::consts::TAU;

use crate::codegen::samples::pan_tilt;
use groebot_ik::ErrorKind;
use groebot_ik::solver::{Batch, Program, Solved};

/// Directions on the sphere; every seventh is not a unit vector.
fn targets() -> Vec<f64> {
    let direction = |k: usize| {
        let mut direction = pan_tilt::direction(0.37 * k as f64, 1.5 * (0.11 * k as f64).sin());
        if k % 7 == 6 {
            direction[0] += 0.5;
        }
        direction
    };
    (0..500).flat_map(direction).collect()
}

fn solved_by(threads: usize, program: &Program, targets: &[f64]) -> Batch {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| program.solve_batch(targets)).unwrap()
}

#[test]
fn a_batch_has_the_answers_of_its_targets_whatever_the_threads() {
    let (program, targets) = (pan_tilt::program(), targets());
    let batch = solved_by(1, &program, &targets);
    assert_eq!(batch, solved_by(3, &program, &targets));
    let (mut starts, mut refused, mut pans) = (vec![0], Vec::new(), Vec::new());
    let mut take = |solved: Solved<'_>| match solved {
        Solved::Answer { q, .. } => pans.push(q[0]),
        Solved::Target { refused: why } => {
            refused.extend(why.map(|error| (starts.len() - 1, error)));
            starts.push(pans.len());
        }
    };
    program.solver().solve_each(&targets, &mut take).unwrap();
    assert_eq!((&pans[..], &refused[..]), (batch.joint(0), batch.refused()));
    assert!((0..500).all(|target| batch.of_target(target) == (starts[target]..starts[target + 1])));
    assert_eq!(batch.targets(), 500);
    assert_eq!(batch.refused().len(), 500 / 7);
    for (index, target) in targets.chunks(3).enumerate() {
        let range = batch.of_target(index);
        match program.solve_numbers(target) {
            Ok(answers) => {
                assert_eq!(answers.len(), range.len());
                for (answer, place) in answers.iter().zip(range) {
                    assert_eq!(answer.q, [batch.joint(0)[place], batch.joint(1)[place]]);
                    assert_eq!((answer.residual, answer.branch), (batch.residuals()[place], batch.branches()[place]));
                    let free: Vec<usize> = (0..2).filter(|joint| batch.free()[place] >> joint & 1 == 1).collect();
                    assert_eq!(answer.free, free);
                }
            }
            Err(error) => {
                assert!(range.is_empty());
                assert!(batch.refused().contains(&(index, error)));
            }
        }
    }
}

#[test]
fn a_batch_may_have_the_room_of_the_one_before() {
    let (program, targets) = (pan_tilt::program(), targets());
    let solver = program.solver();
    let mut batch = solver.solve_batch(&targets[..30]).unwrap();
    for targets in [&targets[..], &targets[600..660], &[]] {
        solver.solve_batch_into(targets, &mut batch).unwrap();
        assert_eq!(batch, solver.solve_batch(targets).unwrap());
    }
    let puma = Program::from_json(include_str!("../../../../derivations/puma/5_program.json")).unwrap().solver();
    let reached = puma.reached(&[0.3, -0.4, 0.5, 0.6, -0.7, 0.8]).unwrap();
    puma.solve_batch_into(&reached, &mut batch).unwrap();
    assert_eq!((batch.targets(), batch.answers(), batch.joint(5).len()), (1, 8, 8));
    assert!(puma.solve_batch_into(&reached[1..], &mut batch).is_err());
    assert_eq!((batch.targets(), batch.answers()), (0, 0));
}

#[test]
fn a_count_that_is_none_of_targets_is_refused() {
    assert_eq!(pan_tilt::program().solve_batch(&[1.0, 0.0]).unwrap_err().kind(), ErrorKind::BadValue);
    assert_eq!(pan_tilt::program().solve_batch(&[]).unwrap().targets(), 0);
}

/// Our arc tangent computes the angles from cosines and sines. They are compared with those of the C library.
#[test]
fn angles_are_those_of_the_c_library() {
    let program = pan_tilt::program();
    let mut worst = 0.0_f64;
    for k in 0..20_000 {
        let pan = f64::from(k) * TAU / 16_000.0;
        let target = pan_tilt::direction(pan, 0.3);
        let answers = program.solve_numbers(&target).unwrap();
        let expected = target[1].atan2(target[0]);
        let nearest = answers.iter().map(|answer| (answer.q[0] - expected).abs()).fold(f64::INFINITY, f64::min);
        worst = worst.max(nearest);
    }
    assert!(worst <= 1.4e-15, "{worst:e}");
}

/// If a target has more isolated solutions than the program's certified number, the nearest two are united.
#[test]
fn more_answers_than_there_can_be_are_united() {
    let program = pan_tilt::program();
    let target = pan_tilt::direction(0.4, 0.9);
    let both = program.solve_numbers(&target).unwrap();
    assert_eq!(both.len(), 2);
    let one = Program { isolated: Some(1), ..program }.solve_numbers(&target).unwrap();
    assert_eq!(one.len(), 1);
    assert!(both.contains(&one[0]));
    assert!(both.iter().all(|answer| one[0].residual <= answer.residual));
}

#[test]
fn solutions_within_limits_are_those_that_have_a_turn_there() {
    let puma = Program::from_json(include_str!("../../../../derivations/puma/5_program.json")).unwrap().solver();
    let target = puma.reached(&[0.3, -0.4, 0.5, 0.6, -0.7, 0.8]).unwrap();
    let all = puma.solve_numbers(&target).unwrap();
    let turned = puma.solve_within(&target, &[[TAU - 3.2, TAU + 3.2]; 6]).unwrap();
    assert_eq!(turned.len(), all.len());
    for (turned, answer) in turned.iter().zip(&all) {
        let turns = turned.q.iter().zip(&answer.q).map(|(a, b)| (a - b) / TAU);
        assert!(turns.into_iter().all(|turns| (turns - turns.round()).abs() < 1e-12), "{turned:?}");
        assert!(turned.q.iter().all(|q| (TAU - 3.2..=TAU + 3.2).contains(q)), "{turned:?}");
    }
    let narrow = puma.solve_within(&target, &[[-1.0, 1.0]; 6]).unwrap();
    let inside = all.iter().filter(|answer| answer.q.iter().all(|q| q.abs() <= 1.0)).count();
    assert!(inside > 0 && narrow.len() == inside, "{narrow:?}");
    assert_eq!(puma.solve_within(&target, &[[-1.0, 1.0]; 5]).unwrap_err().kind(), ErrorKind::BadValue);
}
