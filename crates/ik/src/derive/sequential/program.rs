//! A [`Program`] from a plan's steps: a block for each joint, then the checks.

use super::cases::{Place, SizedValue, cases, quartic, set_spread};
use super::checks::{checks, polishing};
use super::context::Context;
use super::form_basis::Form;
use super::forms::Forms;
use super::frame::{framed, given, reach};
use super::layout::Layout;
use super::ray;
use super::samples::Samples;
use super::slack::Slack;
use super::symbols::Symbols;
use super::{ProvedStep, Sequential, upright_loop};
use crate::derive::closure::Mechanism;
use crate::derive::equations::assemble::Assembler;
use crate::derive::problem::ChainProblem;
use crate::solver::{Block, Checks, Described, Guard, Operand, Program};
use crate::{Error, ErrorKind, Result};
use groebot_robot::kinematics::ideal::Report;
use groebot_robot::kinematics::{Chain, Task};
use groebot_runtime::tolerances::{PIVOTS, STRATA};

/// The program of a chain whose plan has been derived. `slack` bounds the error of its formulas on the chain on which solutions are measured.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a problem that a program cannot represent.
pub(super) fn compile(chain: &Chain, mechanism: &Mechanism, parts: &Sequential, slack: Slack) -> Result<Program> {
    let mut layout = Layout::new(mechanism, chain.length_unit());
    let reach = reach(chain);
    let mut known = mechanism.given().to_vec();
    let mut blocks: Vec<Block> = known.iter().map(|&joint| given(mechanism, &layout, joint)).collect();
    blocks.extend(layout.across.map(ray::across));
    let (samples, mut spreads) = (Samples::of(&parts.steps, slack), Vec::new());
    for (index, step) in parts.steps.iter().enumerate() {
        let free = free(mechanism, &parts.steps[index..]);
        let context =
            Context { mechanism, known: &known, step, free, reach, slack, samples, spreads: &spreads, partner: None };
        let mut block = context.block(&mut layout, &parts.forms)?;
        let has_roots = parts.steps[index + 1..].iter().any(|later| later.shape.form.degree() > 1);
        if has_roots && block.cases.iter().any(|case| !case.free.is_empty()) {
            let spread = layout.unknown(&format!("f{}", mechanism.joints()[step.joint].symbol));
            set_spread(&mut block.cases, spread);
            spreads.push(spread);
        }
        blocks.push(block);
        known.push(step.joint);
    }
    if let Some(upright_loop) = mechanism.upright_loop() {
        upright_loop::close(upright_loop, &mut layout, &mut blocks, reach);
    }
    let (dimension, product) = (parts.plan.dimension, parts.plan.product());
    let most = if mechanism.followers().is_empty() { dimension } else { dimension.max(product) };
    let program = Program {
        capacity: (2 * most + blocks.len()).min(4096),
        // Special targets may have more solutions if the task is overdetermined (more numbers than independent joints). So may a chain that is not ideal.
        isolated: (mechanism.is_tight() && slack == Slack::NONE).then_some(parts.plan.dimension),
        blocks,
        ..framed(chain, mechanism, layout)
    }
    .pruned();
    program.validate().map_err(|error| Error::new(ErrorKind::Unsupported, error.message().to_owned()))?;
    Ok(program)
}

/// The program of `problem`, whose mechanism is `mechanism`.
///
/// # Errors
/// As [`compile`] and [`Mechanism::of_chain`].
pub(super) fn of_problem(problem: &ChainProblem, mechanism: &Mechanism, method: &Sequential) -> Result<Program> {
    let Some((truth, report)) = &problem.truth else {
        return compile(&problem.chain, mechanism, method, Slack::NONE);
    };
    let mut program = compile(&problem.chain, mechanism, method, Slack::within(report.deviation()))?;
    match described_by(mechanism, truth, report, &program)? {
        None => {
            program.checks = checks_on(&problem.chain, truth)?;
            program.nearby = true;
        }
        described => program.described = described,
    }
    Ok(program)
}

/// The checks for a program of `ideal` whose solutions are polished on `chain`. Both chains have the same joints and task.
///
/// # Errors
/// As [`Mechanism::new`].
pub(in crate::derive) fn checks_on(ideal: &Chain, chain: &Chain) -> Result<Checks> {
    let mechanism = Mechanism::new(ideal)?;
    let mut layout = Layout::new(&mechanism, chain.length_unit());
    if let Some(upright_loop) = mechanism.upright_loop() {
        upright_loop::close(upright_loop, &mut layout, &mut Vec::new(), reach(chain));
    }
    Ok(polishing(&Mechanism::of_chain(chain)?, &layout, reach(chain)))
}

