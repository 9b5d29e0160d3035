#![doc = include_str!("../README.md")]

// The modules in dependency order: each uses only those above it.

// One error type: a kind, a location, and a message with the allowed values.
pub mod error;
// Escaping of untrusted text in messages.
pub mod escape;
// Limits of all readers and options, in one table.
pub mod limits;
// Deterministic pseudorandom numbers.
pub mod random;
// Progress, cancellation and budgets of long computations.
pub mod watch;

// Exact numbers: rings and fields as values.
pub mod number;
// Polynomials: orders, parser, printer, gcd, factorization, rational functions.
pub mod poly;

// Groebner bases: Buchberger, F4, FGLM, modular, parametric.
pub mod groebner;
// Real roots of univariate polynomials.
pub mod roots;

// All real solutions of a zero-dimensional system.
pub mod real;

pub use error::{Error, ErrorKind, Result};
pub use watch::Watch;
