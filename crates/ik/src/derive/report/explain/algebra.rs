//! Formulas of a chain's report: equations sorted by the unknowns of one joint.

use std::collections::BTreeMap;

use num_traits::One;

use crate::Result;
use crate::derive::closure::{Factor, Mechanism, Relation};
use crate::derive::sequential::{Symbolic, TargetPoly};
use groebot_algebra::number::{BigRational, Ring, Style};

/// The maximum number of terms that the report prints.
const MOST_TERMS: usize = 120;

/// A relation sorted by the unknowns of one joint. It maps each product of these unknowns to its coefficient: products of the other unknowns, each with a
/// polynomial in the target.
pub struct Sorted {
    symbolic: Symbolic,
    parts: BTreeMap<Vec<Factor>, Vec<(Vec<Factor>, TargetPoly)>>,
}

impl Sorted {
    /// `relation`, sorted by the unknowns of `joint`.
    pub fn new(mechanism: &Mechanism, relation: &Relation, joint: usize) -> Result<Self> {
        let mut symbolic = Symbolic::new(mechanism)?;
        let polynomial = symbolic.polynomial(mechanism, relation)?;
        let mut parts: BTreeMap<Vec<Factor>, Vec<(Vec<Factor>, TargetPoly)>> = BTreeMap::new();
        for (product, value) in polynomial.terms() {
            let (own, rest): (Vec<Factor>, Vec<Factor>) =
                product.list().iter().partition(|factor| factor.joint() == joint);
            parts.entry(own).or_default().push((rest, value.clone()));
        }
        Ok(Sorted { symbolic, parts })
    }

    /// The whole equation.
    pub fn equation(&self, mechanism: &Mechanism) -> String {
        let terms = self.parts.iter().rev().map(|(own, parts)| {
            let count: usize = parts.iter().map(|(_, value)| value.terms().len()).sum();
            (product(mechanism, own), self.sum(mechanism, parts, &BigRational::one()), count)
        });
        let whole: Vec<(String, String, usize)> = terms.collect();
        if whole.iter().map(|(_, _, count)| count).sum::<usize>() > MOST_TERMS {
            return format!("0 = {}", long(whole.iter().map(|(_, _, count)| count).sum()));
        }
        let term = |(own, text, count): (String, String, usize)| match (own.as_str(), text.as_str()) {
            ("", _) => text,
            (_, "1") => own,
            (_, "-1") => format!("-{own}"),
            _ if count > 1 => format!("({text})*{own}"),
            _ => format!("{text}*{own}"),
        };
        signs(whole.into_iter().map(term)) + " = 0"
    }

    /// `factor` times the coefficient of `own`; a long coefficient is shortened to `[5 terms]`.
    pub fn coefficient(&self, mechanism: &Mechanism, own: &[Factor], factor: &BigRational) -> String {
        let Some(parts) = self.parts.get(own) else { return "0".to_owned() };
        match parts.iter().map(|(_, value)| value.terms().len()).sum() {
            count if count > MOST_TERMS => long(count),
            _ => self.sum(mechanism, parts, factor),
        }
    }

    fn sum(&self, mechanism: &Mechanism, parts: &[(Vec<Factor>, TargetPoly)], factor: &BigRational) -> String {
        let ring = &self.symbolic.ring;
        let term = |(rest, value): &(Vec<Factor>, TargetPoly)| {
            let text = ring.format(&ring.scale(value, factor), Style::Decimal);
            match (product(mechanism, rest), text.as_str()) {
                (rest, _) if rest.is_empty() => text,
                (rest, "1") => rest,
                (rest, "-1") => format!("-{rest}"),
                (rest, _) if value.terms().len() > 1 => format!("{rest}*({text})"),
                (rest, _) => format!("{text}*{rest}"),
            }
        };
        signs(parts.iter().rev().map(term))
    }
}

/// The unknowns of a joint as text, such as `c1, s1`. `s1'` is the sine divided by the length of the axis vector, if that is not one.
pub fn joint_unknowns(mechanism: &Mechanism, joint: usize) -> String {
    let screw = &mechanism.joints()[joint];
    let names = unknowns(mechanism, joint).into_iter().map(|factor| name(mechanism, factor));
    let text = names.collect::<Vec<_>>().join(", ");
    if screw.square.is_one() {
        return text;
    }
    let letter = if screw.is_revolute() { 's' } else { 'd' };
    format!("{text}, {letter}{0}' = {letter}{0} / sqrt({1})", screw.symbol, screw.square)
}

/// The unknowns of a joint.
pub fn unknowns(mechanism: &Mechanism, joint: usize) -> Vec<Factor> {
    match mechanism.joints()[joint].is_revolute() {
        true => vec![Factor::Cosine(joint), Factor::Sine(joint)],
        false => vec![Factor::Length(joint)],
    }
}

/// The name of an unknown, such as `c1`, `s1'` or `d3'^2`.
pub fn name(mechanism: &Mechanism, factor: Factor) -> String {
    let joint = &mechanism.joints()[factor.joint()];
    let prime = if joint.square.is_one() { "" } else { "'" };
    match factor {
        Factor::Cosine(_) => format!("c{}", joint.symbol),
        Factor::Sine(_) => format!("s{}{prime}", joint.symbol),
        Factor::Length(_) => format!("d{}{prime}", joint.symbol),
        Factor::LengthSquared(_) => format!("d{}{prime}^2", joint.symbol),
    }
}

/// A product as text, such as `c1*s2'`; empty for 1.
pub fn product(mechanism: &Mechanism, factors: &[Factor]) -> String {
    factors.iter().map(|factor| name(mechanism, *factor)).collect::<Vec<_>>().join("*")
}

/// `text` with whole names replaced.
pub fn renamed(text: &str, names: &[(String, String)]) -> String {
    let (mut rest, mut result) = (text, String::new());
    while let Some(c) = rest.chars().next() {
        let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let length = if is_word(c) { rest.find(|c| !is_word(c)).unwrap_or(rest.len()) } else { c.len_utf8() };
        let word = &rest[..length];
        result += names.iter().find(|(old, _)| old == word).map_or(word, |(_, new)| new);
        rest = &rest[length..];
    }
    result
}

/// A sum as text, such as `a + b - c`.
pub fn signs(terms: impl Iterator<Item = String>) -> String {
    terms.collect::<Vec<_>>().join(" + ").replace("+ -", "- ")
}

fn long(count: usize) -> String {
    format!("[{count} terms]")
}
