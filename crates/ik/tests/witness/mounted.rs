//! Arms on bases that are rotated by angles with irrational sines. The axes keep their relations, and the solvers find all solutions.

use groebot_ik::Watch;
use groebot_ik::derive::Derivation;
use groebot_ik::witness::Options;
use groebot_ik::witness::chain::check_chain;
use groebot_robot::kinematics::{Chain, Geometry};
use groebot_robot::model::Robot;

const KR6: &str = include_str!("../../../../tests/corpus/urdf/kr6_r900.urdf");

/// The arm on a base with this roll, pitch and yaw.
fn mounted(rpy: &str) -> Chain {
    let (first, rest) = KR6.split_once("rpy=\"0 0 0\"").unwrap();
    Robot::from_urdf(&format!("{first}rpy=\"{rpy}\"{rest}")).unwrap().chain(None, None).unwrap()
}

#[test]
fn an_arm_on_a_turned_base_is_solved() {
    let straight = Geometry::of(&mounted("0 0 0"));
    for rpy in ["0 0 0.5235987755982988", "0 0 2.0943951", "0.785398 0 0", "0.5236 0 0", "0.785398 0.523599 0"] {
        let chain = mounted(rpy);
        let geometry = Geometry::of(&chain);
        assert_eq!(geometry.parallel, straight.parallel, "{rpy}");
        assert_eq!(geometry.meeting.len(), straight.meeting.len(), "{rpy}");
        for pair in [[0, 1], [3, 4], [4, 5]] {
            let [a, b] = pair.map(|joint| &chain.joints()[joint].axis);
            let product: groebot_algebra::number::BigRational = a.iter().zip(b).map(|(x, y)| x * y).sum();
            assert_eq!(product, Default::default(), "{rpy}: axes {pair:?} are exactly perpendicular");
        }
        let derived = Derivation::sequentially(&chain, &Watch::none()).unwrap();
        let options = Options { targets: 80, oracle: 1, exact: 6, seed: 4, ..Options::default() };
        let report = check_chain(&chain, derived.program(), derived.dimension(), &options, &Watch::none()).unwrap();
        let failures: Vec<String> = report.failures().map(|row| row.to_string()).collect();
        assert!(failures.is_empty(), "{rpy}: {}", failures.join("\n"));
        assert_eq!(report.summary().exact, 6, "{rpy}");
    }
}
