//! Tests of `groebot::groebner`.

mod blocks;
mod claims;
mod f4;
mod families;
mod fglm;
mod hilbert;
mod homogeneous;
mod cover;
mod cover_points;
mod known;
mod limits;
mod modular;
mod parametric;
mod random;
mod systems;
mod univariate_representation;
