//! The request for a solver: the task file of a folder, and options that override it.

use std::fs;

use groebot_ik::ErrorKind;
use groebot_ik::derive::problem::ends::TASK_NAME;
use groebot_ik::derive::{Ends, InputFile};
use groebot_robot::kinematics::{BaseAxis, Plane, Task};

use crate::errors::assert_error;

const ROBOT: &str = r#"<robot name="r"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
<joint name="one" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>
<joint name="two" type="continuous"><parent link="b"/><child link="c"/><origin xyz="1 0 0"/><axis xyz="0 1 0"/></joint>
<joint name="three" type="continuous"><parent link="b"/><child link="d"/><origin xyz="0 1 0"/><axis xyz="0 1 0"/></joint></robot>"#;
const TASK: &str = "tip = \"c\"\ngiven = [\"one\"]\n\n[task]\nkind = \"ray\"\ndirection = [\"1\", \"-1/2\", \"0\"]\n";

fn folder(task: Option<&str>) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("0_robot.urdf"), ROBOT).unwrap();
    if let Some(task) = task {
        fs::write(folder.path().join(TASK_NAME), task).unwrap();
    }
    folder
}

#[test]
fn a_folder_stores_the_request() {
    let folder = folder(Some(TASK));
    let input = InputFile::read(folder.path()).unwrap();
    assert_eq!(input.ends.to_toml(), TASK);
    let chain = input.chain(&Ends::default()).unwrap().unwrap();
    assert_eq!((chain.task(), chain.given(), chain.joints()[1].name.as_str()), (Task::Ray, vec![0], "two"));
    assert_eq!(chain.direction().each_ref().map(ToString::to_string), ["1", "-1/2", "0"]);
    assert_eq!(
        InputFile::read(&folder.path().join("0_robot.urdf")).unwrap().chain(&Ends::default()).unwrap(),
        Some(chain)
    );
}

#[test]
fn the_command_overrides_the_folder() {
    let folder = folder(Some(TASK));
    let input = InputFile::read(folder.path()).unwrap();
    let request =
        Ends { tip: Some("d".into()), task: Some(Task::Position), given: vec!["three".into()], ..Ends::default() };
    let chain = input.chain(&request).unwrap().unwrap();
    assert_eq!((chain.task(), chain.given(), chain.joints()[1].name.as_str()), (Task::Position, vec![1], "three"));
    assert_eq!(request.or(&input.ends).direction, None);
    let aimed = Ends { direction: request.or(&input.ends).direction.or(input.ends.direction.clone()), ..request };
    assert_error(&input.chain(&aimed).unwrap_err(), ErrorKind::BadValue, None, "orients no direction");
}

#[test]
fn every_task_file_is_read_as_it_was_written() {
    let yaw = Task::PositionYaw { axis: BaseAxis::Y };
    let tasks = [Task::Pose, Task::Direction, Task::Rotation, yaw, Task::PlanarPose { plane: Plane::Xz }];
    for task in tasks {
        let snap = Some(groebot_algebra::number::parse_rational("1e-5").unwrap());
        let ends = Ends { base: Some("a \"b\" \\".into()), task: Some(task), snap, ..Ends::default() };
        assert_eq!(Ends::from_toml(&ends.to_toml()).unwrap(), ends);
    }
    assert_eq!(Ends::from_toml("").unwrap(), Ends::default());
    assert_eq!(Ends::default().to_toml(), "");
}

#[test]
fn mistakes_are_reported() {
    assert_error(&Ends::from_toml("\ntips = 'a'").unwrap_err(), ErrorKind::UnknownKey, Some(2), "tips");
    assert_error(&Ends::from_toml("task = { kind = 'poses' }").unwrap_err(), ErrorKind::BadValue, Some(1), "pose");
    let folder = folder(Some("tip = 'c'\ngiven = ['four']"));
    let wrong = InputFile::read(folder.path()).unwrap().chain(&Ends::default()).unwrap_err();
    assert_error(&wrong, ErrorKind::UnknownName, None, "`one`, `two`");
    let system =
        InputFile::read(concat!(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."), "/derivations/nao_arm_planar").as_ref())
            .unwrap();
    let request = Ends { task: Some(Task::Pose), ..Ends::default() };
    assert_error(&system.chain(&request).unwrap_err(), ErrorKind::BadValue, None, "system of equations");
}
