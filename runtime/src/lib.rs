//! Run time of inverse kinematics: the code that runs on a robot with solvers that the package `groebot` derives.
//!
//! The robot's own file, printed by `groebot codegen --lang rust`, has the program as straight-line code and implements [`Mechanism`]. [`Solve`] then provides
//! all solutions of a target. Each is verified by forward kinematics, at singular poses and on self-motions too. It also provides joint limits and turns,
//! cosines and sines, and batches in the lanes of vector registers. Solving allocates nothing and has no state. Equal targets have bitwise equal solutions on
//! every machine.
//!
//! Without the feature `std` (on by default) the crate needs `core` and the C library's `sqrt`.
#![cfg_attr(not(feature = "std"), no_std)]

pub mod angles;
mod answers;
mod approach;
mod arithmetic;
mod batch;
pub mod conditions;
mod connection;
pub mod counters;
mod curve;
mod curve_steps;
pub mod derivatives;
mod described;
mod double;
pub mod dynamics;
mod effort;
mod exactly;
mod freedom;
mod joints;
mod keep;
pub mod lanes;
pub mod limits;
mod measure;
pub mod mechanism;
mod members;
mod nearest;
mod newton;
mod normal;
pub mod number;
mod order;
pub mod ordinary;
mod placement;
mod problem;
mod quartic;
pub mod redundant;
mod refine;
pub mod registers;
pub mod roots;
mod self_motion;
mod singly;
pub mod six_axes;
mod solution;
pub mod solve;
#[cfg(feature = "sources")]
pub mod sources;

mod rejected;
mod starts;
mod steps;
pub mod storage;
#[doc(hidden)]
pub mod tolerances;
mod triangle;
pub mod trigonometry;

pub use effort::MOST_STEPS;
pub use lanes::Lanes;
pub use mechanism::{Candidates, Condition, Facts, Found, Joint, Mechanism, Preference, Reached, Short, rarely};
pub use number::{Guard, Number, With};
pub use placement::{Placement, target_of};
pub use solution::{Error, Pairs, Solution};
pub use solve::Solve;
pub use storage::Fixed;
