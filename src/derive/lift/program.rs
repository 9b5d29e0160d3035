//! From a plan's steps to a [`Program`]: a block for each joint, the checks behind them.

use num_traits::{Signed, ToPrimitive};

use super::charts::{Place, Sized, charts, quartic, tell_spread};
use super::checks::checks;
use super::eliminate::{Elimination, SymbolPlace};
use super::emit::{Emitted, Emitter, Sizes};
use super::frame::framed;
use super::half_angle::HalfAngles;
use super::layout::Layout;
use super::ray;
use super::shape::Shape;
use super::slack::Slack;
use super::template::{Form, Template};
use super::{Lifted, Parts};
use crate::derive::assemble::{Assembler, FlatTerm};
use crate::derive::closure::{Factor, Mechanism, Multilinear, Relation, evaluate};
use crate::kinematics::{Chain, LengthUnit};
use crate::number::BigRational;
use crate::solver::{Block, Chart, Checks, Guard, Joint, JointValue, NEAR, Operand, Program, Step, Unit};
use crate::{Error, ErrorKind, Result};

/// A free angle is put at places round the circle, none of them one that a solution is likely to have by itself.
const FIRST_SAMPLE: f64 = 0.4;
/// At so many places: one that is a member of the family is enough.
const SAMPLES: i32 = 8;
/// At so many where the formulas are those of an ideal chain: the chain that is meant has a few answers there instead of a family, and
/// each is looked for from the places next to it.
const MANY_SAMPLES: i32 = 32;

/// Two linear equations are nearly dependent when their determinant is below this share of its size.
const DEPENDENT: f64 = 1e-6;

/// The program of a chain whose plan has been lifted. Its formulas are off by `slack` on the chain that answers are measured on.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for what a program cannot hold.
pub(super) fn compile(chain: &Chain, mechanism: &Mechanism, parts: &Parts, slack: Slack) -> Result<Program> {
    let templates = parts.templates.as_slice();
    let mut layout = Layout::new(mechanism, chain.length_unit());
    let reach = reach(chain);
    let mut known = mechanism.given().to_vec();
    let mut blocks: Vec<Block> = known.iter().map(|&joint| given(mechanism, &layout, joint)).collect();
    blocks.extend(layout.across.map(ray::across));
    let mut spreads = Vec::new();
    for (index, step) in parts.steps.iter().enumerate() {
        let free = free(mechanism, &parts.steps[index..]);
        let context = Context { mechanism, known: &known, step, free, reach, slack, spreads: &spreads, partner: None };
        let mut block = context.block(&mut layout, templates, parts.half_angles.as_ref())?;
        let has_roots = parts.steps[index + 1..].iter().any(|later| later.shape.form.degree() > 1);
        if has_roots && block.charts.iter().any(|chart| !chart.free.is_empty()) {
            let spread = layout.unknown(&format!("f{}", mechanism.joints()[step.joint].symbol));
            tell_spread(&mut block.charts, spread);
            spreads.push(spread);
        }
        blocks.push(block);
        known.push(step.joint);
    }
    let program = Program {
        capacity: (2 * parts.plan.dimension + blocks.len()).min(4096),
        // Where the task asks for more than the joints can do, special targets might have more, and so might a chain that is not ideal.
        isolated: (mechanism.seen().freedoms() <= mechanism.unknown().len() && slack == Slack::NONE)
            .then_some(parts.plan.dimension),
        blocks,
        ..framed(chain, mechanism, layout)
    }
    .pruned();
    program.validate().map_err(|error| Error::new(ErrorKind::Unsupported, error.message().to_owned()))?;
    Ok(program)
}

/// The checks of a program by `chain`, which has the joints and the task of the chain that the program solves.
///
/// # Errors
/// As [`Mechanism::new`].
pub(super) fn checks_on(chain: &Chain) -> Result<Checks> {
    let mechanism = Mechanism::new(chain)?;
    Ok(checks(&mechanism, &Layout::new(&mechanism, chain.length_unit()), reach(chain)).pruned())
}

