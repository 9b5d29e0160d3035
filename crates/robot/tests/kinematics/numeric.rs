//! The numeric solver, compared with the screw solver and forward kinematics.

use groebot_robot::ErrorKind;
use groebot_robot::kinematics::numeric::NumericSolver;
use groebot_robot::kinematics::screw::ScrewSolver;
use groebot_robot::kinematics::{Chain, Solution, Target, Task};
use groebot_robot::robots;
use groebot_robot::spatial::angle;

/// Whether the two lists have the same solutions.
fn are_same(chain: &Chain, a: &[Solution], b: &[Solution]) -> bool {
    let off = |joint: usize, x: f64, y: f64| {
        let turns = chain.joints()[joint].kind == groebot_robot::kinematics::JointKind::Revolute;
        if turns { angle::difference(x, y).abs() } else { (x - y).abs() }
    };
    let near = |a: &Solution, b: &Solution| a.q.iter().zip(&b.q).enumerate().all(|(i, (x, y))| off(i, *x, *y) < 1e-6);
    let holds = |a: &[Solution], b: &[Solution]| a.iter().all(|a| b.iter().any(|b| near(a, b)));
    holds(a, b) && holds(b, a)
}

#[test]
fn it_finds_what_the_screw_solver_finds() {
    for name in ["ur5", "puma", "stanford", "polar", "nao_left_leg", "irb120"] {
        let chain = robots::by_name(name).unwrap();
        let (numeric, screws) = (NumericSolver::new(&chain).unwrap(), ScrewSolver::new(&chain).unwrap());
        for k in 0..6 {
            let wave = |joint: usize| ((3 * k + 7 * joint) as f64).sin();
            let q: Vec<f64> = (0..chain.joints().len()).map(wave).collect();
            let target = Target::reached(&chain, &q).unwrap();
            let found = numeric.solve(&target, &[]).unwrap();
            assert!(found.iter().all(|answer| answer.residual < 1e-10));
            assert!(are_same(&chain, &found, &screws.solve(&target).unwrap()), "{name} at {q:?}: {found:?}");
        }
    }
}

#[test]
fn given_joints_stay_where_they_are_given() {
    let chain = robots::by_name("ur5").unwrap();
    let wrist = chain.joints()[3..].iter().map(|joint| joint.name.clone()).collect();
    let chain = chain.with_task(Task::Position, chain.direction().clone(), wrist).unwrap();
    let q = [0.3, -1.0, 0.8, 0.4, 1.1, 0.0];
    let target = Target::reached(&chain, &q).unwrap();
    let found = NumericSolver::new(&chain).unwrap().solve(&target, &q[3..]).unwrap();
    assert!(found.iter().all(|answer| answer.q[3..] == q[3..]), "{found:?}");
    assert!(found.iter().any(|answer| answer.q.iter().zip(q).all(|(x, y)| (x - y).abs() < 1e-8)), "{found:?}");
}

#[test]
fn what_is_no_target_is_refused() {
    let chain = robots::by_name("ur5").unwrap();
    let solver = NumericSolver::new(&chain).unwrap();
    let kind = |target: &Target, given: &[f64]| solver.solve(target, given).unwrap_err().kind();
    assert_eq!(kind(&Target::Position([0.1, 0.2, 0.3].into()), &[]), ErrorKind::BadValue);
    let reached = Target::reached(&chain, &[0.1; 6]).unwrap();
    assert_eq!(kind(&reached, &[0.5]), ErrorKind::BadValue);
    let position = chain.with_task(Task::Position, chain.direction().clone(), Vec::new()).unwrap();
    assert_eq!(NumericSolver::new(&position).unwrap_err().kind(), ErrorKind::PositiveDimensional);
    let nowhere = Target::Pose(groebot_robot::spatial::Pose::translation(9.0, 0.0, 0.0));
    assert_eq!(solver.solve(&nowhere, &[]).unwrap(), []);
}
