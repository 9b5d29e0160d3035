//! Tasks in JSON, `sim::TaskRecord`.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("task_json", bytes));
