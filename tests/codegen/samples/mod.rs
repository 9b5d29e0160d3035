//! Programs written by hand.

pub mod arm;
pub mod leg;
pub mod polar;
pub mod quartic;
