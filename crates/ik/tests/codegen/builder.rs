//! Helpers to write programs by hand: operands as expressions, and the smallest parts of a program.

use groebot_ik::solver::{
    Block, Case, Guard, Input, Instruction, Joint, JointValue, Operand, Operation, ParameterRule, Rule, Step, TipTask,
    Unit,
};
use groebot_robot::kinematics::Task;

/// Code under construction.
#[derive(Default)]
pub struct Code {
    /// Instructions since the last call of `take`.
    lines: Vec<Instruction>,
    registers: usize,
}

impl Code {
    /// Code that follows after a number of registers.
    pub fn after(registers: usize) -> Self {
        Code { lines: vec![], registers }
    }

    fn push(&mut self, operation: Operation) -> Operand {
        self.lines.push(Instruction { target: self.registers, operation });
        self.registers += 1;
        Operand::Register(self.registers - 1)
    }

    pub fn add(&mut self, a: Operand, b: Operand) -> Operand {
        self.push(Operation::Add(a, b))
    }

    pub fn sub(&mut self, a: Operand, b: Operand) -> Operand {
        self.push(Operation::Sub(a, b))
    }

    pub fn mul(&mut self, a: Operand, b: Operand) -> Operand {
        self.push(Operation::Mul(a, b))
    }

    pub fn div(&mut self, a: Operand, b: Operand) -> Operand {
        self.push(Operation::Div(a, b))
    }

    pub fn abs(&mut self, a: Operand) -> Operand {
        self.push(Operation::Abs(a))
    }

    pub fn sqrt(&mut self, a: Operand) -> Operand {
        self.push(Operation::Sqrt(a))
    }

    /// `a + b + ...`, from the left.
    pub fn sum(&mut self, terms: &[Operand]) -> Operand {
        let (first, rest) = terms.split_first().unwrap();
        rest.iter().fold(*first, |sum, term| self.add(sum, *term))
    }

    /// `a * b * ...`, from the left.
    pub fn product(&mut self, factors: &[Operand]) -> Operand {
        let (first, rest) = factors.split_first().unwrap();
        rest.iter().fold(*first, |product, factor| self.mul(product, *factor))
    }

    /// An equation from its terms: their sum and the sum of their magnitudes.
    pub fn equation(&mut self, terms: &[Operand]) -> (Operand, Operand) {
        let value = self.sum(terms);
        let sizes: Vec<Operand> = terms.iter().map(|term| self.abs(*term)).collect();
        (value, self.sum(&sizes))
    }

    /// The instructions since the last call.
    pub fn take(&mut self) -> Vec<Instruction> {
        std::mem::take(&mut self.lines)
    }
}

pub fn constant(value: f64) -> Operand {
    Operand::Constant(value)
}

pub fn parameter(index: usize) -> Operand {
    Operand::Parameter(index)
}

pub fn unknown(index: usize) -> Operand {
    Operand::Unknown(index)
}

pub fn input(name: &str, unit: Unit) -> Input {
    Input { name: name.into(), unit }
}

pub fn rule(name: &str, rule: Rule) -> ParameterRule {
    ParameterRule { name: name.into(), rule }
}

pub fn angle(name: &str, cosine: usize, sine: usize) -> Joint {
    Joint { name: name.into(), unit: Unit::Radian, value: JointValue::Angle { cosine, sine } }
}

pub fn length(name: &str, unknown: usize) -> Joint {
    Joint { name: name.into(), unit: Unit::Metre, value: JointValue::Plain(unknown) }
}

pub fn near(text: &str, value: Operand, scale: Operand) -> Guard {
    Guard { text: text.into(), value, scale, near: true }
}

pub fn away(text: &str, value: Operand, scale: Operand) -> Guard {
    Guard { text: text.into(), value, scale, near: false }
}

/// Cases with their own branch numbers, as one block.
pub fn one_block(cases: Vec<Case>) -> Vec<Block> {
    vec![Block { label: "all".into(), code: vec![], cases }]
}

/// A root step of an unknown with typical size one.
pub fn roots(unknown: usize, polynomials: Vec<Vec<Operand>>) -> Step {
    Step::Roots { unknown, polynomials, typical: None, half_angle: false }
}

/// One tip with this task, whose numbers are the first inputs.
pub fn tip(task: Task) -> Vec<TipTask> {
    vec![TipTask { chain: None, task, direction: task.aims().then(|| task.usual_direction()), first_input: 0 }]
}
