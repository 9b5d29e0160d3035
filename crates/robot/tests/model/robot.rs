//! Trees and the chains in them: NAO's five chains compared with the manufacturer's numbers, paths up and down,
//! refusals.

use groebot_robot::ErrorKind;
use groebot_robot::kinematics::{Chain, JointKind, Mimic, Placement, Task};
use groebot_robot::model::{Joint, JointType, Link, Robot, RobotParts};
use nalgebra::Vector3;
use proptest::prelude::*;

use super::exact;

pub const NAO: &str = include_str!("../../../../tests/corpus/urdf/nao.urdf");

fn nao() -> Robot {
    Robot::from_urdf(NAO).unwrap()
}

fn limb(tip: &str) -> Chain {
    nao().chain(Some("torso"), Some(tip)).unwrap()
}

/// Aldebaran, NAO technical documentation 2.1: the offset of each joint from the previous one in millimetres, and its
/// axis; left side.
const LEG: [(&str, [f64; 3], [f64; 3]); 6] = [
    ("HipYawPitch", [0.0, 50.0, -85.0], [0.0, std::f64::consts::FRAC_1_SQRT_2, -std::f64::consts::FRAC_1_SQRT_2]),
    ("HipRoll", [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
    ("HipPitch", [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
    ("KneePitch", [0.0, 0.0, -100.0], [0.0, 1.0, 0.0]),
    ("AnklePitch", [0.0, 0.0, -102.9], [0.0, 1.0, 0.0]),
    ("AnkleRoll", [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
];
const ARM: [(&str, [f64; 3], [f64; 3]); 5] = [
    ("ShoulderPitch", [0.0, 98.0, 100.0], [0.0, 1.0, 0.0]),
    ("ShoulderRoll", [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
    ("ElbowYaw", [105.0, 15.0, 0.0], [1.0, 0.0, 0.0]),
    ("ElbowRoll", [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
    ("WristYaw", [55.95, 0.0, 0.0], [1.0, 0.0, 0.0]),
];
const HEAD: [(&str, [f64; 3], [f64; 3]); 2] =
    [("HeadYaw", [0.0, 0.0, 126.5], [0.0, 0.0, 1.0]), ("HeadPitch", [0.0, 0.0, 0.0], [0.0, 1.0, 0.0])];

/// Compares a chain with its numbers. `side` is -1 on the right, where y is mirrored (and the axis of HipYawPitch with
/// it).
fn compare(chain: &Chain, prefix: &str, side: f64, figures: &[(&str, [f64; 3], [f64; 3])], last: [f64; 3]) {
    assert_eq!(chain.joints().len(), figures.len());
    let mut point = Vector3::zeros();
    for (joint, (name, offset, axis)) in chain.joints().iter().zip(figures) {
        assert_eq!(joint.name, format!("{prefix}{name}"));
        point += Vector3::new(offset[0], side * offset[1], offset[2]) / 1000.0;
        assert!((joint.location().coords - point).norm() < 1e-15, "{name}");
        let axis = if *name == "HipYawPitch" { [0.0, axis[1], side * axis[2]] } else { *axis };
        assert!((joint.direction().into_inner() - Vector3::from(axis)).norm() < 1e-15, "{name}");
    }
    let tip = point + Vector3::new(last[0], side * last[1], last[2]) / 1000.0;
    assert!((chain.base_from_tip().translation.vector - tip).norm() < 1e-15);
    assert_eq!(chain.task(), Task::Pose);
}

#[test]
fn naos_five_chains() {
    compare(&limb("l_sole"), "L", 1.0, &LEG, [0.0, 0.0, -45.19]);
    compare(&limb("r_sole"), "R", -1.0, &LEG, [0.0, 0.0, -45.19]);
    compare(&limb("l_hand"), "L", 1.0, &ARM, [57.75, 0.0, -12.31]);
    compare(&limb("r_hand"), "R", -1.0, &ARM, [57.75, 0.0, -12.31]);
    compare(&limb("Head"), "", 1.0, &HEAD, [0.0; 3]);
    let tree = nao();
    assert_eq!((tree.root(), tree.leaves()), ("base_link", vec!["Head", "l_sole", "r_sole", "l_hand", "r_hand"]));
    assert_eq!(tree.tips(), ["Head", "LFoot", "RFoot", "LWrist", "RWrist"]);
}

#[test]
fn naos_hip_axis_is_exact_and_its_follower_is_reported() {
    let hip = &limb("l_sole").joints()[0].axis.clone();
    assert_eq!(*hip, ["0", "1", "-1"].map(exact));
    let tree = nao();
    let path = tree.path(None, Some("r_sole")).unwrap();
    assert!(
        tree.notes(&path)[0].starts_with("RHipYawPitch: in the robot it follows LHipYawPitch, outside"),
        "{:?}",
        tree.notes(&path)
    );
    // From sole to sole, both joints are on the path.
    let both = tree.chain(Some("l_sole"), Some("r_sole")).unwrap();
    let places =
        ["LHipYawPitch", "RHipYawPitch"].map(|name| both.joints().iter().position(|joint| joint.name == name).unwrap());
    assert_eq!(both.leader(places[1]).map(|(leader, mimic)| (leader, mimic.law())), Some((places[0], [1.0, 0.0])));
    assert_eq!(both.leader(places[0]), None);
}

#[test]
fn limits_are_the_makers() {
    let degrees =
        |chain: &Chain, index: usize| chain.joints()[index].limits.map(|(a, b)| (a.to_degrees(), b.to_degrees()));
    let (low, high) = degrees(&limb("r_sole"), 3).unwrap();
    assert!((low + 5.90).abs() < 1e-7 && (high - 121.47).abs() < 1e-7);
    let (low, high) = degrees(&limb("l_hand"), 3).unwrap();
    assert!((low + 88.5).abs() < 1e-7 && (high + 2.0).abs() < 1e-7);
}

fn joint(name: &str, parent: &str, child: &str) -> Joint {
    Joint {
        origin: Placement::shifted(0, exact("0.25")).into(),
        axis: ["0", "0", "2"].map(exact),
        line: Some(7),
        ..Joint::new(name, JointType::Continuous, parent, child)
    }
}

fn robot(links: &[&str], joints: Vec<Joint>) -> groebot_robot::Result<Robot> {
    let links = links.iter().map(|name| Link::new(name)).collect();
    Robot::new(RobotParts { name: "r".into(), links, joints, ..RobotParts::default() })
}

fn refused(links: &[&str], joints: Vec<Joint>, kind: ErrorKind, words: &str) {
    let error = robot(links, joints).unwrap_err();
    assert_eq!(error.kind(), kind, "{error}");
    assert!(error.message().contains(words), "{error}");
}

#[test]
fn what_is_no_tree_is_refused() {
    use ErrorKind::{BadValue, DuplicateName, MissingKey, UnknownName};
    refused(&[], vec![], MissingKey, "no <link>");
    refused(&["a", "a"], vec![], DuplicateName, "link `a`");
    refused(&["a", "b", "c"], vec![joint("j", "a", "b"), joint("j", "b", "c")], DuplicateName, "joint `j`");
    refused(&["a", "b"], vec![joint("j", "a", "x")], UnknownName, "joint `j`: its child `x` is not a link");
    refused(&["a", "base"], vec![joint("j", "bass", "a")], UnknownName, "did you mean `base`?");
    refused(&["a", "b", "c"], vec![joint("j", "a", "b")], BadValue, "2 links have no parent joint: `a`, `c`");
    refused(&["a", "b"], vec![joint("j", "a", "b"), joint("k", "b", "a")], BadValue, "loop");
    refused(
        &["a", "b", "c"],
        vec![joint("j", "b", "c"), joint("k", "c", "b")],
        BadValue,
        "joint `j`: it is part of a loop",
    );
    refused(
        &["a", "b"],
        vec![joint("j", "a", "b"), joint("k", "a", "b")],
        BadValue,
        "joint `k`: its child `b` is already the child of joint `j`",
    );
    refused(&["a"], vec![joint("j", "a", "a")], BadValue, "loop");
    refused(&[" "], vec![], BadValue, "visible characters");
    let nameless = Robot::new(RobotParts { name: "r\n".into(), links: vec![Link::new("a")], ..RobotParts::default() })
        .unwrap_err();
    assert!(nameless.message().contains("the robot's name is `r\\n`"), "{nameless}");
}

#[test]
fn what_is_no_joint_is_refused() {
    use ErrorKind::{BadValue, UnknownName};
    let with = |change: &dyn Fn(&mut Joint)| {
        let mut joint = joint("j", "a", "b");
        change(&mut joint);
        vec![joint]
    };
    let follows = |name: &str| Some(Mimic { leader: name.into(), multiplier: exact("1"), offset: exact("0") });
    let links = &["a", "b"];
    refused(links, with(&|joint| joint.axis = ["0"; 3].map(exact)), BadValue, "no direction");
    refused(links, with(&|joint| joint.kind = JointType::Revolute), BadValue, "needs limits");
    refused(links, with(&|joint| joint.kind = JointType::Prismatic), BadValue, "needs limits");
    refused(links, with(&|joint| joint.limits = Some((2.0, 1.0))), BadValue, "inverted");
    refused(links, with(&|joint| joint.limits = Some((f64::NEG_INFINITY, 1.0))), BadValue, "not finite");
    refused(links, with(&|joint| joint.mimic = follows("k")), UnknownName, "mimics `k`, which is not a joint");
    refused(links, with(&|joint| joint.mimic = follows("j")), BadValue, "is a cycle");
}

/// Joints j0 to j(n-1) from the link l0; each follows the previous one.
fn followers(count: usize) -> groebot_robot::Result<Robot> {
    let links: Vec<String> = (0..=count).map(|i| format!("l{i}")).collect();
    let links: Vec<&str> = links.iter().map(String::as_str).collect();
    let follow = |i: usize| {
        let mut joint = joint(&format!("j{i}"), "l0", &format!("l{}", i + 1));
        let leader = format!("j{}", i.saturating_sub(1));
        joint.mimic = (i > 0).then(|| Mimic { leader, multiplier: exact("1"), offset: exact("0") });
        joint
    };
    robot(&links, (0..count).map(follow).collect())
}

#[test]
fn followers_of_followers_have_one_leader() {
    let tree = followers(60).unwrap();
    let chain = tree.chain(Some("l60"), Some("l30")).unwrap();
    let mimic = chain.joints()[1].mimic.clone().unwrap();
    assert_eq!((chain.joints()[1].name.as_str(), mimic.to_string().as_str()), ("j29", "j59"));
    assert!(followers(300).unwrap_err().message().contains("more than 100"));
}

#[test]
fn what_is_no_chain_is_refused() {
    let links = ["a", "b", "c", "d"];
    let mut joints = vec![joint("ab", "a", "b"), joint("bc", "b", "c"), joint("bd", "b", "d")];
    joints[1].kind = JointType::Planar;
    joints[2].kind = JointType::Fixed;
    let tree = robot(&links, joints).unwrap();
    let refused = |base, tip, kind, words: &str| {
        let error = tree.chain(base, tip).unwrap_err();
        assert_eq!(error.kind(), kind, "{error}");
        assert!(error.message().contains(words), "{error}");
    };
    refused(None, Some("c"), ErrorKind::Unsupported, "joint `bc`: the type `planar` is not supported");
    refused(None, None, ErrorKind::MissingKey, "choose a tip link, such as `c`");
    refused(None, Some("e"), ErrorKind::UnknownName, "the tip `e` is not a link");
    refused(Some("x"), Some("d"), ErrorKind::UnknownName, "the base `x` is not a link");
    refused(Some("b"), Some("d"), ErrorKind::BadValue, "no joint moves between `b` and `d`");
    refused(Some("d"), Some("d"), ErrorKind::BadValue, "no joint moves between");
    let chain = tree.chain(None, Some("d")).unwrap();
    assert_eq!((chain.joints().len(), chain.joints()[0].kind), (1, JointKind::Revolute));
    assert!((chain.base_from_tip().translation.x - 0.5).abs() < 1e-15, "the fixed joint counts");
}

#[test]
fn too_long_a_path_is_refused() {
    let count = 70;
    let links: Vec<String> = (0..=count).map(|i| format!("l{i}")).collect();
    let links: Vec<&str> = links.iter().map(String::as_str).collect();
    let joints = (0..count).map(|i| joint(&format!("j{i}"), &format!("l{i}"), &format!("l{}", i + 1))).collect();
    let tree = robot(&links, joints).unwrap();
    assert!(tree.chain(None, None).unwrap_err().message().contains("at most 64"));
    assert!(tree.chain(Some("l50"), None).unwrap_err().message().contains("give 1 to 12"));
    assert_eq!(tree.chain(Some("l60"), None).unwrap().joints().len(), 10);
}

proptest! {
    #![proptest_config(crate::cases(40))]

    /// The path from hand to hand, up one arm and down the other, equals the path through the torso.
    #[test]
    fn the_path_up_is_the_inverse_of_the_path_down(q in prop::collection::vec(-2.0f64..2.0, 10)) {
        let across = nao().chain(Some("l_hand"), Some("r_hand")).unwrap();
        let (left, right) = (limb("l_hand"), limb("r_hand"));
        let reversed: Vec<f64> = q[..5].iter().rev().copied().collect();
        let wanted = left.forward(&reversed).unwrap().inverse() * right.forward(&q[5..]).unwrap();
        let given = across.forward(&q).unwrap();
        prop_assert!((given.to_homogeneous() - wanted.to_homogeneous()).norm() < 1e-14);
        prop_assert_eq!(across.joints()[0].limits, left.joints()[4].limits);
    }
}

#[test]
fn the_outline_names_links_and_joints() {
    let outline = nao().to_string();
    assert_eq!(outline.lines().count(), nao().links().len());
    assert!(
        outline.starts_with("base_link\n") && outline.contains("RHipYawPitch, revolute, follows LHipYawPitch"),
        "{outline}"
    );
}
