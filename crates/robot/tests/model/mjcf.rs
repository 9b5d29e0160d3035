//! MJCF output, and its interpretation by MuJoCo.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use groebot_robot::dynamics::Model;
use groebot_robot::model::{Meshes, Robot};
use groebot_robot::robots;
use groebot_robot::spatial::Pose;
use nalgebra::{Quaternion, Translation3, UnitQuaternion};
use serde_json::{Value, json};

use super::round_trip::RICH;

fn written(robot: &Robot, notes: &mut Vec<String>) -> String {
    robot.to_mjcf(&Meshes::default(), notes).unwrap()
}

/// The elements `name` of `text`.
fn count(text: &str, name: &str) -> usize {
    text.matches(&format!("<{name} ")).count()
}

#[test]
fn every_link_is_a_body_and_every_leader_has_a_servo() {
    for robot in [robots::nao_v5(), robots::rh0(), robots::teo()] {
        let text = written(&robot, &mut Vec::new());
        assert_eq!(count(&text, "body"), robot.links().len());
        assert_eq!(count(&text, "position"), robot.moving().len());
        let weighing = robot.links().iter().filter(|link| link.mass.is_some()).count();
        assert_eq!(count(&text, "inertial"), weighing);
        let shapes: usize = robot.links().iter().map(|link| link.collisions.len() + link.visuals.len()).sum();
        assert_eq!(text.matches("<geom").count(), shapes + 3, "floor and two defaults");
        assert!(text.starts_with("<mujoco model=") && text.ends_with("</mujoco>\n"));
        assert!(urdf_rs::read_from_string(&robot.to_urdf()).is_ok(), "another reader of URDF");
    }
}

/// A chain of eight thousand links is no deeper for the writer than one of two, and its text is not much longer per
/// link.
#[test]
fn a_very_deep_robot_is_written() {
    let chain = |count: usize| {
        let link = |k: usize| {
            let (above, name) = (k - 1, format!("l{k}"));
            let ends = format!("<parent link=\"l{above}\"/><child link=\"{name}\"/>");
            format!("<link name=\"{name}\"/><joint name=\"j{k}\" type=\"fixed\">{ends}</joint>")
        };
        let links: String = (1..=count).map(link).collect();
        Robot::from_urdf(&format!("<robot name=\"deep\"><link name=\"l0\"/>{links}</robot>")).unwrap()
    };
    let text = written(&chain(8_000), &mut Vec::new());
    assert_eq!((count(&text, "body"), text.matches("</body>").count()), (8_001, 8_001));
    assert!(text.len() < 8_001 * 400);
}

#[test]
fn what_follows_is_tied_and_meshes_that_are_not_there_are_left_out() {
    let mut notes = Vec::new();
    let text = written(&Robot::from_urdf(RICH).unwrap(), &mut notes);
    assert!(notes.len() == 1 && notes[0].contains("a.stl` is not found"), "{notes:?}");
    assert!(text.contains("<joint joint1=\"bc\" joint2=\"ab\" polycoef=\"0.01 0.05 0 0 0\"/>"), "{text}");
    assert_eq!(count(&text, "position"), 1);
    assert!(text.contains("forcerange=\"-30 30\" user=\"") && text.contains("armature=\"1\""));
    assert!(!text.contains("mesh=") && text.contains("type=\"capsule\" size=\"0.02 0.1\""));
    assert!(text.contains("class=\"visual\" type=\"box\" size=\"0.05 0.1 0.15\" rgba=\"1 0 0 1\""));
}

/// MuJoCo's results for the model in `robot.xml` of a folder, with joints at these values. Without MuJoCo it prints a
/// note and returns `None` (an error with `GROEBOT_REQUIRE_TOOLS=1`).
fn mujoco(folder: &Path, values: &Value) -> Option<Value> {
    fs::write(folder.join("values.json"), values.to_string()).unwrap();
    let python = std::env::var("GROEBOT_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let script = concat!(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."), "/crates/robot/tests/model/mujoco.py");
    let output = Command::new(python).args(["-B", script, "robot.xml", "values.json"]).current_dir(folder).output();
    let reason = match output {
        Ok(output) if output.status.success() => return Some(serde_json::from_slice(&output.stdout).unwrap()),
        Ok(output) if output.status.code() != Some(7) => panic!("{}", String::from_utf8_lossy(&output.stderr)),
        Ok(output) => String::from_utf8_lossy(&output.stderr).into_owned(),
        Err(error) => error.to_string(),
    };
    let required = std::env::var("GROEBOT_REQUIRE_TOOLS").is_ok_and(|value| value == "1");
    assert!(!required, "MuJoCo is missing: {reason}");
    println!("skipped, MuJoCo is missing: {reason}");
    None
}

