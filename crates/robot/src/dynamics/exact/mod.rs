//! Dynamics in exact polynomials in the cosines and sines of joint angles and the inertial parameters. Main type:
//! [`Symbolic`].

mod base_parameters;
mod certificate;
mod direction;
mod lagrange;
mod masses;
mod model;
mod number;
mod symbolic;

pub use base_parameters::BaseParameters;
pub use certificate::{Certificate, Proof};
pub use masses::masses;
pub(crate) use model::NUMBERS;
pub use model::{ExactModel, Masses};
pub use number::{Exact, Setting};
pub use symbolic::Symbolic;
