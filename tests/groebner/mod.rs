//! Tests of `groebot::groebner`.

mod claims;
mod families;
mod known;
mod limits;
mod random;
mod systems;
