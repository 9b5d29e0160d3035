//! Solutions as cosines and sines, without an arc tangent: [`Program::solve_pairs`].

use serde::Serialize;

use super::instruction::{Instruction, Operand, Operation};
use super::joint::JointValue;
use super::program::{Program, Step};
#[cfg(doc)]
use groebot_robot::kinematics::Solution;

/// A solution of a program, as cosines and sines.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Pairs {
    /// By joint, the cosine and the sine of an angle; for a length its value, in the program's unit, and zero.
    pub joints: Vec<[f64; 2]>,
    /// [`Solution::residual`].
    pub residual: f64,
    /// [`Solution::branch`].
    pub branch: usize,
    /// [`Solution::free`].
    pub free: Vec<usize>,
}

impl Program {
    /// Whether all equations compare the tip with the target, by sums and products of joints' cosines and sines. Then
    /// candidates can be measured without their angles.
    pub(crate) fn compares_tip(&self) -> bool {
        let is_angle = |value| matches!(value, JointValue::Angle { .. });
        let Some(forward) = self.forward().filter(|forward| !forward.inputs.is_empty()) else { return false };
        let values: Option<Vec<Operand>> = forward.equations.iter().map(|pair| pair.map(|(value, _)| value)).collect();
        self.joints.iter().any(|joint| is_angle(joint.value))
            && !self.has_six_axes()
            && self.checks.code.iter().all(|instruction| self.reads_joints(instruction))
            && values.is_some_and(|values| self.are_polynomials(values))
    }

    /// Whether a step finds six joints together.
    pub(crate) fn has_six_axes(&self) -> bool {
        self.cases().flat_map(|case| &case.steps).any(|step| matches!(step, Step::SixAxes(_)))
    }

    /// Whether all unknowns that an instruction reads belong to joints.
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
