//! A task that suits a chain with fewer joints than its task determines: [`fitting_task`].

use num_traits::{One, Zero};

use super::{joints_to_give, plan};
use crate::Watch;
use crate::derive::closure::Mechanism;
use groebot_algebra::number::BigRational;
use groebot_robot::kinematics::{BaseAxis, Chain, ExactVector, Plane, Task};

/// The options of `groebot derive` for a task that the joints of `chain` can fulfil everywhere in their workspace, one joint at a time.
///
/// The task has as many freedoms as the chain has independent joints without given values, or one less. `None` if the chain has enough joints for its own task,
/// or if no such task is found.
pub fn fitting_task(chain: &Chain) -> Option<String> {
    let free = chain.independent().len();
    if free >= chain.task().freedoms() {
        return None;
    }
    let fits = |(task, direction): &(Task, ExactVector)| is_solved(chain, *task, direction);
    candidates(free).into_iter().find(fits).map(|(task, direction)| words(task, &direction))
}

/// The tasks with `free` freedoms, or one less, the most useful first.
fn candidates(free: usize) -> Vec<(Task, ExactVector)> {
    let aimed = |task: Task| [2, 0, 1].map(|axis| (task, along(axis)));
    let planes = [Plane::Xz, Plane::Xy, Plane::Yz];
    let plain = |task: Task| (task, along(2));
    match free {
        5 => aimed(Task::Ray).into_iter().chain([plain(Task::PositionPitchRoll)]).collect(),
        4 => {
            let about = |axis: BaseAxis| axis.across().map(|aim| (Task::PositionYaw { axis }, along(aim)));
            let axes = [BaseAxis::Z, BaseAxis::X, BaseAxis::Y];
            axes.into_iter().flat_map(about).chain([plain(Task::Position)]).collect()
        }
        3 => {
            let planar = planes.map(|plane| plain(Task::PlanarPose { plane }));
            planar.into_iter().chain([plain(Task::Position), plain(Task::Rotation)]).collect()
        }
        2 => {
            let planar = planes.map(|plane| plain(Task::PlanarPosition { plane }));
            planar.into_iter().chain(aimed(Task::Direction)).collect()
        }
        _ => Vec::new(),
    }
}

/// Whether the joints are found one at a time for the task. If the chain has one joint more than the task determines, one joint is given.
fn is_solved(chain: &Chain, task: Task, direction: &ExactVector) -> bool {
    let ask = |given: Vec<String>| chain.with_task(task, direction.clone(), given);
    let Ok(requested) = ask(chain.parts().given.clone()) else { return false };
    if requested.check_task().is_err() {
        return false;
    }
    let watch = Watch::none();
    let given = joints_to_give(&requested, &watch)
        .map(|choice| choice.map_or_else(|| requested.parts().given.clone(), |choice| choice.given));
    let mechanism = given.and_then(ask).and_then(|chain| Mechanism::new(&chain));
    mechanism.and_then(|mechanism| plan(&mechanism, &watch)).is_ok()
}

fn along(axis: usize) -> ExactVector {
    std::array::from_fn(|i| if i == axis { BigRational::one() } else { BigRational::zero() })
}

fn words(task: Task, direction: &ExactVector) -> String {
    let plane = task.plane().map(|plane| format!(" --plane {}", plane.name())).unwrap_or_default();
    let axis = task.axis().map(|axis| format!(" --axis {}", axis.name())).unwrap_or_default();
    let aimed = direction.each_ref().map(ToString::to_string).join(",");
    let aimed = if task.aims() { format!(" --direction {aimed}") } else { String::new() };
    format!("--task {}{plane}{axis}{aimed}", task.name())
}
