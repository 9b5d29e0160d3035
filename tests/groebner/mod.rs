//! Tests of `groebot::groebner`.

mod claims;
mod f4;
mod fglm;
mod hilbert;
mod homogeneous;
mod families;
mod known;
mod limits;
mod modular;
mod random;
mod systems;
