//! Printing of polynomials as text that the parser reads back, and as LaTeX.

use super::monomial::Monomial;
use super::ring::{Polynomial, PolynomialRing, Term};
use crate::number::{Field, Style};

/// `f` as a sum, greatest term first: `3/2*x^2*y - x + 1`.
pub(super) fn format_polynomial<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    style: Style,
) -> String {
    let mut text = String::new();
    for term in f.terms() {
        let (negative, body) = format_term(ring, term, style);
        match (text.is_empty(), negative) {
            (true, false) => {}
            (true, true) => text.push('-'),
            (false, false) => text.push_str(" + "),
            (false, true) => text.push_str(" - "),
        }
        text.push_str(&body);
    }
    if text.is_empty() { "0".to_owned() } else { text }
}

/// The sign of a term and its text without that sign.
fn format_term<F: Field>(ring: &PolynomialRing<F>, term: &Term<F::Element>, style: Style) -> (bool, String) {
    let powers = format_monomial(ring, &term.monomial, style);
    let coefficient = ring.field().format(&term.coefficient, style);
    let (negative, magnitude) = match coefficient.strip_prefix('-') {
        Some(rest) if !is_sum(&coefficient) => (true, rest),
        _ => (false, coefficient.as_str()),
    };
    let body = match (magnitude, powers.is_empty()) {
        (_, true) if is_sum(magnitude) => parenthesise(magnitude, style),
        (_, true) => magnitude.to_owned(),
        ("1", false) => powers,
        _ => {
            let factor = if is_sum(magnitude) { parenthesise(magnitude, style) } else { magnitude.to_owned() };
            format!("{factor}{}{powers}", times(style))
        }
    };
    (negative, body)
}

fn format_monomial<F: Field>(ring: &PolynomialRing<F>, monomial: &Monomial, style: Style) -> String {
    let exponents = ring.layout().exponents(monomial);
    let present = ring.variables().iter().zip(exponents).filter(|(_, exponent)| *exponent > 0);
    let power = |(name, exponent): (&String, u32)| match (style, exponent) {
        (Style::Text | Style::Decimal, 1) => name.clone(),
        (Style::Text | Style::Decimal, _) => format!("{name}^{exponent}"),
        (Style::Latex, 1) => super::latex_name(name),
        (Style::Latex, _) => format!("{}^{{{exponent}}}", super::latex_name(name)),
    };
    present.map(power).collect::<Vec<_>>().join(times(style))
}

fn times(style: Style) -> &'static str {
    match style {
        Style::Text | Style::Decimal => "*",
        Style::Latex => " ",
    }
}

/// `text` in parentheses.
pub(super) fn parenthesise(text: &str, style: Style) -> String {
    match style {
        Style::Text | Style::Decimal => format!("({text})"),
        Style::Latex => format!("\\left({text}\\right)"),
    }
}

/// Whether `text` is a sum at its top level: it has a sign after its first character, outside brackets.
pub(super) fn is_sum(text: &str) -> bool {
    let mut depth = 0usize;
    text.char_indices().any(|(index, c)| {
        match c {
            '(' | '{' => depth += 1,
            ')' | '}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        depth == 0 && index > 0 && matches!(c, '+' | '-')
    })
}
