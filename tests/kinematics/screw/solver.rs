//! The screw solver on robots whose joint values are known: they are among the answers, and every answer reaches the pose.

use std::f64::consts::PI;

use groebot::kinematics::Chain;
use groebot::kinematics::screw::{ScrewSolver, Solution, Subproblem, Target};
use groebot::robots;
use groebot::spatial::{Screw, angle};
use nalgebra::{DMatrix, Vector3};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

use Subproblem::{
    PadenKahan1, PadenKahan2, PadenKahan3, Pardos1, Pardos4, Pardos5, Pardos8, PardosOne, ThreeCircles,
};

/// The reach, or one for a chain that only turns its tip.
pub fn reach(chain: &Chain) -> f64 {
    if chain.reach() > 0.0 { chain.reach() } else { 1.0 }
}

/// Joint values of `chain` in general: angles in (-pi, pi), displacements within 1.5 reaches.
pub fn configurations(chain: &Chain) -> impl Strategy<Value = Vec<f64>> + use<> {
    let reach = reach(chain);
    let slides: Vec<bool> = chain.screws().iter().map(|screw| screw.axis().is_none()).collect();
    let spans = slides.into_iter().map(move |slides| if slides { -1.5 * reach..1.5 * reach } else { -PI..PI });
    spans.collect::<Vec<_>>()
}

/// The smallest singular value of the Jacobian of position (in reaches) and, for a pose, rotation, at `q`.
pub fn sigma(chain: &Chain, q: &[f64], with_rotation: bool) -> f64 {
    let tip = chain.forward(q).unwrap().translation.vector;
    let mut before = groebot::spatial::Pose::identity();
    let rows = if with_rotation { 6 } else { 3 };
    let mut jacobian = DMatrix::zeros(rows, q.len());
    for (i, (screw, q)) in chain.screws().iter().zip(q).enumerate() {
        let (v, w) = match screw.moved(&before) {
            Screw::Revolute(axis) => (axis.direction().cross(&(tip - axis.point().coords)), *axis.direction()),
            Screw::Prismatic(direction) => (*direction, Vector3::zeros()),
        };
        let slides = if screw.axis().is_none() { reach(chain) } else { 1.0 };
        let column: Vec<f64> = (v / reach(chain) * slides).iter().chain(w.iter()).take(rows).copied().collect();
        jacobian.set_column(i, &nalgebra::DVector::from_vec(column));
        before *= screw.exp(*q);
    }
    smallest_singular_value(jacobian)
}

/// By one-sided Jacobi rotations (Hestenes 1958), which keep small singular values accurate.
fn smallest_singular_value(mut a: DMatrix<f64>) -> f64 {
    for _ in 0..30 {
        for i in 0..a.ncols() {
            for j in i + 1..a.ncols() {
                let (x, y) = (a.column(i).clone_owned(), a.column(j).clone_owned());
                let turn = 0.5 * (2.0 * x.dot(&y)).atan2(x.norm_squared() - y.norm_squared());
                let (sine, cosine) = turn.sin_cos();
                a.set_column(i, &(&x * cosine + &y * sine));
                a.set_column(j, &(&y * cosine - &x * sine));
            }
        }
    }
    a.column_iter().map(|column| column.norm()).fold(f64::INFINITY, f64::min)
}

/// How far two joint vectors are apart: radians, or reaches for displacements.
pub fn distance(chain: &Chain, a: &[f64], b: &[f64]) -> f64 {
    let one = |(screw, (a, b)): (&Screw, (&f64, &f64))| match screw.axis() {
        Some(_) => angle::difference(*a, *b).abs(),
        None => (a - b).abs() / reach(chain),
    };
    chain.screws().iter().zip(a.iter().zip(b)).map(one).fold(0.0, f64::max)
}

