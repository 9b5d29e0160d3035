//! Two joints that two chains share and that neither chain determines alone: [`Coupled`].
//!
//! Of each chain a relation is taken that holds no other unknown joint: what the two lines, planes or points keep between them is the
//! same whatever the joints between do, so these drop out. The relations are linear and homogeneous in the cosine and sine of one of
//! the two joints; their determinant is an equation in the other one.

use serde::{Deserialize, Serialize};

use super::certificate::{Proof, prove_template, template_proofs};
use super::eliminate::{self, Elimination};
use super::half_angle::{self, HalfAngles};
use super::layout::Layout;
use super::program::{Context, given, reach};
use super::shape::{Symbolic, eliminated, shape};
use super::template::{Form, Template};
use super::Lifted;
use crate::derive::certificate::refused;
use crate::derive::closure::{Letter, Mechanism, Relation, Word, prove};
use crate::derive::planner::{PlanStep, Way};
use crate::kinematics::Chain;
use crate::solver::{Block, Checks, Condition, Joint, ParameterRule, Program, Rule, Unit};
use crate::{Error, ErrorKind, Result, Watch};

/// A chain, and what stands before its names in a program.
#[derive(Clone, Copy, Debug)]
pub struct Side<'a> {
    /// The chain.
    pub chain: &'a Chain,
    /// What stands before the names of its inputs and joints.
    pub prefix: &'a str,
}

/// Two unknown joints that two chains share, found from one relation of each.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupled {
    /// The number of joints, given ones too, that stand first in both chains and are shared.
    pub shared: usize,
    /// The joint that is found first, by elimination of the other from a relation of each chain; then the other, from the first one.
    pub steps: [Lifted; 2],
    /// The forms that the steps use, solved.
    pub templates: Vec<Template>,
    /// The half angles, where an equation of degree two in cosine and sine is left.
    pub half_angles: Option<HalfAngles>,
    /// Finds the shared joints. Its answers are not measured: programs of the chains are to follow.
    pub program: Program,
}

/// The stored proof.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::derive) struct Stored {
    /// The places of the joint that is found first and of the other.
    joints: [usize; 2],
    relations: [Relation; 2],
    elimination: eliminate::Stored,
    templates: Vec<Proof>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    half_angles: Option<Vec<half_angle::Stored>>,
}

