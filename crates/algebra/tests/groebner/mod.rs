//! Tests of `groebot_algebra::groebner`.

mod blocks;
mod cancellation;
mod claims;
mod cover;
mod cover_points;
mod f4;
mod families;
mod fglm;
mod hilbert;
mod homogeneous;
mod known;
mod limits;
mod modular;
mod modular_by_degree;
mod parametric;
mod random;
mod systems;
mod univariate_representation;
