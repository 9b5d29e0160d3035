//! MJCF input, compared with MuJoCo's compiled model of `formats/arm.xml`. `formats/arm.json` was written by
//! `python formats/witness.py formats/arm.xml` with MuJoCo 4.0.0.

use std::fs;
use std::path::Path;

use groebot_robot::ErrorKind;
use groebot_robot::dynamics::Model;
use groebot_robot::model::{JointType, Meshes, Robot, Solid, XmlFormat};
use groebot_robot::spatial::Pose;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use serde_json::Value;
use tempfile::tempdir;

use super::exact;

const ARM: &str = include_str!("formats/arm.xml");
const NEAR: f64 = 1e-12;

/// The robot of `formats/arm.xml`, with its included file.
fn arm() -> Robot {
    Robot::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/model/formats/arm.xml")).unwrap()
}

fn witness() -> Value {
    serde_json::from_str(include_str!("formats/arm.json")).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// The name in the robot of a part that MuJoCo's file does not name.
fn named(name: &str) -> &str {
    match name {
        "body5" => "body5",
        "joint4" => "body5_joint",
        name => name,
    }
}

/// A model with one body, and `inside` in it.
fn body(inside: &str) -> groebot_robot::Result<Robot> {
    Robot::from_mjcf(&format!("<mujoco>\n<worldbody>\n<body name='b'>\n{inside}\n</body></worldbody></mujoco>"), None)
}

#[test]
fn poses_are_those_of_mujoco() {
    let robot = arm();
    let model = Model::new(&robot).unwrap();
    let names: Vec<&str> = robot.moving().iter().map(|place| robot.joints()[*place].name.as_str()).collect();
    for pose in witness()["poses"].as_array().unwrap() {
        let value = |name: &&str| match name.strip_prefix("body5_joint_") {
            Some(axis) => numbers(&pose["q"]["joint4"])["xyz".find(axis).unwrap()],
            None => pose["q"][*name].as_f64().unwrap(),
        };
        let q: Vec<f64> = names.iter().map(value).collect();
        let mut followed = q.clone();
        robot.follow(&mut followed);
        assert!(q.iter().zip(&followed).all(|(a, b)| (a - b).abs() < NEAR), "the law of `grip`");
        let placed = model.place(&Pose::identity(), &q).unwrap();
        for (body, wanted) in pose["bodies"].as_object().unwrap() {
            let (wanted, link) = (numbers(wanted), placed.world_from_link(robot.link(named(body)).unwrap()));
            let at = Vector3::new(wanted[0], wanted[1], wanted[2]);
            let turned = Quaternion::new(wanted[3], wanted[4], wanted[5], wanted[6]);
            assert!((link.translation.vector - at).norm() < NEAR, "{body}: {} {at}", link.translation);
            assert!(link.rotation.angle_to(&UnitQuaternion::new_normalize(turned)) < 1e-7, "{body}");
            let difference = link.rotation.to_rotation_matrix().matrix()
                - UnitQuaternion::new_normalize(turned).to_rotation_matrix().matrix();
            assert!(difference.norm() < NEAR, "{body}");
        }
        let tool = placed.world_from_link(robot.link("tool0").unwrap()).translation.vector;
        assert!((tool - Vector3::from_vec(numbers(&pose["sites"]["tool0"]))).norm() < NEAR);
    }
}

#[test]
fn limits_and_dynamics_are_those_of_mujoco() {
    let (robot, witness) = (arm(), witness());
    for (name, wanted) in witness["dynamics"].as_object().unwrap() {
        let name = if name == "joint4" { "body5_joint_y" } else { name };
        let joint = &robot.joints()[robot.joint(name).unwrap()];
        assert_eq!([joint.damping, joint.friction, joint.armature].to_vec(), numbers(wanted), "{name}");
    }
    for (name, wanted) in witness["limits"].as_object().unwrap().iter().filter(|(name, _)| *name != "joint4") {
        let (low, high) = robot.joints()[robot.joint(name).unwrap()].limits.unwrap();
        let wanted = numbers(wanted);
        assert!((low - wanted[0]).abs() < NEAR && (high - wanted[1]).abs() < NEAR, "{name}: {low} {high}");
    }
    let effort = |name: &str| robot.joints()[robot.joint(name).unwrap()].effort;
    // forcerange; ctrlrange times gear; actuatorfrcrange before both.
    assert_eq!(["shoulder", "swing", "elbow", "rail"].map(effort), [Some(20.0), Some(6.0), Some(7.0), None]);
}

/// Position gains are those of the joint's actuators together, times the square of the gear: an actuator moves `gear` times as far as its joint.
#[test]
fn servos_are_the_position_gains_of_actuators() {
    let robot = arm();
    let servo = |robot: &Robot, name: &str| {
        robot.joints()[robot.joint(name).unwrap()].servo.map(|servo| [servo.stiffness, servo.damping])
    };
    assert_eq!(["shoulder", "swing", "rail"].map(|name| servo(&robot, name)), [Some([50.0, 0.0]), None, None]);
    let bodies: String =
        ["a", "b", "c", "d"].map(|name| format!("<body><joint name=\"{name}\"/><geom size=\"0.1\"/></body>")).concat();
    let text = format!(
        "<mujoco><worldbody><body><geom size=\"0.1\"/>{bodies}</body></worldbody><actuator>\
         <general joint=\"a\" biastype=\"affine\" gainprm=\"20\" biasprm=\"0 -20 -1\" gear=\"2\"/>\
         <position joint=\"b\" kp=\"10\" kv=\"1\"/><velocity joint=\"b\" kv=\"2\"/>\
         <velocity joint=\"c\" kv=\"2\"/><general joint=\"d\" gainprm=\"5\"/></actuator></mujoco>"
    );
    let robot = Robot::from_mjcf(&text, None).unwrap();
    let servos = ["a", "b", "c", "d"].map(|name| servo(&robot, name));
    assert_eq!(servos, [Some([80.0, 4.0]), Some([10.0, 3.0]), None, None]);
    let written = robot.to_mjcf(&Meshes::default(), &mut Vec::new()).unwrap();
    assert!(written.contains("joint=\"a\" kp=\"80\" kv=\"4\" user=\"0 1\"/>"), "{written}");
    assert!(written.contains("joint=\"c\" kp=\"100\" user=\"0 0\"/>"), "{written}");
    let again = Robot::from_mjcf(&written, None).unwrap();
    assert_eq!(["a", "b", "c", "d"].map(|name| servo(&again, name)), servos);
}

#[test]
fn masses_are_those_of_mujoco() {
    let robot = arm();
    for (name, wanted) in witness()["inertias"].as_object().unwrap() {
        let inertia = robot.links()[robot.link(named(name)).unwrap()].inertia();
        let mass = wanted["mass"].as_f64().unwrap();
        assert!((inertia.mass() - mass).abs() < NEAR * mass, "{name}: {} {mass}", inertia.mass());
        let centre = Vector3::from_vec(numbers(&wanted["centre"]));
        assert!((inertia.centre_of_mass().coords - centre).norm() < NEAR, "{name}");
        let rows: Vec<f64> = wanted["tensor"].as_array().unwrap().iter().flat_map(numbers).collect();
        let tensor = Matrix3::from_row_slice(&rows);
        assert!(
            (inertia.rotational() - tensor).norm() < 1e-10 * tensor.norm(),
            "{name}: {} {tensor}",
            inertia.rotational()
        );
    }
}

#[test]
fn decimals_are_exact_and_quarter_turns_too() {
    let robot = arm();
    let joint = &robot.joints()[robot.joint("shoulder").unwrap()];
    assert_eq!(joint.origin.placement.origin, ["0", "0", "1029/10000"].map(exact));
    let base = &robot.joints()[robot.joint("base_joint").unwrap()];
    assert_eq!(base.kind, JointType::Fixed);
    let quarter = base.origin.placement.rotation.matrix();
    assert_eq!(quarter[0], ["0", "-1", "0"].map(exact), "90 degrees about the first axis of zyx");
}

#[test]
fn structure_and_notes() {
    let robot = arm();
    assert_eq!((robot.name(), robot.root()), ("arm", "world"));
    assert_eq!(robot.faults(), []);
    let joint = |name: &str| robot.joints()[robot.joint(name).unwrap()].clone();
    assert_eq!((joint("rail").kind, joint("body5_joint_x").kind), (JointType::Prismatic, JointType::Continuous));
    let mimic = joint("grip").mimic.unwrap();
    // grip = 0.01 + 0.2 (rail - 0.05)
    assert_eq!((mimic.leader.as_str(), mimic.multiplier, mimic.offset), ("rail", exact("1/5"), exact("0")));
    assert_eq!(robot.links()[robot.link("base").unwrap()].visuals.len(), 2);
    let ellipsoid = robot.doubts();
    assert!(ellipsoid.iter().any(|note| note.contains("an ellipsoid is not a shape")), "{ellipsoid:?}");
}

/// A single body with a free joint is the root, as in a URDF of a humanoid.
#[test]
fn a_free_body_is_the_root() {
    let text = "<mujoco><worldbody><geom type='plane' size='1 1 1'/><body name='trunk' pos='0 0 1'><freejoint/>\
        <geom size='0.1'/><body name='leg'><joint name='hip' axis='1 0 0'/><geom size='0.1'/></body></body>\
        <body name='table'><geom size='0.1'/></body></worldbody></mujoco>";
    let robot = Robot::from_mjcf(text, None).unwrap();
    assert_eq!((robot.root(), robot.links().len(), robot.joints().len()), ("trunk", 2, 1));
    assert_eq!(robot.joints()[0].kind, JointType::Continuous);
    assert!(robot.parts().notes[0].contains("1 bodies of the world"), "{:?}", robot.parts().notes);
    let two = text.replace("<body name='table'>", "<body name='table'><freejoint name='loose'/>");
    let robot = Robot::from_mjcf(&two, None).unwrap();
    assert_eq!((robot.root(), robot.links().len()), ("world", 4));
    assert_eq!(robot.joints().iter().filter(|joint| joint.kind == JointType::Floating).count(), 2);
}

#[test]
fn shapes_have_full_sizes() {
    let robot = body("<geom type='box' size='0.1 0.2 0.3' contype='0' conaffinity='0' rgba='1 0 0 1'/><geom type='capsule' size='0.1 0.2'/>").unwrap();
    let link = &robot.links()[1];
    assert_eq!(link.visuals[0].solid, Solid::Box { size: [0.2, 0.4, 0.6] });
    assert_eq!(link.visuals[0].colour, Some([1.0, 0.0, 0.0, 1.0]));
    assert_eq!(link.collisions[0].solid, Solid::Capsule { radius: 0.1, length: 0.4 });
}

/// Each fault has the line of its element: 4 for what is in the body.
#[test]
fn faults_have_a_kind_and_a_line() {
    let cases = [
        ("<geom size='1'/><joint axis='0 0 0'/>", ErrorKind::BadValue, "give a direction"),
        ("<joint type='hing'/>", ErrorKind::BadValue, "hinge"),
        ("<joint class='arm'/>", ErrorKind::UnknownName, "not a class"),
        ("<joint range='1 -1' limited='true'/>", ErrorKind::BadValue, "lower limit first"),
        ("<joint limited='true'/>", ErrorKind::MissingKey, "range"),
        ("<joint pos='0 0'/>", ErrorKind::BadValue, "2 found"),
        ("<geom type='mesh' mesh='m'/>", ErrorKind::UnknownName, "not an asset"),
        ("<geom type='box' size='1 1'/>", ErrorKind::BadValue, "3 positive numbers"),
        ("<geom fromto='1 1 1 1 1 1' type='capsule' size='1'/>", ErrorKind::BadValue, "two equal points"),
        ("<inertial pos='0 0 0'/>", ErrorKind::MissingKey, "mass"),
        ("<inertial mass='1' diaginertia='1 1 1' fullinertia='1 1 1 0 0 0'/>", ErrorKind::BadValue, "both"),
        ("<body quat='1 0 0 0' euler='0 0 0'/>", ErrorKind::BadValue, "both `quat` and `euler`"),
        ("<body quat='0 0 0 0'/>", ErrorKind::BadValue, "not all zero"),
        ("<body xyaxes='1 0 0 2 0 0'/>", ErrorKind::BadValue, "parallel"),
        ("<body><freejoint/></body>", ErrorKind::BadValue, "body in the world"),
        ("<replicate count='3'><geom/></replicate>", ErrorKind::Unsupported, "by a rule"),
        ("<include file='other.xml'/>", ErrorKind::Unsupported, "no folder"),
    ];
    for (inside, kind, words) in cases {
        let error = body(inside).unwrap_err();
        assert_eq!((error.kind(), error.place().line), (kind, Some(4)), "{inside}: {error}");
        assert!(error.message().contains(words), "{inside}: {error}");
    }
}

#[test]
fn faults_of_the_model() {
    let model = |inside: &str| Robot::from_mjcf(&format!("<mujoco>\n{inside}</mujoco>"), None).unwrap_err();
    let world = "<worldbody><body name='b'/></worldbody>";
    let cases = [
        ("<compiler coordinate='global'/>", ErrorKind::Unsupported, 2),
        ("<compiler eulerseq='xyw'/>", ErrorKind::BadValue, 2),
        ("<compiler angle='grad'/>", ErrorKind::BadValue, 2),
        ("<default><default class='a'/>\n<default class='a'/></default>", ErrorKind::DuplicateName, 3),
        ("<default><default/></default>", ErrorKind::MissingKey, 2),
        ("<worldbody><body name='b'/></worldbody>", ErrorKind::DuplicateName, 2),
    ];
    for (inside, kind, line) in cases {
        let error = model(&format!("{inside}{world}"));
        assert_eq!((error.kind(), error.place().line), (kind, Some(line)), "{inside}: {error}");
    }
    assert_eq!(model("").kind(), ErrorKind::MissingKey);
    assert_eq!(Robot::from_mjcf("<robot name='r'/>", None).unwrap_err().kind(), ErrorKind::BadValue);
}

/// Includes stay inside the folder above the model's; each file is included once; an error has the included file.
#[test]
fn includes_are_bounded() {
    let folder = tempdir().unwrap();
    let read = |main: &str, part: &str| {
        fs::write(folder.path().join("main.xml"), main).unwrap();
        fs::write(folder.path().join("part.xml"), part).unwrap();
        Robot::read(folder.path().join("main.xml"))
    };
    let main = "<mujoco><worldbody><include file='part.xml'/></worldbody></mujoco>";
    let robot = read(main, "<mujocoinclude><body name='b'><geom size='1'/></body></mujocoinclude>").unwrap();
    assert_eq!(robot.links().len(), 2);
    let error = read(main, "<mujocoinclude>\n<body name='b'><joint pos='x'/></body></mujocoinclude>").unwrap_err();
    assert_eq!((error.kind(), error.place().line), (ErrorKind::BadValue, Some(2)));
    assert!(error.to_string().contains("part.xml"), "{error}");
    let itself = read(main, "<mujocoinclude>\n<include file='part.xml'/></mujocoinclude>").unwrap_err();
    assert!(itself.message().contains("a second time"), "{itself}");
    for path in ["/etc/passwd", "../../part.xml", "a/../../../b.xml"] {
        let error = read(&main.replace("part.xml", path), "<x/>").unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Unsupported, "{error}");
    }
    let missing = read(&main.replace("part.xml", "none.xml"), "<x/>").unwrap_err();
    assert_eq!((missing.kind(), missing.place().line), (ErrorKind::Io, Some(1)));
    assert!(missing.to_string().contains("main.xml") && missing.message().contains("none.xml"), "{missing}");
}

