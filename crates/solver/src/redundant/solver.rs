//! A prepared redundant solver: [`RedundantSolver`].

use std::sync;

use groebot_runtime as runtime;
use groebot_runtime::redundant::{self, Arm, Given, Members, Redundant, Target, Task};
use groebot_runtime::six_axes::Rigid;
use nalgebra::{Matrix3, Point3, UnitQuaternion, Vector3};
use num_traits::ToPrimitive;

use crate::MOST_SCANNED;
use crate::{Joint, Program, Solver, TipTask, Unit};
use crate::{Redundancy, RedundantPart};
use groebot_robot::kinematics::BaseAxis;
use groebot_robot::spatial::Pose;

/// The solvers of an arm with one joint more than its task determines, prepared for evaluation. It is made once and solves any number of targets, also from
/// several threads at once.
#[derive(Clone, Debug)]
pub struct RedundantSolver {
    pub(super) arm: Arm,
    /// By joint of the arm, the solver with this joint given.
    solvers: sync::Arc<[Option<Solver>]>,
    pub(super) joints: Vec<Joint>,
    /// The indices of the arm's joints in the chain.
    pub(super) own: Vec<usize>,
    /// The joints of the chain that are held, with their values.
    pub(super) held: Vec<(usize, f64)>,
    /// The index of the given joint of the main solver.
    main: usize,
    /// The number of numbers of a target.
    pub(super) numbers: usize,
}

impl Program {
    /// The prepared solvers of a valid program ([`Program::validate`]) with a redundancy; `None` without one, and for an arm with scanned joints
    /// ([`Program::scanning_solver`]).
    pub fn redundant_solver(&self) -> Option<RedundantSolver> {
        self.curves().map(|redundancy| RedundantSolver::new(self, redundancy, &[]))
    }

    /// The redundancy of an arm without scanned joints: the solutions of a target are curves.
    #[doc(hidden)]
    pub fn curves(&self) -> Option<&Redundancy> {
        self.redundancy.as_deref().filter(|redundancy| redundancy.scanned().is_empty())
    }
}

impl RedundantSolver {
    /// The solvers with the scanned joints held at `values`.
    pub(super) fn new(program: &Program, redundancy: &Redundancy, values: &[f64]) -> Self {
        let (own, held) = own_and_held(redundancy, values);
        let solver = |joint: &usize| match &redundancy.parts[*joint] {
            RedundantPart::Main => Some(program.solver()),
            RedundantPart::Program(other) => Some(other.solver()),
            RedundantPart::Constant | RedundantPart::Scanned | RedundantPart::Unsolved(_) => None,
        };
        let arm = arm_at(program, redundancy, values);
        RedundantSolver {
            solvers: own.iter().map(solver).collect(),
            joints: own.iter().map(|&joint| program.joints[joint].clone()).collect(),
            main: arm.scanned,
            numbers: program.inputs.len().saturating_sub(program.given_joints.len()),
            arm,
            own,
            held,
        }
    }

    /// The same solvers with the held joints at other values.
    pub(super) fn held_at(&self, program: &Program, redundancy: &Redundancy, values: &[f64]) -> Self {
        let (_, held) = own_and_held(redundancy, values);
        RedundantSolver { arm: arm_at(program, redundancy, values), held, ..self.clone() }
    }

    /// The data of the arm: axes and limits as described, and which joints have a solver. Lengths are in the unit of the program. The scanned joint is the given
    /// joint of the program, which the planner chose; it is not selected by speed or by the share of values that have solutions.
    pub fn arm_data(&self) -> &Arm {
        &self.arm
    }

    /// The solver whose given joint is the one of the program.
    pub(super) fn main(&self) -> &Solver {
        self.solvers[self.main].as_ref().expect("a valid program has its main part")
    }

    /// The numbers for the main solver: those of the target, and the given values.
    pub(super) fn inputs(&self, target: &Target, value: f64) -> ([f64; Self::MOST_INPUTS], usize) {
        self.inputs_of(target, self.main, value)
    }

    /// The numbers for the solver of `joint`: those of the target, and the given values from base to tip.
    fn inputs_of(&self, target: &Target, joint: usize, value: f64) -> ([f64; Self::MOST_INPUTS], usize) {
        let mut inputs = [0.0; Self::MOST_INPUTS];
        inputs[..self.numbers].copy_from_slice(&target[..self.numbers]);
        let place = self.own[joint];
        let before = self.held.iter().filter(|(held, _)| *held < place).count();
        for (k, (_, held)) in self.held.iter().enumerate() {
            inputs[self.numbers + k + usize::from(k >= before)] = *held;
        }
        inputs[self.numbers + before] = value;
        (inputs, self.numbers + 1 + self.held.len())
    }

    /// The numbers of a target and the given values.
    const MOST_INPUTS: usize = 13 + MOST_SCANNED;

    /// The values of all joints of the chain.
    pub(super) fn all_joints(&self, q: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; q.len() + self.held.len()];
        self.held.iter().for_each(|(place, value)| all[*place] = *value);
        self.own.iter().zip(q).for_each(|(place, value)| all[*place] = *value);
        all
    }
}

