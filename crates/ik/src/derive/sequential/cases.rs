//! The cases of a block, from the strata of a [`FormBasis`]: symbols become operands, and the form's unknowns become those of the program.

use num_traits::Signed;

use super::circle::{Quotient, divided, on_circle};
use super::form_basis::{Form, FormBasis};
use super::half_angle::{HalfAngle, HalfAngles};
use super::slack::Slack;
use crate::derive::equations::assemble::{Assembler, FlatTerm};
use crate::derive::equations::compile::{flatten, push_code};
use crate::derive::equations::setting::{ParameterPoly, Setting, Unknowns};
use crate::derive::equations::strata::{self, ZeroSet};
use crate::derive::equations::tree::{Node, Outcome, Solved, collect_denominators};
use crate::derive::equations::triangular::Stair;
use crate::solver::{Case, Guard, JointValue, Operand, Pivot, Step};
use crate::tolerances::DERIVED_STRATA;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::{Rationals, Ring, Style};
use groebot_algebra::poly::PolynomialRing;
use groebot_runtime::tolerances::STRATA;

/// The factor on the typical size of later roots if an earlier joint is free. It is so large that each polynomial has at least one root: the point where it
/// comes nearest to zero. Otherwise all samples of the joint may miss the part of the circle that has solutions.
const OUT: f64 = 1e6;

/// The value of a symbol and its size, the sum of its terms' magnitudes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SizedValue {
    pub value: Operand,
    pub size: Operand,
}

impl SizedValue {
    pub fn negated(self, assembler: &mut Assembler) -> Self {
        SizedValue { value: assembler.mul(Operand::Constant(-1.0), self.value), size: self.size }
    }
}

/// The joint of a program for which a form is used.
pub(super) struct Place {
    /// Index of the joint that is free where the form's joint is free.
    pub free: usize,
    /// The joint's unknowns.
    pub value: JointValue,
    /// The auxiliary unknown `w`.
    pub auxiliary: Option<usize>,
    /// The symbols, in the form's order.
    pub symbols: Vec<SizedValue>,
    /// The sampled values of a free joint.
    pub samples: Vec<f64>,
    /// The error bound of the symbols.
    pub slack: Slack,
    /// Unknowns that earlier blocks set: one if the joint of the block is not free, otherwise [`OUT`].
    pub spreads: Vec<usize>,
}

/// Sets the unknown `spread` in each case, so that later blocks know whether this block left its joint free.
pub(super) fn set_spread(cases: &mut [Case], spread: usize) {
    for case in cases {
        let value = Operand::Constant(if case.free.is_empty() { 1.0 } else { OUT });
        case.steps.insert(0, Step::Set { unknown: spread, value });
    }
}

impl Place {
    /// The program's unknown for the form's unknown `name`.
    fn unknown(&self, name: &str) -> Result<usize> {
        let found = match (name, self.value) {
            ("c", JointValue::Angle { cosine, .. }) => Some(cosine),
            ("s", JointValue::Angle { sine, .. }) => Some(sine),
            ("d", JointValue::Plain(unknown)) => Some(unknown),
            ("w", _) => self.auxiliary,
            _ => None,
        };
        found.ok_or_else(|| Error::new(ErrorKind::UnknownName, format!("the joint has no unknown `{name}`")))
    }
}

/// The cases of `form_basis` at `place`, after the code of the block in `assembler`. All have `guards` before their own guards.
pub(super) fn cases(
    form_basis: &FormBasis,
    place: &Place,
    assembler: &Assembler,
    guards: &[Guard],
) -> Result<Vec<Case>> {
    let mut list = Vec::new();
    for node in form_basis.tree.walk() {
        let case = match &node.outcome {
            Outcome::Solved(solved) if !solved.inherited => {
                Builder::new(form_basis.form, place, assembler, guards).solved(form_basis, node, solved)?
            }
            Outcome::SelfMotion(_) => {
                Builder::new(form_basis.form, place, assembler, guards).self_motion(form_basis, node)?
            }
            _ => None,
        };
        list.extend(case);
    }
    Ok(list)
}

