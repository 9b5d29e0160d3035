//! Arguments, one per line, `cli::readers::command_line`.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("command_line", bytes));
