//! Joints that two chains share, found from both chains together: [`Simultaneous`].
//!
//! One relation of each chain is used that contains only shared unknown joints. Such a relation holds an invariant of two lines, planes or points that the
//! joints between them do not change.
//!
//! One shared joint gives a pair of equations; if one is singular, the other determines the joint. Of two shared joints that neither chain determines alone,
//! one is eliminated. The relations are linear and homogeneous in its cosine and sine, and their determinant is an equation in the other joint.

use serde::{Deserialize, Serialize};

use super::ProvedStep;
use super::context::Context;
use super::eliminate::{self, Elimination};
use super::form_basis::Form;
use super::forms::{Forms, NamedForm};
use super::frame::{given, reach};
use super::layout::Layout;
use super::samples::Samples;
use super::shape::{Shape, eliminated};
use super::slack::Slack;
use super::symbolic::Symbolic;
use crate::derive::closure::{Mechanism, Relation, Word, prove};
use crate::derive::equations::certificate::refused;
use crate::derive::planner::{PlanStep, StepMethod};
use crate::solver::{
    Block, Checks, Condition, Instruction, Joint, JointValue, Operand, Operation, ParameterRule, Program, Rule,
    TipTask, Unit,
};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::kinematics::Chain;

/// A chain, and the prefix of its names in a program.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Side<'a> {
    /// The chain.
    pub chain: &'a Chain,
    /// The prefix of the names of its inputs and joints.
    pub prefix: &'a str,
}

/// One or two unknown joints that two chains share, found from one relation of each.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Simultaneous {
    /// The number of shared joints, including given ones. They are the first joints of both chains.
    pub shared: usize,
    /// The step for the joint that is found first, from a relation of each chain. If there is a second joint, it is eliminated in that step, and a second step
    /// finds it from the same relations.
    pub steps: Vec<ProvedStep>,
    /// The forms that the steps use, solved.
    pub forms: Forms,
    /// The program that finds the shared joints. Its checks cover only the given joints, because programs of the chains follow.
    pub program: Program,
}

/// The stored proof.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::derive) struct Stored {
    /// The index of the joint that is found first, and of the other one.
    joints: Vec<usize>,
    relations: [Relation; 2],
    #[serde(default, skip_serializing_if = "Option::is_none")]
    elimination: Option<eliminate::Stored>,
    forms: Vec<NamedForm>,
}

impl Simultaneous {
    /// Derives and proves the unknown joints among the first `shared` joints of two chains, which are common actuators. It searches for relations of both
    /// chains that determine them.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] if the unknown shared joints are not one or two revolute ones, or if no relations fit. As [`Mechanism::new`].
    pub fn derive<'w>(sides: [Side<'_>; 2], shared: usize, watch: impl Into<Option<&'w Watch>>) -> Result<Self> {
        let watch = Watch::or_none(watch);
        let common = Common::new(sides, shared)?;
        let steps = common.search(watch)?;
        let forms = Forms::of(&steps)?;
        common.assemble(steps, forms)
    }

    /// The stored form of the proof.
    ///
    /// # Errors
    /// If a form's field cannot be built. This does not occur for a derivation that this crate made.
    pub(in crate::derive) fn stored(&self) -> Result<Stored> {
        let [f, g] = self.relations()?;
        let elimination = self.steps.first().and_then(|step| step.elimination.as_ref());
        Ok(Stored {
            joints: self.steps.iter().map(|step| step.joint).collect(),
            relations: [f.clone(), g.clone()],
            elimination: elimination.map(Elimination::stored),
            forms: self.forms.named(),
        })
    }

    /// The relations, one of each chain.
    ///
    /// # Errors
    /// [`ErrorKind::Certificate`] if there are not two. This does not occur for a derivation that this crate made.
    pub(crate) fn relations(&self) -> Result<[&Relation; 2]> {
        match self.steps.first().map(|step| step.relations.as_slice()) {
            Some([f, g]) => Ok([f, g]),
            _ => Err(refused("shared joints follow from two relations".to_owned())),
        }
    }

    /// Proves a stored derivation again, without search.
    ///
    /// # Errors
    /// [`ErrorKind::Certificate`] for a false claim.
    pub(in crate::derive) fn reprove(sides: [Side<'_>; 2], shared: usize, stored: &Stored) -> Result<Self> {
        let common = Common::new(sides, shared)?;
        let mut joints = stored.joints.clone();
        joints.sort_unstable();
        if joints != common.unknown {
            return Err(refused("the shared joints are not those that both chains leave undetermined".to_owned()));
        }
        let elimination = match (&stored.joints[..], &stored.elimination) {
            (&[first, second], Some(stored_elimination)) => {
                let sides = common.sides(&stored.relations);
                Some(Elimination::reprove_two(&sides, [second, first], stored_elimination)?)
            }
            (&[_], None) => None,
            _ => return Err(refused("the elimination of a shared joint is missing or superfluous".to_owned())),
        };
        let steps = common.steps(&stored.joints, stored.relations.clone(), elimination)?;
        let forms = Forms::reprove(&steps, &stored.forms)?;
        common.assemble(steps, forms)
    }

    /// The maximum number of complex values of the shared joints together. Two dependent equations in one joint have two common solutions.
    pub fn dimension(&self) -> usize {
        self.steps.iter().map(|step| step.shape.form.degree().max(2)).product()
    }
}

