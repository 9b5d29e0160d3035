//! Answers without an arc tangent: [`Program::solve_pairs`].

use serde::Serialize;

use super::instruction::{Instruction, Operand, Operation};
use super::joint::{Joint, JointValue};
use super::path::Path;
use super::program::{Program, Step};
use super::{BLUR, refine};
use crate::kinematics::Solution;

/// Angles differ by more than [`BLUR`] where their difference has a cosine below this.
const FAR_APART: f64 = 1.0 - 0.52 * BLUR * BLUR;

/// One answer of a program, by cosines and sines.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Pairs {
    /// By joint: the cosine and the sine of an angle; a length's value, in the program's unit, and zero.
    pub joints: Vec<[f64; 2]>,
    /// [`Solution::residual`].
    pub residual: f64,
    /// [`Solution::branch`].
    pub branch: usize,
    /// [`Solution::free`].
    pub free: Vec<usize>,
}

impl Program {
    pub(super) fn pairs_of(&self, solution: &Solution) -> Pairs {
        let mut unknowns = vec![0.0; self.unknowns.len()];
        refine::unknowns_of(self, &solution.q, &mut unknowns);
        let (residual, branch, free) = (solution.residual, solution.branch, solution.free.clone());
        Pairs { joints: self.joint_pairs(&unknowns), residual, branch, free }
    }

    fn joint_pairs(&self, unknowns: &[f64]) -> Vec<[f64; 2]> {
        let pair = |value| match value {
            JointValue::Angle { cosine, sine } => [unknowns[cosine] + 0.0, unknowns[sine] + 0.0],
            JointValue::Plain(unknown) => [unknowns[unknown], 0.0],
        };
        self.joints.iter().map(|joint| pair(joint.value)).collect()
    }

    /// Whether all equations compare the tip with the target, by sums and products of joints' cosines and sines: printed solvers can
    /// measure candidates then without their angles.
    pub(crate) fn compares_tip(&self) -> bool {
        let is_angle = |value| matches!(value, JointValue::Angle { .. });
        let mut steps = self.cases().flat_map(|case| &case.steps);
        let Some(forward) = self.forward().filter(|forward| !forward.inputs.is_empty()) else { return false };
        let values: Option<Vec<Operand>> = forward.equations.iter().map(|pair| pair.map(|(value, _)| value)).collect();
        self.joints.iter().any(|joint| is_angle(joint.value))
            && !steps.any(|step| matches!(step, Step::SixAxes(_)))
            && self.checks.code.iter().all(|instruction| self.reads_joints(instruction))
            && values.is_some_and(|values| self.are_polynomials(values))
    }

    /// Whether all unknowns that an instruction reads are joints'.
    fn reads_joints(&self, instruction: &Instruction) -> bool {
        let (left, right) = instruction.operation.operands();
        let is_joints = |unknown: usize| self.joints.iter().any(|joint| joint.value.unknowns().contains(&unknown));
        [Some(left), right].into_iter().flatten().all(|operand| match operand {
            Operand::Unknown(unknown) => is_joints(unknown),
            _ => true,
        })
    }

    /// Whether values of the checks' code are sums and products.
    fn are_polynomials(&self, mut open: Vec<Operand>) -> bool {
        let mut seen = vec![false; self.checks.code.len()];
        while let Some(operand) = open.pop() {
            let Operand::Register(register) = operand else { continue };
            if std::mem::replace(&mut seen[register], true) {
                continue;
            }
            let operation = self.checks.code[register].operation;
            if !matches!(operation, Operation::Add(..) | Operation::Sub(..) | Operation::Mul(..)) {
                return false;
            }
            let (left, right) = operation.operands();
            open.extend([Some(left), right].into_iter().flatten());
        }
        true
    }
}

/// The pairs of all candidates so far, as long as all of them solve the equations within rounding and are apart.
pub(super) struct UsualPairs(Option<Vec<Pairs>>);

impl UsualPairs {
    pub fn none_yet() -> Self {
        UsualPairs(Some(Vec::new()))
    }

    /// Answers are asked for by angles: no pair is made.
    pub fn unwanted() -> Self {
        UsualPairs(None)
    }

    /// A candidate is none of that kind.
    pub fn give_up(&mut self) {
        self.0 = None;
    }

    /// Adds a candidate that solves the equations within rounding.
    pub fn add(&mut self, program: &Program, path: &Path, residual: f64, unknowns: &[f64]) {
        let Some(list) = &mut self.0 else { return };
        let joints = program.joint_pairs(unknowns);
        let tells = |(joint, (a, b)): (&Joint, (&[f64; 2], &[f64; 2]))| {
            matches!(joint.value, JointValue::Angle { .. }) && a[0] * b[0] + a[1] * b[1] < FAR_APART
        };
        let is_apart = |other: &Pairs| {
            other.branch != path.branch && program.joints.iter().zip(joints.iter().zip(&other.joints)).any(tells)
        };
        if list.len() < program.capacity && list.iter().all(is_apart) {
            list.push(Pairs { joints, residual, branch: path.branch, free: Vec::new() });
        } else {
            self.give_up();
        }
    }

    /// The pairs, if there are no more than the program's isolated answers.
    pub fn into_list(self, program: &Program) -> Option<Vec<Pairs>> {
        self.0.filter(|list| program.isolated.is_none_or(|most| list.len() <= most))
    }
}
