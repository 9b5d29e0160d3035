//! Chains whose leaders are found together with their followers: palletizers, lifters, fingers, rolling joints, hollow wrists. Expected solutions come from
//! independent forward kinematics and Newton's method from many starts on the independent joints.

mod mechanism;

use std::f64::consts::PI;

use groebot_ik::derive::Derivation;
use groebot_ik::{ErrorKind, Watch};
use groebot_robot::kinematics::{Plane, Task};
use groebot_robot::model::Robot;

use self::mechanism::Mechanism;

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

const PLANE: Task = Task::PlanarPosition { plane: Plane::Xz };

/// A base, an arm whose end keeps its orientation by two followers, and a wrist about the vertical.
fn palletizer() -> Mechanism {
    let joints = [
        (true, Z, [0.0; 3], None),
        (true, Y, [0.1, 0.0, 0.3], None),
        (true, Y, [0.1, 0.0, 0.8], Some((1, -1.0, 0.0))),
        (true, Y, [0.17, 0.0, 0.83], None),
        (true, Y, [0.7, 0.0, 0.8], Some((3, -1.0, 0.0))),
        (true, Z, [0.8, 0.0, 0.8], None),
    ];
    Mechanism::new(Task::Pose, [0.8, 0.0, 0.6], &joints)
}

#[test]
fn a_parallelogram_arm_reaches_a_place_in_four_postures() {
    let joints = [
        (true, Z, [0.0; 3], None),
        (true, Y, [0.0; 3], None),
        (true, Y, [0.2, 0.0, 0.0], Some((1, -1.0, 0.0))),
        (true, Y, [0.2, 0.0, 0.0], None),
    ];
    let arm = Mechanism::new(Task::Position, [0.35, 0.0, 0.0], &joints);
    let derived = Derivation::sequentially(&arm.chain(), &Watch::none()).unwrap();
    let target = arm.seen(&arm.whole(&[0.1, 0.3, 0.4]));
    assert_eq!(arm.solved(&derived, &target).len(), 4);
    arm.agrees(9, 60);
}

#[test]
fn a_palletizer_with_a_wrist_keeps_its_tool_level() {
    palletizer().agrees(6, 80);
}

#[test]
fn two_leaders_of_a_lifter_are_a_two_link_arm() {
    let joints = [
        (true, Y, [0.0, 0.0, 0.15], None),
        (true, Y, [0.0, 0.0, 0.4], Some((0, -1.0, 0.0))),
        (true, Y, [0.0, 0.0, 0.45], Some((3, -1.0, 0.0))),
        (true, Y, [0.0, 0.0, 0.7], None),
    ];
    let counts = Mechanism::new(PLANE, [0.02, 0.0, 0.8], &joints).agrees(9, 60);
    assert!(counts.iter().all(|count| *count <= 2) && counts.contains(&2), "{counts:?}");
}

#[test]
fn a_finger_with_one_tendon_has_one_unknown() {
    let joints = [(true, Y, [0.0; 3], None), (true, Y, [0.04, 0.0, 0.0], Some((0, 1.0, 0.0)))];
    let finger = Mechanism::new(Task::Position, [0.07, 0.0, 0.005], &joints);
    assert_eq!(finger.agrees(6, 40), [1; 6]);
}

#[test]
fn a_rolling_joint_is_an_equation_of_degree_four() {
    let joints = [
        (true, Z, [0.0; 3], None),
        (true, Y, [0.02, 0.0, 0.0], None),
        (true, Y, [0.03, 0.0, 0.0], Some((1, 1.0, 0.0))),
        (true, Y, [0.07, 0.0, 0.0], None),
    ];
    Mechanism::new(Task::Position, [0.1, 0.0, 0.0], &joints).agrees(6, 150);
}

#[test]
fn multipliers_and_offsets_are_whole_numbers_and_any_angle() {
    for (leader, multiplier, offset) in [(1, 1.0, 0.3), (0, -2.0, 0.0), (1, -1.0, PI / 2.0), (0, 2.0, -1.1)] {
        let joints = [
            (true, Y, [0.0; 3], None),
            (true, Y, [0.2, 0.0, 0.0], None),
            (true, Y, [0.35, 0.0, 0.05], Some((leader, multiplier, offset))),
        ];
        let arm = Mechanism::new(PLANE, [0.5, 0.0, 0.02], &joints);
        arm.agrees(3, 80);
    }
}

#[test]
fn on_one_axis_each_answer_of_the_sum_is_several_of_the_leader() {
    // The sum is 2 q, or 3 q: elbow up and elbow down, with two or three values of q each.
    for (multiplier, count) in [(1.0, 4), (2.0, 6)] {
        let joints = [
            (true, Y, [0.0; 3], None),
            (true, Y, [0.0; 3], Some((0, multiplier, 0.0))),
            (true, Y, [0.2, 0.0, 0.0], None),
        ];
        let counts = Mechanism::new(PLANE, [0.35, 0.0, 0.0], &joints).agrees(3, 100);
        assert!(counts.iter().all(|own| *own <= count) && counts.contains(&count), "{counts:?}");
    }
}

