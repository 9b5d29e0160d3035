//! [`Program`]: the derived solver as plain data, and the check that a loaded one is well formed.

use serde::{Deserialize, Serialize};

use super::MAX_JOINTS;
use super::instruction::{Instruction, Operand};
use crate::{Error, ErrorKind, Result};

/// The unit of an input or joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Unit {
    /// Metres.
    Metre,
    /// Millimetres.
    Millimetre,
    /// Radians.
    Radian,
    /// A plain number.
    One,
}

/// One number of the target, as the user gives it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Input {
    /// Its name, such as `px`.
    pub name: String,
    /// Its unit.
    pub unit: Unit,
}

/// How the value of a joint follows from the unknowns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JointValue {
    /// `atan2(sine, cosine)` of two unknowns (indices), in (-pi, pi].
    Angle {
        /// Index of the unknown cosine.
        cosine: usize,
        /// Index of the unknown sine.
        sine: usize,
    },
    /// The unknown with this index itself.
    Plain(usize),
}

/// One joint of the answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Joint {
    /// Its name, such as `HipPitch`.
    pub name: String,
    /// The unit of its value.
    pub unit: Unit,
    /// How its value follows from the unknowns.
    pub value: JointValue,
}

/// A parameter of the equations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ParameterRule {
    /// Its name in the equations.
    pub name: String,
    /// How its value follows from the inputs.
    pub rule: Rule,
}

/// How a parameter's value follows from the inputs and the parameters before it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rule {
    /// The input with this index.
    Input(usize),
    /// The cosine of an input angle.
    Cosine(usize),
    /// The sine of an input angle.
    Sine(usize),
    /// The non-negative square root of a value computed from earlier parameters.
    Root {
        /// Code that computes the value.
        code: Vec<Instruction>,
        /// The value under the root.
        value: Operand,
    },
}

/// When a chart runs: its factor is near zero (a stratum) or away from it (a denominator).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Guard {
    /// The factor as text, for people.
    pub text: String,
    /// The factor's value.
    pub value: Operand,
    /// The size that the value is compared with.
    pub scale: Operand,
    /// True: run when `|value| <= NEAR * scale`. False: run when `|value| > TINY * scale`.
    pub near: bool,
}

/// A step of a chart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Step {
    /// Straight-line code; registers count on from the guards' code.
    Compute(Vec<Instruction>),
    /// The unknown gets this value.
    Set {
        /// Index of the unknown.
        unknown: usize,
        /// Its value.
        value: Operand,
    },
    /// The unknown is each real root in turn; the steps behind run once for each.
    Roots {
        /// Index of the unknown.
        unknown: usize,
        /// Polynomials, coefficients from degree 0 up. The first whose leading coefficient is not negligible
        /// ([`super::PIVOT`]) is solved; the last is taken when all others are.
        polynomials: Vec<Vec<Operand>>,
    },
}

/// One way to the solutions, valid where its guards hold. All charts that apply are run and their answers united.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chart {
    /// What it is, for people: `generic`, `pz = 0`, ...
    pub label: String,
    /// Code of the guards, from register 0.
    pub guard_code: Vec<Instruction>,
    /// All must hold.
    pub guards: Vec<Guard>,
    /// The way, unknown by unknown.
    pub steps: Vec<Step>,
    /// Joints (indices) that are free on this stratum: the chart gives one member of the family.
    pub free: Vec<usize>,
    /// The chart is a gap: it could not be derived, and a target here is an error. It has no steps then.
    pub open: bool,
    /// Branch number of the chart's first answer; root choices count on from it in mixed radix.
    pub first_branch: usize,
}

/// The equations and their derivatives by the joints, to measure and polish each answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checks {
    /// Code over parameters and unknowns, from register 0.
    pub code: Vec<Instruction>,
    /// The equations' values, zero at a solution, circle relations left out.
    pub residuals: Vec<Operand>,
    /// The size of each equation: the sum of its terms' magnitudes.
    pub scales: Vec<Operand>,
    /// `jacobian[i][j]`: the derivative of equation `i` by joint `j`.
    pub jacobian: Vec<Vec<Operand>>,
}

