//! Readable polynomials for comparison with a paper: short decimals, common numbers in front, wrapped lines.

use num_bigint::BigInt;
use num_traits::{One, Pow, Signed};

use groebot_algebra::number::{BigRational, Rationals};
use groebot_algebra::poly::{Expression, PolynomialRing};
use groebot_ik::derive::equations::setting::{ParameterPoly, Poly, Unknowns};

/// The greatest power of ten that is tried.
const MAX_POWER: u32 = 24;

/// `f` with its denominators cleared, divided by the power of ten that makes its numbers shortest. With the integers
/// 2058000, 100 and 2058841 it becomes `20580*c4 - px^2 - pz^2 + 20588.41`.
pub fn readable(ring: &Unknowns, f: &Poly) -> Expression {
    let scale = best_scale(f);
    let ground = ring.field().ring();
    let mut sum = Vec::new();
    for term in f.terms() {
        let powers = powers(ring.variables(), &ring.layout().exponents(&term.monomial));
        let coefficient = ground.scale(term.coefficient.numerator(), &scale);
        if powers.is_empty() {
            sum.extend(terms(ground, &coefficient));
        } else {
            sum.push(coefficient_times(ground, &coefficient, powers));
        }
    }
    Expression::sum(sum)
}

/// `leading` without its numeric factor: the divisor of a formula.
pub fn divisor(ring: &PolynomialRing<Rationals>, leading: &ParameterPoly) -> Expression {
    let content = common_magnitude(leading).unwrap_or_else(BigRational::one);
    Expression::sum(terms(ring, &ring.scale(leading, &content.recip())))
}

/// One over the power of ten for which the numbers of `f` take the fewest characters.
fn best_scale(f: &Poly) -> BigRational {
    let numbers: Vec<&BigRational> =
        f.terms().iter().flat_map(|t| t.coefficient.numerator().terms()).map(|t| &t.coefficient).collect();
    let scale = |power: u32| BigRational::new(BigInt::one(), BigInt::from(10).pow(power));
    let length = |power: &u32| -> usize {
        let scaled = numbers.iter().map(|q| (*q * scale(*power)).abs());
        scaled.map(|q| if q.is_one() { 0 } else { Expression::Number(q).to_string().len() }).sum()
    };
    scale((0..=MAX_POWER).min_by_key(length).unwrap_or(0))
}

fn powers(names: &[String], exponents: &[u32]) -> Vec<Expression> {
    let power = |(name, &exponent): (&String, &u32)| match exponent {
        0 => None,
        1 => Some(Expression::name(name)),
        _ => Some(Expression::name(name).power(exponent)),
    };
    names.iter().zip(exponents).filter_map(power).collect()
}

/// `number * factors`, as a negation when the number is negative.
fn product(number: &BigRational, factors: Vec<Expression>) -> Expression {
    let magnitude = number.abs();
    let mut parts = Vec::new();
    if !magnitude.is_one() || factors.is_empty() {
        parts.push(Expression::Number(magnitude));
    }
    parts.extend(factors);
    let product = Expression::product(parts);
    if number.is_negative() { product.negated() } else { product }
}

fn terms(ring: &PolynomialRing<Rationals>, f: &ParameterPoly) -> Vec<Expression> {
    let factors = |monomial| powers(ring.variables(), &ring.layout().exponents(monomial));
    f.terms().iter().map(|term| product(&term.coefficient, factors(&term.monomial))).collect()
}

/// The magnitude of all coefficients, if it is common.
fn common_magnitude(f: &ParameterPoly) -> Option<BigRational> {
    let magnitude = f.leading()?.coefficient.abs();
    f.terms().iter().all(|term| term.coefficient.abs() == magnitude).then_some(magnitude)
}

/// A coefficient before unknowns: `40000*(px^2 + pz^2)*s3^2`, with the sign of its first term in front.
fn coefficient_times(ring: &PolynomialRing<Rationals>, f: &ParameterPoly, unknowns: Vec<Expression>) -> Expression {
    if let [term] = f.terms() {
        let own = powers(ring.variables(), &ring.layout().exponents(&term.monomial));
        return product(&term.coefficient, [own, unknowns].concat());
    }
    let negative = f.leading().is_some_and(|term| term.coefficient.is_negative());
    let mut number = common_magnitude(f).unwrap_or_else(BigRational::one);
    if negative {
        number = -number;
    }
    let inner = Expression::sum(terms(ring, &ring.scale(f, &number.recip())));
    product(&number, [vec![inner], unknowns].concat())
}

/// Evaluates quotients of numbers: `1029/10*c3` becomes `102.9*c3`.
pub fn with_decimals(expression: &Expression) -> Expression {
    let each = |parts: &[Expression]| parts.iter().map(with_decimals).collect::<Vec<_>>();
    match expression {
        Expression::Sum(parts) => Expression::sum(each(parts)),
        Expression::Negation(a) => with_decimals(a).negated(),
        Expression::Power(a, n) => with_decimals(a).power(*n),
        Expression::Inverse(a) => Expression::Inverse(Box::new(with_decimals(a))),
        Expression::Product(parts) => match numeric_start(parts) {
            (Some(number), rest) if rest < parts.len() => product(&number, each(&parts[rest..])),
            (Some(number), _) => Expression::Number(number),
            (None, _) => Expression::product(each(parts)),
        },
        Expression::Number(_) | Expression::Name(_) => expression.clone(),
    }
}

/// The value of the leading numbers of a product, and how many factors they are.
fn numeric_start(parts: &[Expression]) -> (Option<BigRational>, usize) {
    let mut value = None;
    for (index, part) in parts.iter().enumerate() {
        let before = value.clone().unwrap_or_else(BigRational::one);
        value = match part {
            Expression::Number(q) => Some(before * q),
            Expression::Inverse(a) => match a.as_ref() {
                Expression::Number(q) if q.numer() != &BigInt::ZERO => Some(before / q),
                _ => return (value, index),
            },
            _ => return (value, index),
        };
    }
    (value, parts.len())
}

/// Breaks `text` at spaces into lines that end by column `width`. All lines start at column `indent`.
pub fn wrap(text: &str, width: usize, indent: usize) -> String {
    let mut lines = vec![String::new()];
    for piece in pieces(text) {
        match lines.last_mut() {
            Some(line) if line.is_empty() => *line = piece,
            Some(line) if indent + line.chars().count() + 1 + piece.chars().count() <= width => {
                line.push(' ');
                line.push_str(&piece);
            }
            _ => lines.push(piece),
        }
    }
    lines.join(&format!("\n{}", " ".repeat(indent)))
}

/// The words of `text`, with each sign or `=` joined to the next word.
fn pieces(text: &str) -> Vec<String> {
    let mut pieces: Vec<String> = Vec::new();
    let mut sign = None;
    for word in text.split(' ') {
        match sign.take() {
            Some(sign) => pieces.push(format!("{sign} {word}")),
            None if matches!(word, "+" | "-" | "=" | ">") => sign = Some(word),
            None => pieces.push(word.to_owned()),
        }
    }
    pieces.extend(sign.map(str::to_owned));
    pieces
}
