//! Names and their escaping, in messages, Markdown and generated code.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("names", bytes));
