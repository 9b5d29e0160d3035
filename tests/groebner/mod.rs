//! Tests of `groebot::groebner`.

mod blocks;
mod claims;
mod known;
mod limits;
mod parametric;
mod random;
