//! Groebner bases over any field.
//!
//! [`buchberger`] is the algorithm of NAO section 6.3, word for word; [`basis`] is the one to use. [`ideal`] asks questions of
//! a basis; [`verify`] proves one without trusting the engine.

pub mod buchberger;
mod division;
mod engine;
pub mod f4;
mod fglm;
pub mod ideal;
mod pairs;
pub mod parametric;
mod reduced;
pub mod verify;

pub use division::{Division, divide, normal_form, s_polynomial};
pub use engine::{Basis, Options, basis};
pub use f4::{Trace, f4};
pub use fglm::Quotient;
pub use pairs::Strategy;
pub use reduced::reduced_basis;
