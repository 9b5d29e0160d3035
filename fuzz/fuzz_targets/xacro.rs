//! Descriptions in xacro, `model::xacro::expand`.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("xacro", bytes));
