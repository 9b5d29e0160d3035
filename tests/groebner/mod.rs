//! Tests of `groebot::groebner`.

mod claims;
mod known;
mod limits;
mod random;
mod univariate_representation;