/// Damaged files, each with a few replaced words, are read or refused, and what is read is written.
#[test]
fn damaged_words_do_no_harm() {
    let plain = ARM.replace("<include file=\"part.xml\"/>", "");
    let words: Vec<&str> = plain.split_inclusive([' ', '"', '>', '<']).collect();
    let mut state = 1_u64;
    let mut draw = |most: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % most
    };
    for _ in 0..300 {
        let mut damaged = words.clone();
        for _ in 0..3 {
            let (from, to) = (draw(words.len()), draw(words.len()));
            damaged[to] = words[from];
        }
        if let Ok(robot) = Robot::from_mjcf(&damaged.concat(), None) {
            let _ = (robot.to_urdf(), robot.to_sdf(&mut Vec::new()), robot.doubts());
        }
    }
}

/// A deep tree is refused before it is read, and damaged files give errors.
#[test]
fn deep_and_damaged_files_are_refused() {
    let deep = "<body>".repeat(100_000);
    let error = Robot::from_mjcf(&format!("<mujoco><worldbody>{deep}"), None).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Syntax, "{error}");
    for end in (0..ARM.len()).step_by(7) {
        let _ = Robot::from_mjcf(&ARM[..end], None);
    }
}

#[test]
fn the_format_is_that_of_the_root_element() {
    let formats = [("<mujoco/>", XmlFormat::Mjcf), ("<?xml version='1.0'?>\n<!-- x --><sdf/>", XmlFormat::Sdf)];
    for (text, format) in formats.into_iter().chain([("<robot/>", XmlFormat::Urdf), ("no xml", XmlFormat::Urdf)]) {
        assert_eq!(XmlFormat::of(text), format, "{text}");
    }
}

/// A robot that is written as MJCF is read back with the same links, joints and masses.
#[test]
fn written_robots_are_read_back() {
    let robot = groebot_robot::robots::nao_v5();
    let text = robot.to_mjcf(&groebot_robot::model::Meshes::default(), &mut Vec::new()).unwrap();
    let again = Robot::from_mjcf(&text, None).unwrap();
    assert_eq!((again.root(), again.links().len()), (robot.root(), robot.links().len()));
    assert!((again.mass() - robot.mass()).abs() < 1e-9);
    for joint in robot.joints().iter().filter(|joint| joint.kind.is_single()) {
        let other = &again.joints()[again.joint(&joint.name).unwrap()];
        assert_eq!((&other.parent, &other.child, other.limits), (&joint.parent, &joint.child, joint.limits));
    }
}
