//! Polynomials: packed monomials and their orders, sparse rings over any field, gcd, factorization, rational functions.
//!
//! [`PolynomialRing`] is a ring as a value, and [`Polynomial`] is its plain data. [`Fractions`] is the field of
//! rational functions of the parameters. [`Expression`] is the text of a user before expansion. [`gcd()`] and
//! [`factor()`] compute modulo primes on machine words (`words`) and prove their results by division. [`system`] reads
//! and prints systems in the formats of `groebot basis`.

mod arithmetic;
mod evaluate;
mod expression;
mod factor;
mod fractions;
mod gcd;
mod grammar;
mod latex;
mod maps;
mod monomial;
mod order;
mod parse;
mod print;
mod ring;
mod root;
pub mod system;
mod token;
pub mod univariate;
mod words;

pub use evaluate::ExpansionBound;
pub use expression::Expression;
pub use factor::{Factorisation, factor, refine_factors, square_free_factors};
pub use fractions::{Fraction, Fractions};
pub use gcd::gcd;
pub use grammar::MAX_DEPTH;
pub use latex::{latex_name, parse_latex};
pub use monomial::{Layout, Monomial, Width};
pub use order::{Block, Order};
pub use parse::parse_long;
pub use parse::{is_identifier, parse, parse_equation};
pub use ring::{Polynomial, PolynomialRing, Term};
pub use root::{rational_root, square_root};
pub use token::MAX_LENGTH;
