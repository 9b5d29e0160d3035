//! The robots of this crate: their data compared with a second statement of the same numbers.

mod figures;
mod listed;
mod named;

use groebot_robot::kinematics::{LengthUnit, Task};
use groebot_robot::robots;

#[test]
fn every_robot_is_a_chain_of_its_name_in_metres() {
    for robot in robots::ALL {
        let chain = robot.chain();
        assert_eq!(chain.name(), robot.name());
        assert_eq!(chain.length_unit(), LengthUnit::Metre, "{}", robot.name());
        assert!(chain.parts().source.is_some() && chain.parts().description.is_some(), "{}", robot.name());
        assert_eq!(robots::by_name(robot.name()), Some(chain));
    }
    assert_eq!(robots::by_name("c3po"), None);
}

#[test]
fn every_file_of_data_is_a_robot() {
    let folders = ["data", "named"].map(|name| format!("{}/src/robots/{name}", env!("CARGO_MANIFEST_DIR")));
    let files = folders.iter().flat_map(|folder| std::fs::read_dir(folder).unwrap());
    let texts: Vec<String> = files.map(|file| std::fs::read_to_string(file.unwrap().path()).unwrap()).collect();
    let unused = texts.iter().filter(|text| robots::LISTED.iter().all(|robot| robot.text() != text.as_str()));
    assert_eq!(unused.collect::<Vec<_>>(), Vec::<&String>::new());
}

#[test]
fn at_zero_the_tip_is_where_the_file_specifies() {
    for robot in robots::ALL {
        let chain = robot.chain();
        let pose = chain.forward(&vec![0.0; chain.joints().len()]).unwrap();
        assert_eq!(pose, chain.base_from_tip(), "{}", robot.name());
        assert!((0.0..2.0).contains(&chain.reach()), "{}", robot.name());
    }
}

#[test]
fn tasks_and_joints_are_as_promised() {
    for robot in robots::ALL {
        let chain = robot.chain();
        let (joints, task) = match robot.name() {
            "polar" => (3, Task::Position),
            "nao_head" => (2, Task::Pose),
            "nao_left_arm" | "nao_right_arm" => (5, Task::Pose),
            _ => (6, Task::Pose),
        };
        assert_eq!((chain.joints().len(), chain.task()), (joints, task), "{}", robot.name());
    }
}

#[test]
fn the_functions_give_the_robots_of_their_names() {
    assert_eq!(robots::puma().name(), "puma");
    assert_eq!(Some(robots::ur5()), robots::by_name("ur5"));
    assert_eq!(Some(robots::nao_left_leg()), robots::by_name("nao_left_leg"));
}
