//! Robots in SDF, written in all formats.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("sdf", bytes));
