//! groebot: closed-form, complete and proven inverse kinematics from Groebner bases.
#![cfg_attr(test, allow(missing_docs))]

pub mod error;
pub mod files;
pub mod watch;

pub mod number;
pub mod poly;

pub mod groebner;
pub mod roots;

pub mod document;

pub mod spatial;

pub mod kinematics;

pub mod derive;

pub mod solver;

#[cfg(feature = "cli")]
pub mod cli;
pub mod codegen;
pub mod witness;

pub use error::{Error, ErrorKind, Result};
pub use watch::Watch;
