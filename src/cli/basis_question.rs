//! The question about a system of polynomials ([`Question`]): the basis, its ring, and the required certainty.

use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::Rationals;
use groebot_algebra::poly::system::{Format, Heading, PolynomialSystem};
use groebot_algebra::poly::{Block, Order};

/// The required properties of a basis.
pub struct Required<'a> {
    /// The order of monomials; by default that of the system.
    pub order: Option<Order>,
    pub eliminated: &'a [String],
    pub format: Format,
    pub certificate: bool,
    /// Whether a probabilistic result is excluded.
    pub prove: bool,
}

/// The question.
pub struct Question {
    pub system: PolynomialSystem,
    /// The ring to compute in: eliminated variables first.
    pub working: Heading,
    /// The ring of the answer.
    pub target: Heading,
    pub eliminated: Vec<String>,
    pub format: Format,
    pub certificate: bool,
    /// Whether a probabilistic result is excluded.
    pub prove: bool,
}

impl Question {
    /// Builds the question for the basis of `system`.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] and [`ErrorKind::DuplicateName`] for names to eliminate; [`ErrorKind::BadValue`] when
    /// none is left, or the order does not cover the remaining ones; [`ErrorKind::Unsupported`] when `format` cannot
    /// represent the answer.
    pub fn new(system: PolynomialSystem, required: Required<'_>) -> Result<Question> {
        let Required { order, eliminated, format, certificate, prove } = required;
        check_eliminated(&system.heading, eliminated)?;
        let kept = system.heading.variables.iter().filter(|name| !eliminated.contains(name));
        let target = Heading { variables: kept.cloned().collect(), ..system.heading.clone() };
        let order = match (order, &system.heading.order) {
            (Some(order), _) => order,
            (None, Order::Block(_)) if !eliminated.is_empty() => Order::GrevLex,
            (None, order) => order.clone(),
        };
        let target = target.with_order(order).map_err(|error| error.with_context("--order"))?;
        let working = working_heading(&target, eliminated);
        target.print(format, &target.ring(Rationals)?, &[])?;
        Ok(Question { system, working, target, eliminated: eliminated.to_vec(), format, certificate, prove })
    }
}

fn check_eliminated(heading: &Heading, eliminated: &[String]) -> Result<()> {
    let fail = |kind, text: String| Err(Error::new(kind, text).with_context("--eliminate"));
    let known = heading.variables.join(", ");
    for (index, name) in eliminated.iter().enumerate() {
        if !heading.variables.contains(name) {
            return fail(ErrorKind::UnknownName, format!("`{name}` is not a variable; the variables are {known}"));
        }
        if eliminated[..index].contains(name) {
            return fail(ErrorKind::DuplicateName, format!("`{name}` is named twice; name each variable once"));
        }
    }
    if eliminated.len() == heading.variables.len() {
        return fail(ErrorKind::BadValue, "no variable would remain; eliminate fewer".to_owned());
    }
    Ok(())
}

/// The ring with the eliminated variables in a graded block of their own before those of `target`.
fn working_heading(target: &Heading, eliminated: &[String]) -> Heading {
    if eliminated.is_empty() {
        return target.clone();
    }
    let size = target.variables.len();
    let rest = match &target.order {
        Order::GrevLex => vec![Block { size, graded: true }],
        Order::Lex => vec![Block { size, graded: false }],
        Order::Block(blocks) => blocks.clone(),
    };
    let front = Block { size: eliminated.len(), graded: true };
    Heading {
        variables: [eliminated, &target.variables].concat(),
        order: Order::Block([vec![front], rest].concat()),
        ..target.clone()
    }
}
