//! Real roots of univariate polynomials: exactly over Q ([`Sturm`], and [`real_roots_of`] for high degrees), and in `f64`
//! without allocation ([`real_roots`]).
//!
//! The last is the method of generated solvers; the exact ones are the witnesses that it is tested against. [`refine()`] narrows an
//! exact root, [`sign_at_root`] tells the sign of another polynomial there.

mod descartes;
mod eigen;
mod isolate;
mod numeric;
mod polish;
pub(crate) mod quartic;
mod refine;
mod square_free;

pub use descartes::{RealRoot, isolate_square_free, real_roots_of};
pub use eigen::{Eigenvalue, Hessenberg};
pub use isolate::{Interval, Sturm, isolate, rounded_roots};
pub use numeric::{MAX_DEGREE, Roots, TANGENT, real_roots, square_roots};
pub use polish::polish;
pub use refine::{enclose, has_root, refine, sign_at_root};
pub use square_free::{gcd, square_free_parts};