/// Which solutions are marked as the source's own choice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Preference {
    /// Index of the unknown whose root the source chooses.
    pub unknown: usize,
    /// The greater root, else the smaller.
    pub greatest: bool,
}

/// The derived solver of one mechanism and task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Program {
    /// Name of the mechanism: letters, digits and `_`.
    pub name: String,
    /// The version of groebot that derived it.
    pub version: String,
    /// The target's numbers, in order.
    pub inputs: Vec<Input>,
    /// The parameters, in order.
    pub parameters: Vec<ParameterRule>,
    /// Names of the unknowns.
    pub unknowns: Vec<String>,
    /// The joints of an answer, in order.
    pub joints: Vec<Joint>,
    /// A length typical of the mechanism, in the unit of the inputs; positive.
    pub scale: f64,
    /// The charts.
    pub charts: Vec<Chart>,
    /// The equations.
    pub checks: Checks,
    /// The source's choice of root.
    pub preference: Option<Preference>,
    /// The most answers that all charts together can give.
    pub capacity: usize,
}

impl Program {
    /// Reads a program from JSON and validates it.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] with the line; [`ErrorKind::BadValue`] as [`Program::validate`].
    pub fn from_json(text: &str) -> Result<Self> {
        let program: Program = serde_json::from_str(text)
            .map_err(|error| Error::new(ErrorKind::Syntax, error.to_string()).at_line(error.line()))?;
        program.validate()?;
        Ok(program)
    }

    /// The program as pretty JSON, ending in a line feed.
    pub fn to_json(&self) -> String {
        let text = serde_json::to_string_pretty(self).expect("a program holds nothing that JSON cannot say");
        text + "\n"
    }

    /// Number of answers that `chart` can give: the product of its root degrees.
    pub fn branches(chart: &Chart) -> usize {
        if chart.open { 0 } else { chart.steps.iter().map(Step::slots).product() }
    }

    /// Checks that every index is in range, registers are written once and before they are read, every unknown is set once in
    /// each chart, and sizes agree: a valid program never panics.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] saying which part is wrong.
    pub fn validate(&self) -> Result<()> {
        self.validate_names()?;
        let mut context =
            Context { program: self, parameters: 0, registers: 0, unknowns: Vec::new(), magnitude: false };
        for (index, parameter) in self.parameters.iter().enumerate() {
            context.parameters = index;
            context.registers = 0;
            let place = format!("parameter `{}`", parameter.name);
            match &parameter.rule {
                Rule::Input(i) | Rule::Cosine(i) | Rule::Sine(i) => ensure(*i < self.inputs.len(), &place)?,
                Rule::Root { code, value } => {
                    context.code(code, &place).and_then(|()| context.operand(*value, &place))?
                }
            }
        }
        context.parameters = self.parameters.len();
        context.magnitude = true;
        for chart in &self.charts {
            context.chart(chart)?;
        }
        context.checks(&self.checks)?;
        let capacity = self.charts.iter().map(Program::branches).fold(0usize, usize::saturating_add);
        ensure(capacity == self.capacity && capacity <= 4096, "capacity")
    }

    fn validate_names(&self) -> Result<()> {
        let word = |name: &str| {
            let rest = name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_');
            rest && name.bytes().next().is_some_and(|b| !b.is_ascii_digit())
        };
        ensure(word(&self.name), "name: letters, digits and `_` are allowed")?;
        ensure(!self.joints.is_empty() && self.joints.len() <= MAX_JOINTS, "joints: 1 to 8 are allowed")?;
        ensure(self.scale.is_finite() && self.scale > 0.0, "scale: a positive number is allowed")?;
        for joint in &self.joints {
            let known = match joint.value {
                JointValue::Angle { cosine, sine } => cosine.max(sine) < self.unknowns.len(),
                JointValue::Plain(unknown) => unknown < self.unknowns.len(),
            };
            ensure(known, &format!("joint `{}`", joint.name))?;
        }
        let known = self.preference.is_none_or(|preference| preference.unknown < self.unknowns.len());
        ensure(known, "preference")
    }
}

