//! Any input file of `derive`, `derive::Source`.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("input", bytes));
