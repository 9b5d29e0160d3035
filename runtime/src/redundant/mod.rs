//! Arms with one joint more than their task determines: seven joints and a pose, four and a position, six and a ray, five and a position with yaw.
//!
//! The solutions of a target are curves. Along a curve, joint values stay within limits until a joint reaches one of its limits. These end points are solutions
//! of at most `2n` problems in which one joint is given at a limit ([`Redundant::solve_given`]). Curves are traced from end point to end point, and each end
//! point belongs to one arc. Curves that touch no limit are searched at values of some joints.
//!
//! No function allocates. Equal targets have bitwise equal results on every machine.

#![allow(clippy::needless_range_loop, reason = "loops over whole columns, in the order of operations of the C version")]
#![allow(clippy::manual_clamp, reason = "NaN is handled as in the C version")]

mod along;
mod approach;
mod arcs;
mod arm;
mod best;
#[cfg(test)]
mod checks;
mod crossing;
mod elimination;
mod ends;
mod given;
mod goal;
mod links;
mod model;
mod seeds;
mod solve;
mod step;
mod trace;
mod turns;
mod within;

pub use along::{at, sample, sample_from};
pub use arcs::{Arc, End, Outcome, arcs};
pub use arm::{Arm, Given, Limits, MOST_JOINTS, MOST_SECTIONS, Member, Members, Q, Redundant, Section, Target, Task};
pub use best::{Best, Criterion, best, optima};
pub use given::solve_part;
pub use solve::SolveRedundant;
pub use turns::Span;
pub use within::{Within, any_within};