impl Redundant for RedundantSolver {
    fn arm(&self) -> &Arm {
        &self.arm
    }

    fn solve_given(&self, target: &Target, joint: usize, value: f64, out: &mut Members) -> Result<(), runtime::Error> {
        out.clear();
        let (inputs, count) = self.inputs_of(target, joint, value);
        match &self.solvers[joint] {
            Some(solver) => solver.add_members(&inputs[..count], &self.own, out),
            None => Ok(()),
        }
    }
}

/// The indices of the joints that are not scanned, and the scanned ones with their values.
fn own_and_held(redundancy: &Redundancy, values: &[f64]) -> (Vec<usize>, Vec<(usize, f64)>) {
    let scanned = redundancy.scanned();
    let own = (0..redundancy.parts.len()).filter(|joint| !scanned.contains(joint)).collect();
    (own, scanned.into_iter().zip(values.iter().copied()).collect())
}

/// The arm of a valid program without scanned joints in the run time's type.
#[doc(hidden)]
pub fn arm(program: &Program, redundancy: &Redundancy) -> Arm {
    arm_at(program, redundancy, &[])
}

/// The arm of a valid program in the run time's type, with the scanned joints held at `values`: they move the axes after them.
fn arm_at(program: &Program, redundancy: &Redundancy, values: &[f64]) -> Arm {
    let (own, held) = own_and_held(redundancy, values);
    let value = |joint: usize| held.iter().find(|(place, _)| *place == joint).map(|(_, value)| *value);
    let is_main = |place: &usize| redundancy.parts[*place] == RedundantPart::Main;
    let mut arm = Arm {
        count: own.len(),
        task: program.tip().map_or(Task::Pose, task),
        length: program.scale,
        scanned: own.iter().position(is_main).unwrap_or(0),
        ..Arm::NONE
    };
    arm.grid = arm.scanned;
    if let Some(closed) = &redundancy.closed {
        arm.grid = closed.grid;
        arm.section_count = closed.sections.len();
        for (place, section) in arm.sections.iter_mut().zip(&closed.sections) {
            *place = redundant::Section { joint: section.joint, value: section.value };
        }
    }
    let (limits, mut moved, mut k) = (redundancy.limit_pairs(), Pose::identity(), 0);
    for (place, line) in redundancy.lines.iter().enumerate() {
        let (direction, point) = (Vector3::from(line.direction), Point3::from(line.point));
        let slides = program.joints[place].unit != Unit::Radian;
        if let Some(value) = value(place) {
            moved *= motion(direction, point, slides, value);
            continue;
        }
        arm.directions[k] = (moved.rotation * direction).into();
        arm.points[k] = (moved * point).into();
        arm.slides[k] = slides;
        arm.limits[k] = limits[place];
        arm.given[k] = match redundancy.parts[place] {
            RedundantPart::Main | RedundantPart::Program(_) => Given::Solved,
            RedundantPart::Constant => Given::Constant,
            RedundantPart::Scanned | RedundantPart::Unsolved(_) => Given::Unsolved,
        };
        k += 1;
    }
    let rotation = moved.rotation.to_rotation_matrix() * Matrix3::from_fn(|i, j| redundancy.rotation[i][j]);
    arm.tip = Rigid {
        rotation: std::array::from_fn(|i| std::array::from_fn(|j| rotation[(i, j)])),
        translation: (moved * Point3::from(redundancy.position)).into(),
    };
    arm
}

/// The motion of a joint.
fn motion(direction: Vector3<f64>, point: Point3<f64>, slides: bool, value: f64) -> Pose {
    if slides {
        return Pose::from_parts((value * direction).into(), UnitQuaternion::identity());
    }
    let rotation = UnitQuaternion::from_scaled_axis(value * direction);
    Pose::from_parts((point - rotation * point).into(), rotation)
}

/// The task in the run time's type.
fn task(tip: &TipTask) -> Task {
    use groebot_robot::kinematics::Task as Kind;
    let direction = || {
        let [x, y, z]: [f64; 3] = tip
            .direction
            .as_ref()
            .map_or([0.0, 0.0, 1.0], |direction| direction.each_ref().map(|entry| entry.to_f64().unwrap_or(0.0)));
        let length = (x * x + y * y + z * z).sqrt();
        [x / length, y / length, z / length]
    };
    match tip.task {
        Kind::Position => Task::Position,
        Kind::Rotation => Task::Rotation,
        Kind::Pose => Task::Pose,
        Kind::Ray => Task::Ray { direction: direction() },
        Kind::Direction => Task::Direction { direction: direction() },
        Kind::PositionPitchRoll => Task::PositionPitchRoll,
        Kind::PositionYaw { axis } => {
            let axis = match axis {
                BaseAxis::X => 0,
                BaseAxis::Y => 1,
                BaseAxis::Z => 2,
            };
            Task::PositionYaw { axis, direction: direction() }
        }
        Kind::PlanarPosition { plane } => Task::PlanarPosition { coordinates: plane.coordinates() },
        Kind::PlanarPose { plane } => Task::PlanarPose { coordinates: plane.coordinates() },
    }
}
