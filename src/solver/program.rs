//! [`Program`]: the derived solver as plain data, a list of [`Block`]s that find the unknowns one group after the other.

use serde::{Deserialize, Serialize};

use super::about::About;
use super::instruction::{Instruction, Operand};
use super::rule::ParameterRule;
use super::template::{ROOM, SixAxes};
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

impl JointValue {
    /// The indices of its unknowns: of the cosine and the sine, or of the value itself.
    pub(crate) fn unknowns(self) -> Vec<usize> {
        match self {
            JointValue::Angle { cosine, sine } => vec![cosine, sine],
            JointValue::Plain(unknown) => vec![unknown],
        }
    }
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

/// What the inputs must fulfil. Deviations within [`super::CONSISTENT`] are removed before the target is used; larger ones are an
/// error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Condition {
    /// The nine inputs from this index on, by rows, are a rotation matrix.
    Rotation(usize),
    /// The three inputs from this index on are a unit vector.
    Unit(usize),
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
    /// Straight-line code; registers count on from the guards' code, and those from the block's.
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
        /// The unknown's typical size, by which a tangency is told from a miss; `None` for the length scale when the unknown is a
        /// joint's value itself, else for one. A larger size proposes more double roots.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        typical: Option<Operand>,
    },
    /// A free joint is put at each of these values (rad, or the program's length unit) in turn; the steps behind run once for
    /// each. All are members of one family: they have the same branch number.
    Sample {
        /// How the joint's value follows from the unknowns that are set here.
        joint: JointValue,
        /// The values.
        values: Vec<f64>,
    },
    /// The values of six joints are each solution in turn; the steps behind run once for each.
    SixAxes(Box<SixAxes>),
}

/// A chart's claim to be the best conditioned of its group.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pivot {
    /// Charts of one block with the same number are a group: of those whose guards hold only one runs.
    pub group: usize,
    /// It is the one whose value has the greatest magnitude; the first of equals.
    pub value: Operand,
}

/// One way to a block's unknowns, valid where its guards hold. All charts that apply are run and their answers united.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chart {
    /// What it is, for people: `generic`, `pz = 0`, ...
    pub label: String,
    /// Code of the guards and the pivot; registers count on from the block's code.
    pub guard_code: Vec<Instruction>,
    /// All must hold.
    pub guards: Vec<Guard>,
    /// Set where only the best conditioned of several charts is to run.
    pub pivot: Option<Pivot>,
    /// The way, unknown by unknown.
    pub steps: Vec<Step>,
    /// Joints (indices) that are free on this stratum: the chart gives one member of the family.
    pub free: Vec<usize>,
    /// The chart is a gap: it could not be derived, and a target here is an error. It has no steps and no pivot then.
    pub open: bool,
    /// Number, within the block, of the chart's first choice of roots; the others count on from it in mixed radix.
    pub first_branch: usize,
}

/// Unknowns that are found together, given those of the blocks before.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Block {
    /// What it finds, for people: `KneePitch`, ...
    pub label: String,
    /// Code that runs once on entry, from register 0; all charts of the block read its registers.
    pub code: Vec<Instruction>,
    /// The charts; all set the same unknowns.
    pub charts: Vec<Chart>,
}

/// The equations and their derivatives by the joints, to measure and polish each answer.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Checks {
    /// Code over parameters and unknowns, from register 0. Where the derivatives' code comes last, it runs only for Newton steps.
    pub code: Vec<Instruction>,
    /// The equations' values, zero at a solution, circle relations left out.
    pub residuals: Vec<Operand>,
    /// The size of each equation: the sum of its terms' magnitudes.
    pub scales: Vec<Operand>,
    /// `jacobian[i][j]`: the derivative of equation `i` by joint `j`.
    pub jacobian: Vec<Vec<Operand>>,
    /// As few equations that say the same near a solution, for the short way there: empty where nothing is polished.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub short: Vec<Short>,
}

/// One of the equations that lead a nearby candidate to its solution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Short {
    /// Its value, zero at a solution.
    pub residual: Operand,
    /// What the value is a share of.
    pub scale: Operand,
    /// The derivatives of the value by the joints, at a solution.
    pub derivatives: Vec<Operand>,
}

impl Short {
    /// All that it reads.
    pub(crate) fn operands(&self) -> impl Iterator<Item = &Operand> {
        [&self.residual, &self.scale].into_iter().chain(&self.derivatives)
    }
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
    /// What is known of its source.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub about: Option<About>,
    /// The target's numbers, in order.
    pub inputs: Vec<Input>,
    /// What the target must fulfil.
    pub conditions: Vec<Condition>,
    /// The parameters, in order.
    pub parameters: Vec<ParameterRule>,
    /// Names of the unknowns.
    pub unknowns: Vec<String>,
    /// The joints of an answer, in order.
    pub joints: Vec<Joint>,
    /// A length typical of the mechanism, in the unit of the inputs; positive.
    pub scale: f64,
    /// The blocks. For each result of a block the next one runs; results of the last are candidates for answers.
    pub blocks: Vec<Block>,
    /// The equations.
    pub checks: Checks,
    /// The source's choice of root.
    pub preference: Option<Preference>,
    /// The most answers that a target can have, at most 4096; if there were more, the best are kept.
    pub capacity: usize,
    /// The certified number of complex solutions of a generic target, when no target has more isolated ones. Of more, the nearest are
    /// one that rounding has doubled.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub isolated: Option<usize>,
    /// The blocks are those of a mechanism near the one that the equations are of: what they propose is a beginning, and of two answers
    /// next to each other, or of none, they may propose one double one.
    #[serde(default, skip_serializing_if = "is_false")]
    pub nearby: bool,
}