impl Step {
    /// Solutions that the step can give: the largest degree among the polynomials of a root step, else one.
    pub fn slots(&self) -> usize {
        match self {
            Step::Roots { polynomials, .. } => {
                polynomials.iter().map(|coefficients| coefficients.len().saturating_sub(1)).max().unwrap_or(0)
            }
            _ => 1,
        }
    }
}

fn ensure(condition: bool, place: &str) -> Result<()> {
    if condition { Ok(()) } else { Err(Error::new(ErrorKind::BadValue, format!("malformed program: {place}"))) }
}

/// What is defined at a point of the program.
struct Context<'a> {
    program: &'a Program,
    parameters: usize,
    registers: usize,
    unknowns: Vec<bool>,
    magnitude: bool,
}

impl Context<'_> {
    fn operand(&self, operand: Operand, place: &str) -> Result<()> {
        let defined = match operand {
            Operand::Constant(value) => value.is_finite(),
            Operand::Parameter(index) => index < self.parameters,
            Operand::Unknown(index) => self.unknowns.get(index).copied().unwrap_or(false),
            Operand::Register(index) => index < self.registers,
            Operand::Magnitude => self.magnitude,
        };
        ensure(defined, &format!("{place}: `{operand}` is not defined here"))
    }

    fn code(&mut self, code: &[Instruction], place: &str) -> Result<()> {
        for instruction in code {
            let (left, right) = instruction.operation.operands();
            self.operand(left, place)?;
            right.map_or(Ok(()), |right| self.operand(right, place))?;
            ensure(instruction.target == self.registers, &format!("{place}: `{instruction}` is out of order"))?;
            self.registers += 1;
        }
        Ok(())
    }

    fn set(&mut self, unknown: usize, place: &str) -> Result<()> {
        let fresh = self.unknowns.get(unknown).is_some_and(|set| !set);
        ensure(fresh, &format!("{place}: unknown {unknown} is set twice or does not exist"))?;
        self.unknowns[unknown] = true;
        Ok(())
    }

    fn chart(&mut self, chart: &Chart) -> Result<()> {
        let place = format!("chart `{}`", chart.label);
        self.registers = 0;
        self.unknowns = vec![false; self.program.unknowns.len()];
        self.code(&chart.guard_code, &place)?;
        for guard in &chart.guards {
            self.operand(guard.value, &place)?;
            self.operand(guard.scale, &place)?;
        }
        ensure(chart.free.iter().all(|&joint| joint < self.program.joints.len()), &place)?;
        for step in &chart.steps {
            self.step(step, &place)?;
        }
        ensure(chart.open || self.unknowns.iter().all(|&set| set), &format!("{place}: an unknown is never set"))
    }

    fn step(&mut self, step: &Step, place: &str) -> Result<()> {
        match step {
            Step::Compute(code) => self.code(code, place),
            Step::Set { unknown, value } => self.operand(*value, place).and_then(|()| self.set(*unknown, place)),
            Step::Roots { unknown, polynomials } => {
                for coefficients in polynomials {
                    let degree = coefficients.len().saturating_sub(1);
                    ensure((1..=crate::roots::MAX_DEGREE).contains(&degree), &format!("{place}: degree {degree}"))?;
                    coefficients.iter().try_for_each(|&operand| self.operand(operand, place))?;
                }
                ensure(!polynomials.is_empty(), place)?;
                self.set(*unknown, place)
            }
        }
    }

    fn checks(&mut self, checks: &Checks) -> Result<()> {
        self.registers = 0;
        self.unknowns = vec![true; self.program.unknowns.len()];
        self.code(&checks.code, "checks")?;
        let equations = checks.residuals.len();
        let square = checks.scales.len() == equations
            && checks.jacobian.len() == equations
            && checks.jacobian.iter().all(|row| row.len() == self.program.joints.len());
        ensure(square && equations > 0, "checks: sizes differ")?;
        let operands = checks.residuals.iter().chain(&checks.scales).chain(checks.jacobian.iter().flatten());
        operands.copied().try_for_each(|operand| self.operand(operand, "checks"))
    }
}
