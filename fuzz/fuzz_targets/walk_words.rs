//! Text descriptions of walks, `gait::words`.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("walk_words", bytes));
