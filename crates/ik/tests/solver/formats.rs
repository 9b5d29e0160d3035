//! The tasks and the given joints of programs, in format 3 and as read from format 2.

use groebot_ik::derive::{Derivation, Source};
use groebot_ik::folder;
use groebot_ik::solver::{GivenJoint, Program, Reached, TipTask};
use groebot_ik::{ErrorKind, Watch};
use groebot_robot::kinematics::Task;
use serde_json::{Value, json};

use crate::codegen::samples::{arm, wrist};

fn path(name: &str) -> std::path::PathBuf {
    std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../derivations")).join(name)
}

/// The program as format 2 stores it, with the target as text.
fn in_format_2(program: &Program) -> String {
    let mut value: Value = serde_json::from_str(&program.to_json()).unwrap();
    let object = value.as_object_mut().unwrap();
    object.insert("format".into(), json!(2));
    object.remove("tasks").unwrap();
    object.remove("given_joints").unwrap();
    if let Some(about) = object.get_mut("about") {
        about["task"] = program.task_text().into();
    }
    value.to_string()
}

/// A file that groebot wrote before format 3.
#[test]
fn a_file_of_format_2_is_read() {
    let program = Program::from_json(include_str!("../regressions/format_2/iiwa14.json")).unwrap();
    let pose = TipTask { chain: None, task: Task::Pose, direction: None, first_input: 0 };
    assert_eq!(program.tasks, [pose]);
    assert_eq!(program.given_joints, [GivenJoint { joint: 2, input: 12 }]);
    assert_eq!(program.task_text(), "pose, A3 given");
    assert!(program.to_json().contains("\"format\": 3"));
    let again = Program::from_json(&program.to_json()).unwrap();
    assert_eq!(again, program);
    let q = [0.3, -0.6, 0.4, 1.1, -0.2, 0.7, 0.5];
    let target = program.reached(&q).unwrap();
    assert_eq!(target[12], q[2]);
    let answers = program.solve_numbers(&target).unwrap();
    let is_near = |own: &[f64]| own.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-9);
    assert!(
        answers.iter().any(|answer| is_near(&answer.q))
            && answers.iter().all(|answer| (answer.q[2] - q[2]).abs() < 1e-12)
    );
}

#[test]
fn tasks_and_given_joints_are_read_from_the_words_of_format_2() {
    let names = [
        "nao_head",
        "nao_left_arm",
        "nao_arm_planar",
        "nao_left_arm_position",
        "nao_leg_sagittal",
        "nao_legs",
        "planar_4r",
        "polar",
        "scara_yaw",
        "upright_arm",
        "wrist_rotation",
    ];
    for name in names {
        let program = folder::program(&path(name)).unwrap();
        assert_eq!(Program::from_json(&in_format_2(&program)).unwrap(), program, "{name}");
    }
}

/// Without a description, the names of the inputs determine the task.
#[test]
fn without_words_the_inputs_have_the_names_of_a_task() {
    let program = wrist::carried();
    assert_eq!(Program::from_json(&in_format_2(&program)).unwrap().tasks, program.tasks);
    // The inputs of this arm are x, y, z.
    assert!(Program::from_json(&in_format_2(&arm::program())).unwrap().tasks.is_empty());
}

#[test]
fn other_formats_are_refused() {
    for format in [1, 4] {
        let text = arm::program().to_json().replace("\"format\": 3", &format!("\"format\": {format}"));
        let error = Program::from_json(&text).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Unsupported);
        assert!(error.message().contains(&format!("`format` {format}; 2 to 3 are read")), "{error}");
    }
}

/// A joint and a number of the task may have the same name.
#[test]
fn a_given_joint_may_have_the_name_of_a_number() {
    let mut source = Source::read(&path("nao_left_arm_position")).unwrap();
    let own = Derivation::of(&source, &Watch::none()).unwrap();
    let mut parts = source.chain.unwrap().parts().clone();
    parts.given = vec!["px".into()];
    parts.joints[2].name = "px".into();
    if let Some(meant) = &mut parts.meant {
        meant.joints[2].name = "px".into();
    }
    (source.chain, source.ideal) = (Some(parts.try_into().unwrap()), None);
    let renamed = Derivation::of(&source, &Watch::none()).unwrap();
    let program = renamed.program();
    let names: Vec<&str> = program.inputs.iter().map(|input| input.name.as_str()).collect();
    assert_eq!(names, ["px", "py", "pz", "px"]);
    assert_eq!((program.tip().unwrap().task, program.tip().unwrap().first_input), (Task::Position, 0));
    assert_eq!(program.given_joints, [GivenJoint { joint: 2, input: 3 }]);
    assert!(program.is_given(2) && !program.is_given(0));
    assert_eq!(program.forward().unwrap().inputs[3], Reached::Joint(2));
    assert!(matches!(program.forward().unwrap().inputs[0], Reached::Value(_)));
    let numbers = own.reached(&[0.3, 0.2, 0.7, -0.6]).unwrap();
    let (target, given) = (Task::Position.layout().target(&numbers[..3]).unwrap(), [0.7]);
    let answers = program.solver().solve_given(target, &given).unwrap();
    assert!(!answers.is_empty() && answers.iter().all(|answer| (answer.q[2] - given[0]).abs() < 1e-12));
    assert_eq!(answers, own.solver().solve_given(target, &given).unwrap());
    assert_eq!(
        Program::from_json(&in_format_2(&renamed.about(&source).program().clone())).unwrap().given_joints.len(),
        1
    );
}

/// In composed programs, the numbers of one task are given once.
#[test]
fn tasks_of_composed_programs_are_kept() {
    let first = wrist::program(false);
    let both = first.followed_by(&first.prefixed("b_"), &[]).unwrap();
    assert_eq!(both.tasks.iter().map(|tip| tip.first_input).collect::<Vec<_>>(), [0, 9]);
    assert_eq!(both.task_text(), "rotation; rotation");
    let same = first.followed_by(&first, &[]).unwrap();
    assert_eq!((same.tasks.len(), same.inputs.len()), (1, 9));
}

#[test]
fn tasks_and_given_joints_must_fit_the_inputs() {
    #[track_caller]
    fn refused(change: impl Fn(&mut Program), part: &str) {
        let mut program = wrist::carried();
        program.validate().unwrap();
        change(&mut program);
        let error = program.validate().unwrap_err();
        assert_eq!(error.kind(), ErrorKind::BadValue);
        assert!(error.message().contains(part), "`{part}` is not in: {error}");
    }
    refused(|program| program.tasks[0].first_input = 1, "an input does not exist");
    refused(|program| program.tasks[0].first_input = usize::MAX, "an input does not exist");
    refused(|program| program.tasks[0].task = Task::PositionPitchRoll, "another unit");
    refused(|program| program.tasks[0].task = Task::Ray, "the condition");
    refused(|program| program.tasks[0].direction = Some(Task::Ray.usual_direction()), "a direction");
    refused(|program| program.tasks.push(program.tasks[0].clone()), "used twice");
    refused(|program| program.given_joints.push(GivenJoint { joint: 0, input: 0 }), "used twice");
    refused(|program| program.given_joints.push(GivenJoint { joint: 9, input: 0 }), "does not exist");
    refused(|program| program.given_joints.push(GivenJoint { joint: 5, input: 0 }), "different units");
}