/// The largest relative residual of the answers, measured here by the chain's own forward kinematics.
pub fn worst_residual(chain: &Chain, target: &Target, answers: &[Solution]) -> f64 {
    let miss = |answer: &Solution| {
        let reached = Target::reached(chain, &answer.q).unwrap();
        match (target, &reached) {
            (Target::Pose(want), Target::Pose(have)) => {
                let turn = (want.rotation.inverse() * have.rotation).angle();
                turn.max((want.translation.vector - have.translation.vector).norm() / reach(chain))
            }
            (Target::Position(want), Target::Position(have)) => (want - have).norm() / reach(chain),
            (Target::PlanarPosition(want), Target::PlanarPosition(have)) => {
                (want[0] - have[0]).hypot(want[1] - have[1]) / reach(chain)
            }
            (Target::PlanarPose(want), Target::PlanarPose(have)) => {
                let turn = angle::difference(want[2], have[2]).abs();
                turn.max((want[0] - have[0]).hypot(want[1] - have[1]) / reach(chain))
            }
            _ => panic!("{target:?} and {reached:?} are of different kinds"),
        }
    };
    answers.iter().map(miss).fold(0.0, f64::max)
}

/// How near the known answer must come, as the design defines it: 1e-9 rad in general position, else by the singular value.
pub fn matching(sigma: f64) -> f64 {
    if sigma > 1e-3 { 1e-9 } else { (1e-13 / sigma).max(1e-7) }
}

/// All robots with the subproblems of their plans and the joints that these solve.
fn plans() -> Vec<(Chain, Vec<(Subproblem, Vec<usize>)>)> {
    // RH0 A.2: ..(A-25), and in the same order RH0 (3-15)..(3-22) and (3-30)..(3-37).
    let puma = || {
        vec![
            (PadenKahan3, vec![2]),
            (PadenKahan2, vec![0, 1]),
            (PadenKahan2, vec![3, 4]),
            (PadenKahan1, vec![5]),
        ]
    };
    // RH0 A.1: ..(A-12).
    let stanford = vec![
        (PardosOne, vec![2]),
        (PadenKahan2, vec![0, 1]),
        (PadenKahan2, vec![3, 4]),
        (PadenKahan1, vec![5]),
    ];
    vec![
        (robots::puma(), puma()),
        (robots::stanford(), stanford),
        (robots::rh0_right_leg(), puma()),
        (robots::rh0_left_leg(), puma()),
        (robots::irb120(), puma()),
        (robots::teo_leg(), vec![]),
        (robots::polar(), vec![(PardosOne, vec![2]), (PadenKahan2, vec![0, 1])]),
        (robots::nao_left_leg(), vec![]),
        (robots::nao_right_leg(), vec![]),
        (robots::nao_left_arm(), vec![]),
        (robots::nao_right_arm(), vec![]),
        (robots::nao_head(), vec![]),
        (robots::ur5(), vec![]),
    ]
}

#[test]
fn plans_are_those_of_the_thesis() {
    for (chain, expected) in plans() {
        let plan = ScrewSolver::new(&chain).unwrap().plan().clone();
        println!("{}\n{plan}\n", chain.name());
        let told: Vec<_> = plan.steps.iter().map(|step| (step.subproblem, step.joints.clone())).collect();
        if !expected.is_empty() {
            assert_eq!(told, expected, "{}", chain.name());
        }
    }
}

#[test]
fn the_generating_joints_are_among_the_answers() {
    for (chain, _) in plans() {
        let solver = ScrewSolver::new(&chain).unwrap();
        let mut runner = TestRunner::new(Config::with_cases(500));
        let outcome = runner.run(&configurations(&chain), |q| {
            let target = Target::reached(&chain, &q).unwrap();
            let answers = solver.solve(&target).unwrap();
            let near = answers.iter().map(|answer| distance(&chain, &q, &answer.q)).fold(f64::INFINITY, f64::min);
            let sigma = sigma(&chain, &q, matches!(target, Target::Pose(_)));
            prop_assert!(near <= matching(sigma), "{q:?} is missed by {near:e} (sigma {sigma:e}): {answers:?}");
            prop_assert!(answers.len() <= solver.plan().most_solutions());
            let worst = worst_residual(&chain, &target, &answers);
            prop_assert!(worst <= 2e-12, "residual {worst:e}");
            Ok(())
        });
        if let Err(error) = outcome {
            panic!("{}: {error}", chain.name());
        }
    }
}