#[test]
fn a_slide_follows_a_slide_by_any_factor() {
    let joints =
        [(false, Y, [0.0; 3], None), (true, Z, [0.0; 3], None), (false, X, [0.1, 0.0, 0.0], Some((0, 0.5, 0.1)))];
    Mechanism::new(Task::PlanarPosition { plane: Plane::Xy }, [0.3, 0.0, 0.0], &joints).agrees(6, 80);
}

#[test]
fn a_hollow_wrist_bends_by_two_joints_that_turn_against_each_other() {
    for multiplier in [-1.0, 1.0] {
        let centre = [0.9, 0.0, 1.3];
        let joints = [
            (true, Z, [0.0; 3], None),
            (true, Y, [0.2, 0.0, 0.5], None),
            (true, Y, [0.2, 0.0, 1.2], None),
            (true, X, centre, None),
            (true, [0.8, 0.0, 0.6], centre, None),
            (true, [0.8, 0.0, -0.6], centre, Some((4, multiplier, 0.0))),
            (true, X, centre, None),
        ];
        Mechanism::new(Task::Pose, [1.0, 0.0, 1.3], &joints).agrees(1, 250);
    }
}

#[test]
fn a_fraction_of_a_turn_is_left_to_the_search() {
    let joints = [(true, Y, [0.0; 3], None), (true, Y, [0.04, 0.0, 0.0], Some((0, 0.5, 0.0)))];
    let finger = Mechanism::new(Task::Position, [0.07, 0.0, 0.005], &joints);
    let error = Derivation::sequentially(&finger.chain(), &Watch::none()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(error.message().contains("`j1` is 0.5 * j0") && error.message().contains("--numeric"), "{error}");
}

#[test]
fn equations_that_are_solved_together_take_no_followers() {
    let joints = [(true, Y, [0.0; 3], None), (true, Y, [0.04, 0.0, 0.0], Some((0, 1.0, 0.0)))];
    let chain = Mechanism::new(PLANE, [0.07, 0.0, 0.005], &joints).chain();
    let error = groebot_ik::derive::formulate(&chain).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(error.message().contains("`j1` follows another one") && error.message().contains("`order`"), "{error}");
}

#[test]
fn what_is_derived_is_proved_again_and_a_forged_law_is_refused() {
    let chain = palletizer().chain();
    let derived = Derivation::sequentially(&chain, &Watch::none()).unwrap();
    let text = derived.certificate().unwrap();
    let again = Derivation::prove(&chain, &text).unwrap();
    assert_eq!(again.program(), derived.program());
    let other = Mechanism {
        joints: palletizer()
            .joints
            .into_iter()
            .map(|(turns, axis, point, law)| (turns, axis, point, law.map(|(leader, _, offset)| (leader, 1.0, offset))))
            .collect(),
        ..palletizer()
    };
    let error = Derivation::prove(&other.chain(), &text).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Certificate, "{error}");
}

#[test]
fn a_multiplier_of_zero_fixes_a_joint_at_its_offset() {
    let urdf = |mimic: &str| {
        format!(
            "<robot name=\"r\"><link name=\"b\"/><link name=\"u\"/><link name=\"v\"/><link name=\"t\"/>\
             <joint name=\"a\" type=\"continuous\"><parent link=\"b\"/><child link=\"u\"/><axis xyz=\"0 0 1\"/></joint>\
             <joint name=\"f\" type=\"continuous\"><parent link=\"u\"/><child link=\"v\"/><origin xyz=\"0.3 0 0\"/><axis xyz=\"0 2 1\"/>\
             {mimic}</joint>\
             <joint name=\"e\" type=\"fixed\"><parent link=\"v\"/><child link=\"t\"/><origin xyz=\"0.2 0.1 0\"/></joint></robot>"
        )
    };
    let chain = |mimic: &str| Robot::from_urdf(&urdf(mimic)).unwrap().chain(None, Some("t")).unwrap();
    let (held, free) = (chain("<mimic joint=\"a\" multiplier=\"0\" offset=\"0.7\"/>"), chain(""));
    assert_eq!((held.joints().len(), free.joints().len()), (1, 2));
    for q in [-2.0, 0.0, 1.3] {
        let [a, b] = [held.forward(&[q]).unwrap(), free.forward(&[q, 0.7]).unwrap()];
        assert!((a.to_homogeneous() - b.to_homogeneous()).norm() < 1e-14);
    }
}
