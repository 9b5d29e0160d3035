//! Tasks of a mechanism, `derive::Ends`.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("task_toml", bytes));
