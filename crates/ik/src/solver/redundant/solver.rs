//! A prepared redundant solver: [`RedundantSolver`].

use groebot_runtime as runtime;
use groebot_runtime::redundant::{Arm, Given, MOST_JOINTS, Members, Redundant, Target, Task};
use groebot_runtime::six_axes::Rigid;
use num_traits::ToPrimitive;

use crate::solver::{Joint, Program, Solver, TipTask, Unit};
use crate::solver::{Redundancy, RedundantPart};
use groebot_robot::kinematics::BaseAxis;

/// The solvers of an arm with one joint more than its task determines, prepared for evaluation. It is made once and solves any number of targets, also from
/// several threads at once.
#[derive(Clone, Debug)]
pub struct RedundantSolver {
    pub(super) arm: Arm,
    /// By joint, the solver with this joint given.
    solvers: Vec<Option<Solver>>,
    pub(super) joints: Vec<Joint>,
    /// The index of the given joint of the main solver.
    main: usize,
    /// The number of numbers of a target.
    pub(super) numbers: usize,
}

impl Program {
    /// The prepared solvers of a valid program ([`Program::validate`]) with a redundancy; `None` without one.
    pub fn redundant_solver(&self) -> Option<RedundantSolver> {
        self.redundancy.as_ref().map(|redundancy| RedundantSolver::new(self, redundancy))
    }
}

impl RedundantSolver {
    fn new(program: &Program, redundancy: &Redundancy) -> Self {
        let solver = |part: &RedundantPart| match part {
            RedundantPart::Main => Some(program.solver()),
            RedundantPart::Program(other) => Some(other.solver()),
            RedundantPart::Constant | RedundantPart::Unsolved(_) => None,
        };
        RedundantSolver {
            arm: arm(program, redundancy),
            solvers: redundancy.parts.iter().map(solver).collect(),
            joints: program.joints.clone(),
            main: program.given_joints.first().map_or(0, |given| given.joint),
            numbers: program.inputs.len().saturating_sub(program.given_joints.len()),
        }
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

    /// The numbers for the solver of `joint`: those of the target, and the value of the joint.
    pub(super) fn inputs(&self, target: &Target, value: f64) -> ([f64; Self::MOST_INPUTS], usize) {
        let mut inputs = [0.0; Self::MOST_INPUTS];
        inputs[..self.numbers].copy_from_slice(&target[..self.numbers]);
        inputs[self.numbers] = value;
        (inputs, self.numbers + 1)
    }

    /// The numbers of a target and one value.
    const MOST_INPUTS: usize = 13;
}

impl Redundant for RedundantSolver {
    fn arm(&self) -> &Arm {
        &self.arm
    }

    fn solve_given(&self, target: &Target, joint: usize, value: f64, out: &mut Members) -> Result<(), runtime::Error> {
        out.clear();
        let (inputs, count) = self.inputs(target, value);
        match &self.solvers[joint] {
            Some(solver) => solver.add_members(&inputs[..count], out),
            None => Ok(()),
        }
    }
}

/// The arm of a valid program in the run time's type.
pub(crate) fn arm(program: &Program, redundancy: &Redundancy) -> Arm {
    let mut arm = Arm {
        count: program.joints.len(),
        tip: Rigid { rotation: redundancy.rotation, translation: redundancy.position },
        task: program.tip().map_or(Task::Pose, task),
        length: program.scale,
        scanned: program.given_joints.first().map_or(0, |given| given.joint),
        ..Arm::NONE
    };
    let limits = redundancy.limit_pairs();
    #[allow(clippy::needless_range_loop, reason = "several rows have the same index")]
    for joint in 0..arm.count.min(MOST_JOINTS) {
        arm.directions[joint] = redundancy.lines[joint].direction;
        arm.points[joint] = redundancy.lines[joint].point;
        arm.slides[joint] = program.joints[joint].unit != Unit::Radian;
        arm.limits[joint] = limits[joint];
        arm.given[joint] = match redundancy.parts[joint] {
            RedundantPart::Main | RedundantPart::Program(_) => Given::Solved,
            RedundantPart::Constant => Given::Constant,
            RedundantPart::Unsolved(_) => Given::Unsolved,
        };
    }
    arm
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
