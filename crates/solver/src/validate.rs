//! Validation of programs: [`Program::validate`].

use super::instruction::{Instruction, Operand};
use super::joint::JointValue;
use super::program::{Block, Case, Checks, Condition, Described, Program, Short, Step};
use super::rule::Rule;
use super::{MAX_JOINTS, Unit, target};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits::{check_name, is_name};
use groebot_algebra::roots;
use groebot_robot::kinematics::Mimic;

/// The maximum number of solutions of a program.
pub(super) const MOST_ANSWERS: usize = groebot_algebra::limits::PROGRAM_ANSWERS;
/// The maximum number of blocks.
const MOST_BLOCKS: usize = groebot_algebra::limits::PROGRAM_BLOCKS;
/// The maximum number of unknowns.
const MOST_UNKNOWNS: usize = groebot_algebra::limits::PROGRAM_UNKNOWNS;
/// Branch numbers stay below this, 2^53 - 1, so that a double represents all of them.
const MOST_BRANCHES: usize = usize::MAX >> usize::BITS.saturating_sub(53);

impl Program {
    /// Checks that a program is well formed; a valid program never panics.
    ///
    /// Every index is in range. Registers are written once, before they are read. Every unknown is set once along every path through the blocks. Sizes agree.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] with the wrong part.
    pub fn validate(&self) -> Result<()> {
        self.validate_names()?;
        self.conditions.iter().try_for_each(|condition| self.validate_condition(condition))?;
        self.validate_rotations()?;
        target::fault(self).map_or(Ok(()), |fault| ensure(false, fault))?;
        let mut context =
            Context { program: self, parameters: 0, registers: 0, unknowns: Vec::new(), magnitude: false };
        context.parameters()?;
        context.blocks(&self.blocks)?;
        context.checks(&self.checks)?;
        self.described.as_ref().map_or(Ok(()), |described| context.described(described))?;
        let branches = self.blocks.iter().map(Block::branches).try_fold(1usize, usize::checked_mul);
        ensure(branches.is_some_and(|branches| branches <= MOST_BRANCHES), "too many branches")?;
        self.redundancy.as_ref().map_or(Ok(()), |redundancy| redundancy.validate(self))?;
        let least = usize::from(self.cases().any(|case| !case.open));
        ensure(self.isolated != Some(0), "isolated: at least 1 is allowed")?;
        ensure((least..=MOST_ANSWERS).contains(&self.capacity), "capacity: 1 to 4096 is allowed")
    }

    fn validate_names(&self) -> Result<()> {
        let word = |name: &str| {
            let rest = name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_');
            rest && name.bytes().next().is_some_and(|b| !b.is_ascii_digit())
        };
        ensure(word(&self.name) && is_name(&self.name), "name: 1 to 200 letters, digits and `_` are allowed")?;
        ensure((1..=MAX_JOINTS).contains(&self.joints.len()), &format!("joints: 1 to {MAX_JOINTS} are allowed"))?;
        ensure(self.unknowns.len() <= MOST_UNKNOWNS, &format!("unknowns: at most {MOST_UNKNOWNS} are allowed"))?;
        ensure((1..=MOST_BLOCKS).contains(&self.blocks.len()), &format!("blocks: 1 to {MOST_BLOCKS} are allowed"))?;
        ensure(self.scale.is_finite() && self.scale > 0.0, "scale: a positive number is allowed")?;
        for joint in &self.joints {
            ensure(self.has_unknowns(joint.value), &format!("joint `{}`", joint.name))?;
        }
        let words = self.about.iter().flat_map(|about| about.base.iter().chain(&about.tip)).map(String::as_str);
        let names = self
            .joints
            .iter()
            .map(|joint| joint.name.as_str())
            .chain(self.inputs.iter().map(|input| input.name.as_str()));
        let names = names.chain(self.unknowns.iter().map(String::as_str)).chain(words);
        names.chain(self.parameters.iter().map(|own| own.name.as_str())).try_for_each(|name| {
            check_name("joint, input or link", name).map_err(|error| error.with_context("malformed program"))
        })?;
        let limits = self.about.as_ref().map_or(&[][..], |about| &about.limits);
        ensure(limits.is_empty() || limits.len() == self.joints.len(), "limits: one pair per joint, or none")?;
        ensure(limits.iter().flatten().all(|(low, high)| low <= high), "limits: the least, then the greatest value")?;
        let follows = self.about.as_ref().map_or(&[][..], |about| &about.follows);
        ensure(follows.is_empty() || follows.len() == self.joints.len(), "follows: one entry per joint, or none")?;
        let leads = |mimic: &Mimic| self.joints.iter().any(|joint| joint.name == mimic.leader);
        ensure(follows.iter().flatten().all(leads), "follows: the leader must be a joint of the solver")?;
        let known = self.preference.is_none_or(|preference| preference.unknown < self.unknowns.len());
        ensure(known, "preference")
    }

