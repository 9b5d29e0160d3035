//! Tests of `groebot::groebner`.

mod claims;
mod cover;
mod cover_points;
mod known;
mod limits;
mod random;
