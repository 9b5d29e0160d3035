//! The chain model, its file formats (TOML, URDF, DH tables), forward kinematics, the screw solver and the numeric oracle.

mod chain;
mod chain_toml;
mod dh;
mod fk;
mod geometry;
mod ideal;
pub mod jacobian;
mod layout;
mod mimic;
mod numeric;
mod oracle;
mod screw;
mod tip;
mod turns;

use groebot_algebra::number::{BigRational, parse_rational};

/// The exact value of `text`.
pub fn exact(text: &str) -> BigRational {
    parse_rational(text).unwrap()
}

/// NAO's leg in the sagittal plane, the example of `docs/chain_toml.md`.
pub fn documented_example() -> String {
    let page = include_str!("../../../../docs/chain_toml.md");
    let block = page.split("```toml\n").nth(1).unwrap();
    block.split("```").next().unwrap().to_owned()
}
