//! Derived solvers: `5_program.json`; what is read prints as text that reads the same.
#![no_main]

use groebot::solver::Program;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Ok(program) = Program::from_json(text) {
        assert_eq!(Program::from_json(&program.to_json()).map(|again| again.to_json()), Ok(program.to_json()));
    }
});
