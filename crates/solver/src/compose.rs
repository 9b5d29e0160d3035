//! Composition of two programs: mechanisms that share actuators are solved one after the other. The second has the
//! shared joints at the values from the first ([`Program::followed_by`]).

use super::instruction::{Instruction, Operand, Operation};
use super::joint::{Joint, JointValue};
use super::program::{Block, Case, Checks, Condition, Guard, Pivot, Program, Step};
use super::rule::{ParameterRule, Rule};
use super::tips::{GivenJoint, TipTask};
use super::validate::MOST_ANSWERS;
use crate::{Error, ErrorKind, Result};

impl Program {
    /// Same as `self`, but with `prefix` before the names of its inputs, parameters, unknowns and joints.
    #[must_use]
    pub fn prefixed(&self, prefix: &str) -> Program {
        let mut program = self.clone();
        let inputs = program.inputs.iter_mut().map(|input| &mut input.name);
        let parameters = program.parameters.iter_mut().map(|parameter| &mut parameter.name);
        let joints = program.joints.iter_mut().map(|joint| &mut joint.name);
        for name in inputs.chain(parameters).chain(joints).chain(&mut program.unknowns) {
            name.insert_str(0, prefix);
        }
        program
    }

    /// The program that solves this one and then `next`. In each pair of `shared`, a joint of this program and a given
    /// joint of `next` are one actuator. It occurs once among the joints, and is no longer an input of `next`. Inputs
    /// of one name are one input. Other inputs and joints of `next` follow this program's; name, version and preference
    /// are this program's.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a shared joint that does not exist, that moves differently, or that `next` does not
    /// take as given; for more than [`super::MAX_JOINTS`] joints and other faults that [`Program::validate`] refuses.
    pub fn followed_by(&self, next: &Program, shared: &[(usize, usize)]) -> Result<Program> {
        self.joined(next, shared).map(|(program, _)| program)
    }

    /// [`Program::followed_by`], and by input of `next` its index in the composed program; `None` for the value of a
    /// shared joint.
    #[doc(hidden)]
    pub fn joined(&self, next: &Program, shared: &[(usize, usize)]) -> Result<(Program, Vec<Option<usize>>)> {
        let places = Places::new(self, next, shared)?;
        let mut program = self.clone();
        add_new(&mut program.tasks, next.tasks.iter().map(|tip| places.tip(tip)).collect::<Result<_>>()?);
        add_new(&mut program.given_joints, next.given_joints.iter().filter_map(|given| places.given(*given)).collect());
        program.given_joints.sort_by_key(|given| given.input);
        program
            .inputs
            .extend(own(&next.inputs, |index| places.inputs[index].is_some_and(|place| place >= self.inputs.len())));
        program.unknowns.extend(own(&next.unknowns, |index| places.unknowns[index] >= self.unknowns.len()));
        let conditions = next.conditions.iter().map(|&condition| places.condition(condition)).collect::<Result<_>>()?;
        add_new(&mut program.conditions, conditions);
        let is_new = |index: usize| matches!(places.parameters[index], Operand::Parameter(place) if place >= self.parameters.len());
        for parameter in own(&next.parameters, is_new) {
            program.parameters.push(places.parameter(parameter)?);
        }
        let joints = own(&next.joints, |index| places.joints[index] >= self.joints.len());
        program.joints.extend(joints.map(|joint| Joint { value: places.value(joint.value), ..joint }));
        program.blocks.extend(next.blocks.iter().filter_map(|block| places.block(block)));
        program.checks = both(&self.checks, places.checks(&next.checks, program.joints.len()), program.joints.len());
        program.scale = self.scale.max(next.scale);
        program.capacity = self.capacity.saturating_mul(next.capacity).min(MOST_ANSWERS);
        program.isolated = self.isolated.zip(next.isolated).map(|(own, other)| own.saturating_mul(other));
        // The two programs have different sources.
        program.about = None;
        program.validate()?;
        Ok((program, places.inputs))
    }

    /// Whether the user gives the value of a joint by an input.
    fn is_given_by(&self, input: usize) -> bool {
        self.given_joints.iter().any(|given| given.input == input)
    }
}

/// Adds those members to a list that it does not have.
fn add_new<T: PartialEq>(list: &mut Vec<T>, members: Vec<T>) {
    for member in members {
        if !list.contains(&member) {
            list.push(member);
        }
    }
}

/// The members of a list whose index is wanted.
fn own<T: Clone>(list: &[T], wanted: impl Fn(usize) -> bool) -> impl Iterator<Item = T> {
    list.iter().enumerate().filter(move |(index, _)| wanted(*index)).map(|(_, member)| member.clone())
}

