//! A position with pitch and roll for any yaw. The loop that replaces the target closes at the arm's joint values. Solvers of arms with a vertical first axis,
//! up or down and at any point, find the joint values that made each target.

use groebot_algebra::number::{BigRational, parse_rational};
use groebot_ik::derive::{ChainProblem, Derivation};
use groebot_ik::witness::chain::check_chain;
use groebot_ik::witness::{Options, Report as Checked};
use groebot_ik::{ErrorKind, Watch};
use groebot_robot::kinematics::Target;
use groebot_robot::kinematics::ideal::Report;
use groebot_robot::kinematics::{Chain, ChainParts, Task, along_z};

/// An arm of five joints: one about a vertical, three parallel ones, and a roll. Its tip is rotated and not on the last axis.
fn arm(first: [&str; 3], at: [&str; 3]) -> Chain {
    let joint = |name: &str, axis: [&str; 3], point: [&str; 3]| {
        let quoted = |vector: [&str; 3]| vector.map(|x| format!("\"{x}\"")).join(", ");
        format!(
            "[[joint]]\nname = \"{name}\"\ntype = \"revolute\"\naxis = [{}]\npoint = [{}]\n",
            quoted(axis),
            quoted(point)
        )
    };
    let joints = [
        joint("base", first, at),
        joint("shoulder", ["0", "1", "0"], ["0.03", "0", "0.1"]),
        joint("elbow", ["0", "1", "0"], ["0.03", "0", "0.25"]),
        joint("wrist", ["0", "1", "0"], ["0.03", "0", "0.38"]),
        joint("roll", ["0", "0", "1"], ["0.03", "0", "0.45"]),
    ];
    let tip = "[tip]\npoint = [0.05, 0.02, 0.55]\nrpy_deg = [90, 0, 90]\n";
    Chain::from_toml(&format!("name = \"arm\"\n[task]\nkind = \"position_pitch_roll\"\n{}{tip}", joints.concat()))
        .unwrap()
}

fn check(chain: &Chain, derived: &Derivation) -> Checked {
    let options = Options { targets: 100, oracle: 3, ..Options::default() };
    check_chain(chain, derived.program(), derived.dimension(), &options, &Watch::none()).unwrap()
}

#[test]
fn the_loop_closes_where_the_arm_stands() {
    for chain in [arm(["0", "0", "1"], ["0", "0", "0"]), arm(["0", "0", "-2"], ["0.2", "-0.1", "0.3"])] {
        let upright = chain.upright().unwrap();
        for at in 0..50 {
            let q: Vec<f64> = (0..5).map(|joint| (f64::from(at * 5 + joint) * 0.731).sin() * 3.1).collect();
            let target = Target::reached(&chain, &q).unwrap();
            let (_, given) = upright.loop_target(&target, &[]).unwrap();
            // The loop's rotation may have any value that closes the loop.
            let pose = chain.forward(&q).unwrap();
            let (_, _, yaw) = pose.rotation.euler_angles();
            let [x, y] = upright.axis.clone().map(|x| num_traits::ToPrimitive::to_f64(&x).unwrap());
            let tip = pose.translation.vector;
            let azimuth = (tip.y - y).atan2(tip.x - x);
            let first = if upright.is_down { -q[0] } else { q[0] };
            let values = [&q[1..], &given[..2], &[azimuth - yaw], &given[2..], &[first - azimuth]].concat();
            let closed = upright.chain.forward(&values).unwrap();
            assert!((closed.to_homogeneous() - nalgebra::Matrix4::identity()).norm() < 1e-13, "{at}: {closed}");
            let again = upright.answer(&target, &values);
            assert!(again.iter().zip(&q).all(|(a, b)| groebot_robot::spatial::angle::difference(*a, *b).abs() < 1e-13));
        }
    }
}

#[test]
fn arms_are_solved_for_position_with_pitch_and_roll() {
    for chain in [arm(["0", "0", "1"], ["0", "0", "0"]), arm(["0", "0", "-1"], ["0.2", "-0.1", "0.3"])] {
        let derived = Derivation::sequentially(&chain, &Watch::none()).unwrap();
        assert_eq!(derived.dimension().unwrap(), 8);
        let inputs: Vec<&str> = derived.program().inputs.iter().map(|input| input.name.as_str()).collect();
        assert_eq!(inputs, ["px", "py", "pz", "pitch", "roll"]);
        let checked = check(&chain, &derived);
        let wrong: Vec<_> = checked.failures().filter(|row| !row.is_weak_spot()).collect();
        assert!(wrong.is_empty(), "{wrong:?}");
        assert!(checked.rows.iter().filter(|row| row.screw.is_some()).count() == checked.rows.len());
    }
}

#[test]
fn a_described_arm_is_polished() {
    let meant = arm(["0", "0", "1"], ["0", "0", "0"]);
    let mut parts: ChainParts = meant.clone().into();
    parts.joints[2].axis[0] = parse_rational("3e-8").unwrap();
    parts.joints[0].axis[1] = parse_rational("-2e-8").unwrap();
    let described = Chain::new(parts).unwrap();
    let (ideal, report): (Chain, Report) = described.ideal();
    assert_eq!(ideal.joints()[0].axis[1], BigRational::default());
    let derived = Derivation::sequentially(ChainProblem::ideal((ideal, report), &described), &Watch::none()).unwrap();
    let checked = check(&described, &derived);
    let wrong: Vec<_> = checked.failures().filter(|row| !row.is_weak_spot()).collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}

#[test]
fn arms_that_do_not_turn_about_a_vertical_are_refused() {
    let asked = |chain: &Chain, given: Vec<String>| chain.with_task(Task::PositionPitchRoll, along_z(), given).unwrap();
    let tilted = asked(&arm(["0", "1", "1"], ["0", "0", "0"]), Vec::new());
    let held = asked(&arm(["0", "0", "1"], ["0", "0", "0"]), vec!["base".into()]);
    for chain in [tilted, held] {
        let error = chain.upright().unwrap_err();
        assert!(
            error.kind() == ErrorKind::Unsupported
                && error.message().contains("first joint rotates about the base's z"),
            "{error}"
        );
        assert_eq!(Derivation::sequentially(&chain, &Watch::none()).unwrap_err().kind(), ErrorKind::Unsupported);
    }
}
