//! Ordinary targets, which separate code solves: alone, in batches, and by cosines and sines without that code.

use crate::codegen::stored::named;
use crate::codegen::{odd, random};
use groebot_ik::solver::{Program, Solved, Solver};
use groebot_robot::kinematics::Solution;
use groebot_runtime::angles::angle;

/// The bits of joint values and of the residual, and the branch.
type Row = (Vec<u64>, u64, usize);

fn programs() -> Vec<Program> {
    let names = ["ur5", "puma560", "irb120", "stanford", "scara", "nao_left_leg", "rh0_left_leg", "teo_leg"];
    named(&names).into_iter().map(|stored| stored.program).collect()
}

/// Poses of random joints, and a few invalid targets.
fn targets(program: &Program, solver: &Solver) -> Vec<f64> {
    let mut next = random();
    let mut pose = |_| {
        let q: Vec<f64> = (0..program.joints.len()).map(|_| next(-3.0, 3.0)).collect();
        solver.reached(&q).unwrap()
    };
    let mut targets: Vec<Vec<f64>> = (0..67).map(&mut pose).collect();
    targets.extend(odd(program.inputs.len()));
    targets.extend((0..6).map(pose));
    targets.concat()
}

/// What a batch reports: by target its solutions, or none if it is refused.
fn batch(solver: &Solver, targets: &[f64]) -> Vec<Option<Vec<Row>>> {
    let (mut all, mut own) = (Vec::new(), Vec::new());
    let mut take = |solved: Solved<'_>| match solved {
        Solved::Answer { q, residual, branch, .. } => own.push((bits(q), residual.to_bits(), branch)),
        Solved::Target { refused } => {
            let own = std::mem::take(&mut own);
            all.push(refused.is_none().then_some(own));
        }
    };
    solver.solve_each(targets, &mut take).unwrap();
    all
}

fn bits(q: &[f64]) -> Vec<u64> {
    q.iter().map(|value| value.to_bits()).collect()
}

fn row(solution: &Solution) -> Row {
    (bits(&solution.q), solution.residual.to_bits(), solution.branch)
}

#[test]
fn a_batch_of_any_length_has_the_bits_of_single_targets() {
    for program in programs() {
        let (solver, inputs) = (program.solver(), program.inputs.len());
        let targets = targets(&program, &solver);
        let single = |target: &[f64]| solver.solve_numbers(target).ok().map(|own| own.iter().map(row).collect());
        let singles: Vec<Option<Vec<_>>> = targets.chunks(inputs).map(single).collect();
        for count in (1..20).chain([singles.len()]) {
            assert_eq!(batch(&solver, &targets[..count * inputs]), singles[..count], "{}: {count}", program.name);
        }
    }
}

/// Cosines and sines are computed without the code for ordinary targets.
#[test]
fn solutions_are_those_without_code_for_ordinary_targets() {
    for program in programs() {
        let solver = program.solver();
        for target in targets(&program, &solver).chunks(program.inputs.len()) {
            let (Ok(solutions), Ok(pairs)) = (solver.solve_numbers(target), solver.solve_pairs(target)) else {
                continue;
            };
            assert_eq!(solutions.len(), pairs.len(), "{}: {target:?}", program.name);
            for (solution, pairs) in solutions.iter().zip(&pairs) {
                let own = (solution.residual.to_bits(), solution.branch, &solution.free);
                assert_eq!(own, (pairs.residual.to_bits(), pairs.branch, &pairs.free), "{}: {target:?}", program.name);
                for ((&[c, s], &q), turns) in
                    pairs.joints.iter().zip(&solution.q).zip(program.joints.iter().map(is_angle))
                {
                    assert!((if turns { angle(c, s) - q } else { c - q }).abs() <= 1e-15, "{}", program.name);
                }
            }
        }
    }
}

fn is_angle(joint: &groebot_ik::solver::Joint) -> bool {
    matches!(joint.value, groebot_ik::solver::JointValue::Angle { .. })
}
