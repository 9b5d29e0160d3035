//! Solvers of chains with joints that follow others: an arm with a finger whose opening is given, and a finger that is found.

use groebot_algebra::number::BigRational;
use groebot_ik::derive::Derivation;
use groebot_ik::witness::Options;
use groebot_ik::witness::chain::check_chain;
use groebot_ik::{ErrorKind, Watch};
use groebot_robot::kinematics::{Chain, ChainParts, Joint, JointKind, Mimic, Plane, Task, Tip, along_z};
use groebot_robot::robots;

fn exact(text: &str) -> BigRational {
    groebot_algebra::number::parse_rational(text).unwrap()
}

fn turning(name: &str, axis: [&str; 3], point: [&str; 3], mimic: Option<Mimic>) -> Joint {
    Joint {
        name: name.into(),
        symbol: name.into(),
        kind: JointKind::Revolute,
        axis: axis.map(exact),
        point: point.map(exact),
        limits: None,
        mimic,
    }
}

fn follows(leader: &str, multiplier: &str, offset: &str) -> Option<Mimic> {
    Some(Mimic { leader: leader.into(), multiplier: exact(multiplier), offset: exact(offset) })
}

/// Checks the chain's solver at targets of all kinds by independent witnesses. Generating joint values obey the laws.
fn holds(chain: &Chain) {
    let derived = Derivation::sequentially(chain, &Watch::none()).unwrap();
    let options = Options { targets: 60, oracle: 2, ..Options::default() };
    let report = check_chain(chain, derived.program(), None, &options, &Watch::none()).unwrap();
    let wrong: Vec<_> = report.failures().filter(|row| !row.is_weak_spot()).collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}

#[test]
fn an_arm_is_solved_to_a_finger_whose_opening_is_given() {
    let arm = robots::puma();
    let tip = arm.tip().point.clone();
    let shifted = |by: &str| [tip[0].clone(), tip[1].clone(), &tip[2] + exact(by)];
    let finger =
        |name: &str, by: &str, mimic| Joint { point: shifted(by), ..turning(name, ["1", "0", "0"], ["0"; 3], mimic) };
    let mut parts: ChainParts = arm.clone().into();
    parts.joints.extend([finger("knuckle", "1/10", None), finger("pad", "3/20", follows("knuckle", "-3/4", "1/5"))]);
    parts.tip = Tip { point: shifted("9/50"), ..parts.tip };
    let open = Chain::new(parts.clone()).unwrap();
    assert_eq!(Derivation::sequentially(&open, &Watch::none()).unwrap_err().kind(), ErrorKind::Unsupported);
    parts.given = vec!["knuckle".into()];
    holds(&Chain::new(parts).unwrap());
}

#[test]
fn a_finger_of_two_joints_is_found_where_its_tip_can_be() {
    for (multiplier, offset) in [("-1", "0"), ("1", "0"), ("2", "3/10")] {
        let joints = vec![
            turning("a", ["0", "1", "0"], ["0"; 3], None),
            turning("b", ["0", "1", "0"], ["0", "0", "1/20"], follows("a", multiplier, offset)),
        ];
        let chain = Chain::new(ChainParts {
            name: "finger".into(),
            joints,
            tip: Tip { point: ["1/100", "0", "9/100"].map(exact), ..robots::puma().tip().clone() },
            task: Task::PlanarPosition { plane: Plane::Xz },
            direction: along_z(),
            given: Vec::new(),
            order: None,
            choice: None,
            ..ChainParts::from(robots::puma())
        });
        holds(&chain.unwrap());
    }
}
