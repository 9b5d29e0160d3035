//! What a program says of its task. Main type: [`Outline`].

use crate::solver::Program;
use groebot_robot::kinematics::{BaseAxis, Plane, Task};

/// The task of a program.
#[derive(Clone, Debug)]
pub(crate) struct Outline {
    /// The task; `None` for equations with other inputs, and for several tips.
    pub task: Option<Task>,
    /// The number of inputs of the task, without given joints.
    pub own: usize,
    /// The number of all inputs.
    pub inputs: usize,
    /// The typical length, in the unit of the inputs: the reach of a chain.
    pub scale: f64,
}

impl Outline {
    pub fn new(program: &Program) -> Self {
        let own = program.given().start;
        let names: Vec<&str> = program.inputs[..own].iter().map(|input| input.name.as_str()).collect();
        Outline { task: task_of(&names), own, inputs: program.inputs.len(), scale: program.scale }
    }
}

/// The task whose numbers have these names.
fn task_of(names: &[&str]) -> Option<Task> {
    let planes = [Plane::Xy, Plane::Xz, Plane::Yz];
    let whole = [Task::Pose, Task::Position, Task::Ray, Task::Direction, Task::Rotation, Task::PositionPitchRoll];
    let planar = planes.into_iter().flat_map(|plane| [Task::PlanarPosition { plane }, Task::PlanarPose { plane }]);
    let yaw = BaseAxis::ALL.into_iter().map(|axis| Task::PositionYaw { axis });
    whole.into_iter().chain(planar).chain(yaw).find(|task| task.numbers() == names)
}