/// The size of the chain's positions; one when it is a point.
pub(super) fn reach(chain: &Chain) -> f64 {
    let first = chain.joints().first().map_or(0.0, |joint| joint.location().coords.norm());
    let reach = chain.reach() + first;
    if reach > 0.0 { reach } else { 1.0 }
}

pub(super) fn joints(chain: &Chain, layout: &Layout) -> Vec<Joint> {
    let unit = |value: &JointValue| match (value, chain.length_unit()) {
        (JointValue::Angle { .. }, _) => Unit::Radian,
        (JointValue::Plain(_), LengthUnit::Metre) => Unit::Metre,
        (JointValue::Plain(_), LengthUnit::Millimetre) => Unit::Millimetre,
    };
    let joint = |(joint, value): (&crate::kinematics::Joint, &JointValue)| Joint {
        name: joint.name.clone(),
        unit: unit(value),
        value: *value,
    };
    chain.joints().iter().zip(&layout.joints).map(joint).collect()
}

fn template(templates: &[Template], form: Form) -> Result<&Template> {
    let missing = || Error::new(ErrorKind::Certificate, format!("the template `{}` is missing", form.name()));
    templates.iter().find(|template| template.form == form).ok_or_else(missing)
}

/// The joint that moves freely where the first of these steps leaves its joint free: that joint itself, and for the hidden one, which is no
/// joint of an answer, the first that follows from it.
fn free(mechanism: &Mechanism, steps: &[Lifted]) -> usize {
    let own = steps.iter().map(|step| step.joint).find(|joint| mechanism.hidden() != Some(*joint));
    own.unwrap_or(0)
}

/// The block that puts a given joint where the user says.
pub(super) fn given(mechanism: &Mechanism, layout: &Layout, joint: usize) -> Block {
    let unknowns = match layout.joints[joint] {
        JointValue::Angle { cosine, sine } => vec![cosine, sine],
        JointValue::Plain(unknown) => vec![unknown],
    };
    let values = layout.given[joint].iter().map(|&parameter| Operand::Parameter(parameter));
    let steps = unknowns.into_iter().zip(values).map(|(unknown, value)| Step::Set { unknown, value }).collect();
    let label = mechanism.joints()[joint].name.as_str();
    let chart = Chart {
        label: "given".to_owned(),
        guard_code: Vec::new(),
        guards: Vec::new(),
        pivot: None,
        steps,
        free: Vec::new(),
        open: false,
        first_branch: 0,
    };
    Block::numbered(label, Vec::new(), vec![chart])
}

/// The symbols of a step's form, and what computes them.
struct Symbols {
    list: Vec<Sized>,
    /// How many instructions compute their values.
    work: usize,
    assembler: Assembler,
}

impl Symbols {
    /// Whether the same values are numbers, which no code computes.
    fn has_numbers_of(&self, other: &Symbols) -> bool {
        let is_number = |symbol: &Sized| matches!(symbol.value, Operand::Constant(_));
        self.list.iter().map(is_number).eq(other.list.iter().map(is_number))
    }
}

/// A step and what is known when it runs.
pub(super) struct Context<'a> {
    pub mechanism: &'a Mechanism,
    pub known: &'a [usize],
    pub step: &'a Lifted,
    /// The joint that is told as free where the step's is.
    pub free: usize,
    pub reach: f64,
    pub slack: Slack,
    /// The unknowns that tell whether joints are free.
    pub spreads: &'a [usize],
    /// The mechanism that all relations but the first belong to, where it is another, and where its target stands.
    pub partner: Option<(&'a Mechanism, &'a Layout)>,
}

