//! Tests of `groebot::derive`.

mod system;
mod system_toml;
