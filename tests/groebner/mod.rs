//! Tests of `groebot::groebner`.

mod claims;
mod f4;
mod known;
mod limits;
mod modular;
mod random;