fn refuse(text: String) -> Error {
    Error::new(ErrorKind::BadValue, text)
}

/// The indices of the second program's parts in the composed one.
struct Places {
    /// `None` for the value of a shared joint.
    inputs: Vec<Option<usize>>,
    /// A parameter, or an unknown of the first program for the value of a shared joint.
    parameters: Vec<Operand>,
    unknowns: Vec<usize>,
    joints: Vec<usize>,
}

impl Places {
    fn new(first: &Program, next: &Program, shared: &[(usize, usize)]) -> Result<Self> {
        let mut unknowns = vec![None; next.unknowns.len()];
        let mut joints = vec![None; next.joints.len()];
        for &(a, b) in shared {
            let (Some(one), Some(other)) = (first.joints.get(a), next.joints.get(b)) else {
                return Err(refuse(format!("shared joints {a} and {b}: there are no such joints")));
            };
            for (mine, theirs) in paired(one, other)? {
                unknowns[theirs] = Some(mine);
            }
            joints[b] = Some(a);
        }
        let given = given_parameters(next, &unknowns);
        for &(_, b) in shared {
            let known = |unknown| given.iter().any(|(_, set)| *set == unknown);
            if !unknowns_of(next.joints[b].value).into_iter().all(known) {
                return Err(refuse(format!("`{}` is shared, but the next program finds it too", next.joints[b].name)));
            }
        }
        let mut parameters = vec![None; next.parameters.len()];
        let mut used = vec![None; next.inputs.len()];
        for (parameter, unknown) in given {
            parameters[parameter] = unknowns[unknown].map(Operand::Unknown);
            if let Rule::Input(input) | Rule::Cosine(input) | Rule::Sine(input) = next.parameters[parameter].rule {
                used[input] = Some(None);
            }
        }
        for (index, place) in used.iter_mut().enumerate().filter(|(_, place)| place.is_none()) {
            // A joint may have the name of a number of the task.
            let is_same = |other: &usize| {
                first.inputs[*other] == next.inputs[index] && first.is_given_by(*other) == next.is_given_by(index)
            };
            *place = (0..first.inputs.len()).find(is_same).map(Some);
        }
        for (parameter, place) in next.parameters.iter().zip(&mut parameters).filter(|(_, place)| place.is_none()) {
            let same = |other: &ParameterRule| match (&other.rule, &parameter.rule) {
                (Rule::Input(a), Rule::Input(b))
                | (Rule::Cosine(a), Rule::Cosine(b))
                | (Rule::Sine(a), Rule::Sine(b)) => used[*b] == Some(Some(*a)),
                _ => false,
            };
            *place = first.parameters.iter().position(same).map(Operand::Parameter);
        }
        Ok(Places {
            inputs: counted(used, first.inputs.len(), Some),
            parameters: counted(parameters, first.parameters.len(), Operand::Parameter),
            unknowns: counted(unknowns, first.unknowns.len(), |index| index),
            joints: counted(joints, first.joints.len(), |index| index),
        })
    }

    fn operand(&self, operand: Operand) -> Operand {
        match operand {
            Operand::Parameter(index) => self.parameters[index],
            Operand::Unknown(index) => Operand::Unknown(self.unknowns[index]),
            other => other,
        }
    }

    fn code(&self, code: &[Instruction]) -> Vec<Instruction> {
        let operation = |operation| mapped(operation, &|operand| self.operand(operand));
        let line = |line: &Instruction| Instruction { operation: operation(line.operation), ..*line };
        code.iter().map(line).collect()
    }

    fn value(&self, value: JointValue) -> JointValue {
        match value {
            JointValue::Angle { cosine, sine } => {
                JointValue::Angle { cosine: self.unknowns[cosine], sine: self.unknowns[sine] }
            }
            JointValue::Plain(unknown) => JointValue::Plain(self.unknowns[unknown]),
        }
    }

    fn input(&self, index: usize) -> Result<usize> {
        self.inputs[index]
            .ok_or_else(|| refuse(format!("input {index} of the next program is used for more than a shared joint")))
    }

    fn tip(&self, tip: &TipTask) -> Result<TipTask> {
        Ok(TipTask { first_input: self.input(tip.first_input)?, ..tip.clone() })
    }

    /// A given joint of the next program; `None` for a shared one, which the first program finds.
    fn given(&self, given: GivenJoint) -> Option<GivenJoint> {
        Some(GivenJoint { joint: self.joints[given.joint], input: self.inputs[given.input]? })
    }

