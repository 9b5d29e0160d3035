//! The grammar shared by plain text and LaTeX: recursive descent from tokens to an [`Expression`].

use std::fmt;

use super::Expression;
use super::token::{Kind, Token, syntax};
use crate::limits;
use crate::number::parse_rational;
use crate::{Error, Result};

/// Maximum nesting depth of parentheses, fractions and signs.
pub const MAX_DEPTH: usize = limits::EXPRESSION_DEPTH;
/// The largest exponent that the parser accepts.
pub(crate) const MAX_EXPONENT: u32 = limits::EXPRESSION_EXPONENT;

/// Notation of an expression.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Dialect {
    /// Products need `*`; exponents have no braces.
    Text,
    /// Products may be implied; exponents and fractions have braces.
    Latex,
}

/// Parser of tokens. The last token is [`Kind::End`] or a [`Kind::Delimiter`].
pub(super) struct Parser<'a> {
    tokens: Vec<Token<'a>>,
    next: usize,
    depth: usize,
    dialect: Dialect,
}

impl<'a> Parser<'a> {
    pub(super) fn new(tokens: Vec<Token<'a>>, dialect: Dialect) -> Self {
        Parser { tokens, next: 0, depth: 0, dialect }
    }

    /// Parses one expression with nothing after it.
    pub(super) fn whole(mut self) -> Result<Expression> {
        let expression = self.expression()?;
        self.end()?;
        Ok(expression)
    }

    /// Parses one expression, or two with `=` between them.
    pub(super) fn equation(mut self) -> Result<(Expression, Option<Expression>)> {
        self.depth = 1; // the right side is printed in parentheses
        let left = self.expression()?;
        let right = if self.take('=') { Some(self.expression()?) } else { None };
        self.end()?;
        Ok((left, right))
    }

    fn end(&self) -> Result<()> {
        match self.peek() {
            Kind::End | Kind::Delimiter(_) => Ok(()),
            Kind::Symbol('=') => Err(self.error("`=` is allowed once, between the two sides of an equation")),
            Kind::Symbol(')') => Err(self.error("`)` has no matching `(`; remove it or add a `(`")),
            found => Err(self.error(format!("an operator or the end expected, found `{found}`"))),
        }
    }

    fn expression(&mut self) -> Result<Expression> {
        let mut terms = vec![self.signed_term()?];
        while let Kind::Symbol('+' | '-') = self.peek() {
            terms.push(self.signed_term()?);
        }
        Ok(Expression::sum(terms))
    }

    fn signed_term(&mut self) -> Result<Expression> {
        let negative = self.take('-');
        if !negative {
            self.take('+');
        }
        let term = self.term()?;
        Ok(if negative { term.negated() } else { term })
    }

    fn term(&mut self) -> Result<Expression> {
        let mut factors = vec![self.factor()?];
        loop {
            if self.take('*') {
                factors.push(self.factor()?);
            } else if self.take('/') {
                factors.push(Expression::Inverse(Box::new(self.factor()?)));
            } else if self.implied_product()? {
                factors.push(self.power()?);
            } else {
                return Ok(Expression::product(factors));
            }
        }
    }

    /// Whether an operand follows an operand: a product in LaTeX, an error in plain text.
    fn implied_product(&self) -> Result<bool> {
        if !matches!(self.peek(), Kind::Number(_) | Kind::Name(_) | Kind::Fraction | Kind::Symbol('(')) {
            return Ok(false);
        }
        let before = &self.tokens[self.next - 1].kind;
        let digits_touch = matches!((before, self.peek()), (Kind::Number(_), Kind::Number(_)));
        match self.dialect {
            Dialect::Text => Err(self.error(format!("a product needs `*`; write `{before}*{}`", self.peek()))),
            Dialect::Latex if digits_touch => Err(self.error("`\\cdot` expected between two numbers")),
            Dialect::Latex => Ok(true),
        }
    }

    fn factor(&mut self) -> Result<Expression> {
        match self.peek() {
            Kind::Symbol('-') => self.nested(|parser| Ok(parser.factor()?.negated())),
            Kind::Symbol('+') => self.nested(Self::factor),
            _ => self.power(),
        }
    }

    fn power(&mut self) -> Result<Expression> {
        let base = self.primary()?;
        if !self.take('^') {
            return Ok(base);
        }
        let exponent = self.exponent()?;
        if *self.peek() == Kind::Symbol('^') {
            return Err(self.error("a power of a power needs parentheses; write `(x^2)^3`"));
        }
        Ok(base.power(exponent))
    }

    fn exponent(&mut self) -> Result<u32> {
        let braced = self.dialect == Dialect::Latex && self.take('{');
        let single = self.dialect == Dialect::Latex && !braced;
        let exponent = match self.peek() {
            Kind::Number(text) if single && text.len() > 1 => None,
            Kind::Number(text) if text.bytes().all(|b| b.is_ascii_digit()) => text.parse::<u32>().ok(),
            _ => None,
        };
        let Some(exponent) = exponent.filter(|&n| n <= MAX_EXPONENT) else {
            let form = if self.dialect == Dialect::Latex { ", in braces when it has several digits" } else { "" };
            let found = format!("found `{}`", self.peek());
            return Err(self.error(format!("an integer exponent from 0 to {MAX_EXPONENT} expected{form}, {found}")));
        };
        self.next += 1;
        if braced {
            self.expect('}')?;
        }
        Ok(exponent)
    }

    fn primary(&mut self) -> Result<Expression> {
        match self.peek().clone() {
            Kind::Number(text) => {
                let value = parse_rational(text).map_err(|error| self.error(error.message()))?;
                self.next += 1;
                Ok(Expression::Number(value))
            }
            Kind::Name(name) => {
                self.next += 1;
                Ok(Expression::Name(name))
            }
            Kind::Symbol('(') => self.nested(|parser| parser.closed_by(')')),
            Kind::Fraction => self.nested(Self::fraction),
            found => Err(self.error(format!("a number, a name, `(` or a sign expected, found `{found}`"))),
        }
    }

    fn fraction(&mut self) -> Result<Expression> {
        self.expect('{')?;
        let top = self.closed_by('}')?;
        self.expect('{')?;
        let bottom = self.closed_by('}')?;
        Ok(Expression::Product(vec![top, Expression::Inverse(Box::new(bottom))]))
    }

    fn closed_by(&mut self, close: char) -> Result<Expression> {
        let expression = self.expression()?;
        self.expect(close)?;
        Ok(expression)
    }

    /// Takes the next token and parses one level deeper.
    fn nested(&mut self, read: impl FnOnce(&mut Self) -> Result<Expression>) -> Result<Expression> {
        if self.depth == MAX_DEPTH {
            return Err(self.error(format!("nested deeper than {MAX_DEPTH}; define a name for a part of it")));
        }
        self.next += 1;
        self.depth += 1;
        let expression = read(self)?;
        self.depth -= 1;
        Ok(expression)
    }

    fn peek(&self) -> &Kind<'a> {
        &self.tokens[self.next].kind
    }

    fn take(&mut self, symbol: char) -> bool {
        let found = *self.peek() == Kind::Symbol(symbol);
        self.next += usize::from(found);
        found
    }

    fn expect(&mut self, symbol: char) -> Result<()> {
        if self.take(symbol) {
            return Ok(());
        }
        Err(self.error(format!("`{symbol}` expected, found `{}`", self.peek())))
    }

    fn error(&self, message: impl fmt::Display) -> Error {
        let token = &self.tokens[self.next];
        let error = syntax(token.column, message);
        if let Some(line) = token.line { error.at_line(line) } else { error }
    }
}
