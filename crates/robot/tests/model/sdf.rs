//! SDF input and output. The poses of `formats/arm.sdf` are compared with Drake, which reads SDF by its own means:
//! `formats/arm_sdf.json` was written by `python formats/witness_sdf.py formats/arm.sdf` with Drake 1.51.1.

use std::fs;
use std::path::Path;

use groebot_robot::ErrorKind;
use groebot_robot::dynamics::Model;
use groebot_robot::model::{JointType, Robot};
use groebot_robot::spatial::Pose;
use nalgebra::{Matrix3, Vector3};
use serde_json::Value;
use tempfile::tempdir;

use super::exact;
use super::round_trip::RICH;
use crate::errors::assert_error;

const ARM: &str = include_str!("formats/arm.sdf");
const NEAR: f64 = 1e-12;

fn folder() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/model/formats")
}

fn arm() -> Robot {
    Robot::read(folder().join("arm.sdf")).unwrap()
}

fn witness() -> Value {
    serde_json::from_str(include_str!("formats/arm_sdf.json")).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// A model with two links, and `inside` in it.
fn model(inside: &str) -> groebot_robot::Result<Robot> {
    let text = format!("<sdf version='1.9'><model name='m'><link name='a'/><link name='b'/>\n{inside}\n</model></sdf>");
    Robot::from_sdf(&text, None)
}

#[test]
fn poses_are_those_of_drake() {
    let (robot, witness) = (arm(), witness());
    let model = Model::new(&robot).unwrap();
    let names: Vec<&str> = robot.moving().iter().map(|place| robot.joints()[*place].name.as_str()).collect();
    for pose in witness["poses"].as_array().unwrap() {
        let mut q: Vec<f64> = names
            .iter()
            .map(|name| pose["q"][*name].as_f64().unwrap_or_else(|| panic!("no value of `{name}`")))
            .collect();
        robot.follow(&mut q);
        let placed = model.place(&Pose::identity(), &q).unwrap();
        for (frame, wanted) in pose["frames"].as_object().unwrap() {
            let (wanted, link) = (numbers(wanted), placed.world_from_link(robot.link(frame).unwrap()));
            let at = Vector3::new(wanted[0], wanted[1], wanted[2]);
            assert!((link.translation.vector - at).norm() < NEAR, "{frame}: {} {at}", link.translation);
            let turned = Matrix3::from_row_slice(&wanted[3..]);
            assert!((link.rotation.to_rotation_matrix().matrix() - turned).norm() < NEAR, "{frame}");
        }
    }
}

#[test]
fn limits_and_masses_are_those_of_drake() {
    let (robot, witness) = (arm(), witness());
    for (name, wanted) in witness["limits"].as_object().unwrap() {
        let (low, high) = robot.joints()[robot.joint(name).unwrap()].limits.unwrap();
        assert_eq!(vec![low, high], numbers(wanted), "{name}");
    }
    for (name, wanted) in witness["inertias"].as_object().unwrap() {
        let inertia = robot.links()[robot.link(name).unwrap()].inertia();
        assert!((inertia.mass() - wanted["mass"].as_f64().unwrap()).abs() < NEAR, "{name}");
        let centre = Vector3::from_vec(numbers(&wanted["centre"]));
        assert!((inertia.centre_of_mass().coords - centre).norm() < NEAR, "{name}");
        let tensor = Matrix3::from_row_slice(&numbers(&wanted["tensor"]));
        assert!((inertia.rotational() - tensor).norm() < NEAR, "{name}: {} {tensor}", inertia.rotational());
    }
}

#[test]
fn structure_of_the_arm() {
    let robot = arm();
    assert_eq!((robot.name(), robot.root(), robot.faults()), ("arm", "world", &[][..]));
    let joint = |name: &str| robot.joints()[robot.joint(name).unwrap()].clone();
    let shoulder = joint("shoulder");
    assert_eq!(shoulder.origin.placement.origin, ["0", "0", "1029/10000"].map(exact), "exact decimals");
    assert_eq!(
        (shoulder.effort, shoulder.speed, shoulder.damping, shoulder.friction),
        (Some(30.0), Some(2.0), 0.5, 0.1)
    );
    let follower = joint("follower").mimic.unwrap();
    // 0.5 (shoulder - 0.2) + 0.1
    assert_eq!(
        (follower.leader.as_str(), follower.multiplier, follower.offset),
        ("shoulder", exact("1/2"), exact("0"))
    );
    assert_eq!(joint("hand::grip").kind, JointType::Prismatic);
    assert!(robot.link("hand::finger").is_ok() && robot.link("hand::tip").is_ok());
}

#[test]
fn several_axes_and_unlimited_joints() {
    let links = "<joint name='j' type='TYPE'><parent>a</parent><child>b</child>AXES</joint>";
    let axes = "<axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>";
    let read = |kind: &str, axes: &str| model(&links.replace("TYPE", kind).replace("AXES", axes)).unwrap();
    let kinds = |robot: &Robot| robot.joints().iter().map(|joint| joint.kind.name()).collect::<Vec<_>>().join(" ");
    assert_eq!(kinds(&read("universal", axes)), "continuous continuous");
    assert_eq!(kinds(&read("ball", "")), "continuous continuous continuous");
    assert_eq!(kinds(&read("fixed", "")), "fixed");
    let rail = read("prismatic", axes);
    assert_eq!((kinds(&rail), rail.joints()[0].limits), ("prismatic".to_owned(), Some((-1000.0, 1000.0))));
    assert!(rail.joints()[0].notes[0].contains("no limits"));
    let half = "<axis><xyz>0 0 1</xyz><limit><lower>0</lower><upper>inf</upper></limit></axis>";
    assert_eq!(kinds(&read("revolute", half)), "continuous");
}

/// Before version 1.5 axes are in the model's frame; later by `use_parent_model_frame`.
#[test]
fn axes_of_old_files() {
    let axis = |version: &str, old: &str| {
        let text = format!(
            "<sdf version='{version}'><model name='m'><link name='a'/><link name='b'><pose>0 0 1 0 0 1.5707963267948966</pose></link>\
             <joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>1 0 0</xyz>{old}</axis></joint></model></sdf>"
        );
        Robot::from_sdf(&text, None).unwrap().joints()[0].axis.clone()
    };
    assert_eq!(axis("1.7", ""), ["1", "0", "0"].map(exact));
    assert_eq!(axis("1.4", ""), ["0", "-1", "0"].map(exact));
    let old = "<use_parent_model_frame>1</use_parent_model_frame>";
    assert_eq!(axis("1.6", old), ["0", "-1", "0"].map(exact));
}

/// Each fault has the line of its element: 2 for what is in the model.
#[test]
fn faults_have_a_kind_and_a_line() {
    let joint = |inside: &str| format!("<joint name='j' type='revolute'><parent>a</parent>{inside}</joint>");
    let cases = [
        (joint(""), ErrorKind::MissingKey, "child"),
        (joint("<child>c</child><axis/>"), ErrorKind::UnknownName, "no frame `c`"),
        (joint("<child>b</child>"), ErrorKind::MissingKey, "axis"),
        (joint("<child>b</child><axis><xyz>0 0 0</xyz></axis>"), ErrorKind::BadValue, "direction"),
        (joint("<child>b</child><axis><xyz>0 0</xyz></axis>"), ErrorKind::BadValue, "2 found"),
        (
            joint("<child>b</child><axis><xyz expressed_in='x'>0 0 1</xyz></axis>"),
            ErrorKind::UnknownName,
            "no frame `x`",
        ),
        (joint("<child>b</child><axis/>").replace("revolute", "hinge"), ErrorKind::BadValue, "revolute"),
        (joint("<child>b</child><axis/>").replace("revolute", "screw"), ErrorKind::Unsupported, "screw"),
        (
            "<frame name='f'><pose relative_to='f'/></frame><frame name='a'/>".to_owned(),
            ErrorKind::DuplicateName,
            "`a`",
        ),
        (
            "<frame name='f' attached_to='g'/><frame name='g' attached_to='f'/>".to_owned(),
            ErrorKind::BadValue,
            "fixed to no link",
        ),
        ("<frame name='f'><pose relative_to='f'/></frame>".to_owned(), ErrorKind::BadValue, "circle"),
        ("<frame name='f'><pose rotation_format='matrix'/></frame>".to_owned(), ErrorKind::BadValue, "quat_xyzw"),
        ("<link name='c::d'/>".to_owned(), ErrorKind::BadValue, "::"),
        ("<include><uri>part.sdf</uri></include>".to_owned(), ErrorKind::Unsupported, "no folder"),
        ("<link name='c'><inertial><mass>x</mass></inertial></link>".to_owned(), ErrorKind::BadValue, "not a number"),
    ];
    for (inside, kind, words) in cases {
        let error = model(&inside).unwrap_err();
        assert_eq!((error.kind(), error.place().line), (kind, Some(2)), "{inside}: {error}");
        assert!(error.message().contains(words), "{inside}: {error}");
    }
}

#[test]
fn faults_of_the_file() {
    let cases = [
        ("<sdf><model name='m'/></sdf>", ErrorKind::MissingKey),
        ("<sdf version='2.0'><model name='m'/></sdf>", ErrorKind::Unsupported),
        ("<sdf version='1.9'/>", ErrorKind::BadValue),
        ("<sdf version='1.9'><model name='a'/><model name='b'/></sdf>", ErrorKind::BadValue),
        ("<robot name='r'/>", ErrorKind::BadValue),
    ];
    for (text, kind) in cases {
        assert_eq!(Robot::from_sdf(text, None).unwrap_err().kind(), kind, "{text}");
    }
}

/// Included models are in the folder of the file, do not include themselves, and are counted.
#[test]
fn includes_are_bounded() {
    let folder = tempdir().unwrap();
    let part = "<sdf version='1.9'><model name='part'><link name='l'/>INSIDE</model></sdf>";
    let main = |uri: &str, count: usize| {
        let one = |k: usize| format!("<include><name>p{k}</name><uri>{uri}</uri></include>");
        let all: String = (0..count).map(one).collect();
        format!("<sdf version='1.9'><model name='m'>{all}</model></sdf>")
    };
    let read = |main: &str, part: &str| {
        fs::write(folder.path().join("main.sdf"), main).unwrap();
        fs::create_dir_all(folder.path().join("part")).unwrap();
        fs::write(folder.path().join("part/model.sdf"), part).unwrap();
        Robot::read(folder.path().join("main.sdf"))
    };
    let plain = part.replace("INSIDE", "");
    for uri in ["model://part", "part", "part/model.sdf"] {
        assert_eq!(read(&main(uri, 1), &plain).unwrap().links()[0].name, "p0::l");
    }
    let itself = part.replace("INSIDE", "<include><uri>part/model.sdf</uri></include>");
    assert!(read(&main("part", 1), &itself).unwrap_err().message().contains("includes itself"));
    assert!(read(&main("part", 201), &plain).unwrap_err().message().contains("one include too many"));
    for uri in ["https://example.org/part", "../part", "/part"] {
        assert_eq!(read(&main(uri, 1), &plain).unwrap_err().kind(), ErrorKind::Unsupported, "{uri}");
    }
    assert_eq!(read(&main("none", 1), &plain).unwrap_err().kind(), ErrorKind::Io);
}

/// Damaged files, each with a few replaced words, are read or refused, and what is read is written.
#[test]
fn damaged_words_do_no_harm() {
    let start = ARM.find("<include>").unwrap();
    let end = ARM.find("<joint name=\"wrist\"").unwrap();
    let plain = [&ARM[..start], "<model name=\"hand\"><link name=\"palm\"/><frame name=\"tip\"/></model>", &ARM[end..]]
        .concat();
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
        if let Ok(robot) = Robot::from_sdf(&damaged.concat(), None) {
            let _ = (robot.to_urdf(), robot.to_sdf(&mut Vec::new()), robot.doubts());
        }
    }
}