    fn condition(&self, condition: Condition) -> Result<Condition> {
        Ok(match condition {
            Condition::Rotation(first) => Condition::Rotation(self.input(first)?),
            Condition::Unit(first) => Condition::Unit(self.input(first)?),
        })
    }

    fn parameter(&self, parameter: ParameterRule) -> Result<ParameterRule> {
        let rule = match parameter.rule {
            Rule::Root { code, value } => Rule::Root { code: self.code(&code), value: self.operand(value) },
            rule => rule.with_input(|index| self.input(index))?,
        };
        Ok(ParameterRule { rule, ..parameter })
    }

    /// The block; `None` if it only sets shared joints.
    fn block(&self, block: &Block) -> Option<Block> {
        let cases: Vec<Case> = block.cases.iter().map(|case| self.case(case)).collect();
        let idle = |case: &Case| case.steps.is_empty() && case.guards.is_empty() && !case.open;
        let is_idle = matches!(cases.as_slice(), [case] if idle(case));
        (!is_idle).then(|| Block { label: block.label.clone(), code: self.code(&block.code), cases })
    }

    fn case(&self, case: &Case) -> Case {
        let guard = |guard: &Guard| Guard {
            value: self.operand(guard.value),
            scale: self.operand(guard.scale),
            ..guard.clone()
        };
        Case {
            label: case.label.clone(),
            guard_code: self.code(&case.guard_code),
            guards: case.guards.iter().map(guard).collect(),
            pivot: case.pivot.map(|pivot| Pivot { value: self.operand(pivot.value), ..pivot }),
            steps: case.steps.iter().filter_map(|step| self.step(step)).collect(),
            free: case.free.iter().map(|&joint| self.joints[joint]).collect(),
            open: case.open,
            first_branch: case.first_branch,
        }
    }

    /// The step; `None` if it sets an unknown to itself.
    fn step(&self, step: &Step) -> Option<Step> {
        Some(match step {
            Step::Compute(code) => Step::Compute(self.code(code)),
            Step::Set { unknown, value } => {
                let (unknown, value) = (self.unknowns[*unknown], self.operand(*value));
                return (value != Operand::Unknown(unknown)).then_some(Step::Set { unknown, value });
            }
            Step::Roots { unknown, polynomials, typical, half_angle } => Step::Roots {
                unknown: self.unknowns[*unknown],
                polynomials: polynomials.iter().map(|list| self.operands(list)).collect(),
                typical: typical.map(|typical| self.operand(typical)),
                half_angle: *half_angle,
            },
            Step::SixAxes(six) => {
                Step::SixAxes(Box::new(six.renamed(|joint| self.value(joint), |operand| self.operand(operand))))
            }
            Step::Sample { joint, values } => Step::Sample { joint: self.value(*joint), values: values.clone() },
        })
    }

    fn operands(&self, list: &[Operand]) -> Vec<Operand> {
        list.iter().map(|&operand| self.operand(operand)).collect()
    }

    /// The equations, with derivatives by all `joints`. Equations that only set shared joints hold automatically and
    /// are removed.
    fn checks(&self, checks: &Checks, joints: usize) -> Checks {
        let code = self.code(&checks.code);
        let holds = |residual: Operand| match residual {
            Operand::Register(index) => matches!(code[index].operation, Operation::Sub(a, b) if a == b),
            _ => false,
        };
        let row = |line: &Vec<Operand>| {
            let mut row = vec![Operand::Constant(0.0); joints];
            line.iter().zip(&self.joints).for_each(|(&entry, &joint)| row[joint] = self.operand(entry));
            row
        };
        let counts = |index: usize| !holds(checks.residuals[index]);
        Checks {
            residuals: own(&self.operands(&checks.residuals), counts).collect(),
            scales: own(&self.operands(&checks.scales), counts).collect(),
            jacobian: own(&checks.jacobian, counts).map(|line| row(&line)).collect(),
            short: Vec::new(),
            code,
        }
    }
}

/// Fills missing places with consecutive ones from `first` on.
fn counted<T>(places: Vec<Option<T>>, first: usize, place: impl Fn(usize) -> T) -> Vec<T> {
    let mut next = first..;
    places.into_iter().map(|known| known.unwrap_or_else(|| place(next.next().unwrap_or(usize::MAX)))).collect()
}

fn unknowns_of(value: JointValue) -> Vec<usize> {
    match value {
        JointValue::Angle { cosine, sine } => vec![cosine, sine],
        JointValue::Plain(unknown) => vec![unknown],
    }
}

