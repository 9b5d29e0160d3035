//! Straight-line code from polynomials and expressions: Horner form, folded constants, shared common subexpressions.

use std::collections::HashMap;

use num_traits::{Signed, ToPrimitive, Zero};

use crate::solver::{Instruction, Operand, Operation};
use groebot_algebra::number::{BigRational, Rationals};
use groebot_algebra::poly::{Expression, Polynomial, PolynomialRing, Term};

/// A term over operands: an exact coefficient and a power of each operand.
#[derive(Clone, Debug)]
pub(in crate::derive) struct FlatTerm {
    pub coefficient: BigRational,
    /// `(symbol, exponent)`: symbols are indices into the caller's table of operands; exponents are positive.
    pub powers: Vec<(usize, u32)>,
}

impl FlatTerm {
    /// The term with these exponents of all symbols.
    pub fn new(coefficient: BigRational, exponents: &[u32]) -> Self {
        let powers = exponents.iter().enumerate().filter(|(_, e)| **e > 0).map(|(s, e)| (s, *e)).collect();
        FlatTerm { coefficient, powers }
    }

    /// The terms of a polynomial whose variables are the symbols, in their order.
    pub fn all(ring: &PolynomialRing<Rationals>, f: &Polynomial<BigRational>) -> Vec<Self> {
        let term = |t: &Term<BigRational>| FlatTerm::new(t.coefficient.clone(), &ring.layout().exponents(&t.monomial));
        f.terms().iter().map(term).collect()
    }
}

/// Collects instructions. Equal operations share one register, and minus signs move out of products into sums.
#[derive(Clone, Debug)]
pub(in crate::derive) struct Assembler {
    code: Vec<Instruction>,
    /// The maximum number of terms of a sum that is not computed before it is read.
    longest: usize,
    /// The operation of each register.
    operations: Vec<Operation>,
    known: HashMap<String, Operand>,
}

/// The default of [`Assembler::longest`].
const LONGEST: usize = 12;

impl Default for Assembler {
    fn default() -> Self {
        Assembler::with_sums_of(LONGEST)
    }
}

impl Assembler {
    /// An assembler that computes sums of more than `longest` terms at once. Terms of long uncomputed sums may cancel and then need no code. A short computed
    /// sum is computed only once, no matter how often it is read.
    fn with_sums_of(longest: usize) -> Self {
        Assembler { code: Vec::new(), longest, operations: Vec::new(), known: HashMap::new() }
    }

    /// Assemblers for every length of sums that is tried, the default first.
    pub fn variants() -> [Assembler; 5] {
        [LONGEST, 6, 3, 2, 1].map(Assembler::with_sums_of)
    }

    /// The maximum number of terms of a sum that is not computed before it is read.
    pub fn longest(&self) -> usize {
        self.longest
    }

    /// The number of instructions, including those before the last [`Assembler::take`].
    pub fn count(&self) -> usize {
        self.operations.len()
    }

    /// The instructions since the last call.
    pub fn take(&mut self) -> Vec<Instruction> {
        std::mem::take(&mut self.code)
    }

    /// Another assembler that knows the same registers and continues after them.
    pub fn branch(&self) -> Assembler {
        Assembler { code: Vec::new(), ..self.clone() }
    }

    pub fn sqrt(&mut self, a: Operand) -> Operand {
        match a {
            Operand::Constant(x) => Operand::Constant(x.max(0.0).sqrt()),
            _ => self.emit(Operation::Sqrt(a)),
        }
    }

    fn emit(&mut self, operation: Operation) -> Operand {
        let key = Instruction { target: 0, operation }.to_string();
        if let Some(operand) = self.known.get(&key) {
            return *operand;
        }
        let target = self.operations.len();
        self.operations.push(operation);
        self.code.push(Instruction { target, operation });
        self.known.insert(key, Operand::Register(target));
        Operand::Register(target)
    }

    pub fn add(&mut self, a: Operand, b: Operand) -> Operand {
        use Operand::Constant;
        match (a, b) {
            (Constant(x), Constant(y)) => Constant(x + y),
            (Constant(0.0), other) | (other, Constant(0.0)) => other,
            (Constant(x), other) | (other, Constant(x)) if x < 0.0 => self.sub(other, Constant(-x)),
            (Constant(x), other) | (other, Constant(x)) => match self.opposite(other) {
                Some(other) => self.emit(Operation::Sub(Constant(x), other)),
                None => self.emit(Operation::Add(other, Constant(x))),
            },
            _ => match (self.opposite(a), self.opposite(b)) {
                (_, Some(b)) => self.sub(a, b),
                (Some(a), None) => self.sub(b, a),
                (None, None) => self.emit(commuting(a, b, Operation::Add)),
            },
        }
    }

    pub fn sub(&mut self, a: Operand, b: Operand) -> Operand {
        use Operand::Constant;
        match (a, b) {
            (Constant(x), Constant(y)) => Constant(x - y),
            (_, Constant(y)) if y <= 0.0 => self.add(a, Constant(-y)),
            (Constant(0.0), _) => self.negative(b),
            _ if a == b => Constant(0.0),
            _ => match self.opposite(b) {
                Some(b) => self.add(a, b),
                None => self.emit(Operation::Sub(a, b)),
            },
        }
    }

