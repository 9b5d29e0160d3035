//! Real roots of univariate polynomials: exactly over Q ([`Sturm`]), and in `f64` without allocation ([`real_roots`]).
//!
//! The second is the method of generated solvers; the first is the witness that it is tested against.

mod isolate;
mod numeric;
mod polish;

pub use isolate::{Interval, Sturm, isolate, rounded_roots};
pub use numeric::{MAX_DEGREE, Roots, TANGENT, real_roots};
pub use polish::polish;
