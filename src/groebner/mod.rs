//! Groebner bases over any field.
//!
//! [`buchberger`] is the algorithm of NAO section 6.3, word for word; [`basis`] is the one to use. [`ideal`] asks questions of
//! a basis; [`verify`] proves one without trusting the engine.

pub mod buchberger;
pub mod cover;
mod division;
mod engine;
pub mod f4;
mod fglm;
mod hilbert;
mod homogeneous;
pub mod ideal;
pub mod modular;
mod pairs;
mod prime_field;
pub mod parametric;
mod reduced;
mod univariate_representation;
pub mod verify;

pub use division::{Division, divide, normal_form, s_polynomial};
pub use engine::{Basis, Options, basis};
pub use f4::{Settings, Trace, f4, f4_with};
pub use fglm::{Quotient, WordQuotient, change_order};
pub use hilbert::HilbertSeries;
pub use homogeneous::{System, dehomogenise, hilbert_driven, homogenise};
pub use pairs::Strategy;
pub use prime_field::basis_modulo_prime;
pub use reduced::reduced_basis;
pub use univariate_representation::{UnivariateRepresentation, univariate_representation};
