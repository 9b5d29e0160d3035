//! Reach maps of solvers, `reach::ReachMap`.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("reach_json", bytes));
