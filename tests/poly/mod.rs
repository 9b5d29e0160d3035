//! Polynomials.

mod univariate;