fn is_false(value: &bool) -> bool {
    !value
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

    /// Number of root choices of `chart`: the product of its root degrees.
    pub fn branches(chart: &Chart) -> usize {
        if chart.open { 0 } else { chart.steps.iter().map(Step::slots).fold(1, usize::saturating_mul) }
    }

    /// The charts of all blocks.
    pub fn charts(&self) -> impl Iterator<Item = &Chart> {
        self.blocks.iter().flat_map(|block| &block.charts)
    }

    /// The highest degree of a polynomial whose roots a chart takes; 0 without one.
    pub fn degree(&self) -> usize {
        let steps = self.charts().filter(|chart| !chart.open).flat_map(|chart| &chart.steps);
        steps.filter(|step| matches!(step, Step::Roots { .. })).map(Step::slots).max().unwrap_or(0)
    }

    /// The joints that some chart frees, ascending.
    pub fn freed(&self) -> impl Iterator<Item = usize> {
        (0..self.joints.len()).filter(|joint| self.charts().any(|chart| chart.free.contains(joint)))
    }

    /// The most solutions when in each block one chart gives all of them: the product of the blocks' largest numbers of root
    /// choices.
    pub fn bound(&self) -> usize {
        let largest = |block: &Block| block.charts.iter().map(Program::branches).max().unwrap_or(0);
        self.blocks.iter().map(largest).fold(1, usize::saturating_mul)
    }

    /// Whether an unknown is a joint's value itself, not a cosine or sine: its typical size is the length scale, not one.
    pub(crate) fn is_plain(&self, unknown: usize) -> bool {
        self.joints.iter().any(|joint| joint.value == JointValue::Plain(unknown))
    }
}

impl Chart {
    /// Whether it runs near a stratum, whatever the pivots of others, and there has been derived.
    pub(crate) fn is_of_stratum(&self) -> bool {
        !self.open && self.pivot.is_none() && self.guards.iter().any(|guard| guard.near)
    }

    /// Whether it runs at targets only that are singular, or all but that.
    pub(crate) fn is_rare(&self) -> bool {
        !self.free.is_empty() || self.guards.iter().any(|guard| guard.near)
    }
}

/// The constant of a polynomial `x^2 + constant`, if it is the only one.
pub(crate) fn square(polynomials: &[Vec<Operand>]) -> Option<Operand> {
    match polynomials {
        [only] => match only[..] {
            [constant, Operand::Constant(0.0), Operand::Constant(1.0)] => Some(constant),
            _ => None,
        },
        _ => None,
    }
}

impl Block {
    /// A block whose charts get branch numbers one after the other; charts of one pivot group share theirs.
    pub fn numbered(label: &str, code: Vec<Instruction>, mut charts: Vec<Chart>) -> Self {
        let mut next = 0;
        for index in 0..charts.len() {
            let (earlier, rest) = charts.split_at_mut(index);
            let group = |chart: &Chart| chart.pivot.map(|pivot| pivot.group);
            let own = group(&rest[0]);
            let peer = earlier.iter().find(|chart| own.is_some() && group(chart) == own);
            rest[0].first_branch = peer.map_or(next, |peer| peer.first_branch);
            next = next.max(rest[0].first_branch + Program::branches(&rest[0]));
        }
        Block { label: label.to_owned(), code, charts }
    }

    /// Number of branch numbers of the block, the radix of its digit in an answer's branch.
    pub fn branches(&self) -> usize {
        let end = |chart: &Chart| chart.first_branch.saturating_add(Program::branches(chart));
        self.charts.iter().map(end).max().unwrap_or(0).max(1)
    }

    /// Registers that the block needs, those of its largest chart counted.
    pub(crate) fn registers(&self) -> usize {
        let code = |step: &Step| if let Step::Compute(code) = step { code.len() } else { 0 };
        let chart = |chart: &Chart| chart.guard_code.len() + chart.steps.iter().map(code).sum::<usize>();
        self.code.len() + self.charts.iter().map(chart).max().unwrap_or(0)
    }

    /// Whether the chart is alone or the first of its pivot group: where the group takes its turn.
    pub(crate) fn opens_group(&self, chart: usize) -> bool {
        let Some(pivot) = self.charts[chart].pivot else { return true };
        !self.charts[..chart].iter().any(|other| other.pivot.is_some_and(|other| other.group == pivot.group))
    }
}

impl Step {
    /// Solutions that the step can give: the largest degree among the polynomials of a root step, else one.
    pub fn slots(&self) -> usize {
        match self {
            Step::Roots { polynomials, .. } => {
                polynomials.iter().map(|coefficients| coefficients.len().saturating_sub(1)).max().unwrap_or(0)
            }
            Step::SixAxes(_) => 2 * ROOM,
            _ => 1,
        }
    }
}
