//! Groebner bases and real roots: the algebra of groebot. It knows no robot.

pub mod error;
pub mod escape;
pub mod limits;
pub mod watch;

pub mod number;
pub mod poly;

pub mod groebner;
pub mod roots;

pub mod real;

pub use error::{Error, ErrorKind, Result};
pub use watch::Watch;
