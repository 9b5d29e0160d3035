//! Splitting polynomials into coprime, square-free and irreducible factors.

mod coprime;

pub use coprime::{refine_factors, square_free_factors};