impl Context<'_> {
    /// The block of the step.
    pub fn block(
        &self,
        layout: &mut Layout,
        templates: &[Template],
        half_angles: Option<&HalfAngles>,
    ) -> Result<Block> {
        let joint = self.step.joint;
        let screw = &self.mechanism.joints()[joint];
        let auxiliary = match self.step.shape.form {
            Form::Angle | Form::Quadratic | Form::Pair | Form::Quartic => {
                Some(layout.unknown(&format!("w{}", screw.symbol)))
            }
            Form::Turn | Form::Linear | Form::Lengths => None,
        };
        let Symbols { list: symbols, mut assembler, .. } = self.shortest(layout)?;
        let code = assembler.take();
        let place = |symbols: Vec<Sized>| Place {
            free: self.free,
            value: layout.joints[joint],
            auxiliary,
            symbols,
            samples: self.samples(layout.joints[joint]),
            slack: self.slack,
            spreads: self.spreads.to_vec(),
        };
        match (self.step.shape.form, half_angles) {
            (Form::Pair, _) => {}
            (Form::Quartic, Some(half_angles)) => {
                let list = quartic(half_angles, &place(symbols), &assembler)?;
                return Ok(Block::numbered(&screw.name, code, list));
            }
            (form, _) => {
                let list = charts(template(templates, form)?, &place(symbols), &assembler, &[])?;
                return Ok(Block::numbered(&screw.name, code, list));
            }
        }
        let (both, single) = (template(templates, Form::Pair)?, template(templates, Form::Angle)?);
        let [a, b, e, f, x, y] = symbols[..] else {
            return Err(Error::new(ErrorKind::Unsupported, "a pair has six symbols"));
        };
        let singles = [vec![a, b, x.negated(&mut assembler)], vec![e, f, y.negated(&mut assembler)]];
        let guard = dependent([a, b, e, f], self.slack, &mut assembler);
        let code = [code, assembler.take()].concat();
        let mut list = charts(both, &place(symbols), &assembler, &[])?;
        for symbols in singles {
            list.extend(charts(single, &place(symbols), &assembler, std::slice::from_ref(&guard))?);
        }
        Ok(Block::numbered(&screw.name, code, list))
    }

    fn samples(&self, value: JointValue) -> Vec<f64> {
        match value {
            JointValue::Angle { .. } => {
                let count = if self.slack == Slack::NONE { SAMPLES } else { MANY_SAMPLES };
                let step = std::f64::consts::TAU / f64::from(count);
                (0..count).map(|k| FIRST_SAMPLE + f64::from(k - count / 2) * step).collect()
            }
            JointValue::Plain(_) => (0..5).map(|k| self.reach * (f64::from(k - 2) / 2.0 + 0.1)).collect(),
        }
    }

    /// The step's relations with the mechanisms that they belong to.
    fn sides<'b>(&'b self, layout: &'b Layout) -> Vec<(&'b Mechanism, &'b Layout, &'b [Relation])> {
        let relations = self.step.relations.as_slice();
        match self.partner {
            None => vec![(self.mechanism, layout, relations)],
            Some((mechanism, other)) => {
                let (own, others) = relations.split_at(relations.len().min(1));
                vec![(self.mechanism, layout, own), (mechanism, other, others)]
            }
        }
    }

    /// The symbols of the step's form, by sums of the length that leaves the least code. Other lengths than the usual must save an eighth,
    /// and must not make code of what cancels.
    fn shortest(&self, layout: &Layout) -> Result<Symbols> {
        let [usual, others @ ..] = Assembler::sums();
        let mut best = self.symbols(layout, Assembler::with_sums_of(usual))?;
        let allowed = best.work - best.work / 8;
        for longest in others {
            let other = self.symbols(layout, Assembler::with_sums_of(longest))?;
            if other.work < best.work.min(allowed) && other.has_numbers_of(&best) {
                best = other;
            }
        }
        Ok(best)
    }

    /// The symbols of the step's form. Their sizes matter only where a guard asks for them.
    fn symbols(&self, layout: &Layout, mut assembler: Assembler) -> Result<Symbols> {
        let assembler = &mut assembler;
        let mut equations = Vec::new();
        for (mechanism, layout, relations) in self.sides(layout) {
            let assignment = layout.assignment(mechanism, self.known, assembler)?;
            for relation in relations {
                equations.push(evaluate(mechanism, relation, &assignment, &mut Emitter(assembler))?);
            }
        }
        let values = self.combine(&equations, None, assembler);
        let work = assembler.count();
        let is_sized =
            matches!(self.step.shape.form, Form::Pair | Form::Quartic) || !values.first().is_some_and(is_number);
        let sizes = match is_sized {
            true => self.sizes(&equations, layout, assembler)?,
            false => {
                vec![
                    Operand::Constant(values.iter().filter_map(number).fold(1.0, |largest, x| largest.max(x.abs())));
                    values.len()
                ]
            }
        };
        let list = values.into_iter().zip(sizes).map(|(value, size)| Sized { value, size }).collect();
        Ok(Symbols { list, work, assembler: std::mem::take(assembler) })
    }

    fn sizes(
        &self,
        values: &[Multilinear<Emitted>],
        layout: &Layout,
        assembler: &mut Assembler,
    ) -> Result<Vec<Operand>> {
        let mut equations = Vec::new();
        for (mechanism, layout, relations) in self.sides(layout) {
            let assignment = layout.sizes(mechanism, self.known, assembler)?;
            for relation in relations {
                equations.push(evaluate(mechanism, relation, &assignment, &mut Sizes(assembler))?);
            }
        }
        let sizes = self.combine(&equations, Some(values), assembler);
        Ok(sizes.into_iter().map(|size| assembler.abs(size)).collect())
    }

    /// The symbols from the equations' coefficients. With the true sine `s = sqrt(n) s'`. Where `equations` are sizes, `values` are
    /// what they are the sizes of.
    fn combine(
        &self,
        equations: &[Multilinear<Emitted>],
        values: Option<&[Multilinear<Emitted>]>,
        assembler: &mut Assembler,
    ) -> Vec<Operand> {
        let joint = self.step.joint;
        let square = self.mechanism.joints()[joint].square.to_f64().unwrap_or(1.0);
        let root = square.sqrt();
        if let Some(elimination) = &self.step.elimination {
            return self.left(elimination, equations, values, root, assembler);
        }
        let mut take = |equation: usize, factors: &[Factor], factor: f64| match equations[equation].coefficient(factors)
        {
            None => Operand::Constant(0.0),
            Some(value) => value.times(factor).operand(assembler),
        };
        let (c, s, d, dd) =
            ([Factor::Cosine(joint)], [Factor::Sine(joint)], [Factor::Length(joint)], [Factor::LengthSquared(joint)]);
        match self.step.shape {
            Shape { form: Form::Angle, .. } => vec![take(0, &c, 1.0), take(0, &s, 1.0 / root), take(0, &[], 1.0)],
            Shape { form: Form::Turn, ref ratio } => {
                let ratio = ratio.as_ref().and_then(BigRational::to_f64).unwrap_or(1.0);
                vec![take(0, &c, 1.0), take(0, &s, -1.0 / root), take(0, &[], -1.0), take(1, &[], -root / ratio)]
            }
            Shape { form: Form::Pair, .. } => vec![
                take(0, &c, 1.0),
                take(0, &s, 1.0 / root),
                take(1, &c, 1.0),
                take(1, &s, 1.0 / root),
                take(0, &[], -1.0),
                take(1, &[], -1.0),
            ],
            Shape { form: Form::Linear, .. } => vec![take(0, &d, 1.0 / root), take(0, &[], 1.0)],
            Shape { form: Form::Quartic | Form::Lengths, .. } => Vec::new(),
            Shape { form: Form::Quadratic, .. } => {
                vec![take(0, &dd, 1.0 / square), take(0, &d, 0.5 / root), take(0, &[], 1.0)]
            }
        }
    }
}

