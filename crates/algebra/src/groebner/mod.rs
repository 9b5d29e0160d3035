//! Groebner bases over any field, and computations with them.
//!
//! Which function for which task:
//!
//! | task | function | the result is |
//! | --- | --- | --- |
//! | a basis over any field, with cofactors on request | [`basis()`] | exact; Buchberger's algorithm with criteria |
//! | a basis modulo a prime, in any order | [`basis_modulo_prime`] | [`f4()`], then [`change_order`]; wrong with a probability below 2^-50 per block of rows |
//! | a basis over Q | [`modular::basis`] | [`modular::Status::Probable`]; [`modular::prove`] proves it |
//! | a basis over the rational functions of parameters | [`parametric::basis`] | for generic parameters; exact or tested, as reported |
//! | a basis for every value of the parameters | [`cover::cover`] | a list of strata; [`cover::check`] proves it |
//! | another order, elimination, a minimal polynomial | [`change_order`], [`Quotient`], [`WordQuotient`] | exact; dimension zero only |
//! | elimination in any dimension | [`ideal::eliminate`] | exact |
//! | dimension, degree, number of solutions | [`Basis::hilbert_series`], [`Basis::quotient_dimension`] | exact |
//! | all complex solutions as roots of one polynomial | [`univariate_representation()`] | proved over Q, given the basis |
//! | all real solutions in boxes | [`crate::real::solve`] | proved |
//!
//! [`buchberger`] is the algorithm of NAO section 6.3, line by line: the reference. [`verify`] proves a basis
//! independently of the engines. `docs/groebner.md` explains what each guarantee depends on.

pub mod buchberger;
pub mod cover;
mod division;
mod engine;
pub mod f4;
mod fglm;
mod goal;
mod hilbert;
mod homogeneous;
pub mod ideal;
pub mod modular;
mod pairs;
pub mod parametric;
mod prime_field;
mod reduced;
mod tracked;
mod univariate_representation;
pub mod verify;

pub use division::{Division, divide, normal_form, s_polynomial};
pub use engine::{Options, basis};
pub use f4::{Settings, Trace, f4, f4_with};
pub use fglm::{Quotient, WordQuotient, change_order};
pub use hilbert::HilbertSeries;
pub use homogeneous::{System, dehomogenise, hilbert_driven, homogenise};
pub use pairs::Strategy;
pub use prime_field::basis_modulo_prime;
pub use reduced::{Basis, reduced_basis};
pub use univariate_representation::{UnivariateRepresentation, univariate_representation};
