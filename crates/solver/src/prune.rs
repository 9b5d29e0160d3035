//! Removal of instructions whose results are not read.

use std::collections::{BTreeMap, BTreeSet};

use super::instruction::{Instruction, Operand, Operation};
use super::program::{Block, Case, Checks, Program, Short, Step};

impl Program {
    /// Same as `self`, without the instructions whose results are not read.
    #[doc(hidden)]
    pub fn pruned(mut self) -> Program {
        self.blocks.iter_mut().for_each(prune_block);
        self.checks = self.checks.pruned();
        self
    }
}

impl Checks {
    /// Same as `self`, without the instructions whose results are not read: first those for values and sizes, then the
    /// rest.
    #[doc(hidden)]
    pub fn pruned(mut self) -> Checks {
        prune_checks(&mut self);
        self
    }

    /// The number of instructions that the values and sizes need.
    #[doc(hidden)]
    pub fn work(&self) -> usize {
        self.measured().0.len()
    }

    /// The registers that values and sizes need.
    fn measured(&self) -> Live {
        let mut live = Live::default();
        self.residuals.iter().chain(&self.scales).for_each(|operand| live.read(*operand));
        live.code(&self.code);
        live
    }
}

/// The registers that are read.
#[derive(Default)]
struct Live(BTreeSet<usize>);

impl Live {
    fn read(&mut self, operand: Operand) {
        if let Operand::Register(index) = operand {
            self.0.insert(index);
        }
    }

    /// Adds the registers that code reads, if these registers are read after it.
    fn code(&mut self, code: &[Instruction]) {
        for instruction in code.iter().rev() {
            if self.0.contains(&instruction.target) {
                let (a, b) = instruction.operation.operands();
                [Some(a), b].into_iter().flatten().for_each(|operand| self.read(operand));
            }
        }
    }

    fn case(&mut self, case: &Case) {
        for step in case.steps.iter().rev() {
            match step {
                Step::Compute(code) => self.code(code),
                Step::Set { value, .. } => self.read(*value),
                Step::Roots { polynomials, typical, .. } => {
                    polynomials.iter().flatten().chain(typical).for_each(|operand| self.read(*operand));
                }
                Step::SixAxes(six) => six.operands().into_iter().for_each(|operand| self.read(operand)),
                Step::Sample { .. } => {}
            }
        }
        for guard in &case.guards {
            self.read(guard.value);
            self.read(guard.scale);
        }
        case.pivot.iter().for_each(|pivot| self.read(pivot.value));
        self.code(&case.guard_code);
    }
}

/// New numbers of registers.
#[derive(Clone, Default)]
struct Numbers(BTreeMap<usize, usize>);

impl Numbers {
    /// Removes dead instructions from `code`, and renumbers the rest.
    fn code(&mut self, code: &mut Vec<Instruction>, live: &Live) {
        code.retain(|instruction| live.0.contains(&instruction.target));
        for instruction in code {
            let next = self.0.len();
            self.operation(&mut instruction.operation);
            self.0.insert(instruction.target, next);
            instruction.target = next;
        }
    }

    fn operand(&self, operand: &mut Operand) {
        if let Operand::Register(index) = operand {
            *index = self.0[index];
        }
    }

    fn operation(&self, operation: &mut Operation) {
        match operation {
            Operation::Add(a, b) | Operation::Sub(a, b) | Operation::Mul(a, b) | Operation::Div(a, b) => {
                self.operand(a);
                self.operand(b);
            }
            Operation::Abs(a) | Operation::Sqrt(a) => self.operand(a),
        }
    }

    fn case(&mut self, case: &mut Case, live: &Live) {
        self.code(&mut case.guard_code, live);
        for guard in &mut case.guards {
            self.operand(&mut guard.value);
            self.operand(&mut guard.scale);
        }
        case.pivot.iter_mut().for_each(|pivot| self.operand(&mut pivot.value));
        for step in &mut case.steps {
            match step {
                Step::Compute(code) => self.code(code, live),
                Step::Set { value, .. } => self.operand(value),
                Step::Roots { polynomials, typical, .. } => {
                    polynomials.iter_mut().flatten().chain(typical).for_each(|operand| self.operand(operand));
                }
                Step::SixAxes(six) => {
                    let renumbered = |mut operand: Operand| {
                        self.operand(&mut operand);
                        operand
                    };
                    **six = six.renamed(|joint| joint, renumbered);
                }
                Step::Sample { .. } => {}
            }
        }
        case.steps.retain(|step| !matches!(step, Step::Compute(code) if code.is_empty()));
    }
}

fn prune_block(block: &mut Block) {
    let mut all = Live::default();
    let lives: Vec<Live> = block
        .cases
        .iter()
        .map(|case| {
            let mut live = Live::default();
            live.case(case);
            all.0.extend(&live.0);
            live
        })
        .collect();
    all.code(&block.code);
    let mut numbers = Numbers::default();
    numbers.code(&mut block.code, &all);
    for (case, live) in block.cases.iter_mut().zip(&lives) {
        numbers.clone().case(case, live);
    }
}

fn prune_checks(checks: &mut Checks) {
    let whole = std::mem::take(&mut checks.code);
    let live = |operands: &mut dyn Iterator<Item = &Operand>| {
        let mut live = Live::default();
        operands.for_each(|operand| live.read(*operand));
        live.code(&whole);
        live
    };
    // First the code for measuring, then the additional code for fast polishing, then the rest.
    let mut parts = [
        live(&mut checks.residuals.iter().chain(&checks.scales)),
        live(&mut checks.short.iter().flat_map(Short::operands)),
        live(&mut checks.jacobian.iter().flatten()),
    ];
    let mut numbers = Numbers::default();
    for part in 0..parts.len() {
        let (before, rest) = parts.split_at_mut(part);
        rest[0].0.retain(|register| !before.iter().any(|live| live.0.contains(register)));
        let mut code = whole.clone();
        numbers.code(&mut code, &rest[0]);
        checks.code.append(&mut code);
    }
    let short = checks
        .short
        .iter_mut()
        .flat_map(|short| [&mut short.residual, &mut short.scale].into_iter().chain(&mut short.derivatives));
    let operands = checks.residuals.iter_mut().chain(&mut checks.scales).chain(checks.jacobian.iter_mut().flatten());
    operands.chain(short).for_each(|operand| numbers.operand(operand));
}
