//! The [`Program`] of a tree of strata: one case for each stratum with its own formulas.

use num_traits::{Signed, ToPrimitive, Zero};

use crate::derive::equations::assemble::{Assembler, FlatTerm};
use crate::derive::equations::setting::{ParameterPoly, Poly, Setting, Unknowns};
use crate::derive::equations::strata::{self, ZeroSet};
use crate::derive::equations::tree::{Node, Outcome, Solved, collect_denominators};
use crate::derive::equations::triangular::{Stair, clear_denominators};
use crate::derive::{JointKindUnknown, ParameterSource, Quantity, Root, System};
use crate::solver::{
    Block, Case, Checks, Guard, Input, Joint, JointValue, Operand, ParameterRule, Preference, Program, Rule, Step,
    TipTask, Unit,
};
use crate::tolerances::DERIVED_STRATA;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::{BigRational, Ring, Style};
use groebot_algebra::poly::{Expression, Order};

/// Compiles the solver of `system` from its proved tree.
///
/// # Errors
/// [`ErrorKind::Unsupported`] if the system has more joints or higher degrees than a program may have.
pub fn compile(system: &System, tree: &Node) -> Result<Program> {
    let compiler = Compiler { system };
    let mut cases = Vec::new();
    compiler.cases(tree, &mut Vec::new(), &mut cases)?;
    let block = Block::numbered(&system.name, Vec::new(), cases);
    let capacity = block.cases.iter().map(Program::branches).sum();
    // The case of a stratum gives all solutions there, and a target is on only one stratum.
    let most = block.cases.iter().map(Program::branches).max().filter(|most| *most > 0);
    let isolated = most.filter(|_| !block.cases.iter().any(|case| case.open));
    let (checks, scale) = compiler.checks()?;
    let tip = system.task.map(|task| TipTask { chain: None, task, direction: None, first_input: 0 });
    let program = Program {
        name: system.name.clone(),
        tasks: tip.into_iter().collect(),
        inputs: system
            .inputs
            .iter()
            .map(|i| Input { name: i.name.clone(), unit: Unit::of(i.quantity, system.length_unit) })
            .collect(),
        parameters: compiler.parameters()?,
        unknowns: system.order.clone(),
        joints: system.joints.iter().map(|joint| compiler.joint(joint)).collect::<Result<_>>()?,
        scale,
        blocks: vec![block],
        checks,
        preference: compiler.preference()?,
        capacity,
        isolated,
        ..Program::default()
    }
    .pruned();
    program.validate().map_err(|error| Error::new(ErrorKind::Unsupported, error.message().to_owned()))?;
    Ok(program)
}

/// A factor of a stratum, and the setting whose parameters it contains.
type Condition<'a> = (&'a Setting, &'a Expression);

struct Compiler<'a> {
    system: &'a System,
}

impl<'a> Compiler<'a> {
    fn unknown(&self, name: &str) -> Result<usize> {
        let missing = || Error::new(ErrorKind::UnknownName, format!("no unknown `{name}`"));
        self.system.order.iter().position(|unknown| unknown == name).ok_or_else(missing)
    }

    fn joint(&self, joint: &crate::derive::JointUnknown) -> Result<Joint> {
        let (value, unit) = match &joint.kind {
            JointKindUnknown::Angle { cosine, sine } => {
                (JointValue::Angle { cosine: self.unknown(cosine)?, sine: self.unknown(sine)? }, Unit::Radian)
            }
            JointKindUnknown::Value { unknown } => {
                (JointValue::Plain(self.unknown(unknown)?), Unit::of(Quantity::Length, self.system.length_unit))
            }
        };
        Ok(Joint { name: joint.name.clone(), unit, value })
    }

    fn preference(&self) -> Result<Option<Preference>> {
        let Some(choice) = &self.system.choice else { return Ok(None) };
        Ok(Some(Preference { unknown: self.unknown(&choice.unknown)?, greatest: choice.root == Root::Plus }))
    }