/// Two mechanisms whose first joints are common revolute actuators.
struct Common<'a> {
    sides: [Side<'a>; 2],
    mechanisms: [Mechanism; 2],
    shared: usize,
    /// The shared joints that are not given, one or two.
    unknown: Vec<usize>,
}

impl<'a> Common<'a> {
    fn new(sides: [Side<'a>; 2], shared: usize) -> Result<Self> {
        let unsupported = |text: &str| Err(Error::new(ErrorKind::Unsupported, text.to_owned()));
        let mechanisms = [Mechanism::new(sides[0].chain)?, Mechanism::new(sides[1].chain)?];
        let [first, second] =
            mechanisms.each_ref().map(|mechanism| mechanism.joints().get(..shared).unwrap_or_default());
        let alike = first.iter().zip(second).all(|(a, b)| a.is_revolute() && b.is_revolute() && a.square == b.square);
        if first.len() != shared || second.len() != shared || !alike {
            return unsupported(
                "shared joints must be the first joints of both chains and revolute, with axis vectors of equal length",
            );
        }
        if mechanisms.iter().any(|mechanism| mechanism.hidden().is_some()) {
            return unsupported(
                "joints that two chains share cannot be found from a ray, which leaves a rotation open; choose another task",
            );
        }
        let given = mechanisms[0].given().to_vec();
        if given != mechanisms[1].given() || given.iter().any(|joint| *joint >= shared) {
            return unsupported("the joints that are given must be shared, and given to both chains");
        }
        let unknown: Vec<usize> = (0..shared).filter(|joint| !given.contains(joint)).collect();
        if !matches!(unknown[..], [_] | [_, _]) {
            return unsupported("one or two of the shared joints must be unknown");
        }
        Ok(Common { sides, mechanisms, shared, unknown })
    }

    /// The steps from the first suitable relations.
    fn search(&self, watch: &Watch) -> Result<Vec<ProvedStep>> {
        let [first, second] = [self.candidates(0)?, self.candidates(1)?];
        let pairs = || first.iter().flat_map(|f| second.iter().map(move |g| [f.clone(), g.clone()]));
        let text =
            "the joints that two chains share do not follow from one relation of each; give the value of one of them";
        let unsupported = || Error::new(ErrorKind::Unsupported, text);
        let &[a, b] = self.unknown.as_slice() else {
            return self.steps(&self.unknown, pairs().next().ok_or_else(unsupported)?, None);
        };
        for joints in [[a, b], [b, a]] {
            for relations in pairs() {
                watch.check()?;
                match Elimination::of_two(&self.sides(&relations), [joints[1], joints[0]]) {
                    Err(error) if error.kind() == ErrorKind::Unsupported => {}
                    found => return self.steps(&joints, relations, Some(found?)),
                }
            }
        }
        Err(unsupported())
    }

    /// The relations of one chain that contain only shared joints. A relation has an arc of further joints between its two objects. The arc is removed if its
    /// joints do not change the measured quantity.
    fn candidates(&self, side: usize) -> Result<Vec<Relation>> {
        let mechanism = &self.mechanisms[side];
        let mut symbolic = Symbolic::new(mechanism)?;
        let mut found = Vec::new();
        for relation in mechanism.relations() {
            let joints: Vec<usize> = relation.right.0.iter().filter_map(|letter| letter.joint()).collect();
            let holds_all = self.unknown.iter().all(|joint| joints.contains(joint));
            if !holds_all || joints.iter().any(|joint| *joint >= self.shared) {
                continue;
            }
            let arc = Relation { right: Word::default(), ..relation.clone() };
            if symbolic.polynomial(mechanism, &arc)?.is_zero() {
                found.push(Relation { left: Word::default(), ..relation });
            }
        }
        Ok(found)
    }

    fn sides<'b>(&'b self, relations: &'b [Relation; 2]) -> [(&'b Mechanism, &'b Relation); 2] {
        [(&self.mechanisms[0], &relations[0]), (&self.mechanisms[1], &relations[1])]
    }

