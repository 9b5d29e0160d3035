//! Seven joints of which the first or the last is given, revolute or prismatic. The six others are found together for every given value.

use groebot_ik::Watch;
use groebot_ik::derive::Derivation;
use groebot_ik::derive::planner::joints_to_give;
use groebot_ik::witness::Options;
use groebot_ik::witness::chain::check_chain;
use groebot_robot::kinematics::{Chain, ChainParts, Joint, Mimic, Task, along_z};

use super::rational;

/// A vertical arm of seven joints whose axes miss each other by millimetres.
pub const ARM: &str = include_str!("../../../../derivations/gen3_like/0_chain.toml");

pub fn with_given(text: &str, joint: &str) -> Chain {
    Chain::from_toml(text).unwrap().with_task(Task::Pose, along_z(), vec![joint.to_owned()]).unwrap()
}

/// Same arm, but on a rail, or with a prismatic joint at its end.
pub fn slid(joint: &str) -> String {
    let (head, tail) = ARM.split_at(ARM.find(&format!("name = \"{joint}\"")).unwrap());
    let mut slid = head.to_owned() + &tail.replacen("type = \"revolute\"", "type = \"prismatic\"", 1);
    let at = head.len();
    let axis = slid[at..].find("axis = ").unwrap() + at;
    let end = slid[axis..].find('\n').unwrap() + axis;
    slid.replace_range(axis..end, "axis = [1, 2, 2]");
    slid
}

#[test]
fn an_end_joint_is_given() {
    let rail = slid("Joint1");
    let quill = slid("Joint7");
    for (text, joint) in [(ARM, "Joint1"), (ARM, "Joint7"), (&rail, "Joint1"), (&quill, "Joint7")] {
        let chain = with_given(text, joint);
        let derived = Derivation::by_eigenvalues(&chain, &Watch::none()).unwrap();
        assert_eq!(derived.eigenvalue().unwrap().method.six.joints().len(), 6);
        let options = Options { targets: 60, oracle: 1, exact: 4, seed: 3, ..Options::default() };
        let report = check_chain(&chain, derived.program(), derived.dimension(), &options, &Watch::none()).unwrap();
        let failures: Vec<String> =
            report.failures().filter(|row| !row.is_weak_spot()).map(|r| r.to_string()).collect();
        assert!(failures.is_empty(), "{joint}: {}", failures.join("\n"));
        assert!(report.rows.iter().filter(|row| row.solutions > 2).count() > 20, "{}", report.summary());
        let again = Derivation::prove(&chain, &derived.certificate().unwrap()).unwrap();
        assert_eq!(again.program(), derived.program());
    }
}

/// An arm of seven joints with a finger, whose pad follows its knuckle. The joints with the best shares alone do not leave six consecutive joints.
#[test]
fn joints_at_the_ends_are_chosen_where_no_others_will_do() {
    let mut parts: ChainParts = Chain::from_toml(ARM).unwrap().into();
    let finger = |name: &str, by: i64, mimic| Joint {
        name: name.to_owned(),
        symbol: name.to_owned(),
        mimic,
        point: [rational(by, 100), rational(0, 1), &parts.tip.point[2] + rational(by, 100)],
        axis: [1, 0, 0].map(|entry| rational(entry, 1)),
        ..parts.joints[6].clone()
    };
    let law = Mimic { leader: "knuckle".to_owned(), multiplier: rational(-1, 1), offset: rational(0, 1) };
    let fingers = [finger("knuckle", 3, None), finger("pad", 5, Some(law))];
    parts.joints.extend(fingers);
    parts.given.clear();
    let choice = joints_to_give(&Chain::new(parts).unwrap(), &Watch::none()).unwrap().unwrap();
    assert_eq!(choice.given, ["Joint7", "knuckle"]);
}
