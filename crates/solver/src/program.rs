//! [`Program`]: the derived solver as plain data, a list of [`Block`]s that find the unknowns one group after the
//! other.

use groebot_runtime::six_axes::ROOM;
use serde::{Deserialize, Serialize};

mod redundancy;

pub use redundancy::{ClosedSearch, MOST_SCANNED, MOST_SECTIONS, Redundancy, RedundantPart, Section};

use super::about::About;
use super::eigenvalue::SixAxes;
use super::instruction::{Instruction, Operand};
use super::joint::{Joint, JointValue, Unit};
use super::rule::ParameterRule;
use super::tips::{GivenJoint, TipTask};
use groebot_robot::kinematics::Mimic;

/// One number of the target, as the user gives it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Input {
    /// Its name, such as `px`.
    pub name: String,
    /// Its unit.
    pub unit: Unit,
}

/// A condition on the inputs. Deviations within `ACCEPTANCE.input` of the run time are removed before the target is used; larger
/// ones are an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Condition {
    /// The nine inputs from this index on, by rows, are a rotation matrix.
    Rotation(usize),
    /// The three inputs from this index on are a unit vector.
    Unit(usize),
}

/// The condition under which a case runs: its factor is near zero (a stratum) or not (a denominator).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Guard {
    /// The factor as text.
    pub text: String,
    /// The factor's value.
    pub value: Operand,
    /// The size that the value is compared with.
    pub scale: Operand,
    /// True: run when `|value| <= STRATA.near * scale`. False: run when `|value| > STRATA.denominator * scale`.
    pub near: bool,
}

/// A step of a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Step {
    /// Straight-line code; registers are numbered after those of the guards' code, and those after the block's.
    Compute(Vec<Instruction>),
    /// The unknown gets this value.
    Set {
        /// Index of the unknown.
        unknown: usize,
        /// Its value.
        value: Operand,
    },
    /// The unknown is each real root in turn; the following steps run once for each.
    Roots {
        /// Index of the unknown.
        unknown: usize,
        /// Polynomials, coefficients from degree 0 up. The first whose leading coefficient is not negligible
        /// (`ROOTS.pivot`) is solved; the last is used if all others are negligible.
        polynomials: Vec<Vec<Operand>>,
        /// The unknown's typical size, which distinguishes a tangency from a miss. `None` is the length scale if the
        /// unknown is a joint's value itself, else one. A larger size proposes more double roots.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        typical: Option<Operand>,
        /// Whether the unknown is the tangent of half an angle, of a polynomial that may miss the axis by more than
        /// rounding. Its terms are then measured at `typical` times the greater of the tangent and one.
        #[serde(default, skip_serializing_if = "is_false")]
        half_angle: bool,
    },
    /// A free joint has each of these values (rad, or the program's length unit) in turn; the following steps run once
    /// for each. All are members of one self-motion: they have the same branch number.
    Sample {
        /// The joint's value as a function of the unknowns that are set here.
        joint: JointValue,
        /// The values.
        values: Vec<f64>,
    },
    /// The values of six joints are each solution in turn; the following steps run once for each.
    SixAxes(Box<SixAxes>),
}

/// A case's claim to be the best conditioned of its group.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pivot {
    /// Cases of one block with the same number are a group: of those whose guards hold only one runs.
    pub group: usize,
    /// The case whose value has the greatest magnitude runs; the first of equals.
    pub value: Operand,
}

/// A method for a block's unknowns, valid where its guards hold. All cases that apply are run, and their solutions are
/// united.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Case {
    /// Its label: `generic`, `pz = 0`, ...
    pub label: String,
    /// Code of the guards and the pivot; registers are numbered after those of the block's code.
    pub guard_code: Vec<Instruction>,
    /// All must hold.
    pub guards: Vec<Guard>,
    /// Set if only the best conditioned of several cases runs.
    pub pivot: Option<Pivot>,
    /// The steps of the method.
    pub steps: Vec<Step>,
    /// Joints (indices) that are free on this stratum: the case gives one member of the self-motion.
    pub free: Vec<usize>,
    /// Whether the case is a gap: it could not be derived, and a target here is an error. It has no steps and no pivot
    /// then.
    pub open: bool,
    /// The number, within the block, of the case's first choice of roots; the others follow in mixed radix.
    pub first_branch: usize,
}

/// Unknowns that are found together, given those of the blocks before.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Block {
    /// Its label: `KneePitch`, ...
    pub label: String,
    /// Code that runs once on entry, from register 0; all cases of the block read its registers.
    pub code: Vec<Instruction>,
    /// The cases; all set the same unknowns.
    pub cases: Vec<Case>,
}

