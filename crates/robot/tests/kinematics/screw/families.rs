//! The screw solver on random chains of each family that it must solve, not only on known robots.

use groebot_algebra::number::BigRational;
use groebot_robot::kinematics::screw::ScrewSolver;
use groebot_robot::kinematics::{
    Chain, ChainParts, ExactVector, Joint, JointKind, LengthUnit, Plane, Target, Task, Tip, along_z,
};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed, TestRunner};

use super::solver::{configurations, distance, matching, sigma, worst_residual};

type Vector = [i64; 3];

/// A vector with entries in hundredths.
fn vector() -> impl Strategy<Value = Vector> {
    [-100_i64..=100, -100..=100, -100..=100]
}

/// A direction that is not too short.
fn direction() -> impl Strategy<Value = Vector> {
    vector().prop_filter("short", |v| v.iter().map(|x| x * x).sum::<i64>() > 400)
}

fn exact(v: &Vector) -> ExactVector {
    v.map(|x| BigRational::new(x.into(), 100.into()))
}

/// A joint with its axis and a point; a prismatic joint has no point.
type Placed = (Vector, Option<Vector>);

fn chain(joints: &[Placed], tip: Vector, task: Task) -> Chain {
    let joint = |(index, (axis, point)): (usize, &Placed)| Joint {
        mimic: None,
        name: format!("joint{}", index + 1),
        symbol: (index + 1).to_string(),
        kind: if point.is_some() { JointKind::Revolute } else { JointKind::Prismatic },
        axis: exact(axis),
        point: exact(&point.unwrap_or_default()),
        limits: None,
    };
    let one = |i: usize, j: usize| BigRational::from_integer(i64::from(i == j).into());
    Chain::new(ChainParts {
        name: "random".into(),
        description: None,
        source: None,
        length_unit: LengthUnit::Metre,
        joints: joints.iter().enumerate().map(joint).collect(),
        tip: Tip { point: exact(&tip), rotation: [0, 1, 2].map(|i| [0, 1, 2].map(|j| one(i, j))) },
        task,
        direction: along_z(),
        given: Vec::new(),
        order: None,
        choice: None,
        meant: None,
    })
    .unwrap()
}

/// Checks 4 configurations of each of `cases` random chains.
fn check(name: &str, cases: u32, chains: impl Strategy<Value = Chain>, most: usize) {
    let inputs = chains.prop_flat_map(|chain| {
        let q = proptest::collection::vec(configurations(&chain), 4);
        (Just(chain), q)
    });
    // The same chains each time. Near singular poses residuals reach some 1e-12, and one run in fifty would exceed the
    // limit.
    let config = Config { max_shrink_iters: 50, rng_seed: RngSeed::Fixed(5), ..Config::with_cases(cases) };
    let mut runner = TestRunner::new(config);
    let outcome = runner.run(&inputs, |(chain, configurations)| {
        let solver = match ScrewSolver::new(&chain) {
            Ok(solver) => solver,
            Err(error) => return Err(TestCaseError::fail(format!("{error}"))),
        };
        prop_assert!(solver.plan().most_solutions() <= most, "{}", solver.plan());
        for q in configurations {
            let target = Target::reached(&chain, &q).unwrap();
            let answers = solver.solve(&target).unwrap();
            let near = answers.iter().map(|answer| distance(&chain, &q, &answer.q)).fold(f64::INFINITY, f64::min);
            let sigma = sigma(&chain, &q, matches!(target, Target::Pose(_)));
            prop_assert!(near <= matching(sigma), "{q:?} missed by {near:e} (sigma {sigma:e}); {}", solver.plan());
            let worst = worst_residual(&chain, &target, &answers);
            prop_assert!(worst <= 2e-12, "residual {worst:e}");
        }
        Ok(())
    });
    if let Err(error) = outcome {
        panic!("{name}: {error}");
    }
}

/// `count` joints at any position.
fn anywhere(count: usize) -> impl Strategy<Value = Vec<Placed>> {
    proptest::collection::vec((direction(), vector().prop_map(Some)), count)
}

/// Three joints with intersecting axes.
fn wrist() -> impl Strategy<Value = Vec<Placed>> {
    ([direction(), direction(), direction()], vector())
        .prop_filter("parallel neighbours", |(w, _)| apart(&w[0], &w[1]) && apart(&w[1], &w[2]))
        .prop_map(|(w, point)| w.map(|w| (w, Some(point))).to_vec())
}

/// Whether two directions are at least a few degrees apart.
fn apart(a: &Vector, b: &Vector) -> bool {
    let dot: i64 = a.iter().zip(b).map(|(x, y)| x * y).sum();
    let square = |v: &Vector| v.iter().map(|x| x * x).sum::<i64>();
    (dot as f64).powi(2) < 0.95 * (square(a) * square(b)) as f64
}

/// `count` joints with parallel axes.
fn parallel(count: usize) -> impl Strategy<Value = Vec<Placed>> {
    (direction(), proptest::collection::vec(vector(), count))
        .prop_map(|(w, points)| points.into_iter().map(|point| (w, Some(point))).collect())
}

