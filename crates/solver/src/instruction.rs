//! The instructions of a program and their text: `r3 = r1 * p0`.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::{Error, ErrorKind};

/// A value that an instruction reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operand {
    /// A number, the double nearest to an exact one.
    Constant(f64),
    /// A parameter of the equations: `p0`, `p1`, ...
    Parameter(usize),
    /// An unknown of the equations: `x0`, `x1`, ...
    Unknown(usize),
    /// The result of an earlier instruction: `r0`, `r1`, ...
    Register(usize),
    /// The length scale of the problem, `m`: the largest magnitude among the parameters and the program's own scale.
    Magnitude,
}

/// The operation of an instruction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operation {
    /// `a + b`
    Add(Operand, Operand),
    /// `a - b`
    Sub(Operand, Operand),
    /// `a * b`
    Mul(Operand, Operand),
    /// `a / b`
    Div(Operand, Operand),
    /// `abs a`
    Abs(Operand),
    /// `sqrt a`, of zero where `a` is negative.
    Sqrt(Operand),
}

/// One step of straight-line code: register `target` becomes the value of `operation`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Instruction {
    /// The register that is written, once.
    pub target: usize,
    /// The operation.
    pub operation: Operation,
}

impl Operation {
    /// The operands, one or two.
    pub fn operands(&self) -> (Operand, Option<Operand>) {
        match *self {
            Operation::Add(a, b) | Operation::Sub(a, b) | Operation::Mul(a, b) | Operation::Div(a, b) => (a, Some(b)),
            Operation::Abs(a) | Operation::Sqrt(a) => (a, None),
        }
    }
}

impl fmt::Display for Operand {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Operand::Constant(value) => write!(f, "{value:?}"),
            Operand::Parameter(index) => write!(f, "p{index}"),
            Operand::Unknown(index) => write!(f, "x{index}"),
            Operand::Register(index) => write!(f, "r{index}"),
            Operand::Magnitude => f.write_str("m"),
        }
    }
}

impl FromStr for Operand {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let fail = || {
            Error::new(ErrorKind::Syntax, format!("`{text}` is not an operand; give p0, x0, r0, m or a finite number"))
        };
        let index = |rest: &str| rest.parse::<usize>().map_err(|_| fail());
        match text.split_at_checked(1) {
            Some(("p", rest)) => Ok(Operand::Parameter(index(rest)?)),
            Some(("x", rest)) => Ok(Operand::Unknown(index(rest)?)),
            Some(("r", rest)) => Ok(Operand::Register(index(rest)?)),
            Some(("m", "")) => Ok(Operand::Magnitude),
            _ => text.parse::<f64>().ok().filter(|value| value.is_finite()).map(Operand::Constant).ok_or_else(fail),
        }
    }
}

impl fmt::Display for Instruction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "r{} = ", self.target)?;
        match self.operation {
            Operation::Add(a, b) => write!(f, "{a} + {b}"),
            Operation::Sub(a, b) => write!(f, "{a} - {b}"),
            Operation::Mul(a, b) => write!(f, "{a} * {b}"),
            Operation::Div(a, b) => write!(f, "{a} / {b}"),
            Operation::Abs(a) => write!(f, "abs {a}"),
            Operation::Sqrt(a) => write!(f, "sqrt {a}"),
        }
    }
}

impl FromStr for Instruction {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let fail = || {
            Error::new(ErrorKind::Syntax, format!("`{text}` is not an instruction; give one such as `r3 = r1 * p0`"))
        };
        let words: Vec<&str> = text.split(' ').collect();
        let operation = match words.as_slice() {
            [_, "=", "abs", a] => Operation::Abs(a.parse()?),
            [_, "=", "sqrt", a] => Operation::Sqrt(a.parse()?),
            [_, "=", a, "+", b] => Operation::Add(a.parse()?, b.parse()?),
            [_, "=", a, "-", b] => Operation::Sub(a.parse()?, b.parse()?),
            [_, "=", a, "*", b] => Operation::Mul(a.parse()?, b.parse()?),
            [_, "=", a, "/", b] => Operation::Div(a.parse()?, b.parse()?),
            _ => return Err(fail()),
        };
        match words[0].parse()? {
            Operand::Register(target) => Ok(Instruction { target, operation }),
            _ => Err(fail()),
        }
    }
}

/// Text conversions for serde: operands and instructions are written as short strings.
macro_rules! text_for_serde {
    ($type:ty) => {
        impl From<$type> for String {
            fn from(value: $type) -> String {
                value.to_string()
            }
        }
        impl TryFrom<String> for $type {
            type Error = Error;
            fn try_from(text: String) -> Result<Self, Error> {
                text.parse()
            }
        }
    };
}
text_for_serde!(Operand);
text_for_serde!(Instruction);

impl Serialize for Operand {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Operand {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(serde::de::Error::custom)
    }
}
