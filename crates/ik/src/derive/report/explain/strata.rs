//! A tree of strata in a report: bases, the combinations of equations that prove them, and the remaining system where they are singular.

use super::algebra::signs;
use super::document::{Document, Line};
use crate::Result;
use crate::derive::describe;
use crate::derive::equations::certify::Certified;
use crate::derive::equations::setting::Setting;
use crate::derive::equations::tree::{Node, Outcome, Solved};
use crate::derive::equations::triangular::presented;
use groebot_algebra::number::{Ring, Style};

/// The maximum length of a printed combination, in characters.
const LONGEST: usize = 360;

/// The polynomials of a solved stratum as text `f = 0`, smallest unknown first.
pub fn stairs(solved: &Solved) -> Vec<String> {
    let polynomials = solved.triangular.stairs.iter().flat_map(|stair| &stair.polynomials);
    polynomials.map(|f| format!("{} = 0", presented(&solved.triangular.ring, f))).collect()
}

/// Adds the proof that `certified` is a Groebner basis of the equations, which the report calls `f1`, `f2`, ...
pub fn proof(page: &mut Document, setting: &Setting, certified: &Certified) -> Result<()> {
    let ring = certified.ring(setting)?;
    let mut left_out = 0;
    page.text("Made monic, the polynomials of the basis are these combinations of the equations:");
    for (index, (g, row)) in certified.basis.iter().zip(&certified.cofactors).enumerate() {
        let with = row.iter().enumerate().filter(|(_, cofactor)| !cofactor.is_zero());
        let terms = with.map(|(number, cofactor)| match ring.format(cofactor, Style::Decimal).as_str() {
            "1" => format!("f{}", number + 1),
            "-1" => format!("-f{}", number + 1),
            text => format!("{}*f{}", factor(text), number + 1),
        });
        let text = tidy(&format!("g{} = {} = {}", index + 1, ring.format(g, Style::Decimal), signs(terms)));
        if text.len() > LONGEST { left_out += 1 } else { page.display(text) }
    }
    if left_out > 0 {
        page.text(&format!("{left_out} more have long cofactors; they are in certificate.json."));
    }
    let proof = certified.proof;
    page.text(&format!(
        "So all of them are in the ideal of the equations ({} combinations were multiplied out), and the equations are in theirs \
         ({} remainders are zero). They are a Groebner basis by Buchberger's criterion: every S-polynomial reduces to zero (pairs: {}).",
        proof.cofactor_rows, proof.generators, proof.pairs
    ));
    Ok(())
}

/// `text` as a factor: in parentheses if it is a sum.
pub fn factor(text: &str) -> String {
    let mut depth = 0;
    let sum = text.char_indices().any(|(at, c)| {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        depth == 0 && at > 0 && matches!(c, '+' | '-') && text[..at].ends_with(' ')
    });
    if sum { format!("({text})") } else { text.to_owned() }
}

/// `text` without parentheses around a single name.
fn tidy(text: &str) -> String {
    let (mut rest, mut result) = (text, String::new());
    while let Some(at) = rest.find('(') {
        let (before, inner) = (&rest[..at], &rest[at + 1..]);
        let end = inner.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(inner.len());
        let single = end > 0 && inner[end..].starts_with(')') && !before.ends_with(char::is_alphabetic);
        let (name, length) = if single { (&inner[..end], end + 1) } else { ("(", 0) };
        result += before;
        result += name;
        rest = &inner[length..];
    }
    result + rest
}

/// Adds the behaviour where a denominator vanishes. `free` returns text that names the joints of a self-motion.
pub fn degenerate(page: &mut Document, tree: &Node, free: &dyn Fn(&Node) -> String) {
    let mut items = Vec::new();
    for node in tree.walk().into_iter().skip(1) {
        items.push(Line::of("Where ").formula(&node.label).and(&format!(": {}.", outcome(node, free))));
    }
    if !items.is_empty() {
        page.text("A basis whose coefficients are symbols has denominators. Where such a denominator vanishes, the equations have another basis:");
    }
    page.items(items);
    for node in tree.walk().into_iter().skip(1) {
        let Some(solved) = node.solved().filter(|solved| !solved.inherited) else { continue };
        page.paragraph(Line::of("Where ").formula(&node.label).and(" the basis is"));
        stairs(solved).into_iter().for_each(|stair| page.display(stair));
    }
    let never = |node: &Node| {
        let excluded = node.excluded.iter();
        excluded.map(|e| (e.factor.to_string(), e.reason.clone())).collect::<Vec<_>>()
    };
    let mut factors: Vec<(String, String)> = tree.walk().into_iter().flat_map(never).collect();
    factors.sort();
    factors.dedup();
    let line = |(factor, reason): (String, String)| {
        Line::of("The denominator ").formula(&factor).and(" is never zero: ").and(&reason).and(".")
    };
    page.items(factors.into_iter().map(line).collect());
}

fn outcome(node: &Node, free: &dyn Fn(&Node) -> String) -> String {
    match &node.outcome {
        Outcome::SelfMotion(_) => format!("every value solves the equations, {} free", free(node)),
        Outcome::Inconsistent(_) => "no solution: 1 is a combination of the equations".to_owned(),
        Outcome::Seen(_) => "the same equations as at a stratum above".to_owned(),
        _ => describe(node),
    }
}