/// Values of all revolute and prismatic joints. Mimic joints follow their leaders.
fn values(robot: &Robot, seed: usize) -> Vec<f64> {
    let mut q: Vec<f64> = (0..robot.moving().len()).map(|joint| (1.3 * (seed + joint) as f64 + 0.4).sin()).collect();
    robot.follow(&mut q);
    q
}

fn named(robot: &Robot, q: &[f64]) -> Value {
    let names = robot.moving().into_iter().map(|joint| robot.joints()[joint].name.clone());
    json!(names.zip(q.iter().copied()).collect::<BTreeMap<_, _>>())
}

/// The frame of each link in that of the root, joint by joint.
fn links(robot: &Robot, q: &[f64]) -> Vec<Pose> {
    let model = Model::new(robot).unwrap();
    let moved = |link: usize| {
        let (body, base_from_link) = model.link(link);
        let path = model.path(body);
        path.iter().fold(Pose::identity(), |pose, joint| pose * model.joints()[*joint].screw.exp(q[*joint]))
            * base_from_link
    };
    (0..robot.links().len()).map(moved).collect()
}

/// MuJoCo's minimum mass of each body in the model \[kg\].
const LEAST_MASS: f64 = 1e-4;

/// Degrees of freedom, masses, centres of mass, and poses of the links in three configurations.
fn compare(robot: &Robot, reported: &Value, name: impl Fn(&str) -> String) {
    let leads = |joint: &&usize| robot.law(&robot.joints()[**joint]).leader == robot.joints()[**joint].name;
    let (moving, leaders) = (robot.moving().len(), robot.moving().iter().filter(leads).count());
    assert_eq!(reported["freedom"], 6 + moving, "{}", robot.name());
    assert_eq!((&reported["servos"], &reported["ties"]), (&json!(leaders), &json!(moving - leaders)));
    for link in robot.links().iter().filter(|link| link.mass.is_some()) {
        let (inertia, own) = (link.inertia(), name(&link.name));
        let mass = reported["masses"][&own].as_f64().unwrap();
        assert!((mass - inertia.mass().max(LEAST_MASS)).abs() <= 1e-12 * mass, "{own}: {mass} kg");
        let centre: [f64; 3] = serde_json::from_value(reported["centres"][&own].clone()).unwrap();
        assert!(
            (inertia.centre_of_mass().coords - nalgebra::Vector3::from(centre)).norm() < 1e-12,
            "{own}: {centre:?}"
        );
    }
    for (seed, pose) in reported["poses"].as_array().unwrap().iter().enumerate() {
        assert!(pose["off"].as_f64().unwrap() < 1e-12, "joints that follow: {pose}");
        for (link, expected) in robot.links().iter().zip(links(robot, &values(robot, seed))) {
            let [x, y, z, w, i, j, k]: [f64; 7] =
                serde_json::from_value(pose["bodies"][name(&link.name)].clone()).unwrap();
            let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k));
            let off = Pose::from_parts(Translation3::new(x, y, z), turn).inv_mul(&expected);
            let off = off.translation.vector.norm().max(off.rotation.angle());
            assert!(off < 1e-9, "{}, {}: {off:e}", robot.name(), link.name);
        }
    }
}

fn poses(robot: &Robot) -> Value {
    (0..3).map(|seed| named(robot, &values(robot, seed))).collect()
}

