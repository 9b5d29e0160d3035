//! Maps from rows of characters, and of the Moving AI lab.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("map_text", bytes));