#[test]
fn deep_and_damaged_files_are_refused() {
    let deep = "<model name='m'>".repeat(100_000);
    assert_eq!(Robot::from_sdf(&format!("<sdf version='1.9'>{deep}"), None).unwrap_err().kind(), ErrorKind::Syntax);
    for end in (0..ARM.len()).step_by(7) {
        let _ = Robot::from_sdf(&ARM[..end], None);
    }
}

/// A robot that is written as SDF is read back with the same moving joints, poses and masses.
#[test]
fn written_robots_are_read_back() {
    let robots = [Robot::from_urdf(RICH).unwrap(), groebot_robot::robots::nao_v5(), arm()];
    for robot in robots {
        let text = robot.to_sdf(&mut Vec::new()).unwrap();
        let again = Robot::from_sdf(&text, None).unwrap();
        again.check().unwrap();
        let models = [&robot, &again].map(|robot| Model::new(robot).unwrap());
        let name = |robot: &Robot, place: usize| robot.joints()[place].name.replace("::", "_");
        let names = |robot: &Robot| robot.moving().iter().map(|place| name(robot, *place)).collect::<Vec<_>>();
        let (one, two) = (names(&robot), names(&again));
        let value =
            |name: &String| one.iter().position(|own| own == name).map_or(f64::NAN, |at| 0.1 + 0.05 * at as f64);
        let poses = [(&models[0], &one), (&models[1], &two)].map(|(model, names)| {
            model.place(&Pose::identity(), &names.iter().map(value).collect::<Vec<_>>()).unwrap()
        });
        for (place, link) in robot.links().iter().enumerate() {
            let other = again.link(&link.name.replace("::", "_")).unwrap();
            let [a, b] = [poses[0].world_from_link(place), poses[1].world_from_link(other)];
            assert!((a.translation.vector - b.translation.vector).norm() < NEAR, "{}", link.name);
            assert!((a.to_homogeneous() - b.to_homogeneous()).norm() < NEAR, "{}", link.name);
            let masses = [link.inertia(), again.links()[other].inertia()].map(|inertia| inertia.mass());
            assert!((masses[0] - masses[1]).abs() < 1e-5, "{}: {masses:?}", link.name);
        }
    }
}

