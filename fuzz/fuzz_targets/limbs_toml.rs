//! Limbs with shared joints: `limbs.toml`, whose chains stand in the text itself.
#![no_main]

use std::path::Path;

use groebot::derive::limbs::Limbs;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let _ = Limbs::from_toml(text, Path::new("/nonexistent"));
});
