//! Names of the numbers of a task's target: those of derived solvers.

use std::path::Path;

use groebot_ik::folder;
use groebot_robot::kinematics::{Plane, Task};

#[test]
fn a_task_names_its_numbers_as_derived_solvers_do() {
    let cases = [
        (Task::Pose, "ur5"),
        (Task::Position, "polar"),
        (Task::Ray, "nao_left_arm"),
        (Task::Direction, "nao_head"),
        (Task::Rotation, "wrist_rotation"),
        (Task::PositionPitchRoll, "upright_arm"),
        (Task::PlanarPosition { plane: Plane::Xz }, "nao_leg_sagittal"),
        (Task::PlanarPose { plane: Plane::Xz }, "prr"),
    ];
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations");
    for (task, name) in cases {
        let program = folder::program(&root.join(name)).unwrap();
        let names: Vec<String> = program.inputs.iter().map(|input| input.name.clone()).collect();
        assert_eq!(task.layout().names(), names, "{}", task.name());
        assert_eq!(program.tip().map(|tip| tip.task), Some(task), "{name}");
    }
}
