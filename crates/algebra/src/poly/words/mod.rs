//! Polynomials on machine words: finite fields, dense univariate and packed sparse multivariate polynomials over them,
//! and conversions from and to the rationals. The modular gcd and the factorization use them.

pub mod convert;
pub mod dense;
mod extension;
mod field;
mod flat;
mod images;
mod integral;
mod quotient;
pub mod skeleton;

pub use extension::Extension;
pub use field::{Prime, WordField};
pub use flat::{Flat, Packing};
pub use images::{Images, primes};
pub use integral::{Integral, residue};
