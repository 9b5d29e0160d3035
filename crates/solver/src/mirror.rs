//! Candidates in pairs.
//!
//! After a root step `x^2 + constant` there must be no other branch. All values that depend on the root must keep or change their sign with it. Then the second
//! root's candidate differs from the first one's only in signs, to the last bit, because negation is exact. (The sign of a zero may also differ; neither the
//! equations nor angles depend on it.)

use std::collections::HashMap;

use super::instruction::{Instruction, Operand, Operation};
use super::joint::JointValue;
use super::program::{Block, Case, Program, Step, square};

/// The parity of a value when the root changes its sign.
#[derive(Clone, Copy, PartialEq)]
enum Parity {
    /// The value does not change.
    Even,
    /// The value changes its sign.
    Odd,
    /// Neither even nor odd.
    Mixed,
}

/// The case whose two roots give a pair of candidates each.
#[doc(hidden)]
pub struct Mirror {
    /// The index of its block.
    pub block: usize,
    /// The index of the case in the block.
    pub case: usize,
    /// By unknown, whether it changes its sign.
    pub odd: Vec<bool>,
}

impl Mirror {
    /// The mirror of a program, if it has one; `wanted` are the unknowns of a candidate.
    pub fn of(program: &Program, wanted: &[usize]) -> Option<Self> {
        let block = (0..program.blocks.len()).rev().find(|&block| !is_straight(&program.blocks[block]))?;
        let mut often = program.blocks[block].cases.iter().enumerate().filter(|(_, case)| !case.is_rare());
        let (index, case) = often.next().filter(|(_, case)| case.pivot.is_none() && !case.open)?;
        if often.next().is_some() {
            return None;
        }
        let mut unknowns = vec![Parity::Even; program.unknowns.len()];
        if !analyse_root(case, &mut unknowns) {
            return None;
        }
        for later in &program.blocks[block + 1..] {
            let mut registers = HashMap::new();
            run(&later.code, &unknowns, &mut registers);
            later.cases[0].steps.iter().for_each(|step| follow(step, &mut unknowns, &mut registers));
        }
        let is_length = |unknown: usize| program.joints.iter().any(|joint| joint.value == JointValue::Plain(unknown));
        let is_clear = |&unknown: &usize| match unknowns[unknown] {
            Parity::Even => true,
            Parity::Odd => !is_length(unknown),
            Parity::Mixed => false,
        };
        let odd = unknowns.iter().map(|parity| *parity == Parity::Odd).collect();
        wanted.iter().all(is_clear).then_some(Mirror { block, case: index, odd })
    }

    /// Whether both candidates of a pair have equal residuals: none of them changes its sign with the root.
    pub fn keeps_misses(&self, program: &Program) -> bool {
        let parity = |odd: &bool| if *odd { Parity::Odd } else { Parity::Even };
        let unknowns: Vec<Parity> = self.odd.iter().map(parity).collect();
        let mut registers = HashMap::new();
        run(&program.checks.code, &unknowns, &mut registers);
        let mut read = program.checks.residuals.iter().chain(&program.checks.scales);
        read.all(|&operand| self::parity(operand, &unknowns, &registers) == Parity::Even)
    }
}

/// Whether the only root step of a case keeps the magnitudes of the unknowns `found`, which the case finds.
pub(crate) fn turns(program: &Program, case: &Case, found: &[usize]) -> bool {
    let mut unknowns = vec![Parity::Even; program.unknowns.len()];
    analyse_root(case, &mut unknowns) && found.iter().all(|&unknown| unknowns[unknown] != Parity::Mixed)
}

/// Whether a block has one solution, by code without any condition.
fn is_straight(block: &Block) -> bool {
    let is_code = |step: &Step| matches!(step, Step::Compute(_) | Step::Set { .. });
    let [case] = block.cases.as_slice() else { return false };
    let is_plain = case.guards.is_empty() && case.pivot.is_none() && case.free.is_empty() && !case.open;
    is_plain && case.first_branch == 0 && case.steps.iter().all(is_code)
}

/// Analyses a case whose only root step is `x^2 + constant`; false for any other case.
fn analyse_root(case: &Case, unknowns: &mut [Parity]) -> bool {
    let mut registers = HashMap::new();
    let mut roots = 0;
    for step in &case.steps {
        match step {
            Step::Roots { unknown, polynomials, .. } if square(polynomials).is_some() => {
                unknowns[*unknown] = Parity::Odd;
                roots += 1;
            }
            Step::Compute(_) | Step::Set { .. } => follow(step, unknowns, &mut registers),
            _ => return false,
        }
    }
    roots == 1
}

fn follow(step: &Step, unknowns: &mut [Parity], registers: &mut HashMap<usize, Parity>) {
    match step {
        Step::Compute(code) => run(code, unknowns, registers),
        Step::Set { unknown, value } => unknowns[*unknown] = parity(*value, unknowns, registers),
        _ => {}
    }
}

fn run(code: &[Instruction], unknowns: &[Parity], registers: &mut HashMap<usize, Parity>) {
    for instruction in code {
        let value = result(instruction.operation, unknowns, registers);
        registers.insert(instruction.target, value);
    }
}

/// The parity of an operand. Registers that are not listed were computed before the root.
fn parity(operand: Operand, unknowns: &[Parity], registers: &HashMap<usize, Parity>) -> Parity {
    match operand {
        Operand::Unknown(unknown) => unknowns[unknown],
        Operand::Register(register) => registers.get(&register).copied().unwrap_or(Parity::Even),
        Operand::Constant(_) | Operand::Parameter(_) | Operand::Magnitude => Parity::Even,
    }
}

fn result(operation: Operation, unknowns: &[Parity], registers: &HashMap<usize, Parity>) -> Parity {
    let parity = |operand| parity(operand, unknowns, registers);
    let is_zero = |operand| matches!(operand, Operand::Constant(0.0));
    match operation {
        Operation::Add(a, b) | Operation::Sub(a, b) if is_zero(a) => parity(b),
        Operation::Add(a, b) | Operation::Sub(a, b) if is_zero(b) => parity(a),
        Operation::Add(a, b) | Operation::Sub(a, b) if parity(a) == parity(b) => parity(a),
        Operation::Add(..) | Operation::Sub(..) => Parity::Mixed,
        Operation::Mul(a, b) | Operation::Div(a, b) => match (parity(a), parity(b)) {
            (Parity::Mixed, _) | (_, Parity::Mixed) => Parity::Mixed,
            (a, b) if a == b => Parity::Even,
            _ => Parity::Odd,
        },
        Operation::Abs(a) if parity(a) != Parity::Mixed => Parity::Even,
        Operation::Sqrt(a) if parity(a) == Parity::Even => Parity::Even,
        Operation::Abs(_) | Operation::Sqrt(_) => Parity::Mixed,
    }
}