/// The equations and their derivatives by the joints, to measure and polish each solution.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Checks {
    /// Code over parameters and unknowns, from register 0. If the derivatives' code comes last, it runs only for Newton
    /// steps.
    pub code: Vec<Instruction>,
    /// The equations' values, zero at a solution, without circle relations.
    pub residuals: Vec<Operand>,
    /// The size of each equation: the sum of its terms' magnitudes.
    pub scales: Vec<Operand>,
    /// `jacobian[i][j]`: the derivative of equation `i` by joint `j`.
    pub jacobian: Vec<Vec<Operand>>,
    /// A minimal set of equations that are equivalent near a solution, for fast polishing; empty where nothing is
    /// polished.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub short: Vec<Short>,
}

/// One of the equations that lead a nearby candidate to its solution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Short {
    /// Its value, zero at a solution.
    pub residual: Operand,
    /// The size that the value is relative to.
    pub scale: Operand,
    /// The derivatives of the value by the joints, at a solution.
    pub derivatives: Vec<Operand>,
}

impl Short {
    /// All operands that it reads.
    #[doc(hidden)]
    pub fn operands(&self) -> impl Iterator<Item = &Operand> {
        [&self.residual, &self.scale].into_iter().chain(&self.derivatives)
    }
}

/// The solutions that are marked as the published choice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Preference {
    /// The index of the unknown whose root the source chooses.
    pub unknown: usize,
    /// The greater root, else the smaller.
    pub greatest: bool,
}

/// The derived solver of one mechanism and task.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Program {
    /// Name of the mechanism: letters, digits and `_`.
    pub name: String,
    /// Information about its source.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub about: Option<About>,
    /// The task of each tip; empty for a program of equations.
    #[serde(default)]
    pub tasks: Vec<TipTask>,
    /// The joints whose values the user gives, in the order of their inputs.
    #[serde(default)]
    pub given_joints: Vec<GivenJoint>,
    /// The target's numbers, in order.
    pub inputs: Vec<Input>,
    /// Conditions on the target.
    pub conditions: Vec<Condition>,
    /// The parameters, in order.
    pub parameters: Vec<ParameterRule>,
    /// Names of the unknowns.
    pub unknowns: Vec<String>,
    /// The joints of an answer, in order.
    pub joints: Vec<Joint>,
    /// A length typical of the mechanism, in the unit of the inputs; positive.
    pub scale: f64,
    /// The blocks. For each result of a block the next one runs; results of the last are candidates for solutions.
    pub blocks: Vec<Block>,
    /// The equations.
    pub checks: Checks,
    /// The published choice of root.
    pub preference: Option<Preference>,
    /// The greatest number of solutions of a target, at most 4096; if there were more, the best are kept.
    pub capacity: usize,
    /// The certified number of complex solutions of a generic target, if no target has more isolated ones. If more are
    /// found, the two nearest are one that rounding has doubled.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub isolated: Option<usize>,
    /// Whether the blocks are those of a mechanism near the one of the equations. Their results are then only start
    /// values. For two solutions close to each other, or for none, they may give one double result.
    #[serde(default, skip_serializing_if = "is_false")]
    pub nearby: bool,
    /// The mechanism as described, if blocks and equations are those of the ideal one, and the task has more numbers
    /// than the joints can reach.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub described: Option<Described>,
    /// For a chain with one joint more than its task determines: the programs with another joint given, and the axes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub redundancy: Option<Box<Redundancy>>,
}

/// The equations of the mechanism as described. The ideal mechanism decides which solutions a target has.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Described {
    /// Code over parameters and unknowns, from register 0.
    pub code: Vec<Instruction>,
    /// The equations' values, in the order of [`Checks::residuals`]: each is affine in the numbers of each joint.
    pub residuals: Vec<Operand>,
    /// The tolerance relative to each equation's size within which the ideal mechanism reaches a target.
    pub within: f64,
}

fn is_false(value: &bool) -> bool {
    !value
}

impl Program {
    /// By joint, the least and the greatest value in its source, in the joint's unit; infinite where it has none.
    pub fn limits(&self) -> Vec<[f64; 2]> {
        let limits = self.about.as_ref().map(|about| about.limits.as_slice()).unwrap_or_default();
        let of = |joint: usize| {
            limits.get(joint).copied().flatten().map_or([f64::NEG_INFINITY, f64::INFINITY], |(low, high)| [low, high])
        };
        (0..self.joints.len()).map(of).collect()
    }

    /// By joint, how it follows another one in its source.
    pub fn follows(&self) -> Vec<Option<&Mimic>> {
        let described = self.about.as_ref().map(|about| about.follows.as_slice()).unwrap_or_default();
        (0..self.joints.len()).map(|joint| described.get(joint)?.as_ref()).collect()
    }

