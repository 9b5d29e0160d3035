//! Robots in MJCF, written in all formats.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("mjcf", bytes));