    fn parameters(&self) -> Result<Vec<ParameterRule>> {
        let names: Vec<&str> = self.system.parameters.iter().map(|p| p.name.as_str()).collect();
        let rule = |parameter: &crate::derive::Parameter| match (parameter.source, &parameter.square) {
            (ParameterSource::Input(index), _) => Ok(Rule::Input(index)),
            (ParameterSource::Cosine(index), _) => Ok(Rule::Cosine(index)),
            (ParameterSource::Sine(index), _) => Ok(Rule::Sine(index)),
            (ParameterSource::SquareRoot, Some(square)) => {
                let mut assembler = Assembler::default();
                let value = |name: &str| names.iter().position(|n| *n == name).map(Operand::Parameter);
                let value = assembler.expression(square, &value).ok_or_else(|| undefined(&parameter.name))?;
                Ok(Rule::Root { code: assembler.take(), value })
            }
            (ParameterSource::SquareRoot, None) => Err(undefined(&parameter.name)),
        };
        let build = |p: &crate::derive::Parameter| Ok(ParameterRule { name: p.name.clone(), rule: rule(p)? });
        self.system.parameters.iter().map(build).collect()
    }

    /// The cases of `node` and of all strata below it.
    fn cases(&self, node: &'a Node, path: &mut Vec<Condition<'a>>, cases: &mut Vec<Case>) -> Result<()> {
        match &node.outcome {
            Outcome::Solved(solved) if !solved.inherited => {
                cases.push(self.case(node, &node.setting, solved, &[], path)?);
            }
            Outcome::SelfMotion(self_motion) => match &self_motion.member.outcome {
                Outcome::Solved(solved) => {
                    cases.push(self.case(node, &self_motion.member.setting, solved, &self_motion.free, path)?);
                }
                _ => cases.push(self.open_case(node, path)?),
            },
            Outcome::Open(_) => cases.push(self.open_case(node, path)?),
            Outcome::Solved(_) | Outcome::Inconsistent(_) | Outcome::Seen(_) => {}
        }
        for child in &node.children {
            let factor = child.factors.last().ok_or_else(|| undefined(&child.label))?;
            path.push((&node.setting, factor));
            self.cases(child, path, cases)?;
            path.pop();
        }
        Ok(())
    }

