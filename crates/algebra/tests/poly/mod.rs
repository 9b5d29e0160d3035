//! Tests of `groebot_algebra::poly`.

mod expression;
mod factorisation;
mod factors;
mod fractions;
mod gcd;
mod latex;
mod monomial;
mod parse;
mod print;
mod ring;
pub mod sparse;
mod system;
mod system_mutated;
mod system_refused;
mod trees;
mod univariate;