/// The pairs of unknowns of two joints that are one actuator.
fn paired(first: &Joint, next: &Joint) -> Result<Vec<(usize, usize)>> {
    let (mine, theirs) = (unknowns_of(first.value), unknowns_of(next.value));
    if first.unit != next.unit || mine.len() != theirs.len() {
        let text = format!(
            "`{}` and `{}` are shared; both must be revolute, or prismatic with one unit",
            first.name, next.name
        );
        return Err(refuse(text));
    }
    Ok(mine.into_iter().zip(theirs).collect())
}

/// The parameters that a program only copies into unknowns with a place, with these unknowns.
fn given_parameters(next: &Program, unknowns: &[Option<usize>]) -> Vec<(usize, usize)> {
    let steps = next.cases().flat_map(|case| &case.steps);
    let copied = steps.filter_map(|step| match step {
        Step::Set { unknown, value: Operand::Parameter(parameter) } => Some((*parameter, *unknown)),
        _ => None,
    });
    copied.filter(|(_, unknown)| unknowns[*unknown].is_some()).collect()
}

fn mapped(operation: Operation, place: &dyn Fn(Operand) -> Operand) -> Operation {
    match operation {
        Operation::Add(a, b) => Operation::Add(place(a), place(b)),
        Operation::Sub(a, b) => Operation::Sub(place(a), place(b)),
        Operation::Mul(a, b) => Operation::Mul(place(a), place(b)),
        Operation::Div(a, b) => Operation::Div(place(a), place(b)),
        Operation::Abs(a) => Operation::Abs(place(a)),
        Operation::Sqrt(a) => Operation::Sqrt(place(a)),
    }
}

/// The equations of two programs for one set of `joints`. The code of all values comes before that of the derivatives.
fn both(first: &Checks, next: Checks, joints: usize) -> Checks {
    let (mine, theirs, length) = (measured(first), measured(&next), first.code.len());
    let ahead = |index: usize| if index < mine { index } else { index + theirs };
    let renumbered = |index: usize| if index < theirs { index + mine } else { index + length };
    let mut checks = moved(first, &ahead);
    let next = moved(&next, &renumbered);
    checks.jacobian.iter_mut().for_each(|row| row.resize(joints, Operand::Constant(0.0)));
    checks.code.extend(next.code);
    checks.code.sort_by_key(|line| line.target);
    checks.residuals.extend(next.residuals);
    checks.scales.extend(next.scales);
    checks.jacobian.extend(next.jacobian);
    without_repeats(&checks)
}

/// Removes repeated values, which mechanisms on one base have in common.
fn without_repeats(checks: &Checks) -> Checks {
    let mut code: Vec<Instruction> = Vec::with_capacity(checks.code.len());
    let mut places: Vec<usize> = Vec::with_capacity(checks.code.len());
    for line in &checks.code {
        let operation = mapped(line.operation, &|operand| placed(operand, &places));
        let known = code.iter().position(|other| other.operation == operation);
        places.push(known.unwrap_or(code.len()));
        if known.is_none() {
            code.push(Instruction { target: code.len(), operation });
        }
    }
    let all = |list: &[Operand]| list.iter().map(|&entry| placed(entry, &places)).collect();
    Checks {
        residuals: all(&checks.residuals),
        scales: all(&checks.scales),
        jacobian: checks.jacobian.iter().map(|row| all(row)).collect(),
        short: Vec::new(),
        code,
    }
}

/// The operand with its register renumbered by `places`.
fn placed(operand: Operand, places: &[usize]) -> Operand {
    match operand {
        Operand::Register(index) => Operand::Register(places[index]),
        other => other,
    }
}

/// The equations with renumbered registers.
fn moved(checks: &Checks, place: &dyn Fn(usize) -> usize) -> Checks {
    let operand = |operand: Operand| match operand {
        Operand::Register(index) => Operand::Register(place(index)),
        other => other,
    };
    let line =
        |line: &Instruction| Instruction { target: place(line.target), operation: mapped(line.operation, &operand) };
    let all = |list: &[Operand]| list.iter().map(|&entry| operand(entry)).collect();
    Checks {
        code: checks.code.iter().map(line).collect(),
        residuals: all(&checks.residuals),
        scales: all(&checks.scales),
        jacobian: checks.jacobian.iter().map(|row| all(row)).collect(),
        short: Vec::new(),
    }
}

/// The number of instructions that the equations' values and sizes need; the others are for the derivatives.
fn measured(checks: &Checks) -> usize {
    let end = |operand: &Operand| if let Operand::Register(index) = operand { index + 1 } else { 0 };
    checks.residuals.iter().chain(&checks.scales).map(end).max().unwrap_or(0)
}
