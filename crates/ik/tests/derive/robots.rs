//! The descriptions in `derivations/`: each can be read, names the source of its numbers, and is the robot of its name.

use std::path::PathBuf;

use groebot_ik::derive::InputFile;
use groebot_robot::kinematics::{BaseAxis, Chain, Geometry, Joint, LengthUnit, Task};
use groebot_robot::robots;

/// Every folder's name and chain, except those with equations or with the NAO chapter's millimetres.
fn described() -> Vec<(String, Chain)> {
    let folders = std::fs::read_dir(concat!(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."), "/derivations")).unwrap();
    let mut folders: Vec<PathBuf> = folders.map(|folder| folder.unwrap().path()).collect();
    folders.sort();
    let chain = |folder: &PathBuf| InputFile::read(folder).unwrap().chain(&Default::default()).unwrap();
    let name = |folder: &PathBuf| folder.file_name().unwrap().to_str().unwrap().to_owned();
    let described = folders.iter().filter(|folder| name(folder) != "nao_leg_sagittal");
    described.filter_map(|folder| Some((name(folder), chain(folder)?))).collect()
}

#[test]
fn every_folder_is_described() {
    let described = described();
    assert!(described.len() >= 28, "{}", described.len());
    for (name, chain) in described {
        assert_eq!(chain.length_unit(), LengthUnit::Metre, "{name}");
        if name != "irb4600_rounded" {
            assert!(chain.parts().source.is_some() && chain.parts().description.is_some(), "{name}");
            assert_eq!(chain.name(), name);
        }
        let most = chain.task().freedoms() + chain.given().len();
        assert!(chain.joints().len() <= most, "{name}: give the values of some joints");
    }
}

/// A URDF with five decimals: its wrist axes do not meet, but those of the ideal robot do. The ideal robot differs by at most 0.2 mm.
#[test]
fn a_rounded_robot_is_snapped() {
    let folder = concat!(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."), "/derivations/irb4600_rounded");
    let input = InputFile::read(folder.as_ref()).unwrap();
    let chain = input.chain(&Default::default()).unwrap().unwrap();
    assert!(Geometry::of(&chain).meeting.is_empty());
    let (ideal, report) = input.ends.ideal(&chain).unwrap();
    let geometry = Geometry::of(&ideal);
    assert_eq!((geometry.parallel.len(), geometry.parallel[0].clone()), (1, 1..3));
    assert_eq!((geometry.meeting.len(), geometry.meeting[0].joints.clone()), (1, 3..6));
    assert!(ideal.ideal_within(1e-3).unwrap().1.is_empty() && report.relations.len() >= 2, "{report}");
    for q in [0.0, 0.7, -2.0] {
        let [a, b] = [&chain, &ideal].map(|chain| chain.forward(&[q; 6]).unwrap());
        assert!((a.translation.vector - b.translation.vector).norm() < 2e-4);
    }
}

#[test]
fn a_folder_with_the_name_of_a_robot_has_its_mechanism() {
    let mut met = 0;
    for (name, chain) in described() {
        let Some(robot) = robots::by_name(&name) else { continue };
        // A chain's joints have the names and limits of the whole robot: `LHipYawPitch` instead of the chain's `HipYawPitch`.
        let renamed = |joint: &Joint, named: &Joint| Joint {
            name: if named.name.ends_with(&joint.name) { named.name.clone() } else { joint.name.clone() },
            limits: joint.limits.or(named.limits),
            axis: named.axis.clone(),
            ..joint.clone()
        };
        let joints: Vec<Joint> = chain.joints().iter().zip(robot.joints()).map(|(a, b)| renamed(a, b)).collect();
        assert_eq!((&joints[..], chain.tip()), (robot.joints(), robot.tip()), "{name}");
        for (a, b) in chain.joints().iter().zip(robot.joints()) {
            assert!((a.direction().into_inner() - b.direction().into_inner()).norm() < 1e-15, "{name} {}", a.name);
        }
        met += 1;
    }
    assert_eq!(met, robots::ALL.len());
}

#[test]
fn tasks_are_as_promised() {
    for (name, chain) in described() {
        let (task, given): (Task, &[usize]) = match name.as_str() {
            "nao_left_arm" | "nao_right_arm" => (Task::Ray, &[]),
            "nao_left_arm_position" | "nao_right_arm_position" => (Task::Position, &[2]),
            "nao_head" => (Task::Direction, &[]),
            "wrist_rotation" => (Task::Rotation, &[]),
            "upright_arm" => (Task::PositionPitchRoll, &[]),
            "scara_yaw" => (Task::PositionYaw { axis: BaseAxis::Z }, &[]),
            "polar" | "rrp" | "rh0_arm" => (Task::Position, &[]),
            "iiwa14" => (Task::Pose, &[2]),
            "gen3_like" => (Task::Pose, &[6]),
            // The joint whose solver is the main one of all arcs.
            "panda" => (Task::Pose, &[4]),
            "planar_4r" => (chain.task(), &[0]),
            _ if chain.task().plane().is_some() => (chain.task(), &[]),
            _ => (Task::Pose, &[]),
        };
        assert_eq!((chain.task(), chain.given()), (task, given.to_vec()), "{name}");
    }
}
