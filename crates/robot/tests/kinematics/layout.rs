//! The numbers of targets.

use groebot_robot::kinematics::{BaseAxis, Plane, Quantity, Target, TargetNumber, Task};
use nalgebra::{UnitQuaternion, Vector3};

#[test]
fn numbers_have_names_in_the_order_of_derived_solvers() {
    let names = [
        (Task::Pose, "px py pz r11 r12 r13 r21 r22 r23 r31 r32 r33"),
        (Task::Position, "px py pz"),
        (Task::Rotation, "r11 r12 r13 r21 r22 r23 r31 r32 r33"),
        (Task::Ray, "px py pz dx dy dz"),
        (Task::Direction, "dx dy dz"),
        (Task::PositionPitchRoll, "px py pz pitch roll"),
        (Task::PositionYaw { axis: BaseAxis::X }, "px py pz yaw_x"),
        (Task::PositionYaw { axis: BaseAxis::Z }, "px py pz yaw"),
        (Task::PlanarPosition { plane: Plane::Xz }, "px pz"),
        (Task::PlanarPose { plane: Plane::Yz }, "py pz phi"),
    ];
    for (task, expected) in names {
        assert_eq!(task.layout().names().join(" "), expected, "{task}");
    }
}

#[test]
fn a_target_is_its_numbers() {
    for task in Task::all() {
        let layout = task.layout();
        let rotation = UnitQuaternion::from_euler_angles(0.3, -0.5, 1.1).to_rotation_matrix();
        let direction = Vector3::new(0.48, 0.6, 0.64);
        let value = |number: &TargetNumber| match *number {
            TargetNumber::Position(axis) => 0.1 + axis.coordinate() as f64,
            TargetNumber::Rotation { row, column } => rotation[(row.coordinate(), column.coordinate())],
            TargetNumber::Direction(axis) => direction[axis.coordinate()],
            TargetNumber::PlaneAngle(_) | TargetNumber::Yaw(_) => 0.7,
            TargetNumber::Pitch => -0.2,
            TargetNumber::Roll => 0.4,
        };
        let values: Vec<f64> = layout.numbers().iter().map(value).collect();
        let target = layout.target(&values).unwrap();
        assert!(target.is_of(task));
        let again = layout.values(&target).unwrap();
        assert!(again.iter().zip(&values).all(|(a, b)| (a - b).abs() < 1e-15), "{task}: {again:?}");
        assert!(layout.target(&values[1..]).is_err());
        let lengths = layout.numbers().iter().filter(|number| number.quantity() == Quantity::Length).count();
        assert_eq!(layout.lengths(), lengths, "lengths come first: {task}");
    }
}

#[test]
fn a_target_of_another_task_has_no_numbers() {
    let error = Task::Pose.layout().values(&Target::Position([0.0; 3].into())).unwrap_err();
    assert!(error.message().contains("the task is `pose`"), "{error}");
}

#[test]
fn rotations_and_directions_have_places() {
    let places = |task: Task| (task.layout().rotation(), task.layout().direction());
    assert_eq!(places(Task::Pose), (Some(3), None));
    assert_eq!(places(Task::Ray), (None, Some(3)));
    assert_eq!(places(Task::Direction), (None, Some(0)));
    assert_eq!(places(Task::Position), (None, None));
    let meaning = Task::Pose.layout().numbers()[4].to_string();
    assert_eq!(meaning, "row 1, column 2 of the rotation matrix");
}
