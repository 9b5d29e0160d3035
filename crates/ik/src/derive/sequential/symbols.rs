//! The symbols of a step's form: their values and typical sizes from the coefficients of the step's relations, in the shortest code.

use num_traits::{Signed, ToPrimitive};

use super::cases::SizedValue;
use super::context::Context;
use super::eliminate::{Elimination, SymbolPlace};
use super::emit::{Emitted, Emitter, Sizes};
use super::form_basis::Form;
use super::layout::Layout;
use super::shape::Shape;
use crate::Result;
use crate::derive::closure::{Factor, Mechanism, Multilinear, Relation, evaluate};
use crate::derive::equations::assemble::{Assembler, FlatTerm, of_least_work};
use crate::solver::Operand;
use groebot_algebra::number::BigRational;

/// The symbols of a step's form, and their code.
pub(super) struct Symbols {
    pub list: Vec<SizedValue>,
    /// The number of instructions that compute their values.
    work: usize,
    pub assembler: Assembler,
}

impl Symbols {
    /// Whether exactly the same values are constants, which need no code.
    fn has_numbers_of(&self, other: &Symbols) -> bool {
        let is_number = |symbol: &SizedValue| number(&symbol.value).is_some();
        self.list.iter().map(is_number).eq(other.list.iter().map(is_number))
    }
}

impl Context<'_> {
    /// The symbols of the step's form, in the shortest code over several lengths of sums. Constant values must remain constants.
    pub fn shortest(&self, layout: &Layout) -> Result<Symbols> {
        let [usual, others @ ..] = Assembler::variants();
        let usual = self.symbols(layout, usual)?;
        let mut alike = Vec::with_capacity(others.len());
        for other in others {
            alike.push(self.symbols(layout, other)?);
        }
        alike.retain(|other| other.has_numbers_of(&usual));
        Ok(of_least_work(usual, alike, |symbols| symbols.work))
    }

    /// The step's relations, grouped with their mechanisms.
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

    /// The symbols of the step's form. Sizes are computed only if a guard may read them.
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
        let sizes = if is_sized {
            self.sizes(&equations, layout, assembler)?
        } else {
            let largest = values.iter().filter_map(number).fold(1.0, |largest: f64, x| largest.max(x.abs()));
            vec![Operand::Constant(largest); values.len()]
        };
        let list = values.into_iter().zip(sizes).map(|(value, size)| SizedValue { value, size }).collect();
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

    /// The symbols from the equations' coefficients, for the physical sine `s = sqrt(n) s'`. If `equations` are sizes, `values` are the corresponding values.
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
            Shape { form: Form::Rotation, ref ratio } => {
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

    /// The symbols from the result of an elimination.
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

/// The error factor of a term `q S^powers`, as terms in the symbols' magnitudes and then their sizes. If each symbol has an error of a fraction of its size,
/// the term has an error of that fraction of this sum. The sum is at least the term itself, and much less than the product of sizes if symbols are small.
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

/// The value of a constant operand.
fn number(value: &Operand) -> Option<f64> {
    match value {
        Operand::Constant(value) => Some(*value),
        _ => None,
    }
}

/// Whether the operand is a nonzero constant.
fn is_number(value: &Operand) -> bool {
    number(value).is_some_and(|value| value != 0.0)
}