/// The equations of the chain `truth` as described, if the task is overdetermined (more numbers than independent joints). Then the described chain may have no
/// solution where the ideal one has several, or only the one from which the target was made. `None` if polishing handles the difference.
///
/// # Errors
/// As [`Mechanism::of_chain`].
fn described_by(mechanism: &Mechanism, truth: &Chain, report: &Report, program: &Program) -> Result<Option<Described>> {
    let layout = Layout::new(mechanism, truth.length_unit());
    if !is_overdetermined(mechanism) || mechanism.upright_loop().is_some() {
        return Ok(None);
    }
    let Checks { code, residuals, .. } = Checks {
        scales: Vec::new(),
        jacobian: Vec::new(),
        ..checks(&Mechanism::of_chain(truth)?, &layout, reach(truth))
    }
    .pruned();
    let described = Described { code, residuals, within: 2.0 * report.bound() };
    let fits = described.is_affine(program) && program.forward().is_some_and(|forward| !forward.inputs.is_empty());
    Ok(fits.then_some(described))
}

/// Whether the equations have conditions that no joint can influence. A planar pose requires that the chain stays in its plane, an angle about an axis that the
/// tip does not tilt.
fn is_overdetermined(mechanism: &Mechanism) -> bool {
    let freedoms = mechanism.seen().freedoms();
    matches!(mechanism.task(), Task::PlanarPose { .. } | Task::PositionYaw { .. })
        || freedoms > mechanism.unknown().len()
}

/// The joint that is reported as free where the first of these steps leaves its joint free.
///
/// It is that joint itself, or its leader if it has one. The hidden joint belongs to no solution; the first joint that follows from it replaces it.
fn free(mechanism: &Mechanism, steps: &[ProvedStep]) -> usize {
    let own = steps.iter().map(|step| step.joint).find(|joint| mechanism.hidden() != Some(*joint));
    let leading = |joint: usize| mechanism.joints()[joint].coupling.as_ref().map_or(joint, |coupling| coupling.leader);
    own.map_or(0, leading)
}

impl Context<'_> {
    /// The block of the step.
    pub fn block(&self, layout: &mut Layout, forms: &Forms) -> Result<Block> {
        let joint = self.step.joint;
        let screw = &self.mechanism.joints()[joint];
        let auxiliary = match self.step.shape.form {
            Form::Angle | Form::Quadratic | Form::Pair | Form::Quartic => {
                Some(layout.unknown(&format!("w{}", screw.symbol)))
            }
            Form::Rotation | Form::Linear | Form::Lengths => None,
        };
        let Symbols { list: symbols, mut assembler, .. } = self.shortest(layout)?;
        let code = assembler.take();
        let place = |symbols: Vec<SizedValue>| Place {
            free: self.free,
            value: layout.joints[joint],
            auxiliary,
            symbols,
            samples: self.samples.places(layout.joints[joint], self.reach, screw.travel),
            slack: self.slack,
            spreads: self.spreads.to_vec(),
        };
        match (self.step.shape.form, &forms.half_angles) {
            (Form::Pair, _) => {}
            (Form::Quartic, Some(half_angles)) => {
                let list = quartic(half_angles, &place(symbols), &assembler)?;
                return Ok(Block::numbered(&screw.name, code, list));
            }
            (form, _) => {
                let list = cases(forms.basis(form)?, &place(symbols), &assembler, &[])?;
                return Ok(Block::numbered(&screw.name, code, list));
            }
        }
        let (both, single) = (forms.basis(Form::Pair)?, forms.basis(Form::Angle)?);
        let [a, b, e, f, x, y] = symbols[..] else {
            return Err(Error::new(ErrorKind::Unsupported, "a pair has six symbols"));
        };
        let singles = [vec![a, b, x.negated(&mut assembler)], vec![e, f, y.negated(&mut assembler)]];
        let guard = dependent([a, b, e, f], self.slack, &mut assembler);
        let code = [code, assembler.take()].concat();
        let mut list = cases(both, &place(symbols), &assembler, &[])?;
        for symbols in singles {
            list.extend(cases(single, &place(symbols), &assembler, std::slice::from_ref(&guard))?);
        }
        Ok(Block::numbered(&screw.name, code, list))
    }
}

/// The guard for two nearly dependent linear equations. Each is then also solved alone; the final measurement removes wrong solutions.
fn dependent([a, b, e, f]: [SizedValue; 4], slack: Slack, assembler: &mut Assembler) -> Guard {
    let mut determinant = |part: fn(&SizedValue) -> Operand, sum: bool| {
        let (left, right) = (assembler.mul(part(&a), part(&f)), assembler.mul(part(&b), part(&e)));
        if sum { assembler.add(left, right) } else { assembler.sub(left, right) }
    };
    let (value, size) = (determinant(|s| s.value, false), determinant(|s| s.size, true));
    let scale = assembler.mul(Operand::Constant(slack.share(PIVOTS.regular) / STRATA.near), size);
    Guard { text: "A*F - B*E".to_owned(), value, scale, near: true }
}
