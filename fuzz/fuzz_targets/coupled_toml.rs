//! Coupled chains: `0_coupled.toml`, whose chains stand in the text itself.
#![no_main]

use std::path::Path;

use groebot::derive::coupled::CoupledChains;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let _ = CoupledChains::from_toml(text, Path::new("/nonexistent"));
});
