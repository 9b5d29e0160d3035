//! From a plan to a solver: each step's equations become a [`Template`] with free symbols, proved on all strata, and the symbols
//! become code that computes their values from the target and the joints before.

mod template;

pub use template::{Form, Template};
