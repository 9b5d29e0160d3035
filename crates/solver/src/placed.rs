//! Base and tool given at run time. Main type: [`PlacedSolver`].

use groebot_robot::kinematics::{BaseAxis, InverseKinematics, Solution, Target, Task};
use groebot_robot::spatial::{Pose, angle};
use groebot_runtime::target_of;
use groebot_runtime::tolerances::ACCEPTANCE;
use nalgebra::{Matrix3, Vector3};

use super::prepared::Outline;
use super::{Batch, Pairs, Program, Solver};
use crate::{Error, ErrorKind, Result};

/// Tolerance of a rotation that must be about an axis, and of a tool that must not move the tip \[rad, and relative to the reach\]. It is that of a
/// target's rotation.
const ALIGNED: f64 = ACCEPTANCE.input;

/// Where the base is in the world, and where the tool is on the tip. The default is the identity for both.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Placement {
    /// The pose of the base in the world frame, with lengths in the program's unit.
    pub world_from_base: Pose,
    /// The pose of the tool in the tip frame.
    pub tip_from_tool: Pose,
}

impl Placement {
    /// Sets the pose of the base in the world frame.
    #[must_use]
    pub fn base(mut self, world_from_base: Pose) -> Self {
        self.world_from_base = world_from_base;
        self
    }

    /// Sets the pose of the tool in the tip frame.
    #[must_use]
    pub fn tool(mut self, tip_from_tool: Pose) -> Self {
        self.tip_from_tool = tip_from_tool;
        self
    }

    fn inverse(&self) -> Self {
        Placement { world_from_base: self.world_from_base.inverse(), tip_from_tool: self.tip_from_tool.inverse() }
    }
}

/// A [`Placement`] that is checked for the task of a program. It converts targets.
#[derive(Clone, Debug, PartialEq)]
pub struct TaskPlacement {
    task: Task,
    /// The number of inputs of the task.
    own: usize,
    placement: Placement,
}

/// A [`Solver`] whose base is placed in a world frame, and whose tip has a tool. Its targets are those of the tool in the world frame.
#[derive(Clone, Debug)]
pub struct PlacedSolver<'a> {
    solver: &'a Solver,
    task: TaskPlacement,
}

impl Solver {
    /// The solver for targets of a tool in a world frame, world_from_tool.
    ///
    /// A pose allows any base and any tool. Other tasks allow the following.
    ///
    /// | task | base | tool |
    /// | --- | --- | --- |
    /// | position | any | rotation only, which has no effect |
    /// | rotation | any | any; its translation has no effect |
    /// | direction | any | translation only, which has no effect |
    /// | ray | any | none |
    /// | planar position | rotation about the normal of the plane | rotation only, which has no effect |
    /// | planar pose | rotation about the normal of the plane | none |
    /// | position and angle about an axis | rotation about this axis | none |
    /// | position, pitch and roll | rotation about z | none |
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for any other placement, and for a program that is not of one tip.
    pub fn placed(&self, placement: &Placement) -> Result<PlacedSolver<'_>> {
        Ok(PlacedSolver { solver: self, task: self.outline.placed(placement)? })
    }
}

impl Outline {
    fn placed(&self, placement: &Placement) -> Result<TaskPlacement> {
        let refuse = |text: String| Err(Error::new(ErrorKind::Unsupported, text));
        let Some(task) = self.task else {
            return refuse("base and tool belong to one tip; this solver is not of a task of one tip".to_owned());
        };
        if let Some(axis) = kept_axis(task)
            && !turns_about(&placement.world_from_base, axis)
        {
            return refuse(format!("for the task `{}` the base may only rotate about {}", task.name(), axis.name()));
        }
        match refused_tool(task, &placement.tip_from_tool, self.scale) {
            Some(reason) => refuse(format!("for the task `{}` the tool {reason}", task.name())),
            None => Ok(TaskPlacement { task, own: self.own, placement: *placement }),
        }
    }
}

/// The reason why a task does not allow a tool.
fn refused_tool(task: Task, tip_from_tool: &Pose, scale: f64) -> Option<&'static str> {
    let moves = tip_from_tool.translation.vector.norm() > ALIGNED * scale;
    let turns = tip_from_tool.rotation.angle() > ALIGNED;
    match task {
        Task::Pose | Task::Rotation => None,
        Task::Position | Task::PlanarPosition { .. } => moves.then_some("may only rotate; give no translation"),
        Task::Direction => turns.then_some("may only be moved; give no rotation"),
        _ => (moves || turns).then_some("must be the tip; derive a chain whose tip is the tool"),
    }
}

