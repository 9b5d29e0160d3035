//! Text descriptions of walks, `gait::step_commands`.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("walk_words", bytes));