    fn has_unknowns(&self, value: JointValue) -> bool {
        match value {
            JointValue::Angle { cosine, sine } => cosine.max(sine) < self.unknowns.len(),
            JointValue::Plain(unknown) => unknown < self.unknowns.len(),
        }
    }

    fn validate_condition(&self, condition: &Condition) -> Result<()> {
        let (first, count) = condition.inputs();
        let inputs = first.checked_add(count).and_then(|end| self.inputs.get(first..end));
        let plain = inputs.is_some_and(|inputs| inputs.iter().all(|input| input.unit == Unit::One));
        ensure(plain, "condition: its inputs do not exist or are not plain numbers")
    }

    /// Checks that no input belongs to two rotations, because each may be given as a quaternion.
    fn validate_rotations(&self) -> Result<()> {
        let rotation = |condition: &Condition| match condition {
            Condition::Rotation(first) => Some(*first),
            Condition::Unit(_) => None,
        };
        let mut firsts: Vec<usize> = self.conditions.iter().filter_map(rotation).collect();
        firsts.sort_unstable();
        let are_apart = firsts.windows(2).all(|pair| pair[1] - pair[0] >= 9);
        ensure(are_apart, "condition: two rotations have an input in common")
    }
}

fn ensure(condition: bool, place: &str) -> Result<()> {
    if condition { Ok(()) } else { Err(Error::new(ErrorKind::BadValue, format!("malformed program: {place}"))) }
}

