//! Derived solvers, `solver::Program`, and their generated code.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("program_json", bytes));