impl TaskPlacement {
    /// Checks a placement for the task of `program`.
    ///
    /// # Errors
    /// As [`Solver::placed`].
    pub fn new(program: &Program, placement: &Placement) -> Result<Self> {
        Outline::new(program).placed(placement)
    }

    /// The placement of base and tool.
    pub fn placement(&self) -> &Placement {
        &self.placement
    }

    /// Converts the numbers of a target world_from_tool to the base frame, base_from_tip. Numbers after them are unchanged, and so are too few numbers. For
    /// poses it is the conversion of the run times, equal to the last bit.
    pub fn to_base(&self, target: &mut [f64]) {
        if let Some(own) = target.get_mut(..self.own) {
            converted(self.task, &self.placement, own);
        }
    }

    /// Converts the numbers of a target base_from_tip to the world frame, world_from_tool.
    pub fn to_world(&self, target: &mut [f64]) {
        if let Some(own) = target.get_mut(..self.own) {
            converted(self.task, &self.placement.inverse(), own);
        }
    }
}

/// The axis of the base about which a task's angle or plane is.
fn kept_axis(task: Task) -> Option<BaseAxis> {
    match task {
        Task::PlanarPosition { plane } | Task::PlanarPose { plane } => Some(BaseAxis::ALL[plane.normal()]),
        Task::PositionYaw { axis } => Some(axis),
        Task::PositionPitchRoll => Some(BaseAxis::Z),
        _ => None,
    }
}

fn turns_about(pose: &Pose, axis: BaseAxis) -> bool {
    let normal = Vector3::ith(axis.coordinate(), 1.0);
    (pose.rotation * normal - normal).norm() <= ALIGNED
}

/// A pose as the first 12 numbers of a target.
fn numbers(pose: &Pose) -> [f64; 12] {
    let (at, rotation) = (pose.translation.vector, pose.rotation.to_rotation_matrix());
    std::array::from_fn(|i| if i < 3 { at[i] } else { rotation[((i - 3) / 3, (i - 3) % 3)] })
}

/// Converts a target by `base^-1 target tool^-1`.
fn converted(task: Task, placement: &Placement, target: &mut [f64]) {
    let base = &placement.world_from_base;
    let back = base.rotation.inverse();
    let moved = |at: &mut [f64]| {
        let point = back * (Vector3::from_row_slice(at) - base.translation.vector);
        at.copy_from_slice(point.as_slice());
    };
    let turned = |along: &mut [f64]| {
        let direction = back * Vector3::from_row_slice(along);
        along.copy_from_slice(direction.as_slice());
    };
    let turned_by = |axis: BaseAxis| 2.0 * base.rotation.imag()[axis.coordinate()].atan2(base.rotation.scalar());
    match task {
        Task::Pose => {
            let pose: [f64; 12] = std::array::from_fn(|i| target[i]);
            target.copy_from_slice(&target_of(&numbers(base), &numbers(&placement.tip_from_tool), &pose));
        }
        Task::Rotation => {
            let rotation = back.to_rotation_matrix().into_inner() * Matrix3::from_row_slice(target);
            let rotation = rotation * placement.tip_from_tool.rotation.inverse().to_rotation_matrix().into_inner();
            target.copy_from_slice(rotation.transpose().as_slice());
        }
        Task::Direction => turned(target),
        Task::Position | Task::PositionPitchRoll => moved(&mut target[..3]),
        Task::Ray => {
            moved(&mut target[..3]);
            turned(&mut target[3..6]);
        }
        Task::PositionYaw { axis } => {
            moved(&mut target[..3]);
            target[3] = angle::wrap(target[3] - turned_by(axis));
        }
        Task::PlanarPosition { plane } | Task::PlanarPose { plane } => {
            let [first, second] = plane.coordinates();
            let mut point = [0.0; 3];
            (point[first], point[second]) = (target[0], target[1]);
            moved(&mut point);
            (target[0], target[1]) = (point[first], point[second]);
            if let Some(phi) = target.get_mut(2) {
                *phi = angle::wrap(*phi - turned_by(BaseAxis::ALL[plane.normal()]));
            }
        }
    }
}