    /// The number of root choices of `case`: the product of its root degrees.
    pub fn branches(case: &Case) -> usize {
        if case.open { 0 } else { case.steps.iter().map(Step::slots).fold(1, usize::saturating_mul) }
    }

    /// The cases of all blocks.
    pub fn cases(&self) -> impl Iterator<Item = &Case> {
        self.blocks.iter().flat_map(|block| &block.cases)
    }

    /// The highest degree of a polynomial whose roots a case needs; 0 without one.
    #[doc(hidden)]
    pub fn degree(&self) -> usize {
        let steps = self.cases().filter(|case| !case.open).flat_map(|case| &case.steps);
        steps.filter(|step| matches!(step, Step::Roots { .. })).map(Step::slots).max().unwrap_or(0)
    }

    /// The joints that some case leaves free, ascending.
    pub(crate) fn freed(&self) -> impl Iterator<Item = usize> {
        (0..self.joints.len()).filter(|joint| self.cases().any(|case| case.free.contains(joint)))
    }

    /// An upper bound for the number of solutions, if in each block one case gives all of them: the product of the
    /// blocks' largest numbers of root choices.
    pub fn bound(&self) -> usize {
        let largest = |block: &Block| block.cases.iter().map(Program::branches).max().unwrap_or(0);
        self.blocks.iter().map(largest).fold(1, usize::saturating_mul)
    }

    /// Whether an unknown is a joint's value itself, not a cosine or sine: its typical size is the length scale, not
    /// one.
    #[doc(hidden)]
    pub fn is_plain(&self, unknown: usize) -> bool {
        self.joints.iter().any(|joint| joint.value == JointValue::Plain(unknown))
    }
}

impl Case {
    /// Whether it runs near a stratum, independent of the pivots of others, and is derived there.
    #[doc(hidden)]
    pub fn is_of_stratum(&self) -> bool {
        !self.open && self.pivot.is_none() && self.guards.iter().any(|guard| guard.near)
    }

    /// Whether it runs only at targets that are singular or nearly singular.
    #[doc(hidden)]
    pub fn is_rare(&self) -> bool {
        !self.free.is_empty() || self.guards.iter().any(|guard| guard.near)
    }
}

/// The constant of a polynomial `x^2 + constant`, if it is the only one.
#[doc(hidden)]
pub fn square(polynomials: &[Vec<Operand>]) -> Option<Operand> {
    match polynomials {
        [only] => match only[..] {
            [constant, Operand::Constant(0.0), Operand::Constant(1.0)] => Some(constant),
            _ => None,
        },
        _ => None,
    }
}

impl Block {
    /// A block whose cases get consecutive branch numbers; cases of one pivot group share theirs.
    pub fn numbered(label: &str, code: Vec<Instruction>, mut cases: Vec<Case>) -> Self {
        let mut next = 0;
        for index in 0..cases.len() {
            let (earlier, rest) = cases.split_at_mut(index);
            let group = |case: &Case| case.pivot.map(|pivot| pivot.group);
            let own = group(&rest[0]);
            let peer = earlier.iter().find(|case| own.is_some() && group(case) == own);
            rest[0].first_branch = peer.map_or(next, |peer| peer.first_branch);
            next = next.max(rest[0].first_branch + Program::branches(&rest[0]));
        }
        Block { label: label.to_owned(), code, cases }
    }

    /// The number of branch numbers of the block, the radix of its digit in a solution's branch.
    pub fn branches(&self) -> usize {
        let end = |case: &Case| case.first_branch.saturating_add(Program::branches(case));
        self.cases.iter().map(end).max().unwrap_or(0).max(1)
    }

    /// The registers that the block needs, including those of its largest case.
    #[doc(hidden)]
    pub fn registers(&self) -> usize {
        let code = |step: &Step| if let Step::Compute(code) = step { code.len() } else { 0 };
        let case = |case: &Case| case.guard_code.len() + case.steps.iter().map(code).sum::<usize>();
        self.code.len() + self.cases.iter().map(case).max().unwrap_or(0)
    }

    /// Whether the case is alone or the first of its pivot group, at which the group runs.
    #[doc(hidden)]
    pub fn opens_group(&self, case: usize) -> bool {
        let Some(pivot) = self.cases[case].pivot else { return true };
        !self.cases[..case].iter().any(|other| other.pivot.is_some_and(|other| other.group == pivot.group))
    }
}

impl Step {
    /// The number of solutions of the step: the largest degree among the polynomials of a root step, else one.
    #[doc(hidden)]
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
