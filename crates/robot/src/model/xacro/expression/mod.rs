//! Expressions in `${...}`: the part of Python that descriptions in xacro use. Main function: [`evaluate`].
//!
//! Integers have up to 38 digits. A number with a point or an exponent is a double, as in Python, and is printed with
//! the shortest text that reads as the same double.

mod evaluate;
mod functions;
mod lexer;
mod methods;
mod operators;
mod parser;
mod syntax;
mod value;

pub use evaluate::{Context, evaluate};
pub use functions::eval_function;
pub use lexer::syntax as syntax_error;
pub use methods::insert;
pub use value::{Value, parse_float, parse_int};
