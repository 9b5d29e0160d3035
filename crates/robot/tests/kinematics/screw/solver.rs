//! The screw solver on robots with known joint values: these are among the solutions, and every solution reaches the
//! pose.

use std::f64::consts::PI;

use groebot_robot::kinematics::oracle::{Oracle, Unknown};
use groebot_robot::kinematics::screw::{ScrewSolver, Subproblem};
use groebot_robot::kinematics::{Chain, Solution, Target};
use groebot_robot::robots;
use groebot_robot::spatial::{Pose, Screw, angle};
use nalgebra::{DMatrix, Quaternion, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

use Subproblem::{PadenKahan1, PadenKahan2, PadenKahan3, PardosOne};

/// The reach, or one for a chain that only rotates its tip.
pub fn reach(chain: &Chain) -> f64 {
    if chain.reach() > 0.0 { chain.reach() } else { 1.0 }
}

/// General joint values of `chain`: angles in (-pi, pi), displacements within 1.5 reaches.
pub fn configurations(chain: &Chain) -> impl Strategy<Value = Vec<f64>> + use<> {
    let reach = reach(chain);
    let slides: Vec<bool> = chain.screws().iter().map(|screw| screw.axis().is_none()).collect();
    let spans = slides.into_iter().map(move |slides| if slides { -1.5 * reach..1.5 * reach } else { -PI..PI });
    spans.collect::<Vec<_>>()
}

/// The smallest singular value of the Jacobian of position (in reaches) and, for a pose, rotation, at `q`.
pub fn sigma(chain: &Chain, q: &[f64], with_rotation: bool) -> f64 {
    let tip = chain.forward(q).unwrap().translation.vector;
    let mut before = Pose::identity();
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

/// By one-sided Jacobi rotations (Hestenes 1958), which compute small singular values accurately.
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

/// The distance of two joint vectors: radians, or reaches for displacements.
pub fn distance(chain: &Chain, a: &[f64], b: &[f64]) -> f64 {
    let one = |(screw, (a, b)): (&Screw, (&f64, &f64))| match screw.axis() {
        Some(_) => angle::difference(*a, *b).abs(),
        None => (a - b).abs() / reach(chain),
    };
    chain.screws().iter().zip(a.iter().zip(b)).map(one).fold(0.0, f64::max)
}

/// The largest relative residual of the solutions, measured by the chain's own forward kinematics.
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

/// The required distance of the known solution, as defined in the design: 1e-9 rad in general position, else by the
/// singular value.
pub fn matching(sigma: f64) -> f64 {
    if sigma > 1e-3 { 1e-9 } else { (1e-13 / sigma).max(1e-7) }
}

/// The subproblems of a plan, each with its joints.
type Told = Vec<(Subproblem, Vec<usize>)>;

/// All robots with the subproblems of their plans and the joints of each.
fn plans() -> Vec<(Chain, Told)> {
    // RH0 A.2: ..(A-25), and in the same order RH0 (3-15)..(3-22) and (3-30)..(3-37).
    let puma =
        || vec![(PadenKahan3, vec![2]), (PadenKahan2, vec![0, 1]), (PadenKahan2, vec![3, 4]), (PadenKahan1, vec![5])];
    // RH0 A.1: ..(A-12).
    let stanford =
        vec![(PardosOne, vec![2]), (PadenKahan2, vec![0, 1]), (PadenKahan2, vec![3, 4]), (PadenKahan1, vec![5])];
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
        let reported: Vec<_> = plan.steps.iter().map(|step| (step.subproblem, step.joints.clone())).collect();
        if !expected.is_empty() {
            assert_eq!(reported, expected, "{}", chain.name());
        }
    }
}

/// Checks that `q` is among the solutions for the target that it reaches, and that every solution reaches it.
fn check(solver: &ScrewSolver, q: &[f64]) -> Result<Vec<Solution>, TestCaseError> {
    let chain = solver.chain();
    let target = Target::reached(chain, q).unwrap();
    let answers = solver.solve(&target).unwrap();
    let near = answers.iter().map(|answer| distance(chain, q, &answer.q)).fold(f64::INFINITY, f64::min);
    let sigma = sigma(chain, q, has_rotation(&target));
    prop_assert!(near <= matching(sigma), "{q:?} is missed by {near:e} (sigma {sigma:e}): {answers:?}");
    check_answers(solver, &target, &answers)?;
    Ok(answers)
}

/// Checks that the solutions reach the target, are no more than the plan permits, and are different.
fn check_answers(solver: &ScrewSolver, target: &Target, answers: &[Solution]) -> Result<(), TestCaseError> {
    let chain = solver.chain();
    prop_assert!(answers.len() <= solver.plan().most_solutions());
    let worst = worst_residual(chain, target, answers);
    prop_assert!(worst <= 2e-12, "residual {worst:e}");
    for (i, a) in answers.iter().enumerate() {
        prop_assert!(answers[..i].iter().all(|b| distance(chain, &a.q, &b.q) > 1e-9), "twice: {a:?}");
    }
    Ok(())
}

pub fn has_rotation(target: &Target) -> bool {
    matches!(target, Target::Pose(_) | Target::PlanarPose(_))
}

/// Runs `test` on `cases` configurations of each robot.
fn each_robot(cases: u32, test: impl Fn(&ScrewSolver, &[f64]) -> Result<(), TestCaseError>) {
    for (chain, _) in plans() {
        let solver = ScrewSolver::new(&chain).unwrap();
        let mut runner = TestRunner::new(Config { failure_persistence: None, ..Config::with_cases(cases) });
        if let Err(error) = runner.run(&configurations(&chain), |q| test(&solver, &q)) {
            panic!("{}: {error}", chain.name());
        }
    }
}

#[test]
fn the_generating_joints_are_among_the_answers() {
    each_robot(500, |solver, q| check(solver, q).map(drop));
}

#[test]
fn the_oracle_finds_as_many_answers() {
    each_robot(6, |solver, q| {
        let chain = solver.chain();
        let target = Target::reached(chain, q).unwrap();
        if sigma(chain, q, has_rotation(&target)) < 1e-2 {
            return Err(TestCaseError::reject("nearly singular"));
        }
        let answers = check(solver, q)?;
        let found = oracle(chain, &target);
        prop_assert_eq!(answers.len(), found.len(), "{:?}\nbut the oracle has {:?}", answers, found);
        for other in found {
            let near = answers.iter().map(|answer| distance(chain, &other, &answer.q)).fold(f64::INFINITY, f64::min);
            prop_assert!(near < 1e-6, "the oracle alone has {other:?}");
        }
        Ok(())
    });
}

/// The numeric oracle's solutions: damped least squares on forward kinematics from many starting points.
pub fn oracle(chain: &Chain, target: &Target) -> Vec<Vec<f64>> {
    let unknowns: Vec<Unknown> = chain
        .screws()
        .iter()
        .map(|screw| match screw.axis() {
            Some(_) => Unknown::Angle,
            None => Unknown::Displacement { low: -2.0 * reach(chain), high: 2.0 * reach(chain) },
        })
        .collect();
    let residual = |q: &[f64]| match (target, Target::reached(chain, q).unwrap()) {
        (Target::Pose(want), Target::Pose(have)) => {
            let rotations = (want.rotation.to_rotation_matrix(), have.rotation.to_rotation_matrix());
            let turn = rotations.0.matrix() - rotations.1.matrix();
            let shift = (want.translation.vector - have.translation.vector) / reach(chain);
            turn.iter().chain(shift.iter()).copied().collect()
        }
        (Target::Position(want), Target::Position(have)) => (want - have).iter().map(|x| x / reach(chain)).collect(),
        other => panic!("{other:?}"),
    };
    let oracle = Oracle { seeds: 400, tolerance: 1e-10, ..Oracle::default() };
    oracle.search(&unknowns, residual).unwrap().into_iter().map(|answer| answer.q).collect()
}

/// Joint values of robots at which their Jacobian is singular.
fn singular() -> Vec<(Chain, Vec<f64>)> {
    let general = [0.4, -0.7, 1.1, 0.6, 0.9, -0.5];
    let with = |joint: usize, value: f64| {
        let mut q = general.to_vec();
        q[joint] = value;
        q
    };
    vec![
        (robots::puma(), with(4, 0.0)),
        (robots::puma(), with(4, PI)),
        (robots::puma(), with(2, 0.0)),
        (robots::puma(), vec![0.0; 6]),
        (robots::stanford(), with(4, 0.0)),
        (robots::irb120(), with(4, 0.0)),
        (robots::irb120(), vec![0.0; 6]),
        (robots::ur5(), with(4, 0.0)),
        (robots::ur5(), with(4, PI)),
        (robots::ur5(), with(2, 0.0)),
        (robots::ur5(), vec![0.0; 6]),
        (robots::rh0_right_leg(), with(2, 0.0)),
        (robots::rh0_left_leg(), vec![0.0; 6]),
        (robots::nao_left_leg(), with(3, 0.0)),
        (robots::nao_left_leg(), vec![0.0; 6]),
        (robots::nao_right_leg(), vec![0.0; 6]),
        (robots::teo_leg(), vec![0.0; 6]),
        (robots::nao_left_arm(), vec![0.0; 5]),
        (robots::polar(), vec![0.3, 0.4, 0.0]),
        (robots::polar(), vec![0.3, PI / 2.0, 0.5]),
    ]
}

#[test]
fn no_singular_pose_is_without_answers() {
    for (chain, q) in singular() {
        let solver = ScrewSolver::new(&chain).unwrap();
        let target = Target::reached(&chain, &q).unwrap();
        let answers = solver.solve(&target).unwrap();
        assert!(!answers.is_empty(), "{} at {q:?}", chain.name());
        check_answers(&solver, &target, &answers).unwrap();
    }
}

#[test]
fn poses_near_singular_ones_keep_their_answers() {
    for (chain, centre) in singular() {
        let solver = ScrewSolver::new(&chain).unwrap();
        for joint in 0..centre.len() {
            for exponent in 1..=16 {
                for sign in [-1.0, 1.0] {
                    let mut q = centre.clone();
                    q[joint] += sign * 10_f64.powi(-exponent);
                    let target = Target::reached(&chain, &q).unwrap();
                    let answers = solver.solve(&target).unwrap();
                    let at = format!("{} at {q:?}", chain.name());
                    assert!(!answers.is_empty(), "{at}");
                    let worst = worst_residual(&chain, &target, &answers);
                    assert!(worst <= 2e-12, "{at}: residual {worst:e}");
                }
            }
        }
    }
}

#[test]
fn a_free_joint_is_reported_and_any_value_solves() {
    // The wrist is stretched: theta4 and theta6 rotate about one line.
    let solver = ScrewSolver::new(&robots::puma()).unwrap();
    let mut q = vec![0.4, -0.7, 1.1, 0.6, PI / 2.0, -0.5];
    let axis = |i: usize| robots::puma().screws()[i].axis().unwrap().direction();
    // PUMA's sixth axis is z, its fourth y, its fifth x: a quarter turn of the fifth makes them parallel.
    assert!((axis(3).y - 1.0).abs() + (axis(5).z - 1.0).abs() < 1e-15);
    for quarter in [PI / 2.0, -PI / 2.0] {
        q[4] = quarter;
        let target = Target::reached(solver.chain(), &q).unwrap();
        let answers = solver.solve(&target).unwrap();
        check_answers(&solver, &target, &answers).unwrap();
        let free: Vec<_> = answers.iter().filter(|answer| !answer.free.is_empty()).collect();
        assert!(!free.is_empty() && free.iter().all(|answer| answer.free == [3]), "{answers:?}");
        for answer in free {
            for value in [-2.0, 0.3, 1.0, 3.0] {
                let turned = |back: f64| {
                    let mut q = answer.q.clone();
                    (q[3], q[5]) = (value, q[5] + back * value);
                    let reached = Solution { q, ..answer.clone() };
                    worst_residual(solver.chain(), &target, &[reached])
                };
                assert!(turned(1.0).min(turned(-1.0)) < 1e-12);
            }
        }
    }
}

#[test]
fn poses_out_of_reach_have_no_answer() {
    each_robot(100, |solver, q| {
        let chain = solver.chain();
        if chain.name() == robots::nao_head().name() || chain.joints().len() == 3 {
            return Ok(());
        }
        let Target::Pose(pose) = Target::reached(chain, q).unwrap() else { return Ok(()) };
        let far = Translation3::new(3.0 * reach(chain), 0.0, 0.0) * pose;
        let slides = chain.screws().iter().any(|screw| screw.axis().is_none());
        let answers = solver.solve(&Target::Pose(far)).unwrap();
        prop_assert!(slides || answers.is_empty(), "{answers:?}");
        Ok(())
    });
}

#[test]
fn bad_targets_are_refused() {
    let solver = ScrewSolver::new(&robots::puma()).unwrap();
    let pose = robots::puma().base_from_tip();
    let kind = |target: Target| solver.solve(&target).map_err(|error| error.kind());
    let bad = Err(groebot_robot::ErrorKind::BadValue);
    assert_eq!(kind(Target::Position([0.0; 3].into())), bad);
    assert_eq!(kind(Target::PlanarPose([0.0; 3])), bad);
    assert_eq!(kind(Target::Pose(Translation3::new(f64::NAN, 0.0, 0.0) * pose)), bad);
    let stretched = UnitQuaternion::new_unchecked(Quaternion::new(1.0, 0.0, 0.0, 0.1));
    assert_eq!(kind(Target::Pose(Pose::from_parts(pose.translation, stretched))), bad);
    let nan = UnitQuaternion::new_unchecked(Quaternion::new(f64::NAN, 0.0, 0.0, 0.0));
    assert_eq!(kind(Target::Pose(Pose::from_parts(pose.translation, nan))), bad);
}
