//! Tests of `groebot::groebner`.

mod claims;
mod known;
mod limits;
mod modular;
mod random;
