//! Names of the numbers of tasks: those of derived solvers.

use groebot_ik::solver::Program;
use groebot_robot::kinematics::{Plane, Task};

#[test]
fn a_task_names_its_numbers_as_derived_solvers_do() {
    let cases = [
        (Task::Pose, include_str!("../../../../derivations/ur5/5_program.json")),
        (Task::Position, include_str!("../../../../derivations/polar/5_program.json")),
        (Task::Ray, include_str!("../../../../derivations/nao_left_arm/5_program.json")),
        (Task::Direction, include_str!("../../../../derivations/nao_head/5_program.json")),
        (Task::Rotation, include_str!("../../../../derivations/wrist_rotation/5_program.json")),
        (Task::PositionPitchRoll, include_str!("../../../../derivations/upright_arm/5_program.json")),
        (
            Task::PlanarPosition { plane: Plane::Xz },
            include_str!("../../../../derivations/nao_leg_sagittal/5_program.json"),
        ),
        (Task::PlanarPose { plane: Plane::Xz }, include_str!("../../../../derivations/prr/5_program.json")),
    ];
    for (task, program) in cases {
        let program = Program::from_json(program).unwrap();
        let names: Vec<String> = program.inputs.into_iter().map(|input| input.name).collect();
        assert_eq!(task.numbers(), names, "{}", task.name());
    }
}
