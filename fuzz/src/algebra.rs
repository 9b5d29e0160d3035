//! Numbers, expressions, systems of polynomials.

use groebot::limits::{self, DIGITS, EXPRESSION_CHARACTERS, EXPRESSION_EXPONENT};
use groebot::number::parse_rational;
use groebot::poly::system::{Format, PolynomialSystem, parse_order};
use groebot::poly::{Expression, parse, parse_equation, parse_latex};

use super::{Target, check_refusal, check_shown, read, text};

pub(super) const TARGETS: [Target; 7] = [
    Target { name: "number", about: "`number::parse_rational`, `limits::number`", run: number, damaged: 300 },
    Target { name: "expression", about: "`poly::parse`, `poly::parse_equation`", run: expression, damaged: 300 },
    Target { name: "latex", about: "`poly::parse_latex`", run: latex, damaged: 300 },
    Target { name: "plain", about: "systems of polynomials in plain text", run: plain, damaged: 200 },
    Target { name: "singular", about: "systems of polynomials in Singular's format", run: singular, damaged: 200 },
    Target { name: "msolve", about: "systems of polynomials in msolve's format", run: msolve, damaged: 200 },
    Target { name: "order", about: "`poly::system::parse_order`", run: order, damaged: 300 },
];

/// Expansions with more terms are skipped, unless they are so large that they must be refused.
const TERMS: f64 = 200.0;
/// Expansions with more bits in a coefficient are also skipped.
const BITS: f64 = 10_000.0;

/// The text of a number is read as the same number.
fn number(bytes: &[u8]) {
    if let Some(number) = read(parse_rational(&text(bytes))) {
        // Longer numbers have no readable text.
        let written = number.to_string();
        if written.len() <= DIGITS {
            assert_eq!(parse_rational(&written), Ok(number));
        }
    }
    match limits::number(&text(bytes)) {
        Ok(number) => assert!(number.abs() <= limits::LARGEST),
        Err(words) => check_shown(&words),
    }
}

/// The text of an expression is read as the same tree.
fn expression(bytes: &[u8]) {
    let _ = read(parse_equation(&text(bytes)));
    if let Some(tree) = read(parse(&text(bytes))) {
        assert_eq!(parse(&tree.to_string()), Ok(tree));
    }
}

fn latex(bytes: &[u8]) {
    let _ = read(parse_latex(&text(bytes)));
}

fn plain(bytes: &[u8]) {
    system(bytes, Format::Plain);
}

fn singular(bytes: &[u8]) {
    system(bytes, Format::Singular);
}

fn msolve(bytes: &[u8]) {
    system(bytes, Format::Msolve);
}

/// The text of an order is read as the same order.
fn order(bytes: &[u8]) {
    if let Some(order) = read(parse_order(&text(bytes))) {
        assert_eq!(parse_order(&order.to_string()), Ok(order));
    }
}

/// The error for a system has a line and a column. A system that is read is written in each format, and its text is
/// read and written unchanged.
fn system(bytes: &[u8], format: Format) {
    let system = match PolynomialSystem::read_bytes(bytes, Some(format)) {
        Ok(system) => system,
        Err(error) => {
            assert!(error.place().line.is_some() && error.message().starts_with("column "), "{error}");
            return check_refusal(&error);
        }
    };
    let is_large = |tree: &Expression| tree.expansion_bound().terms > limits::EXPANSION_TERMS;
    let is_quick = |tree: &Expression| {
        let bound = tree.expansion_bound();
        bound.terms <= TERMS && bound.bits <= BITS
    };
    let trees = || system.polynomials.iter().map(|given| &given.expression);
    if trees().all(is_quick) {
        [Format::Plain, Format::Singular, Format::Msolve].into_iter().for_each(|format| print(&system, format));
    } else if trees().take_while(|tree| is_quick(tree) || is_large(tree)).any(is_large) {
        assert!(system.print(format).is_err(), "an expansion beyond the limit is printed");
    }
}

/// The text of a system is refused only if it exceeds the limits of powers, digits or length.
fn print(system: &PolynomialSystem, format: Format) {
    let Some(text) = read(system.print(format)) else { return };
    match PolynomialSystem::read(&text, Some(format)) {
        Ok(again) if again.heading == system.heading => assert_eq!(again.print(format).as_ref(), Ok(&text)),
        // msolve's format has no order, so the default order is written and read.
        Ok(again) => {
            assert_eq!(format, Format::Msolve);
            print(&again, format);
        }
        Err(error) => {
            let is_beyond = |tree: &Expression| {
                tree.degree_bound() > u64::from(EXPRESSION_EXPONENT)
                    || tree.expansion_bound().bits > 3.0 * DIGITS as f64
            };
            let trees = system.polynomials.iter().map(|given| &given.expression);
            assert!(trees.into_iter().any(is_beyond) || text.len() > EXPRESSION_CHARACTERS, "{error}\n{text}");
        }
    }
}
