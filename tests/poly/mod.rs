//! Tests of `groebot::poly`.

mod expression;
mod latex;
mod parse;
mod trees;
mod univariate;