    fn open_case(&self, node: &Node, path: &[Condition<'_>]) -> Result<Case> {
        let mut assembler = Assembler::default();
        let guards = self.near_guards(path, &mut assembler)?;
        let guard_code = assembler.take();
        Ok(Case { label: node.label.clone(), guard_code, guards, open: true, ..Case::default() })
    }

    fn case(
        &self,
        node: &Node,
        setting: &Setting,
        solved: &Solved,
        free: &[usize],
        path: &[Condition<'_>],
    ) -> Result<Case> {
        let mut assembler = Assembler::default();
        let mut guards = self.near_guards(path, &mut assembler)?;
        let ground = setting.field()?.ring().clone();
        let mut denominators = Vec::new();
        collect_denominators(&ground, solved.certified.basis.iter(), &mut denominators);
        for factor in strata::factors(&ground, &denominators)? {
            if !matches!(strata::zero_set(setting, &factor)?, ZeroSet::Empty(_)) {
                guards.push(self.guard(setting, &factor, false, &mut assembler)?);
            }
        }
        let guard_code = assembler.take();
        let mut steps = Vec::new();
        for stair in &solved.triangular.stairs {
            self.stair(setting, &solved.triangular.ring, stair, &mut assembler, &mut steps)?;
        }
        Ok(Case { label: node.label.clone(), guard_code, guards, steps, free: free.to_vec(), ..Case::default() })
    }

    fn near_guards(&self, path: &[Condition<'_>], assembler: &mut Assembler) -> Result<Vec<Guard>> {
        let guard = |(setting, factor): &Condition<'_>| {
            let polynomial = factor.evaluate(setting.field()?.ring())?;
            self.guard(setting, &polynomial, true, assembler)
        };
        path.iter().map(guard).collect()
    }

    /// A guard on a polynomial of the parameters. Its size is the sum of its coefficients' magnitudes times powers of the length scale.
    fn guard(&self, setting: &Setting, factor: &ParameterPoly, near: bool, assembler: &mut Assembler) -> Result<Guard> {
        let field = setting.field()?;
        let ground = field.ring();
        let symbols = self.symbols(setting, assembler)?;
        let value = assembler.horner(&FlatTerm::all(ground, factor), &symbols);
        let sizes: Vec<FlatTerm> = factor
            .terms()
            .iter()
            .map(|t| FlatTerm::new(t.coefficient.abs(), &[ground.layout().degree(&t.monomial)]))
            .collect();
        let scale = assembler.horner(&sizes, &[Operand::Magnitude]);
        Ok(Guard { text: ground.format(factor, Style::Text), value, scale, near })
    }

    /// The operands of a setting's parameters. A parameter that a stratum introduced is computed from the parameter that it replaces.
    fn symbols(&self, setting: &Setting, assembler: &mut Assembler) -> Result<Vec<Operand>> {
        let direct = |name: &str| self.system.parameters.iter().position(|p| p.name == name).map(Operand::Parameter);
        let mut symbols = Vec::new();
        for symbol in &setting.symbols {
            let operand = match direct(&symbol.name) {
                Some(operand) => operand,
                None => {
                    let made = setting.substitutions.iter().find(|s| s.value.names().contains(&symbol.name.as_str()));
                    let made = made.ok_or_else(|| undefined(&symbol.name))?;
                    let old = direct(&made.name).ok_or_else(|| undefined(&made.name))?;
                    let zero = |name: &str| (name == symbol.name).then_some(Operand::Constant(0.0));
                    let rest = assembler.expression(&made.value, &|name| zero(name).or_else(|| direct(name)));
                    assembler.sub(old, rest.ok_or_else(|| undefined(&symbol.name))?)
                }
            };
            symbols.push(operand);
        }
        Ok(symbols)
    }

    /// Solves one unknown: as a value if its polynomial is linear with a leading coefficient free of unknowns, otherwise as roots.
    fn stair(
        &self,
        setting: &Setting,
        ring: &Unknowns,
        stair: &Stair,
        assembler: &mut Assembler,
        steps: &mut Vec<Step>,
    ) -> Result<()> {
        let unknown = self.unknown(&ring.variables()[stair.unknown])?;
        let symbols = self.all_symbols(setting, ring, assembler)?;
        let parts: Vec<Vec<Poly>> = stair.polynomials.iter().map(|f| ring.coefficients_in(f, stair.unknown)).collect();
        if let [linear] = parts.as_slice()
            && let [low, high] = linear.as_slice()
            && ring.as_constant(high).is_some()
        {
            let top = assembler.horner(&flatten(ring, &ring.neg(low)), &symbols);
            let bottom = assembler.horner(&flatten(ring, high), &symbols);
            let value = assembler.div(top, bottom);
            push_code(steps, assembler);
            steps.push(Step::Set { unknown, value });
            return Ok(());
        }
        let polynomials = parts
            .iter()
            .map(|coefficients| coefficients.iter().map(|c| assembler.horner(&flatten(ring, c), &symbols)).collect())
            .collect();
        push_code(steps, assembler);
        steps.push(Step::Roots { unknown, polynomials, typical: None, half_angle: false });
        Ok(())
    }

    /// Operands of the parameters, then of the ring's unknowns.
    fn all_symbols(&self, setting: &Setting, ring: &Unknowns, assembler: &mut Assembler) -> Result<Vec<Operand>> {
        let mut symbols = self.symbols(setting, assembler)?;
        for name in ring.variables() {
            symbols.push(Operand::Unknown(self.unknown(name)?));
        }
        Ok(symbols)
    }

    /// The equations without the circle relations, and the program's own length scale.
    fn checks(&self) -> Result<(Checks, f64)> {
        let setting = Setting::new(self.system);
        let ring = setting.ring(&self.system.order, Order::Lex)?;
        let mut assembler = Assembler::default();
        let symbols = self.all_symbols(&setting, &ring, &mut assembler)?;
        let mut checks = Checks::default();
        let mut scale = BigRational::zero();
        for f in setting.generators(&ring)? {
            if self.is_circle(&ring, &f) {
                continue;
            }
            let (f, denominator) = clear_denominators(&ring, &f);
            let bottom = assembler.horner(&flatten(&ring, &ring.constant(ring.field().embed(&denominator))), &symbols);
            let value = |f: &Poly, assembler: &mut Assembler| {
                let top = assembler.horner(&flatten(&ring, f), &symbols);
                assembler.div(top, bottom)
            };
            let residual = value(&f, &mut assembler);
            let row = self.derivatives(&ring, &f)?;
            let row = row.iter().map(|derivative| value(derivative, &mut assembler)).collect();
            let size = self.size(&ring, &f, &symbols, &mut assembler);
            let bottom = assembler.abs(bottom);
            checks.scales.push(assembler.div(size, bottom));
            checks.residuals.push(residual);
            checks.jacobian.push(row);
            scale = scale.max(numbers(&ring, &f));
        }
        checks.code = assembler.take();
        Ok((checks, scale.to_f64().unwrap_or(0.0).max(DERIVED_STRATA.least_scale)))
    }

    fn is_circle(&self, ring: &Unknowns, f: &Poly) -> bool {
        self.system.joints.iter().any(|joint| match &joint.kind {
            JointKindUnknown::Angle { cosine, sine } => {
                let square = |name: &str| ring.generator(name).map(|x| ring.mul(&x, &x));
                square(cosine).zip(square(sine)).is_some_and(|(c, s)| ring.sub(&ring.add(&c, &s), &ring.one()) == *f)
            }
            JointKindUnknown::Value { .. } => false,
        })
    }

    /// The derivative by each joint: for an angle `c df/ds - s df/dc`.
    fn derivatives(&self, ring: &Unknowns, f: &Poly) -> Result<Vec<Poly>> {
        let derivative = |joint: &crate::derive::JointUnknown| match &joint.kind {
            JointKindUnknown::Angle { cosine, sine } => {
                let (c, s) = (self.unknown(cosine)?, self.unknown(sine)?);
                let rise = ring.mul(&ring.variable(c), &ring.derivative(f, s));
                Ok(ring.sub(&rise, &ring.mul(&ring.variable(s), &ring.derivative(f, c))))
            }
            JointKindUnknown::Value { unknown } => Ok(ring.derivative(f, self.unknown(unknown)?)),
        };
        self.system.joints.iter().map(derivative).collect()
    }

    /// The sum of the magnitudes of all terms, with cosines and sines counted as one.
    fn size(&self, ring: &Unknowns, f: &Poly, symbols: &[Operand], assembler: &mut Assembler) -> Operand {
        let parameters = ring.field().ring().variables().len();
        let plain = |symbol: usize| {
            self.system.joints.iter().any(|joint| match &joint.kind {
                JointKindUnknown::Value { unknown } => self.unknown(unknown).ok() == symbol.checked_sub(parameters),
                JointKindUnknown::Angle { .. } => false,
            })
        };
        let mut terms = flatten(ring, f);
        for term in &mut terms {
            term.coefficient = term.coefficient.abs();
            term.powers.retain(|&(symbol, _)| symbol < parameters || plain(symbol));
        }
        let grouped = merge_like(terms);
        let used = |s: usize| grouped.iter().any(|term| term.powers.iter().any(|&(symbol, _)| symbol == s));
        let mut magnitude = |(s, &symbol)| if used(s) { assembler.abs(symbol) } else { symbol };
        let sizes: Vec<Operand> = symbols.iter().enumerate().map(&mut magnitude).collect();
        assembler.horner(&grouped, &sizes)
    }
}

fn undefined(name: &str) -> Error {
    Error::new(ErrorKind::UnknownName, format!("`{name}` has no value in the compiled program"))
}

pub(in crate::derive) fn push_code(steps: &mut Vec<Step>, assembler: &mut Assembler) {
    let code = assembler.take();
    if !code.is_empty() {
        steps.push(Step::Compute(code));
    }
}

/// The terms of `f` over parameters, then unknowns. The denominators of `f` must be one.
pub(in crate::derive) fn flatten(ring: &Unknowns, f: &Poly) -> Vec<FlatTerm> {
    let ground = ring.field().ring();
    let mut terms = Vec::new();
    for term in f.terms() {
        debug_assert!(ground.is_one(term.coefficient.denominator()), "denominators are cleared");
        let unknowns = ring.layout().exponents(&term.monomial);
        for part in term.coefficient.numerator().terms() {
            let mut powers = ground.layout().exponents(&part.monomial);
            powers.extend(&unknowns);
            terms.push(FlatTerm::new(part.coefficient.clone(), &powers));
        }
    }
    terms
}

fn merge_like(terms: Vec<FlatTerm>) -> Vec<FlatTerm> {
    let mut merged: Vec<FlatTerm> = Vec::new();
    for term in terms {
        match merged.iter_mut().find(|other| other.powers == term.powers) {
            Some(other) => other.coefficient += term.coefficient,
            None => merged.push(term),
        }
    }
    merged
}

/// The sum of the magnitudes of the constants in `f`: separate terms, or coefficients of unknowns only.
fn numbers(ring: &Unknowns, f: &Poly) -> BigRational {
    let field = ring.field();
    let own = f.terms().iter().filter_map(|term| field.as_constant(&term.coefficient));
    own.fold(BigRational::zero(), |sum, number| sum + number.abs())
}
