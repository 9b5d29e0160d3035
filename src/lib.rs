//! groebot: closed-form, complete and proven inverse kinematics from Groebner bases.
#![cfg_attr(test, allow(missing_docs))]

pub mod document;
pub mod error;
pub mod kinematics;
pub mod number;
pub mod watch;

pub use error::{Error, ErrorKind, Result};
pub use watch::Watch;