    pub fn mul(&mut self, a: Operand, b: Operand) -> Operand {
        use Operand::Constant;
        match (a, b) {
            (Constant(x), Constant(y)) => Constant(x * y),
            (Constant(0.0), _) | (_, Constant(0.0)) => Constant(0.0),
            (Constant(1.0), other) | (other, Constant(1.0)) => other,
            (Constant(x), other) | (other, Constant(x)) if x < 0.0 => {
                let product = self.mul(Constant(-x), other);
                self.negative(product)
            }
            _ => self.signed([a, b], |assembler, [a, b]| assembler.emit(commuting(a, b, Operation::Mul))),
        }
    }

    pub fn div(&mut self, a: Operand, b: Operand) -> Operand {
        use Operand::Constant;
        match (a, b) {
            (Constant(x), Constant(y)) if y != 0.0 => Constant(x / y),
            (Constant(0.0), _) => a,
            (_, Constant(1.0)) => a,
            (_, Constant(y)) if y < 0.0 => {
                let quotient = self.div(a, Constant(-y));
                self.negative(quotient)
            }
            _ => self.signed([a, b], |assembler, [a, b]| assembler.emit(Operation::Div(a, b))),
        }
    }

    pub fn abs(&mut self, a: Operand) -> Operand {
        match a {
            Operand::Constant(x) => Operand::Constant(x.abs()),
            Operand::Magnitude => a,
            _ => {
                let a = self.opposite(a).unwrap_or(a);
                self.emit(Operation::Abs(a))
            }
        }
    }

    /// Whether the form of `a` shows that it is not negative, such as a sum of squares.
    pub fn is_non_negative(&self, a: Operand) -> bool {
        match a {
            Operand::Constant(x) => x >= 0.0,
            Operand::Magnitude => true,
            Operand::Register(index) => match self.operations[index] {
                Operation::Abs(_) | Operation::Sqrt(_) => true,
                Operation::Mul(a, b) => a == b || (self.is_non_negative(a) && self.is_non_negative(b)),
                Operation::Add(a, b) | Operation::Div(a, b) => self.is_non_negative(a) && self.is_non_negative(b),
                Operation::Sub(..) => false,
            },
            Operand::Parameter(_) | Operand::Unknown(_) => false,
        }
    }

    /// A product or quotient of operands without their minus signs.
    fn signed(&mut self, factors: [Operand; 2], emit: impl Fn(&mut Self, [Operand; 2]) -> Operand) -> Operand {
        let opposites = factors.map(|factor| self.opposite(factor));
        let value = emit(self, [0, 1].map(|index| opposites[index].unwrap_or(factors[index])));
        if opposites[0].is_some() == opposites[1].is_some() { value } else { self.negative(value) }
    }

    /// The operand whose negative is `a`, if `a` is a negation.
    fn opposite(&self, a: Operand) -> Option<Operand> {
        match a {
            Operand::Register(index) => match self.operations[index] {
                Operation::Sub(Operand::Constant(0.0), b) => Some(b),
                _ => None,
            },
            _ => None,
        }
    }

    /// `-a`. The operands of a difference are exchanged.
    fn negative(&mut self, a: Operand) -> Operand {
        match a {
            Operand::Constant(x) => Operand::Constant(-x),
            Operand::Register(index) => match self.operations[index] {
                Operation::Sub(Operand::Constant(0.0), b) => b,
                Operation::Sub(b, c) => self.emit(Operation::Sub(c, b)),
                _ => self.emit(Operation::Sub(Operand::Constant(0.0), a)),
            },
            _ => self.emit(Operation::Sub(Operand::Constant(0.0), a)),
        }
    }

    fn power(&mut self, base: Operand, exponent: u32) -> Operand {
        match exponent {
            0 => Operand::Constant(1.0),
            1 => base,
            _ => {
                let half = self.power(base, exponent / 2);
                let square = self.mul(half, half);
                if exponent % 2 == 1 { self.mul(square, base) } else { square }
            }
        }
    }

    /// The value of a sum of terms, in a greedy multivariate Horner form: the most frequent symbol is factored out first.
    pub fn horner(&mut self, terms: &[FlatTerm], symbols: &[Operand]) -> Operand {
        match terms {
            [] => Operand::Constant(0.0),
            [term] => self.product(term, symbols),
            _ => {
                let uses = |s: usize| terms.iter().filter(|t| t.powers.iter().any(|&(symbol, _)| symbol == s)).count();
                let counts = (0..symbols.len()).map(|s| (uses(s), s)).filter(|(count, _)| *count > 1);
                match counts.max_by_key(|&(count, s)| (count, usize::MAX - s)) {
                    Some((_, symbol)) => self.take_out(terms, symbol, symbols),
                    None => self.sum(terms, symbols),
                }
            }
        }
    }

