//! Programs that are not well formed, each with one fault.

use crate::codegen::builder::*;
use crate::codegen::samples::{pan_tilt, wrist};
use groebot_ik::ErrorKind;
use groebot_ik::solver::{Case, Condition, JointValue, Operand, Program, Step};

#[track_caller]
fn refused(change: impl Fn(&mut Program), part: &str) {
    let mut program = wrist::program(true);
    program.validate().unwrap();
    change(&mut program);
    let error = program.validate().unwrap_err();
    assert_eq!(error.kind(), ErrorKind::BadValue);
    assert!(error.message().contains(part), "`{part}` is not in: {error}");
}

#[test]
fn unknowns_are_set_once_along_every_path() {
    refused(|program| drop(program.blocks.remove(1)), "`x3` is not defined here");
    refused(|program| program.blocks[1].cases[0].steps.truncate(2), "case `s2 = 0` does not set");
    refused(|program| program.blocks[1].cases[1].steps.clear(), "case `s2 = 0` does not set");
    refused(|program| program.blocks.swap(0, 1), "`x1` is not defined here");
    refused(
        |program| {
            let block = program.blocks[0].clone();
            program.blocks.push(block);
        },
        "unknown 0 is set twice",
    );
}

#[test]
fn registers_belong_to_their_block_and_case() {
    refused(|program| program.blocks[2].cases[0].pivot.as_mut().unwrap().value = Operand::Register(6), "`r6`");
    refused(
        |program| program.blocks[0].cases[0].steps.push(Step::Set { unknown: 2, value: Operand::Register(9) }),
        "`r9`",
    );
    refused(|program| program.blocks[2].code.swap(0, 1), "out of order");
    refused(|program| program.blocks[2].code.truncate(5), "`r5`");
}

#[test]
fn steps_have_what_they_need() {
    let sample = |values| Step::Sample { joint: JointValue::Plain(2), values };
    refused(|program| program.blocks[1].cases[1].steps[0] = sample(vec![]), "finite values");
    refused(|program| program.blocks[1].cases[1].steps[0] = sample(vec![f64::NAN]), "finite values");
    refused(
        |program| {
            let Step::Roots { typical, .. } = &mut program.blocks[0].cases[0].steps[2] else { panic!() };
            *typical = Some(unknown(5));
        },
        "`x5`",
    );
    refused(
        |program| {
            let Step::Roots { polynomials, .. } = &mut program.blocks[0].cases[0].steps[2] else { panic!() };
            polynomials.clear();
        },
        "no polynomial",
    );
    refused(|program| program.blocks[2].cases[0].open = true, "open case");
    refused(|program| program.blocks[1].cases[1].free = vec![3], "s2 = 0");
}

#[test]
fn the_whole_has_its_bounds() {
    refused(|program| program.capacity = 0, "capacity");
    refused(|program| program.capacity = 4097, "capacity");
    refused(|program| program.blocks.clear(), "blocks");
    refused(|program| program.blocks[1].cases[0].first_branch = usize::MAX, "generic");
    refused(|program| program.conditions = vec![Condition::Rotation(1)], "condition");
    refused(|program| program.conditions = vec![Condition::Unit(usize::MAX)], "condition");
    refused(|program| program.blocks[1].cases.retain(|case| case.open), "has only open cases");
    refused(
        |program| {
            for block in &mut program.blocks {
                block.cases[0].first_branch = 1 << 52;
            }
        },
        "branches",
    );
}

#[test]
fn a_single_block_may_have_open_cases_only() {
    let whole = pan_tilt::program();
    let gap = Case { steps: vec![], open: true, ..whole.blocks[0].cases[0].clone() };
    let mut block = whole.blocks[0].clone();
    block.cases = vec![gap];
    let program = Program { blocks: vec![block], capacity: 0, ..whole };
    program.validate().unwrap();
    assert_eq!(program.solve_numbers(&[0.6, 0.0, 0.8]).unwrap_err().kind(), ErrorKind::Unsupported);
    assert!(program.solve_numbers(&[0.0, 0.0, 1.0]).unwrap().is_empty());
}