/// Joints that are revolute (true) or prismatic, at any position.
fn mixed(kinds: Vec<bool>) -> impl Strategy<Value = Vec<Placed>> {
    let joints = kinds
        .into_iter()
        .map(|turns| (direction(), vector()).prop_map(move |(axis, point)| (axis, turns.then_some(point))));
    joints.collect::<Vec<_>>()
}

fn poses(joints: impl Strategy<Value = Vec<Placed>>) -> impl Strategy<Value = Chain> {
    (joints, vector()).prop_map(|(joints, tip)| chain(&joints, tip, Task::Pose))
}

fn joined(
    a: impl Strategy<Value = Vec<Placed>>,
    b: impl Strategy<Value = Vec<Placed>>,
) -> impl Strategy<Value = Vec<Placed>> {
    (a, b).prop_map(|(a, b)| [a, b].concat())
}

#[test]
fn any_three_joints_before_a_spherical_wrist() {
    check("wrist", 100, poses(joined(anywhere(3), wrist())), 8);
}

#[test]
fn any_three_joints_after_a_spherical_hip() {
    check("hip", 100, poses(joined(wrist(), anywhere(3))), 8);
}

#[test]
fn three_axes_that_meet_anywhere_in_the_chain() {
    check("second to fourth", 50, poses(joined(joined(anywhere(1), wrist()), anywhere(2))), 8);
    check("third to fifth", 50, poses(joined(joined(anywhere(2), wrist()), anywhere(1))), 8);
}

#[test]
fn three_parallel_axes_anywhere_in_the_chain() {
    check("first to third", 50, poses(joined(parallel(3), anywhere(3))), 8);
    check("second to fourth", 50, poses(joined(joined(anywhere(1), parallel(3)), anywhere(2))), 8);
    check("third to fifth", 50, poses(joined(joined(anywhere(2), parallel(3)), anywhere(1))), 8);
    check("fourth to sixth", 50, poses(joined(anywhere(3), parallel(3))), 8);
}

#[test]
fn three_parallel_pairs() {
    check("pairs", 100, poses(joined(joined(parallel(2), parallel(2)), parallel(2))), 16);
}

#[test]
fn prismatic_joints_before_a_wrist() {
    for kinds in 0..7 {
        let turns: Vec<bool> = (0..3).map(|joint| kinds >> joint & 1 == 1).collect();
        check(&format!("{turns:?}"), 40, poses(joined(mixed(turns.clone()), wrist())), 8);
    }
}

#[test]
fn a_position_by_three_joints() {
    for kinds in 0..8 {
        let turns: Vec<bool> = (0..3).map(|joint| kinds >> joint & 1 == 1).collect();
        let chains = (mixed(turns.clone()), vector()).prop_map(|(joints, tip)| chain(&joints, tip, Task::Position));
        check(&format!("{turns:?}"), 40, chains, 4);
    }
}

#[test]
fn fewer_than_six_joints_for_a_pose() {
    check("two joints", 50, poses(anywhere(2)), 1);
    check("four joints, two of them meeting", 50, poses(joined(anywhere(1), wrist())), 4);
    check("five joints", 50, poses(joined(anywhere(2), wrist())), 8);
}

#[test]
fn a_planar_arm() {
    let joint = |(x, y): (i64, i64)| ([0, 0, 100], Some([x, y, 0]));
    let points = proptest::collection::vec((-100_i64..=100, -100_i64..=100), 3);
    let chains = (points, -100_i64..=100, -100_i64..=100).prop_map(move |(points, x, y)| {
        let joints: Vec<Placed> = points.into_iter().map(joint).collect();
        chain(&joints, [x, y, 0], Task::PlanarPose { plane: Plane::Xy })
    });
    check("planar", 100, chains, 2);
}

#[test]
fn a_chain_in_general_position_is_refused() {
    let mut runner = TestRunner::new(Config::with_cases(20));
    let outcome = runner.run(&poses(anywhere(6)), |chain| {
        let error = ScrewSolver::new(&chain).err().map(|error| error.kind());
        prop_assert_eq!(error, Some(groebot_robot::ErrorKind::Unsupported));
        Ok(())
    });
    outcome.unwrap();
}

#[test]
fn two_parallel_pairs_alone_are_refused() {
    let mut runner = TestRunner::new(Config::with_cases(10));
    let chains = poses(joined(joined(parallel(2), parallel(2)), anywhere(2)));
    let outcome = runner.run(&chains, |chain| {
        let Err(error) = ScrewSolver::new(&chain) else { return Err(TestCaseError::fail("solved")) };
        prop_assert_eq!(error.kind(), groebot_robot::ErrorKind::Unsupported);
        prop_assert!(error.message().contains("axes 1, 2 are parallel, axes 3, 4 are parallel"), "{}", error);
        Ok(())
    });
    outcome.unwrap();
}