/// The cases of an equation of degree two in cosine and sine. There is one case per direction, of which the best conditioned runs. One more case runs if all
/// coefficients vanish.
pub(super) fn quartic(half_angles: &HalfAngles, place: &Place, assembler: &Assembler) -> Result<Vec<Case>> {
    let mut list = Vec::new();
    for half in &half_angles.0 {
        list.push(Builder::new(Form::Quartic, place, assembler, &[]).half(half)?);
    }
    let mut free = Builder::new(Form::Quartic, place, assembler, &[]);
    for (symbol, name) in place.symbols.iter().zip(Form::Quartic.symbols()) {
        let scale =
            free.assembler.mul(Operand::Constant(place.slack.share(DERIVED_STRATA.close) / STRATA.near), symbol.size);
        free.guards.push(Guard { text: (*name).to_owned(), value: symbol.value, scale, near: true });
    }
    list.push(free.free("A = B = C = D = E = 0"));
    Ok(list)
}

struct Builder<'a> {
    form: Form,
    place: &'a Place,
    assembler: Assembler,
    guards: Vec<Guard>,
}

impl<'a> Builder<'a> {
    fn new(form: Form, place: &'a Place, assembler: &Assembler, guards: &[Guard]) -> Self {
        Builder { form, place, assembler: assembler.branch(), guards: guards.to_vec() }
    }

    /// The case of a stratum with its own formulas; `None` if its guards never hold.
    fn solved(mut self, form_basis: &FormBasis, node: &Node, solved: &Solved) -> Result<Option<Case>> {
        let field = node.setting.field()?;
        let ground = field.ring();
        let mut denominators = Vec::new();
        collect_denominators(ground, solved.certified.basis.iter(), &mut denominators);
        let mut possible = self.near(form_basis, node)?;
        for factor in strata::factors(ground, &denominators)? {
            if !matches!(strata::zero_set(&node.setting, &factor)?, ZeroSet::Empty(_)) {
                possible &= self.guard(ground, &factor, false)?;
            }
        }
        let guard_code = self.assembler.take();
        let mut steps = Vec::new();
        let mut values = Vec::new();
        for stair in &solved.triangular.stairs {
            self.stair(&node.setting, &solved.triangular.ring, stair, &mut steps, &mut values)?;
        }
        self.put(&values, &mut steps)?;
        Ok(possible.then(|| self.case(&node.label, guard_code, steps, Vec::new())))
    }

    /// The case of a stratum where the joint is free.
    fn self_motion(mut self, form_basis: &FormBasis, node: &Node) -> Result<Option<Case>> {
        let possible = self.near(form_basis, node)?;
        Ok(possible.then(|| self.free(&node.label)))
    }

    /// The case that sets the joint to its sampled values.
    fn free(mut self, label: &str) -> Case {
        let guard_code = self.assembler.take();
        let (joint, values) = (self.place.value, self.place.samples.clone());
        let mut steps = vec![Step::Sample { joint, values }];
        if let Some(unknown) = self.place.auxiliary {
            steps.insert(0, Step::Set { unknown, value: Operand::Constant(0.0) });
        }
        let free = vec![self.place.free];
        self.case(label, guard_code, steps, free)
    }

    fn case(
        self,
        label: &str,
        guard_code: Vec<crate::solver::Instruction>,
        steps: Vec<Step>,
        free: Vec<usize>,
    ) -> Case {
        Case { label: label.to_owned(), guard_code, guards: self.guards, steps, free, ..Case::default() }
    }

    /// The case of one direction of the half angle.
    fn half(mut self, half: &HalfAngle) -> Result<Case> {
        let ring = &half.ring;
        let unknown = self.place.unknown("w")?;
        let quartic = self.coefficients(ring, half.stair(2)?, 2, Operand::Constant(0.0));
        let lead = quartic.last().copied().unwrap_or(Operand::Constant(0.0));
        let typical = Some(self.spread(Operand::Constant(1.0), quartic.len() - 1));
        let guard_code = self.assembler.take();
        let half_angle = self.place.slack != Slack::NONE;
        let mut steps = vec![Step::Roots { unknown, polynomials: vec![quartic], typical, half_angle }];
        let sine = self.coefficients(ring, half.stair(1)?, 1, Operand::Unknown(unknown));
        let sine = self.root(&sine)?;
        let low = self.parts(ring, half.stair(0)?, 0, [Operand::Constant(0.0), sine, Operand::Unknown(unknown)]);
        let cosine = self.root(&low)?;
        let values = [(self.place.unknown("c")?, cosine), (self.place.unknown("s")?, sine)];
        let values = values.map(|(unknown, value)| (unknown, Quotient::whole(value)));
        self.put(&values, &mut steps)?;
        let mut case = self.case("half angle", guard_code, steps, Vec::new());
        case.pivot = Some(Pivot { group: 0, value: lead });
        Ok(case)
    }