    /// The steps for `joints`, proved.
    fn steps(
        &self,
        joints: &[usize],
        relations: [Relation; 2],
        elimination: Option<Elimination>,
    ) -> Result<Vec<ProvedStep>> {
        for (mechanism, relation) in self.sides(&relations) {
            if let Some(joint) = relation.joints().into_iter().find(|joint| *joint >= self.shared) {
                return Err(refused(format!("`{relation}` contains joint {}, which is not shared", joint + 1)));
            }
            if !relation.has_target() {
                return Err(refused(format!("`{relation}` does not contain the target")));
            }
            prove(mechanism, relation)?;
        }
        let by_pair = |joint: usize| ProvedStep {
            joint,
            relations: relations.to_vec(),
            elimination: None,
            shape: Shape { form: Form::Pair, ratio: None },
        };
        let (&[leading, following], Some(elimination)) = (joints, elimination) else {
            return Ok(self.unknown.iter().map(|joint| by_pair(*joint)).collect());
        };
        let method = StepMethod::Eliminated { relations: relations.to_vec(), away: vec![following] };
        let leader = PlanStep { joint: leading, method, degree: 4 };
        let shape = eliminated(&self.mechanisms[0], &leader, &elimination)?;
        let relations = relations.to_vec();
        Ok(vec![ProvedStep { joint: leading, relations, elimination: Some(elimination), shape }, by_pair(following)])
    }

    fn assemble(&self, steps: Vec<ProvedStep>, forms: Forms) -> Result<Simultaneous> {
        let unit = self.sides[0].chain.length_unit();
        let [mechanism, partner] = &self.mechanisms;
        let (mut layout, mut other) = (Layout::new(mechanism, unit), Layout::new(partner, unit));
        layout.keep_joints(self.shared);
        other.first = layout.parameters.len();
        other.joints[..self.shared].copy_from_slice(&layout.joints[..self.shared]);
        let reach = reach(self.sides[0].chain).max(reach(self.sides[1].chain));
        let mut known = mechanism.given().to_vec();
        let mut blocks: Vec<Block> = known.iter().map(|&joint| given(mechanism, &layout, joint)).collect();
        let (slack, samples) = (Slack::NONE, Samples::of(&steps, Slack::NONE));
        for step in &steps {
            let (free, partner) = (step.joint, Some((partner, &other)));
            let context =
                Context { mechanism, known: &known, step, free, reach, slack, samples, spreads: &[], partner };
            blocks.push(context.block(&mut layout, &forms)?);
            known.push(step.joint);
        }
        let program = self.program(layout, other, blocks, reach);
        Ok(Simultaneous { shared: self.shared, steps, forms, program })
    }

