//! groebot: closed-form, complete and proven inverse kinematics from Groebner bases.
#![cfg_attr(test, allow(missing_docs))]

pub mod error;
pub mod groebner;
pub mod files;
pub mod number;
pub mod poly;
pub mod roots;
pub mod kinematics;
pub mod number;
pub mod spatial;
pub mod watch;

pub use error::{Error, ErrorKind, Result};
pub use watch::Watch;