impl Coupled {
    /// Finds the relations of two chains, whose first `shared` joints are the same motors, that determine the two unknown ones among
    /// these; proves them and what follows.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] when the shared joints are not two unknown ones that turn, or no relations fit; as [`Mechanism::new`].
    pub fn derive(sides: [Side<'_>; 2], shared: usize, watch: &Watch) -> Result<Self> {
        let pair = Pair::new(sides, shared)?;
        let [first, second] = [pair.candidates(0)?, pair.candidates(1)?];
        let [a, b] = pair.unknown;
        for joints in [[a, b], [b, a]] {
            for relations in first.iter().flat_map(|f| second.iter().map(move |g| [f.clone(), g.clone()])) {
                watch.check()?;
                match Elimination::of_two(&pair.sides(&relations), [joints[1], joints[0]]) {
                    Err(error) if error.kind() == ErrorKind::Unsupported => {}
                    found => {
                        let steps = pair.steps(joints, relations, found?)?;
                        let forms = Template::needed(&steps);
                        let templates = forms.into_iter().map(|form| Template::derive(form, watch)).collect::<Result<_>>()?;
                        let half_angles = is_quartic(&steps).then(|| HalfAngles::derive(watch)).transpose()?;
                        return pair.assemble(steps, templates, half_angles);
                    }
                }
            }
        }
        let text = "the joints that two limbs share do not follow from one relation of each; give the value of one of them";
        Err(Error::new(ErrorKind::Unsupported, text))
    }

    /// What is stored of the proof.
    ///
    /// # Errors
    /// When a template's field cannot be built: never for a derivation that was made by this crate.
    pub(in crate::derive) fn stored(&self) -> Result<Stored> {
        let [first, second] = &self.steps;
        let (Some(elimination), [f, g]) = (&first.elimination, first.relations.as_slice()) else {
            return Err(refused("the first of two shared joints follows from two relations".to_owned()));
        };
        Ok(Stored {
            joints: [first.joint, second.joint],
            relations: [f.clone(), g.clone()],
            elimination: elimination.stored(),
            templates: template_proofs(&self.templates)?,
            half_angles: self.half_angles.as_ref().map(HalfAngles::stored),
        })
    }

    /// Proves a stored derivation anew, without search.
    ///
    /// # Errors
    /// [`ErrorKind::Certificate`] for a claim that does not hold.
    pub(in crate::derive) fn again(sides: [Side<'_>; 2], shared: usize, stored: &Stored) -> Result<Self> {
        let pair = Pair::new(sides, shared)?;
        let [first, second] = stored.joints;
        if first == second || ![first, second].iter().all(|joint| pair.unknown.contains(joint)) {
            return Err(refused("the shared joints are not those that both limbs leave open".to_owned()));
        }
        let sides = pair.sides(&stored.relations);
        let elimination = Elimination::of_two_again(&sides, [second, first], &stored.elimination)?;
        let steps = pair.steps([first, second], stored.relations.clone(), elimination)?;
        let half_angles = stored.half_angles.as_deref().map(HalfAngles::again).transpose()?;
        let templates = stored.templates.iter().map(prove_template).collect::<Result<Vec<_>>>()?;
        let needed: Vec<Form> = Template::needed(&steps);
        if templates.iter().map(|template| template.form).ne(needed) || half_angles.is_some() != is_quartic(&steps) {
            return Err(refused("the templates or half angles are not those of the shared joints' forms".to_owned()));
        }
        pair.assemble(steps, templates, half_angles)
    }

    /// The number of complex values of the two joints together.
    pub fn dimension(&self) -> usize {
        self.steps.iter().map(|step| step.shape.form.degree()).product()
    }
}

fn is_quartic(steps: &[Lifted]) -> bool {
    steps.iter().any(|step| step.shape.form == Form::Quartic)
}

/// Two mechanisms whose first joints are the same motors, which turn.
struct Pair<'a> {
    sides: [Side<'a>; 2],
    mechanisms: [Mechanism; 2],
    shared: usize,
    /// The shared joints that are not given.
    unknown: [usize; 2],
}

impl<'a> Pair<'a> {
    fn new(sides: [Side<'a>; 2], shared: usize) -> Result<Self> {
        let unsupported = |text: &str| Err(Error::new(ErrorKind::Unsupported, text.to_owned()));
        let mechanisms = [Mechanism::new(sides[0].chain)?, Mechanism::new(sides[1].chain)?];
        let [first, second] = mechanisms.each_ref().map(|mechanism| mechanism.joints().get(..shared).unwrap_or_default());
        let alike = first.iter().zip(second).all(|(a, b)| a.is_revolute() && b.is_revolute() && a.square == b.square);
        if first.len() != shared || second.len() != shared || !alike {
            return unsupported("shared joints must stand first in both chains, and turn about axes that are vectors of one length");
        }
        let given = mechanisms[0].given().to_vec();
        if given != mechanisms[1].given() || given.iter().any(|joint| *joint >= shared) {
            return unsupported("the joints that are given must be shared, and given to both limbs");
        }
        let unknown: Vec<usize> = (0..shared).filter(|joint| !given.contains(joint)).collect();
        let [a, b] = unknown[..] else {
            return unsupported("two of the shared joints must be unknown; one more may be given, or one asked for less");
        };
        Ok(Pair { sides, mechanisms, shared, unknown: [a, b] })
    }

    /// The relations of one of the chains that hold no joint but shared ones: the arc between the two things that are measured is
    /// left out where what is measured stays the same on it.
    fn candidates(&self, side: usize) -> Result<Vec<Relation>> {
        let mechanism = &self.mechanisms[side];
        let mut symbolic = Symbolic::new(mechanism)?;
        let mut found = Vec::new();
        for relation in mechanism.relations() {
            let joints: Vec<usize> = relation.right.0.iter().filter_map(|letter| letter.joint()).collect();
            let holds_both = self.unknown.iter().all(|joint| joints.contains(joint));
            if !holds_both || joints.iter().any(|joint| *joint >= self.shared) {
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

    /// The steps for the joints `first` and `second`, proved.
    fn steps(&self, [first, second]: [usize; 2], relations: [Relation; 2], elimination: Elimination) -> Result<[Lifted; 2]> {
        for (mechanism, relation) in self.sides(&relations) {
            if let Some(joint) = relation.joints().into_iter().find(|joint| *joint >= self.shared) {
                return Err(refused(format!("`{relation}` holds joint {}, which is not shared", joint + 1)));
            }
            if relation.left.0.iter().chain(&relation.right.0).all(|letter| *letter != Letter::Target) {
                return Err(refused(format!("`{relation}` does not hold the target")));
            }
            prove(mechanism, relation)?;
        }
        let mechanism = &self.mechanisms[0];
        let [f, g] = relations;
        let way = Way::Eliminated { relations: vec![f.clone(), g.clone()], away: vec![second] };
        let leading = PlanStep { joint: first, way, degree: 4 };
        let following = PlanStep { joint: second, way: Way::Single(f.clone()), degree: 2 };
        Ok([
            Lifted {
                joint: first,
                relations: vec![f.clone(), g],
                shape: eliminated(mechanism, &leading, &elimination)?,
                elimination: Some(elimination),
            },
            Lifted { joint: second, relations: vec![f], shape: shape(mechanism, &following)?, elimination: None },
        ])
    }

    fn assemble(&self, steps: [Lifted; 2], templates: Vec<Template>, half_angles: Option<HalfAngles>) -> Result<Coupled> {
        let unit = self.sides[0].chain.length_unit();
        let [mechanism, partner] = &self.mechanisms;
        let (mut layout, mut other) = (Layout::new(mechanism, unit), Layout::new(partner, unit));
        layout.keep_joints(self.shared);
        other.first = layout.parameters.len();
        other.joints[..self.shared].copy_from_slice(&layout.joints);
        let reach = reach(self.sides[0].chain).max(reach(self.sides[1].chain));
        let mut known = mechanism.given().to_vec();
        let mut blocks: Vec<Block> = known.iter().map(|&joint| given(mechanism, &layout, joint)).collect();
        for (step, partner) in steps.iter().zip([Some((partner, &other)), None]) {
            let context = Context { mechanism, known: &known, step, reach, partner };
            blocks.push(context.block(&mut layout, &templates, half_angles.as_ref())?);
            known.push(step.joint);
        }
        let program = self.program(layout, other, blocks, reach);
        Ok(Coupled { shared: self.shared, steps, templates, half_angles, program })
    }

    /// The program that finds the shared joints. The inputs and parameters of the second chain's target stand last.
    fn program(&self, layout: Layout, other: Layout, blocks: Vec<Block>, scale: f64) -> Program {
        let mut program = Program {
            name: "shared".to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            joints: layout.joints.iter().zip(self.sides[0].chain.joints()).map(joint).collect(),
            inputs: layout.inputs,
            conditions: layout.conditions,
            parameters: layout.parameters,
            unknowns: layout.unknowns,
            blocks,
            checks: Checks { code: Vec::new(), residuals: Vec::new(), scales: Vec::new(), jacobian: Vec::new() },
            preference: None,
            capacity: 1,
            scale,
        }
        .prefixed(self.sides[0].prefix);
        let (first, prefix) = (program.inputs.len(), self.sides[1].prefix);
        let (inputs, parameters) = (
            other.inputs.len() - self.mechanisms[1].given().len(),
            self.mechanisms[1].parameters().len(),
        );
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

fn joint((value, joint): (&crate::solver::JointValue, &crate::kinematics::Joint)) -> Joint {
    Joint { name: joint.name.clone(), unit: Unit::Radian, value: *value }
}

/// The rule with its input `by` places further on.
fn moved(rule: Rule, by: usize) -> Rule {
    match rule {
        Rule::Input(index) => Rule::Input(index + by),
        Rule::Cosine(index) => Rule::Cosine(index + by),
        Rule::Sine(index) => Rule::Sine(index + by),
        root @ Rule::Root { .. } => root,
    }
}
