//! All solutions within limits of a chain with one joint more than its task determines.

mod data;

pub use data::{Redundancy, RedundantPart};
