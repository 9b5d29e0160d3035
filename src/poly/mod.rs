//! Polynomials: packed monomials and their orders, sparse rings over any field, gcd, rational functions.
//!
//! [`PolynomialRing`] is a ring as a value, [`Polynomial`] its plain data; [`Fractions`] is the field of
//! rational functions of the parameters.

mod factor;
mod fractions;
mod gcd;
mod monomial;
mod order;
mod print;
mod ring;

pub use factor::{refine_factors, square_free_factors};
pub use fractions::{Fraction, Fractions};
pub use gcd::gcd;
pub use monomial::{Layout, Monomial, Width};
pub use order::{Block, Order};
pub use ring::{Polynomial, PolynomialRing, Term};

/// Until the expression reader lands.
fn latex_name(name: &str) -> String { name.to_owned() }
