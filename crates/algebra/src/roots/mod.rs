//! Real roots of univariate polynomials: exactly over Q ([`Sturm`], and [`real_roots_of`] for high degrees), and in
//! `f64` as in the run time ([`real_roots`]).
//!
//! The exact methods test the floating-point one. [`refine()`] narrows an exact root; [`sign_at_root`] computes the
//! sign of another polynomial there.

mod descartes;
mod isolate;
mod refine;
mod square_free;

pub use groebot_runtime::roots::{MAX_DEGREE, real_roots};
/// A critical point with `|p| <= TANGENT sum |a_i y^i|` counts as a root, `y` being the larger of `|x|` and the unknown's typical size.
#[doc(hidden)]
pub const TANGENT: f64 = groebot_runtime::tolerances::ROOTS.tangent;

pub use descartes::{RealRoot, isolate_square_free, real_roots_of};
pub use isolate::{Interval, Sturm, isolate, rounded_roots};
pub(crate) use refine::{enclose, has_root};
pub use refine::{refine, sign_at_root};
pub use square_free::{gcd, square_free_parts};