impl Context<'_> {
    /// The symbols from what an elimination leaves.
    fn left(
        &self,
        elimination: &Elimination,
        equations: &[Multilinear<Emitted>],
        values: Option<&[Multilinear<Emitted>]>,
        root: f64,
        assembler: &mut Assembler,
    ) -> Vec<Operand> {
        let list = |equations: &[Multilinear<Emitted>], assembler: &mut Assembler| -> Vec<Operand> {
            let coefficient = |place: &SymbolPlace| equations[place.relation].coefficient(&place.factors);
            let mut value = |place| coefficient(place).map_or(Operand::Constant(0.0), |value| value.operand(assembler));
            elimination.symbols.iter().map(&mut value).collect()
        };
        let mut symbols = list(equations, assembler);
        if let Some(values) = values {
            let values = list(values, assembler);
            symbols = values.into_iter().map(|value| assembler.abs(value)).chain(symbols).collect();
        }
        let parts = elimination.coefficients();
        let mut take = |exponents: &[u32], factor: f64| {
            let Some(terms) = parts.get(exponents) else { return Operand::Constant(0.0) };
            let flat = |(q, powers): &(BigRational, Vec<u32>)| match values {
                Some(_) => derivatives(q, powers),
                None => vec![FlatTerm::new(q.clone(), powers)],
            };
            let terms: Vec<FlatTerm> = terms.iter().flat_map(flat).collect();
            let sum = assembler.horner(&terms, &symbols);
            assembler.mul(Operand::Constant(factor), sum)
        };
        let sine = 1.0 / root;
        match self.step.shape.form {
            Form::Angle => vec![take(&[1, 0], 1.0), take(&[0, 1], sine), take(&[0, 0], 1.0)],
            Form::Linear => vec![take(&[1], sine), take(&[0], 1.0)],
            Form::Lengths => (0..5).rev().map(|k: i32| take(&[k as u32], sine.powi(k))).collect(),
            Form::Quadratic => vec![take(&[2], sine * sine), take(&[1], 0.5 * sine), take(&[0], 1.0)],
            _ => vec![
                take(&[1, 1], sine),
                take(&[0, 2], sine * sine),
                take(&[1, 0], 1.0),
                take(&[0, 1], sine),
                take(&[0, 0], 1.0),
            ],
        }
    }
}

