//! Tests of `groebot::derive`.

mod certificate;
mod chains;
mod lift;
mod renamed;
mod seed;
mod strata;
mod system;
mod system_toml;
