//! Parser of plain-text expressions and equations: `L1*c2 + L2*s4 - pz = 0`.
//!
//! ```text
//! equation   = expression ["=" expression]
//! expression = ["+"|"-"] term {("+"|"-") term}
//! term       = factor {("*"|"/") factor}
//! factor     = ("+"|"-") factor | primary ["^" integer]
//! primary    = number | name | "(" expression ")"
//! number     = 12 | 102.9 | .5 | 1.5e-3        exact
//! name       = letter or "_", then letters, digits and "_"
//! ```
//!
//! So `-x^2` is `-(x^2)`. A product needs `*`. An exponent is an integer from 0 to [`MAX_EXPONENT`], and a power of a
//! power needs parentheses. Spaces, tabs and line ends separate tokens. Text is at most [`MAX_LENGTH`] bytes long and
//! parentheses and signs nest at most [`MAX_DEPTH`] deep.
//!
//! [`MAX_EXPONENT`]: super::MAX_EXPONENT [`MAX_LENGTH`]: super::MAX_LENGTH [`MAX_DEPTH`]: super::MAX_DEPTH

use std::str::FromStr;

use num_traits::Zero;

use super::Expression;
use super::grammar::{Dialect, Parser};
use super::token::{Cursor, Kind, Token};
use crate::{Error, Result};

/// Whether `text` is an identifier `[A-Za-z_][A-Za-z0-9_]*`.
pub fn is_identifier(text: &str) -> bool {
    text.chars().next().is_some_and(starts_name) && text.chars().all(continues_name)
}

/// Parses an expression without `=`.
///
/// # Errors
/// [`ErrorKind::Syntax`](crate::ErrorKind::Syntax) with the column (in characters, from 1) and what is allowed there.
pub fn parse(text: &str) -> Result<Expression> {
    Parser::new(tokens(text)?, Dialect::Text).whole()
}

/// Same as [`parse`], but the caller limits the length of the text.
///
/// # Errors
/// Those of [`parse`].
pub fn parse_long(text: &str) -> Result<Expression> {
    Parser::new(words(Cursor::at_start(text))?, Dialect::Text).whole()
}

impl FromStr for Expression {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        parse(text)
    }
}

impl TryFrom<String> for Expression {
    type Error = Error;

    fn try_from(text: String) -> Result<Self> {
        parse(&text)
    }
}

/// Parses `a = b` as the expression `a - b` (`a` alone when `b` is 0), and `a` without `=` as `a = 0`.
///
/// # Errors
/// Those of [`parse`]. A second `=`, or one inside parentheses, is refused.
pub fn parse_equation(text: &str) -> Result<Expression> {
    equation_of(tokens(text)?)
}

/// Same as [`parse_equation`], but the tokens are given.
pub(super) fn equation_of(tokens: Vec<Token<'_>>) -> Result<Expression> {
    let (left, right) = Parser::new(tokens, Dialect::Text).equation()?;
    Ok(match right {
        None => left,
        Some(Expression::Number(zero)) if zero.is_zero() => left,
        Some(right) => difference(left, right),
    })
}

fn difference(left: Expression, right: Expression) -> Expression {
    let terms_of = |side| if let Expression::Sum(terms) = side { terms } else { vec![side] };
    let negated = |term| if let Expression::Negation(a) = term { *a } else { term.negated() };
    let mut terms = terms_of(left);
    terms.extend(terms_of(right).into_iter().map(negated));
    Expression::Sum(terms)
}

pub(super) fn starts_name(c: char) -> bool {
    c.is_ascii_alphabetic() || c == '_'
}

pub(super) fn continues_name(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

fn tokens(text: &str) -> Result<Vec<Token<'_>>> {
    words(Cursor::new(text)?)
}

fn words(mut cursor: Cursor<'_>) -> Result<Vec<Token<'_>>> {
    let mut tokens = Vec::new();
    while let Some(c) = cursor.peek_after_space() {
        let column = cursor.column();
        let kind = match c {
            '0'..='9' | '.' => Kind::Number(number(&mut cursor)),
            c if starts_name(c) => Kind::Name(cursor.take_while(continues_name).to_owned()),
            '+' | '-' | '*' | '/' | '^' | '(' | ')' | '=' => Kind::Symbol(cursor.take_one()),
            _ => return Err(cursor.unknown_character("numbers, names, `+ - * / ^ ( )` and, in an equation, `=`")),
        };
        tokens.push(Token { line: None, column, kind });
    }
    tokens.push(Token { line: None, column: cursor.column(), kind: Kind::End });
    Ok(tokens)
}

/// Scans digits and points, then an exponent if `e` or `E` is followed by one. The number is validated later.
pub(super) fn number<'a>(cursor: &mut Cursor<'a>) -> &'a str {
    let start = cursor.mark();
    cursor.take_while(|c| c.is_ascii_digit() || c == '.');
    let end = cursor.mark();
    if cursor.take_if(|c| c == 'e' || c == 'E') {
        cursor.take_if(|c| c == '+' || c == '-');
        if cursor.take_while(|c| c.is_ascii_digit()).is_empty() {
            cursor.reset(end);
        }
    }
    cursor.since(start)
}
