//! Equations of a mechanism: `system.toml`.
#![no_main]

use groebot::derive::System;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let _ = System::from_toml(text);
});
