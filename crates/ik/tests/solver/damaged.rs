//! Damaged files give an error or another program, never a panic.

use crate::codegen::samples::{pan_tilt, wrist};
use groebot_ik::ErrorKind;
use groebot_ik::solver::Program;

/// Solves a target if the program accepts one. Its result is not checked, because the program is arbitrary.
fn run(text: &str) -> bool {
    match Program::from_json(text) {
        Ok(program) => {
            let target = vec![0.0; program.inputs.len()];
            drop(program.solve_numbers(&target));
            let mut target = target;
            for (index, value) in target.iter_mut().enumerate() {
                *value = f64::from(u8::from(index % 4 == 0));
            }
            drop(program.solve_numbers(&target));
            true
        }
        Err(error) => {
            assert!(
                matches!(error.kind(), ErrorKind::Syntax | ErrorKind::BadValue | ErrorKind::Unsupported),
                "{error}"
            );
            false
        }
    }
}

#[test]
fn every_number_and_operand_of_a_file_replaced() {
    let mut accepted = 0;
    let mut tried = 0;
    for whole in [pan_tilt::program(), wrist::program(true)] {
        let text = whole.to_json();
        for (index, _) in text.match_indices(|c: char| c.is_ascii_digit()) {
            for replacement in ["7", "0", "99999999999999999999", "-1"] {
                let damaged = format!("{}{replacement}{}", &text[..index], &text[index + 1..]);
                accepted += usize::from(run(&damaged));
                tried += 1;
            }
        }
    }
    assert!(accepted > 100 && tried - accepted > 100, "{accepted} of {tried}");
}

#[test]
fn a_file_cut_short_says_the_line() {
    let text = wrist::program(false).to_json();
    for length in (0..text.len() - 2).step_by(97) {
        let error = Program::from_json(&text[..length]).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Syntax);
    }
    let error = Program::from_json(&text.replacen("\"blocks\"", "\"cases\"", 1)).unwrap_err();
    assert!(error.message().contains("blocks"), "{error}");
}