    /// The coefficients of `f` in unknown `v` of c, s, t. `f` contains no unknown other than `v` and t.
    fn coefficients(
        &mut self,
        ring: &PolynomialRing<Rationals>,
        f: &ParameterPoly,
        v: usize,
        t: Operand,
    ) -> Vec<Operand> {
        let zero = Operand::Constant(0.0);
        self.parts(ring, f, v, [zero, zero, t])
    }

    /// The coefficients of `f` in unknown `v`, at these values of c, s, t.
    fn parts(
        &mut self,
        ring: &PolynomialRing<Rationals>,
        f: &ParameterPoly,
        v: usize,
        unknowns: [Operand; 3],
    ) -> Vec<Operand> {
        let operands: Vec<Operand> = unknowns.into_iter().chain(self.place.symbols.iter().map(|s| s.value)).collect();
        let parts = ring.coefficients_in(f, v);
        parts.iter().map(|part| self.assembler.horner(&FlatTerm::all(ring, part), &operands)).collect()
    }

    /// The root of a linear polynomial, given by its two coefficients.
    fn root(&mut self, coefficients: &[Operand]) -> Result<Operand> {
        let [low, high] = coefficients else {
            return Err(Error::new(ErrorKind::Unsupported, "a polynomial of a half angle is not linear"));
        };
        let top = self.assembler.mul(Operand::Constant(-1.0), *low);
        Ok(self.assembler.div(top, *high))
    }

    /// Guards for the factors that vanish on a stratum, which are polynomials of the form's own symbols.
    fn near(&mut self, form_basis: &FormBasis, node: &Node) -> Result<bool> {
        let field = form_basis.tree.setting.field()?;
        let ground = field.ring();
        let mut possible = true;
        for factor in &node.factors {
            possible &= self.guard(ground, &factor.evaluate(ground)?, true)?;
        }
        Ok(possible)
    }

    /// Adds a guard on a factor, unless its value is a constant. Returns false if the guard never holds.
    fn guard(&mut self, ground: &PolynomialRing<Rationals>, factor: &ParameterPoly, near: bool) -> Result<bool> {
        let symbols = self.symbols(ground.variables())?;
        let (values, sizes): (Vec<Operand>, Vec<Operand>) = symbols.iter().map(|s| (s.value, s.size)).unzip();
        let mut terms = FlatTerm::all(ground, factor);
        let value = self.assembler.horner(&terms, &values);
        if let Operand::Constant(value) = value {
            return Ok((value == 0.0) == near);
        }
        terms.iter_mut().for_each(|term| term.coefficient = term.coefficient.abs());
        let size = self.assembler.horner(&terms, &sizes);
        let degree = ground.degree(factor) as i32;
        let close = self.place.slack.share(DERIVED_STRATA.close);
        let share =
            if near { close.powi(degree) / STRATA.near } else { DERIVED_STRATA.lost.powi(degree) / STRATA.denominator };
        let scale = self.assembler.mul(Operand::Constant(share), size);
        self.guards.push(Guard { text: ground.format(factor, Style::Text), value, scale, near });
        Ok(true)
    }

    fn symbols(&self, names: &[String]) -> Result<Vec<SizedValue>> {
        let all = self.form.symbols();
        let symbol = |name: &String| {
            let index = all.iter().position(|symbol| symbol == name);
            index.map(|index| self.place.symbols[index]).ok_or_else(|| {
                Error::new(ErrorKind::UnknownName, format!("`{name}` is not a symbol of `{}`", self.form.name()))
            })
        };
        names.iter().map(symbol).collect()
    }

