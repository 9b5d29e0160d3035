//! All solutions within limits of a chain with one joint more than its task determines. Main types: [`RedundantSolver`], [`Arcs`].
//!
//! The solutions of a target are curves. [`RedundantSolver::arcs`] returns their parts within limits. The end points are computed by solvers with one joint
//! given; curves between them are followed numerically ([`groebot_runtime::redundant`]). Of a chain with more redundant joints, the ranges of some are scanned
//! ([`ScanningSolver`]).

mod arcs;
mod batch;
mod best;
mod closest;
mod limits;
mod path;
mod sampled;
mod scan_samples;
mod scanned;
mod scanned_path;
mod solver;
mod target;
mod turns;
mod within;

pub use arcs::{Absence, Arc, ArcEnd, Arcs};
pub use batch::BestByArc;
pub use best::{Best, Criterion};
pub use limits::JointLimits;
pub use path::{ArmJump, ArmPath, PathOptions};
pub use scanned::{Scanned, ScanningSolver};
pub use solver::RedundantSolver;
#[doc(hidden)]
pub use solver::arm;
pub use target::ArmTarget;
pub use turns::Turns;
pub use within::Within;