/// A link without mass between the world and a joint is a link: a frame would be fixed to another link.
#[test]
fn links_at_the_world_are_written() {
    let fixed = |name: &str, parent: &str, child: &str, kind: &str| {
        format!("<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/></joint>")
    };
    let links: String = ["world", "stand", "arm"].map(|name| format!("<link name='{name}'/>")).concat();
    let joints = fixed("s", "world", "stand", "fixed") + &fixed("j", "stand", "arm", "continuous");
    let robot = Robot::from_urdf(&format!("<robot name='r'>{links}{joints}</robot>")).unwrap();
    let again = Robot::from_sdf(&robot.to_sdf(&mut Vec::new()).unwrap(), None).unwrap();
    assert_eq!((again.root(), again.joints()[1].parent.as_str()), ("world", "stand"));
}

#[test]
fn floating_joints_are_not_written() {
    let text = "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='floating'><parent link='a'/><child link='b'/></joint></robot>";
    let error = Robot::from_urdf(text).unwrap().to_sdf(&mut Vec::new()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported, "{error}");
}

#[test]
fn a_joint_that_closes_a_loop_is_ignored_with_a_note() {
    let four_bars = "<link name='c'/><link name='d'/>
        <joint name='ab' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint>
        <joint name='ad' type='revolute'><parent>a</parent><child>d</child><axis><xyz>0 0 1</xyz></axis></joint>
        <joint name='bc' type='revolute'><parent>b</parent><child>c</child><axis><xyz>0 0 1</xyz></axis></joint>
        <joint name='dc' type='revolute'><parent>d</parent><child>c</child><axis><xyz>0 0 1</xyz></axis></joint>";
    let robot = model(four_bars).unwrap();
    assert_eq!(robot.moving().len(), 3);
    let notes = robot.parts().notes.join("\n");
    assert!(notes.contains("line 6: joint `dc` closes a loop of links and is ignored"), "{notes}");
}

/// Joint `cb` is reversed. Where a joint is beside the origin of its child, links and joints without lines are added, also then the error has its own line.
#[test]
fn a_reversed_joint_is_refused_with_its_line() {
    let axis = "<axis><xyz>0 0 1</xyz></axis>";
    for pose in ["", "<pose>0 0 1 0 0 0</pose>"] {
        for kind in ["revolute", "ball", "universal"] {
            let axes =
                if kind == "universal" { format!("{axis}<axis2><xyz>0 1 0</xyz></axis2>") } else { axis.to_owned() };
            let text = format!(
                "<link name='c'/>
                <joint name='ab' type='revolute'><parent>a</parent><child>b</child>{pose}{axis}</joint>
                <joint name='cb' type='{kind}'><parent>c</parent><child>b</child>{pose}{axes}</joint>"
            );
            let error = model(&text).unwrap_err();
            assert_error(&error, ErrorKind::BadValue, Some(4), "its child `b` is already the child of joint `ab`");
            assert!(error.message().starts_with("joint `cb`: "), "{error}");
        }
    }
}
