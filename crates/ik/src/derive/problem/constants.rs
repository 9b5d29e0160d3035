//! The `[constants]` of a system. Exact values replace their names; irrational square roots remain names.

use std::collections::HashMap;

use num_traits::Signed;

use crate::derive::problem::system_parts::{Parameter, ParameterSource};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::{BigRational, Rationals};
use groebot_algebra::poly::{Expression, is_identifier, parse, rational_root};
use groebot_robot::document::Node;

/// The maximum number of bits of a rational constant.
const MAX_BITS: f64 = groebot_algebra::limits::CONSTANT_BITS as f64;
/// The maximum number of parts: of a constant with square roots, and of an equation after its constants are replaced.
const MAX_PARTS: (usize, usize) = (groebot_algebra::limits::CONSTANT_PARTS, groebot_algebra::limits::EQUATION_PARTS);

/// The constants that are read so far, with their values.
#[derive(Default)]
pub(in crate::derive) struct Constants {
    values: HashMap<String, Expression>,
    /// The square roots, each with its line.
    pub(in crate::derive) roots: Vec<(Parameter, usize)>,
}

impl Constants {
    /// Whether `name` is a constant.
    pub(in crate::derive) fn has(&self, name: &str) -> bool {
        self.values.contains_key(name)
    }

    /// Reads one constant: a number, an expression in earlier constants, or `{ square = ... }`.
    pub(in crate::derive) fn read(&mut self, node: &Node<'_>) -> Result<()> {
        if !is_identifier(node.name()) {
            let text = "not a valid name for a constant; give letters, digits and `_`, no digit first";
            return Err(node.error(ErrorKind::BadValue, text));
        }
        let value = match node.table() {
            Ok(table) => {
                table.deny_unknown(&["square"])?;
                self.root(node, self.value(&table.required("square")?)?)?
            }
            Err(_) => self.value(node)?,
        };
        self.values.insert(node.name().to_owned(), value);
        Ok(())
    }

    /// The positive root of `square`: a number if the root is rational, otherwise a new parameter.
    fn root(&mut self, node: &Node<'_>, square: Expression) -> Result<Expression> {
        if let Expression::Number(q) = &square
            && let Some(root) = rational_root(q).filter(Signed::is_positive)
        {
            return Ok(Expression::Number(root));
        }
        let name = node.name().to_owned();
        let square = Some(canonical(&square).map_err(|error| node.place(error))?);
        self.roots.push((Parameter { name: name.clone(), source: ParameterSource::SquareRoot, square }, node.line()));
        Ok(Expression::Name(name))
    }

    fn value(&self, node: &Node<'_>) -> Result<Expression> {
        let Ok(text) = node.text() else { return node.exact().map(Expression::Number) };
        let written = parse(text).map_err(|error| node.place(error))?;
        if let Some(name) = written.names().into_iter().find(|name| !self.has(name)) {
            let text =
                format!("`{}` is not an earlier constant; declare it above", groebot_robot::document::shown(name));
            return Err(node.error(ErrorKind::UnknownName, text));
        }
        let value = self.put_in(&written, MAX_PARTS.0).map_err(|error| node.place(error))?;
        if !value.names().is_empty() {
            return Ok(value);
        }
        rational(&value).map(Expression::Number).map_err(|error| node.place(error))
    }

    /// `expression` with its constants replaced by their values, as the tree that the parser builds from its text.
    pub(in crate::derive) fn apply(&self, expression: Expression) -> Result<Expression> {
        if !expression.names().into_iter().any(|name| self.has(name)) {
            return Ok(expression);
        }
        canonical(&self.put_in(&expression, MAX_PARTS.1)?).map_err(|error| error.with_context("with its constants"))
    }

    fn put_in(&self, expression: &Expression, limit: usize) -> Result<Expression> {
        let mut parts = 0;
        expression.visit(&mut |node| {
            parts += match node {
                Expression::Name(name) => self.values.get(name).map_or(1, count_parts),
                _ => 1,
            }
        });
        if expression.names().is_empty() || parts <= limit {
            return Ok(expression.substitute(&|name| self.values.get(name).cloned()));
        }
        let text = format!("with its constants it has more than {limit} parts; shorten it");
        Err(Error::new(ErrorKind::Overflow, text))
    }
}

fn count_parts(expression: &Expression) -> usize {
    let mut parts = 0;
    expression.visit(&mut |_| parts += 1);
    parts
}

fn canonical(expression: &Expression) -> Result<Expression> {
    parse(&expression.to_string())
}

fn rational(expression: &Expression) -> Result<BigRational> {
    if expression.expansion_bound().bits > MAX_BITS {
        let text = format!("the constant may take more than {MAX_BITS:.0} bits; shorten it");
        return Err(Error::new(ErrorKind::Overflow, text));
    }
    expression.evaluate(&Rationals)
}
