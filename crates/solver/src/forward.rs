//! Forward kinematics from a program's own equations: [`Program::forward`].
//!
//! The checks of a chain compare the tip with the target, `value(q) - parameter = 0`, one equation per parameter;
//! `value` is the pose that the joints reach.

use super::instruction::{Instruction, Operand, Operation};
use super::joint::JointValue;
use super::program::Program;
use super::rule::Rule;
use super::tips::GivenJoint;

/// The target that joint values reach, as operands of the checks' code.
#[derive(Clone, Debug, PartialEq)]
pub struct Forward {
    /// The inputs of the target, in order.
    pub inputs: Vec<Reached>,
    /// By equation, the part that depends only on the joints, and the parameter that it is compared with.
    pub equations: Vec<Option<(Operand, usize)>>,
}

/// The expression of an input of the target by the joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reached {
    /// This value.
    Value(Operand),
    /// The angle of this cosine and sine.
    Angle {
        /// The cosine.
        cosine: Operand,
        /// The sine.
        sine: Operand,
    },
    /// The value of the joint with this index, which the user gives.
    Joint(usize),
}

impl Program {
    /// The target that joint values reach. `None` for a program whose equations do not compare each number of the
    /// target with an expression of the joints.
    pub fn forward(&self) -> Option<Forward> {
        let pure = self.pure_registers();
        let equations: Vec<_> = self.checks.residuals.iter().map(|&residual| self.compared(residual, &pure)).collect();
        let inputs =
            (0..self.inputs.len()).map(|input| self.reached_input(input, &equations)).collect::<Option<_>>()?;
        Some(Forward { inputs, equations })
    }

    /// By register of the checks, whether it depends only on the joints.
    fn pure_registers(&self) -> Vec<bool> {
        let mut pure = Vec::with_capacity(self.checks.code.len());
        for Instruction { operation, .. } in &self.checks.code {
            let (left, right) = operation.operands();
            let depends = |operand| self.is_pure(operand, &pure);
            pure.push(depends(left) && right.is_none_or(depends));
        }
        pure
    }

    fn is_pure(&self, operand: Operand, pure: &[bool]) -> bool {
        match operand {
            Operand::Constant(_) => true,
            Operand::Unknown(unknown) => self.joints.iter().any(|joint| joint.value.unknowns().contains(&unknown)),
            Operand::Register(register) => pure[register],
            Operand::Parameter(_) | Operand::Magnitude => false,
        }
    }

    /// The sides of an equation `value - parameter`.
    fn compared(&self, residual: Operand, pure: &[bool]) -> Option<(Operand, usize)> {
        let Operand::Register(register) = residual else { return None };
        match self.checks.code[register].operation {
            Operation::Sub(value, Operand::Parameter(parameter)) if self.is_pure(value, pure) => {
                Some((value, parameter))
            }
            _ => None,
        }
    }

    fn reached_input(&self, input: usize, equations: &[Option<(Operand, usize)>]) -> Option<Reached> {
        let reaches = |rule: Rule| {
            let parameter = self.parameters.iter().position(|parameter| parameter.rule == rule)?;
            equations.iter().flatten().find(|(_, compared)| *compared == parameter).map(|(value, _)| *value)
        };
        let reached = match (reaches(Rule::Input(input)), reaches(Rule::Cosine(input)), reaches(Rule::Sine(input))) {
            (Some(value), _, _) => Reached::Value(value),
            (None, Some(cosine), Some(sine)) => Reached::Angle { cosine, sine },
            _ => return None,
        };
        let is_given = |given: &GivenJoint| given.input == input && self.reaches(given.joint, reached);
        let given = self.given_joints.iter().find(|given| is_given(given));
        Some(given.map_or(reached, |given| Reached::Joint(given.joint)))
    }

    /// Whether the value of a joint is what the equations compare.
    fn reaches(&self, joint: usize, reached: Reached) -> bool {
        let own = match self.joints[joint].value {
            JointValue::Angle { cosine, sine } => {
                Reached::Angle { cosine: Operand::Unknown(cosine), sine: Operand::Unknown(sine) }
            }
            JointValue::Plain(unknown) => Reached::Value(Operand::Unknown(unknown)),
        };
        own == reached
    }
}
