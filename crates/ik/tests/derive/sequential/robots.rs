//! All robots of `groebot_robot::robots` at random poses, compared with the generating joints and with the screw solver.

use std::time::{Duration, Instant};

use groebot_robot::kinematics::Target;
use groebot_robot::kinematics::screw::ScrewSolver;
use groebot_robot::robots;

use super::{Random, derive, distance, miss};

const POSES: usize = 200;

#[test]
fn answers_are_complete_exact_and_as_many_as_the_screw_solver_s() {
    for robot in robots::ALL {
        let chain = robot.chain();
        let start = Instant::now();
        let derived = derive(&chain);
        let time = start.elapsed();
        let solver = derived.program().solver();
        let screws = ScrewSolver::new(&chain).unwrap();
        let mut random = Random(7);
        let mut running = Duration::ZERO;
        for pose in 0..POSES {
            let q = random.joints(&chain);
            let target = derived.reached(&q).unwrap();
            let start = Instant::now();
            let answers = solver.solve_numbers(&target).unwrap();
            running += start.elapsed();
            let place = format!("{} pose {pose} {q:?}: {answers:?}", robot.name());
            assert!(answers.iter().any(|answer| distance(&chain, &answer.q, &q, &answer.free) < 1e-9), "{place}");
            assert!(answers.iter().all(|answer| miss(&derived, &target, answer) <= 1e-12), "{place}");
            assert!(answers.len() <= derived.dimension().unwrap(), "{place}");
            let expected = screws.solve(&Target::reached(&chain, &q).unwrap()).unwrap();
            assert_eq!(answers.len(), expected.len(), "{place}\n{expected:?}");
        }
        let each = running / POSES as u32;
        println!(
            "{}: derived in {time:?}, solved in {each:?}, {}",
            robot.name(),
            derived.sequential().unwrap().method.plan
        );
    }
}
