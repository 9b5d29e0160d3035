//! Tests of `groebot::derive`.

mod renamed;
mod seed;
mod system;
mod system_toml;