    /// `symbol^k * (...) + ...` with the largest `k` that all terms with the symbol share.
    fn take_out(&mut self, terms: &[FlatTerm], symbol: usize, symbols: &[Operand]) -> Operand {
        let exponent = |t: &FlatTerm| t.powers.iter().find(|(s, _)| *s == symbol).map_or(0, |(_, e)| *e);
        let shared = terms.iter().map(exponent).filter(|&e| e > 0).min().unwrap_or(1);
        let (with, without): (Vec<FlatTerm>, Vec<FlatTerm>) = terms.iter().cloned().partition(|t| exponent(t) > 0);
        let divided: Vec<FlatTerm> = with
            .into_iter()
            .map(|mut term| {
                for (_, e) in term.powers.iter_mut().filter(|(s, _)| *s == symbol) {
                    *e -= shared;
                }
                term.powers.retain(|(_, e)| *e > 0);
                term
            })
            .collect();
        let inner = self.horner(&divided, symbols);
        let power = self.power(symbols[symbol], shared);
        let product = self.mul(power, inner);
        if without.is_empty() {
            return product;
        }
        let negative = without.iter().all(|t| t.coefficient.is_negative());
        if negative {
            let positive: Vec<FlatTerm> = without.into_iter().map(negated).collect();
            let rest = self.horner(&positive, symbols);
            return self.sub(product, rest);
        }
        let rest = self.horner(&without, symbols);
        self.add(product, rest)
    }

    fn sum(&mut self, terms: &[FlatTerm], symbols: &[Operand]) -> Operand {
        let (first, rest) = match terms.iter().position(|t| !t.coefficient.is_negative()) {
            Some(index) => {
                let mut rest = terms.to_vec();
                (rest.remove(index), rest)
            }
            None => (terms[0].clone(), terms[1..].to_vec()),
        };
        let mut sum = self.product(&first, symbols);
        for term in rest {
            if term.coefficient.is_negative() {
                let part = self.product(&negated(term), symbols);
                sum = self.sub(sum, part);
            } else {
                let part = self.product(&term, symbols);
                sum = self.add(sum, part);
            }
        }
        sum
    }

    fn product(&mut self, term: &FlatTerm, symbols: &[Operand]) -> Operand {
        let mut product: Option<Operand> = None;
        for &(symbol, exponent) in &term.powers {
            let power = self.power(symbols[symbol], exponent);
            product = Some(product.map_or(power, |product| self.mul(product, power)));
        }
        let coefficient = constant(&term.coefficient);
        product.map_or(coefficient, |product| self.mul(coefficient, product))
    }

    /// The value of an expression whose names `value` knows.
    pub fn expression(&mut self, expression: &Expression, value: &dyn Fn(&str) -> Option<Operand>) -> Option<Operand> {
        match expression {
            Expression::Number(q) => Some(constant(q)),
            Expression::Name(name) => value(name),
            Expression::Negation(a) => {
                let a = self.expression(a, value)?;
                Some(self.mul(Operand::Constant(-1.0), a))
            }
            Expression::Inverse(a) => {
                let a = self.expression(a, value)?;
                Some(self.div(Operand::Constant(1.0), a))
            }
            Expression::Power(a, n) => {
                let a = self.expression(a, value)?;
                Some(self.power(a, *n))
            }
            Expression::Sum(parts) => {
                let mut sum = Operand::Constant(0.0);
                for part in parts {
                    let part = self.expression(part, value)?;
                    sum = self.add(sum, part);
                }
                Some(sum)
            }
            Expression::Product(parts) => {
                let mut product = Operand::Constant(1.0);
                for part in parts {
                    product = match part {
                        Expression::Inverse(a) => {
                            let a = self.expression(a, value)?;
                            self.div(product, a)
                        }
                        part => {
                            let part = self.expression(part, value)?;
                            self.mul(product, part)
                        }
                    };
                }
                Some(product)
            }
        }
    }
}

/// The usual result, or another one that needs at most seven eighths of its work.
pub(in crate::derive) fn of_least_work<T>(usual: T, others: impl IntoIterator<Item = T>, work: fn(&T) -> usize) -> T {
    let allowed = work(&usual) - work(&usual) / 8;
    let best = others.into_iter().filter(|other| work(other) < allowed).min_by_key(work);
    best.unwrap_or(usual)
}

/// A sum or product of two operands in a canonical order.
fn commuting(a: Operand, b: Operand, operation: fn(Operand, Operand) -> Operation) -> Operation {
    let rank = |operand: Operand| match operand {
        Operand::Constant(_) => (0, 0),
        Operand::Magnitude => (1, 0),
        Operand::Parameter(index) => (2, index),
        Operand::Unknown(index) => (3, index),
        Operand::Register(index) => (4, index),
    };
    if rank(b) < rank(a) { operation(b, a) } else { operation(a, b) }
}

fn negated(mut term: FlatTerm) -> FlatTerm {
    term.coefficient = -term.coefficient;
    term
}

/// The double nearest to `q`.
pub(in crate::derive) fn constant(q: &BigRational) -> Operand {
    if q.is_zero() { Operand::Constant(0.0) } else { Operand::Constant(q.to_f64().unwrap_or(f64::MAX)) }
}
