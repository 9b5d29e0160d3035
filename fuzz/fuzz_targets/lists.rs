//! Lists of options: targets, joint values, furniture.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("lists", bytes));
