//! Programs written by hand.

pub mod arm;
pub mod leg;
pub mod pan_tilt;
pub mod polar;
pub mod quartic;
pub mod wrist;