    /// The program that finds the shared joints. The inputs and parameters of the second chain's target come last.
    fn program(&self, layout: Layout, other: Layout, blocks: Vec<Block>, scale: f64) -> Program {
        let checks = held(&layout, self.mechanisms[0].given(), self.shared);
        let mut program = Program {
            name: "shared".to_owned(),
            joints: layout.joints.iter().zip(self.sides[0].chain.joints()).take(self.shared).map(joint).collect(),
            tasks: vec![TipTask::of(self.sides[0].chain)],
            given_joints: layout.given_joints,
            inputs: layout.inputs,
            conditions: layout.conditions,
            parameters: layout.parameters,
            unknowns: layout.unknowns,
            blocks,
            checks,
            capacity: 1,
            scale,
            ..Program::default()
        }
        .prefixed(self.sides[0].prefix);
        let (first, prefix) = (program.inputs.len(), self.sides[1].prefix);
        program.tasks.push(TipTask { first_input: first, ..TipTask::of(self.sides[1].chain) });
        let (inputs, parameters) =
            (other.inputs.len() - self.mechanisms[1].given().len(), self.mechanisms[1].parameters().len());
        for mut input in other.inputs.into_iter().take(inputs) {
            input.name.insert_str(0, prefix);
            program.inputs.push(input);
        }
        for ParameterRule { name, rule } in other.parameters.into_iter().take(parameters) {
            program.parameters.push(ParameterRule { name: format!("{prefix}{name}"), rule: moved(rule, first) });
        }
        program.conditions.extend(other.conditions.into_iter().map(|condition| match condition {
            Condition::Rotation(index) => Condition::Rotation(first + index),
            Condition::Unit(index) => Condition::Unit(first + index),
        }));
        program
    }
}

fn joint((value, joint): (&JointValue, &groebot_robot::kinematics::Joint)) -> Joint {
    Joint { name: joint.name.clone(), unit: Unit::Radian, value: *value }
}

/// The equations that fix the joints `given`, among `count` joints, at their input values.
fn held(layout: &Layout, given: &[usize], count: usize) -> Checks {
    let mut checks = Checks::default();
    let mut emit = |operation: Operation| {
        checks.code.push(Instruction { target: checks.code.len(), operation });
        Operand::Register(checks.code.len() - 1)
    };
    let angles: Vec<(usize, usize, usize)> = given
        .iter()
        .filter_map(|&joint| match layout.joints[joint] {
            JointValue::Angle { cosine, sine } => Some((joint, cosine, sine)),
            JointValue::Plain(_) => None,
        })
        .collect();
    for &(joint, cosine, sine) in &angles {
        for (unknown, &parameter) in [cosine, sine].into_iter().zip(&layout.given[joint]) {
            checks.residuals.push(emit(Operation::Sub(Operand::Unknown(unknown), Operand::Parameter(parameter))));
            checks.scales.push(Operand::Constant(1.0));
        }
    }
    for (joint, cosine, sine) in angles {
        let fall = emit(Operation::Mul(Operand::Constant(-1.0), Operand::Unknown(sine)));
        for derivative in [fall, Operand::Unknown(cosine)] {
            let mut row = vec![Operand::Constant(0.0); count];
            row[joint] = derivative;
            checks.jacobian.push(row);
        }
    }
    checks
}

/// The rule with `by` added to its input index.
fn moved(rule: Rule, by: usize) -> Rule {
    let Ok(rule) = rule.with_input(|index| Ok::<_, std::convert::Infallible>(index + by));
    rule
}