#[test]
fn mujoco_sees_the_same_robot() {
    let corpus = [
        include_str!("../../../../tests/corpus/urdf/finger.urdf"),
        include_str!("../../../../tests/corpus/urdf/telescope.urdf"),
        include_str!("../../../../tests/corpus/dynamics/panda.urdf"),
        include_str!("../../../../tests/corpus/dynamics/humanoid.urdf"),
    ];
    let read = |text: &&str| Robot::from_urdf(text).unwrap().as_meant().unwrap();
    let robots = [robots::nao_v5(), robots::rh0(), robots::teo()].into_iter().chain(corpus.iter().map(read));
    for robot in robots {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("robot.xml"), written(&robot, &mut Vec::new())).unwrap();
        let Some(reported) = mujoco(folder.path(), &poses(&robot)) else { return };
        compare(&robot, &reported, str::to_owned);
    }
}

/// Features that URDF allows and MuJoCo does not: its own names, equal limits, solids without size, negative moments;
/// text, flat and damaged meshes.
const HARD: &str = r#"<robot name="a &amp; b">
  <link name="world"/>
  <link name="arm"><inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="-0.5" ixy="0" ixz="0" iyz="0.2"/></inertial>
    <collision><geometry><sphere radius="0"/></geometry></collision>
    <collision><geometry><box size="1 0 1"/></geometry></collision>
    <visual><geometry><mesh filename="good.stl"/></geometry></visual>
    <visual><geometry><mesh filename="flat.stl"/></geometry></visual>
    <collision><geometry><mesh filename="BINARY.STL" scale="-1 1 0.001"/></geometry></collision>
    <visual><geometry><mesh filename="bad.stl"/></geometry></visual></link>
  <link name="rod &lt;1&gt;"><inertial><origin rpy="0.3 0.2 0.1"/><mass value="1"/><inertia ixx="0" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="root" type="revolute"><parent link="world"/><child link="arm"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/>
    <limit lower="0.5" upper="0.5" effort="0" velocity="1"/></joint>
  <joint name="root_" type="prismatic"><parent link="arm"/><child link="rod &lt;1&gt;"/><origin rpy="1 2 3"/><axis xyz="1 1 0"/>
    <limit lower="-1" upper="1" effort="1e300" velocity="1"/></joint>
</robot>"#;

#[test]
fn unsupported_features_are_converted_for_mujoco() {
    let folder = tempfile::tempdir().unwrap();
    let solid = |corners: [&str; 4]| {
        let facet = |[a, b, c]: [usize; 3]| {
            let [a, b, c] = [a, b, c].map(|corner| corners[corner]);
            format!("facet normal 0 0 0\nouter loop\nvertex {a}\nvertex {b}\nvertex {c}\nendloop\nendfacet\n")
        };
        [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(facet).concat()
    };
    let facets = solid(["0 0 0", "1 0 0", "0 1 0", "0 0 1"]);
    fs::write(folder.path().join("good.stl"), format!("solid t\n{facets}endsolid t\n")).unwrap();
    fs::write(folder.path().join("bad.stl"), format!("solid t\n{facets}")).unwrap();
    let flat = solid(["0 0 1", "1 0 1", "0 1 1", "1 1 1"]);
    fs::write(folder.path().join("flat.stl"), format!("solid t\n{flat}endsolid t\n")).unwrap();
    fs::write(folder.path().join("BINARY.STL"), super::mesh::binary()).unwrap();
    let (robot, mut notes) = (Robot::from_urdf(HARD).unwrap(), Vec::new());
    let text = robot.to_mjcf(&Meshes::beside(&folder.path().join("robot.urdf")), &mut notes).unwrap();
    let words = ["moments of inertia", "`flat.stl` is flat", "bad.stl: line 29"];
    assert!(notes.len() == 3 && notes.iter().zip(words).all(|(note, words)| note.contains(words)), "{notes:?}");
    assert!(text.contains("face=\"0 1 2 0 2 3 ") && text.contains("BINARY.STL\" scale=\"-1 1 0.001\""), "{text}");
    assert!(!text.contains("good.stl") && !text.contains("bad.stl"));
    fs::write(folder.path().join("robot.xml"), text).unwrap();
    let Some(reported) = mujoco(folder.path(), &poses(&robot)) else { return };
    compare(&robot, &reported, |name| if name == "world" { "world_".to_owned() } else { name.to_owned() });
}
