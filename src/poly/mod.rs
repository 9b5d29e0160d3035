//! Algebraic expressions: their tree, text and LaTeX.

mod evaluate;
mod expression;
mod grammar;
mod latex;
mod parse;
mod token;

pub use evaluate::ExpansionBound;
pub use expression::Expression;
pub use grammar::{MAX_DEPTH, MAX_EXPONENT};
pub use latex::{latex_name, parse_latex};
pub use parse::{is_identifier, parse, parse_equation};
pub use token::MAX_LENGTH;