/// The values that are defined at a point of the program.
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

    fn parameters(&mut self) -> Result<()> {
        let program = self.program;
        for (index, parameter) in program.parameters.iter().enumerate() {
            self.parameters = index;
            self.registers = 0;
            let place = format!("parameter `{}`", parameter.name);
            match &parameter.rule {
                Rule::Input(i) | Rule::Cosine(i) | Rule::Sine(i) => ensure(*i < program.inputs.len(), &place)?,
                Rule::Following(law) | Rule::CosineFollowing(law) | Rule::SineFollowing(law) => {
                    let is_sound = law.factor.is_finite() && law.offset.is_finite();
                    ensure(law.input < program.inputs.len() && is_sound, &place)?;
                }
                Rule::Root { code, value } => {
                    self.code(code, &place)?;
                    self.operand(*value, &place)?;
                }
            }
        }
        self.parameters = program.parameters.len();
        self.magnitude = true;
        Ok(())
    }

    /// Checks the blocks one after the other. Only a single block may be entirely open.
    fn blocks(&mut self, blocks: &[Block]) -> Result<()> {
        self.unknowns = vec![false; self.program.unknowns.len()];
        for block in blocks {
            self.block(block)?;
            let ends = !block.cases.iter().any(|case| !case.open);
            ensure(!ends || blocks.len() == 1, &format!("block `{}` has only open cases", block.label))?;
            if ends {
                return Ok(());
            }
        }
        ensure(self.unknowns.iter().all(|&set| set), "an unknown is never set")
    }

    fn block(&mut self, block: &Block) -> Result<()> {
        self.registers = 0;
        self.code(&block.code, &format!("block `{}`", block.label))?;
        let (entry, shared) = (self.unknowns.clone(), self.registers);
        let mut after: Option<Vec<bool>> = None;
        for case in &block.cases {
            (self.unknowns, self.registers) = (entry.clone(), shared);
            self.case(case)?;
            if !case.open {
                let alike = after.get_or_insert_with(|| self.unknowns.clone()) == &self.unknowns;
                let text =
                    || format!("case `{}` does not set what the other cases of `{}` set", case.label, block.label);
                ensure(alike, &text())?;
            }
        }
        self.unknowns = after.unwrap_or(entry);
        Ok(())
    }

    fn case(&mut self, case: &Case) -> Result<()> {
        let place = format!("case `{}`", case.label);
        self.code(&case.guard_code, &place)?;
        for guard in &case.guards {
            self.operand(guard.value, &place)?;
            self.operand(guard.scale, &place)?;
        }
        if let Some(pivot) = &case.pivot {
            self.operand(pivot.value, &place)?;
        }
        let bare = case.steps.is_empty() && case.pivot.is_none();
        ensure(!case.open || bare, &format!("{place}: an open case has steps or a pivot"))?;
        ensure(case.free.iter().all(|&joint| joint < self.program.joints.len()), &place)?;
        ensure(case.first_branch < MOST_BRANCHES, &place)?;
        case.steps.iter().try_for_each(|step| self.step(step, &place))
    }

    fn step(&mut self, step: &Step, place: &str) -> Result<()> {
        match step {
            Step::Compute(code) => self.code(code, place),
            Step::Set { unknown, value } => self.operand(*value, place).and_then(|()| self.set(*unknown, place)),
            Step::Roots { unknown, polynomials, typical, half_angle } => {
                for coefficients in polynomials {
                    let degree = coefficients.len().saturating_sub(1);
                    ensure((1..=roots::MAX_DEGREE).contains(&degree), &format!("{place}: degree {degree}"))?;
                    coefficients.iter().try_for_each(|&operand| self.operand(operand, place))?;
                }
                ensure(!polynomials.is_empty(), &format!("{place}: no polynomial"))?;
                typical.map_or(Ok(()), |typical| self.operand(typical, place))?;
                let is_whole = !half_angle || typical.is_some() && polynomials.len() == 1;
                ensure(is_whole, &format!("{place}: a half angle has one polynomial, and a spread"))?;
                self.set(*unknown, place)
            }
            Step::SixAxes(six) => {
                six.operands().into_iter().try_for_each(|operand| self.operand(operand, place))?;
                let unknowns = six.parts().joints.iter().flat_map(|joint| joint.unknowns());
                unknowns.into_iter().try_for_each(|unknown| self.set(unknown, place))
            }
            Step::Sample { joint, values } => {
                let finite = !values.is_empty() && values.iter().all(|value| value.is_finite());
                ensure(finite, &format!("{place}: finite values are allowed in a sample"))?;
                match *joint {
                    JointValue::Angle { cosine, sine } => self.set(cosine, place).and_then(|()| self.set(sine, place)),
                    JointValue::Plain(unknown) => self.set(unknown, place),
                }
            }
        }
    }

    fn described(&mut self, described: &Described) -> Result<()> {
        self.registers = 0;
        self.code(&described.code, "described")?;
        described.residuals.iter().try_for_each(|&operand| self.operand(operand, "described"))?;
        let is_whole = described.residuals.len() == self.program.checks.residuals.len() && !self.program.nearby;
        ensure(
            is_whole && described.within.is_finite() && described.within >= 0.0,
            "described: equations or tolerance",
        )?;
        ensure(
            described.is_affine(self.program),
            "described: equations that are not affine in the numbers of each joint",
        )?;
        let reached = self.program.forward().is_some_and(|forward| !forward.inputs.is_empty());
        ensure(reached, "described: the equations do not compare the tip with the target")
    }

    fn checks(&mut self, checks: &Checks) -> Result<()> {
        self.registers = 0;
        self.unknowns = vec![true; self.program.unknowns.len()];
        self.code(&checks.code, "checks")?;
        let equations = checks.residuals.len();
        let square = checks.scales.len() == equations
            && checks.jacobian.len() == equations
            && checks.jacobian.iter().all(|row| row.len() == self.program.joints.len())
            && checks.short.iter().all(|short| short.derivatives.len() == self.program.joints.len());
        ensure(square && equations > 0, "checks: sizes differ")?;
        ensure(
            !self.program.nearby || !checks.short.is_empty(),
            "checks: a program that polishes needs `short` equations",
        )?;
        let operands = checks.residuals.iter().chain(&checks.scales).chain(checks.jacobian.iter().flatten());
        let operands = operands.chain(checks.short.iter().flat_map(Short::operands));
        operands.copied().try_for_each(|operand| self.operand(operand, "checks"))
    }
}