    /// Solves one polynomial of the triangular form: as a root step, or as a quotient in `values` if it is linear.
    fn stair(
        &mut self,
        setting: &Setting,
        ring: &Unknowns,
        stair: &Stair,
        steps: &mut Vec<Step>,
        values: &mut Vec<(usize, Quotient)>,
    ) -> Result<()> {
        let unknown = self.place.unknown(&ring.variables()[stair.unknown])?;
        let mut operands: Vec<Operand> =
            self.symbols(setting.field()?.ring().variables())?.iter().map(|s| s.value).collect();
        for name in ring.variables() {
            let own = self.place.unknown(name)?;
            let value = values.iter().find(|(unknown, _)| *unknown == own);
            operands.push(value.map_or(Operand::Unknown(own), |(_, value)| value.value));
        }
        let parts = ring.coefficients_in(&stair.polynomials[0], stair.unknown);
        let coefficients: Vec<Operand> =
            parts.iter().map(|part| self.assembler.horner(&flatten(ring, part), &operands)).collect();
        match coefficients.as_slice() {
            [low, high] => {
                let top = self.assembler.mul(Operand::Constant(-1.0), *low);
                values.push((unknown, Quotient::new(top, *high, &mut self.assembler)));
            }
            _ => {
                let typical = if self.form == Form::Lengths { None } else { Some(self.typical()?) };
                let typical = typical.map(|size| self.spread(size, coefficients.len() - 1));
                push_code(steps, &mut self.assembler);
                steps.push(Step::Roots { unknown, polynomials: vec![coefficients], typical, half_angle: false });
            }
        }
        Ok(())
    }

    /// The typical size of the auxiliary unknown: `w` is one leg of a right-angled triangle, or half the difference of two roots.
    fn typical(&mut self) -> Result<Operand> {
        let squares: &[(usize, usize)] = match self.form {
            Form::Quadratic => &[(1, 1), (0, 2)],
            _ => &[(0, 0), (1, 1)],
        };
        let size = |index: usize| self.place.symbols[index].size;
        let assembler = &mut self.assembler;
        let sum = squares.iter().fold(Operand::Constant(0.0), |sum, &(i, j)| {
            let product = assembler.mul(size(i), size(j));
            assembler.add(sum, product)
        });
        Ok(self.assembler.sqrt(sum))
    }

    /// An unknown's typical size, enlarged for polynomials of this degree that may miss a double root by more than rounding.
    fn spread(&mut self, typical: Operand, degree: usize) -> Operand {
        let factors = self.place.spreads.iter().map(|&spread| Operand::Unknown(spread));
        let factors: Vec<Operand> = factors.chain([Operand::Constant(self.place.slack.typical(degree))]).collect();
        factors.into_iter().fold(typical, |size, factor| self.assembler.mul(factor, size))
    }

    /// Sets the joint's unknowns. A cosine and a sine are scaled to the unit circle.
    fn put(&mut self, values: &[(usize, Quotient)], steps: &mut Vec<Step>) -> Result<()> {
        let quotient = |unknown: usize| values.iter().find(|(u, _)| *u == unknown).map(|(_, value)| *value);
        let value = |unknown: usize| quotient(unknown).map(|quotient| quotient.value);
        let missing = || Error::new(ErrorKind::Unsupported, "a polynomial of a form is not linear");
        let put: Vec<(usize, Operand)> = match self.place.value {
            JointValue::Angle { cosine, sine } => {
                let (c, s) = quotient(cosine).zip(quotient(sine)).ok_or_else(missing)?;
                let has_root = self.form == Form::Angle && steps.iter().any(|step| matches!(step, Step::Roots { .. }));
                let [c, s] = if has_root && c.bottom == s.bottom {
                    divided([c, s], &mut self.assembler)
                } else {
                    on_circle([c, s], &mut self.assembler)
                };
                vec![(cosine, c), (sine, s)]
            }
            JointValue::Plain(_) if self.form == Form::Lengths && values.is_empty() => Vec::new(),
            JointValue::Plain(unknown) => vec![(unknown, value(unknown).ok_or_else(missing)?)],
        };
        push_code(steps, &mut self.assembler);
        if let Some(unknown) = self.place.auxiliary
            && !steps.iter().any(|step| matches!(step, Step::Roots { unknown: w, .. } if *w == unknown))
        {
            steps.push(Step::Set { unknown, value: value(unknown).unwrap_or(Operand::Constant(0.0)) });
        }
        steps.extend(put.into_iter().map(|(unknown, value)| Step::Set { unknown, value }));
        Ok(())
    }
}
