//! Equations of a mechanism, `derive::System`.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("system_toml", bytes));
