//! What is written as MJCF. That MuJoCo reads it and walks with it is seen in scripts/physics.

use groebot::model::{Meshes, Robot};
use groebot::robots;

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

/// A chain of eight thousand links is no deeper for the writer than one of two, and its text is not much longer a link.
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
    assert!(text.contains("forcerange=\"-30 30\"") && text.contains("armature=\"1\""));
    assert!(!text.contains("mesh=") && text.contains("type=\"capsule\" size=\"0.02 0.1\""));
    assert!(text.contains("class=\"visual\" type=\"box\" size=\"0.05 0.1 0.15\" rgba=\"1 0 0 1\""));
}