/// The size of a term `q S^powers`, in the magnitudes of the symbols and, behind them, their sizes: where each symbol is off by a share
/// of its size, the term is off by that share of this. It is no less than the term itself, and far less than the product of sizes
/// where symbols are small.
fn derivatives(q: &BigRational, powers: &[u32]) -> Vec<FlatTerm> {
    if powers.iter().all(|&power| power == 0) {
        return vec![FlatTerm::new(q.abs(), powers)];
    }
    let held = (0..powers.len()).filter(|&symbol| powers[symbol] > 0);
    let by = |symbol: usize| {
        let mut exponents = powers.to_vec();
        exponents.resize(2 * powers.len(), 0);
        exponents[symbol] -= 1;
        exponents[powers.len() + symbol] = 1;
        FlatTerm::new(q.abs() * BigRational::from_integer(powers[symbol].into()), &exponents)
    };
    held.map(by).collect()
}

/// The guard that two linear equations are nearly dependent, so that each is solved alone as well: answers are measured in the end.
fn dependent([a, b, e, f]: [Sized; 4], slack: Slack, assembler: &mut Assembler) -> Guard {
    let mut determinant = |part: fn(&Sized) -> Operand, sum: bool| {
        let (left, right) = (assembler.mul(part(&a), part(&f)), assembler.mul(part(&b), part(&e)));
        if sum { assembler.add(left, right) } else { assembler.sub(left, right) }
    };
    let (value, size) = (determinant(|s| s.value, false), determinant(|s| s.size, true));
    let scale = assembler.mul(Operand::Constant(slack.share(DEPENDENT) / NEAR), size);
    Guard { text: "A*F - B*E".to_owned(), value, scale, near: true }
}

/// The value of a number.
fn number(value: &Operand) -> Option<f64> {
    match value {
        Operand::Constant(value) => Some(*value),
        _ => None,
    }
}

/// Whether it is a number other than zero.
fn is_number(value: &Operand) -> bool {
    matches!(value, Operand::Constant(value) if *value != 0.0)
}