impl<'a> PlacedSolver<'a> {
    /// The solver of targets in the base frame.
    pub fn solver(&self) -> &'a Solver {
        self.solver
    }

    /// The placement of base and tool.
    pub fn placement(&self) -> &Placement {
        &self.task.placement
    }

    pub(super) fn task_placement(&self) -> &TaskPlacement {
        &self.task
    }

    /// The numbers of the target in the base frame, for the numbers of a target world_from_tool ([`TaskPlacement::to_base`]).
    pub fn base_from_tip(&self, world_from_tool: &[f64]) -> Vec<f64> {
        let mut target = world_from_tool.to_vec();
        self.task.to_base(&mut target);
        target
    }

    /// Same as [`Solver::solve`], but for a target of the tool in the world frame.
    ///
    /// # Errors
    /// As [`Solver::solve`].
    pub fn solve(&self, target: impl Into<Target>) -> Result<Vec<Solution>> {
        self.solve_given(target, &[])
    }

    /// Same as [`Solver::solve_given`], but for a target of the tool in the world frame.
    ///
    /// # Errors
    /// As [`Solver::solve_given`].
    pub fn solve_given(&self, target: impl Into<Target>, given: &[f64]) -> Result<Vec<Solution>> {
        self.solve_numbers(&self.solver.numbers_of(&target.into(), given)?)
    }

    /// Same as [`Solver::solve_numbers`], but for a target of the tool in the world frame.
    ///
    /// # Errors
    /// As [`Solver::solve_numbers`].
    pub fn solve_numbers(&self, target: &[f64]) -> Result<Vec<Solution>> {
        self.solver.solve_numbers(&self.base_from_tip(target))
    }

    /// Same as [`Solver::solve_pairs`], but for a target of the tool in the world frame.
    ///
    /// # Errors
    /// As [`Solver::solve_pairs`].
    pub fn solve_pairs(&self, target: &[f64]) -> Result<Vec<Pairs>> {
        self.solver.solve_pairs(&self.base_from_tip(target))
    }

    /// Same as [`Solver::solve_within`], but for a target of the tool in the world frame.
    ///
    /// # Errors
    /// As [`Solver::solve_within`].
    pub fn solve_within(&self, target: &[f64], limits: &[[f64; 2]]) -> Result<Vec<Solution>> {
        self.solver.solve_within(&self.base_from_tip(target), limits)
    }

    /// Same as [`Solver::nearest_to`], but for a target of the tool in the world frame.
    ///
    /// # Errors
    /// As [`Solver::nearest_to`].
    pub fn nearest_to(
        &self,
        target: &[f64],
        q0: &[f64],
        weights: Option<&[f64]>,
        limits: Option<&[[f64; 2]]>,
    ) -> Result<Option<Solution>> {
        self.solver.nearest_to(&self.base_from_tip(target), q0, weights, limits)
    }

    /// Same as [`Solver::solve_batch`], but for targets of the tool in the world frame.
    ///
    /// # Errors
    /// As [`Solver::solve_batch`].
    pub fn solve_batch(&self, targets: &[f64]) -> Result<Batch> {
        let mut batch = Batch::default();
        self.solve_batch_into(targets, &mut batch)?;
        Ok(batch)
    }

    /// Same as [`Solver::solve_batch_into`], but for targets of the tool in the world frame.
    ///
    /// # Errors
    /// As [`Solver::solve_batch_into`].
    pub fn solve_batch_into(&self, targets: &[f64], batch: &mut Batch) -> Result<()> {
        let mut converted = targets.to_vec();
        converted.chunks_mut(self.solver.outline.inputs.max(1)).for_each(|target| self.task.to_base(target));
        self.solver.solve_batch_into(&converted, batch)
    }

    /// Same as [`Solver::reached`], but for the target of the tool in the world frame.
    pub fn reached(&self, q: &[f64]) -> Option<Vec<f64>> {
        let mut target = self.solver.reached(q)?;
        self.task.to_world(&mut target);
        Some(target)
    }
}

impl InverseKinematics for PlacedSolver<'_> {
    fn solve(&self, target: &Target, given: &[f64], out: &mut Vec<Solution>) -> Result<()> {
        *out = self.solve_given(target, given)?;
        Ok(())
    }

    fn nearest_to(&self, target: &Target, given: &[f64], q0: &[f64], limits: &[[f64; 2]]) -> Result<Option<Solution>> {
        let numbers = self.base_from_tip(&self.solver.numbers_of(target, given)?);
        self.solver.nearest_to(&numbers, q0, None, Some(limits))
    }

    fn uses_eigenvalues(&self) -> bool {
        self.solver.uses_eigenvalues()
    }
}
