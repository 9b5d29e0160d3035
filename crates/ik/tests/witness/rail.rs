//! Arms on rails that are longer than the arms.

use std::f64::consts::FRAC_PI_2;

use groebot_ik::Watch;
use groebot_ik::derive::Derivation;
use groebot_robot::kinematics::Chain;

const RAIL: &str = r#"
name = "rail"
source = "made for this test"
task = { kind = "ray" }
tip = { point = [0.1, 0, 1.5] }
joint = [
    { name = "Rail", type = "prismatic", axis = [0, 1, 0], point = [0, 0, 0], limits = [0, 6.3] },
    { name = "Yaw", type = "revolute", axis = [0, 0, 1], point = [0, 0, 0.3] },
    { name = "Shoulder", type = "revolute", axis = [0, 1, 0], point = [0.1, 0, 0.4] },
    { name = "Elbow", type = "revolute", axis = [0, 1, 0], point = [0.1, 0, 0.9] },
    { name = "Wrist", type = "revolute", axis = [0, 1, 0], point = [0.1, 0, 1.3] },
]
"#;

/// Where the arm is parallel to the rail, the prismatic joint is free. A target at the far end is reachable only from there.
#[test]
fn an_arm_along_its_rail_is_solved_at_both_ends() {
    let chain = Chain::from_toml(RAIL).unwrap();
    let derived = Derivation::sequentially(&chain, &Watch::none()).unwrap();
    let solver = derived.program().solver();
    for place in [0.2, 1.5, 3.0, 4.5, 6.1] {
        for elbow in [-2.0, -0.5, 0.7, 1.9] {
            let q = [place, -FRAC_PI_2, 0.4 * place - 1.0, elbow, 0.6];
            let target = derived.reached(&q).unwrap();
            let answers = solver.solve_numbers(&target).unwrap();
            assert!(answers.iter().any(|answer| answer.free.contains(&0)), "{q:?}: {answers:?}");
            for answer in answers {
                let reached = derived.reached(&answer.q).unwrap();
                let miss = reached.iter().zip(&target).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(miss < 1e-11, "{q:?}: {answer:?} misses by {miss:e}");
            }
        }
    }
}
