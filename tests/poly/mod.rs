//! Tests of `groebot::poly`.

mod expression;
mod latex;
mod parse;
mod trees;
//! Polynomials.

mod univariate;
