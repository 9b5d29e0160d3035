//! Polynomials over any [`crate::number::Field`].

pub mod univariate;
