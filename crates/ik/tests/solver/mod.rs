//! The meaning of a program's blocks, pivots, samples and conditions, on programs with solutions computed by hand.

mod batch;
mod closest;
mod compose;
mod damaged;
mod derivatives;
mod described;
mod follow;
mod formats;
mod ordinary;
mod placed;
mod redundant;
mod redundant_batch;
mod redundant_closed;
mod redundant_closest;
mod redundant_corpus;
mod redundant_scanned;
mod refused;
mod task;

use std::f64::consts::{FRAC_PI_2, PI};

use crate::codegen::builder::*;
use crate::codegen::samples::{arm, pan_tilt, polar, wrist};
use groebot_ik::ErrorKind;
use groebot_ik::solver::{Block, Case, Checks, JointValue, Pivot, Program, Rule, Step, Unit};
use groebot_robot::kinematics::Solution;

fn close(a: f64, b: f64, tolerance: f64) -> bool {
    let turn = 2.0 * PI;
    (a - b - turn * ((a - b) / turn).round()).abs() <= tolerance
}

#[track_caller]
fn assert_joints(answer: &Solution, expected: &[f64], tolerance: f64) {
    let equal = answer.q.iter().zip(expected).all(|(a, b)| close(*a, *b, tolerance));
    assert!(equal && answer.q.len() == expected.len(), "{answer:?} instead of {expected:?}");
}

/// Pan is 0 or pi, tilt follows from a triangle of sides 3, 4, 5; the smaller root comes first.
#[test]
fn each_root_of_the_first_block_goes_through_the_second() {
    let answers = pan_tilt::program().solve_numbers(&[0.6, 0.0, 0.8]).unwrap();
    assert_eq!(answers.iter().map(|answer| answer.branch).collect::<Vec<_>>(), [0, 1]);
    assert_joints(&answers[0], &[PI, 0.8_f64.atan2(-0.6)], 1e-15);
    assert_joints(&answers[1], &[0.0, 0.8_f64.atan2(0.6)], 1e-15);
    assert!(answers.iter().all(|answer| answer.free.is_empty() && answer.residual <= 1e-15));
}

#[test]
fn straight_up_pan_is_free_and_the_first_sample_is_shown() {
    let answers = pan_tilt::program().solve_numbers(&[0.0, 0.0, 1.0]).unwrap();
    assert_eq!(answers.len(), 1, "{answers:?}");
    assert_joints(&answers[0], &[0.0, FRAC_PI_2], 1e-15);
    assert_eq!((answers[0].free.as_slice(), answers[0].branch), ([0].as_slice(), 2));
}

#[test]
fn the_wrist_has_two_answers_and_the_generating_joints_are_one() {
    let program = wrist::program(false);
    for k in 1..200 {
        let q = [0.77 * f64::from(k), 0.31 * f64::from(k), 1.13 * f64::from(k)];
        let answers = program.solve_numbers(&wrist::rotation(q)).unwrap();
        assert_eq!(answers.len(), 2, "{q:?}: {answers:?}");
        assert!(answers.iter().any(|answer| answer.q.iter().zip(q).all(|(a, b)| close(*a, b, 1e-13))), "{q:?}");
        let flipped = [q[0] + PI, -q[1], q[2] + PI];
        assert!(answers.iter().any(|answer| answer.q.iter().zip(flipped).all(|(a, b)| close(*a, b, 1e-13))), "{q:?}");
    }
}

/// With the middle joint straight, only the sum of the other joints is determined, for any rounding in the third column.
#[test]
fn a_straight_wrist_is_one_self_motion() {
    let program = wrist::program(false);
    for k in 0..60 {
        let q = [0.3 + f64::from(k), 0.0, 0.5 - 0.37 * f64::from(k)];
        let mut target = wrist::rotation(q);
        for (index, noise) in [(2, 1e-17), (5, -3e-17)] {
            target[index] = f64::from(k % 3) * noise;
        }
        let answers = program.solve_numbers(&target).unwrap();
        assert_eq!(answers.len(), 1, "{q:?}: {answers:?}");
        assert_eq!(answers[0].free, [0]);
        assert_joints(&answers[0], &[0.0, 0.0, q[0] + q[2]], 1e-12);
    }
}

/// Next to the pole, the sample `pan = 0` happens to be a solution. It is isolated, not a member of a self-motion.
#[test]
fn an_isolated_answer_at_a_sample_is_no_self_motion() {
    for small in [1e-4, 1e-8, 1e-10] {
        let answers = pan_tilt::program().solve_numbers(&pan_tilt::direction(0.0, FRAC_PI_2 - small)).unwrap();
        assert_eq!(answers.len(), 2, "{answers:?}");
        assert!(answers.iter().all(|answer| answer.free.is_empty()), "{answers:?}");
        assert!(answers.iter().any(|answer| close(answer.q[0], 0.0, 1e-15)), "{answers:?}");
    }
}

#[test]
fn close_to_a_straight_wrist_the_two_answers_are_isolated() {
    let program = wrist::program(false);
    for small in [1e-3, 1e-6, 1e-9] {
        let answers = program.solve_numbers(&wrist::rotation([0.4, small, 1.1])).unwrap();
        assert_eq!(answers.len(), 2, "{small}: {answers:?}");
        assert!(answers.iter().all(|answer| answer.free.is_empty()));
        assert!(answers.iter().any(|answer| close(answer.q[0], 0.4, 1e-15 / small)), "{small}: {answers:?}");
    }
}

/// Both values of `x` solve `(x - 1) (x - 2) = 0`; the result shows which case ran. The pivots are the inputs or their square roots.
fn choice(claims: [f64; 2], by_roots: bool) -> Vec<f64> {
    let mut code = Code::default();
    let x = unknown(0);
    let (a, b) = (code.sub(x, constant(1.0)), code.sub(x, constant(2.0)));
    let (product, slope) = (code.mul(a, b), code.add(a, b));
    let code = code.take();
    let checks = Checks {
        code,
        residuals: vec![product],
        scales: vec![constant(1.0)],
        jacobian: vec![vec![slope]],
        short: Vec::new(),
    };
    let root = |claim: usize| {
        let mut code = Code::default();
        (code.sqrt(parameter(claim)), code.take())
    };
    let claim = |claim| if by_roots { root(claim) } else { (parameter(claim), vec![]) };
    let case = |value: f64, index: usize| Case {
        label: format!("x = {value}"),
        guard_code: claim(index).1,
        guards: vec![],
        pivot: Some(Pivot { group: 0, value: claim(index).0 }),
        steps: vec![Step::Set { unknown: 0, value: constant(value) }],
        free: vec![],
        open: false,
        first_branch: 0,
    };
    let program = Program {
        name: "choice".into(),
        about: None,
        tasks: vec![],
        given_joints: vec![],
        inputs: vec![input("a", Unit::One), input("b", Unit::One)],
        conditions: vec![],
        parameters: (0..2).map(|i| rule(["a", "b"][i], Rule::Input(i))).collect(),
        unknowns: vec!["x".into()],
        joints: vec![length("x", 0)],
        scale: 1.0,
        blocks: vec![Block::numbered("x", vec![], vec![case(1.0, 0), case(2.0, 1)])],
        checks,
        preference: None,
        capacity: 1,
        isolated: None,
        nearby: false,
        described: None,
        redundancy: None,
    };
    program.validate().unwrap();
    program.solve_numbers(&claims).unwrap().iter().map(|answer| answer.q[0]).collect()
}

#[test]
fn of_a_pivot_group_the_case_with_the_greatest_magnitude_runs_and_the_first_of_equals() {
    assert_eq!(choice([3.0, 2.0], false), [1.0]);
    assert_eq!(choice([3.0, -4.0], false), [2.0]);
    assert_eq!(choice([-3.0, 3.0], false), [1.0]);
    assert_eq!(choice([0.0, 0.0], false), [1.0]);
}

#[test]
fn the_square_root_of_a_negative_number_is_zero() {
    assert_eq!(choice([-9.0, 0.0], true), [1.0]);
    assert_eq!(choice([-9.0, 1e-20], true), [2.0]);
    assert_eq!(choice([9.0, 10.0], true), [2.0]);
}

#[test]
fn cases_of_a_pivot_group_share_their_branch_numbers() {
    let block = &wrist::program(true).blocks[2];
    assert_eq!(block.cases.iter().map(|case| case.first_branch).collect::<Vec<_>>(), [0, 0, 1]);
    assert_eq!(block.branches(), 1);
    assert_eq!(wrist::program(true).blocks[1].branches(), 2);
    assert_eq!(arm::program().bound(), 4);
}

/// `R33 = 1/2`: the last block has a gap there. Choices of earlier blocks must not hide it.
#[test]
fn an_open_case_of_a_later_block_is_an_error() {
    let program = wrist::program(true);
    let error = program.solve_numbers(&wrist::rotation([0.2, PI / 3.0, 0.4])).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(error.message().contains("r33 = 1/2"), "{error}");
    assert_eq!(program.solve_numbers(&wrist::rotation([0.2, 1.0, 0.4])).unwrap().len(), 2);
}

#[test]
fn a_target_off_its_conditions_is_refused_by_name_and_measure() {
    let program = wrist::program(false);
    let exact = wrist::rotation([0.2, 0.3, 0.4]);
    let refused = |target: [f64; 9]| {
        let error = program.solve_numbers(&target).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::BadValue);
        error.message().to_owned()
    };
    let text = refused(exact.map(|value| value * 1.001));
    assert!(text.contains("`r11` to `r33`") && text.contains("2.0e-3") && text.contains("1e-9"), "{text}");
    assert!(refused(exact.map(|value| -value)).contains("determinant"));
    assert!(refused([f64::MAX; 9]).contains("differs"));
    let error = pan_tilt::program().solve_numbers(&[0.6, 0.0, 0.9]).unwrap_err();
    assert!(error.message().contains("`dx` to `dz` are not a unit vector"), "{error}");
}

/// A rotation with ten digits is not orthogonal to the last bit. The nearest rotation is solved.
#[test]
fn what_rounding_to_ten_digits_leaves_is_removed() {
    let q = [0.2, 0.3, 0.4];
    let rounded = wrist::rotation(q).map(|value| (value * 1e10).round() * 1e-10);
    let answers = wrist::program(false).solve_numbers(&rounded).unwrap();
    assert_eq!(answers.len(), 2);
    assert!(answers.iter().all(|answer| answer.residual <= 1e-15), "{answers:?}");
    assert!(answers.iter().any(|answer| answer.q.iter().zip(q).all(|(a, b)| close(*a, b, 1e-9))));
}

#[test]
fn too_small_a_capacity_keeps_the_best() {
    let whole = arm::program();
    let target = arm::tool([0.4, 0.5, 0.6]);
    let all = whole.solve_numbers(&target).unwrap();
    assert_eq!(all.len(), 4);
    let few = Program { capacity: 2, ..whole }.solve_numbers(&target).unwrap();
    assert_eq!(few.len(), 2);
    assert!(few.iter().all(|answer| all.contains(answer)));
}

#[test]
fn programs_survive_their_json() {
    for program in [pan_tilt::program(), wrist::program(true), arm::program(), polar::program()] {
        assert_eq!(Program::from_json(&program.to_json()).unwrap(), program);
    }
    let text = pan_tilt::program().to_json();
    for part in ["\"unit\": 0", "\"sample\"", "sqrt r2", "\"blocks\"", "\"conditions\""] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    assert!(wrist::program(false).to_json().contains("\"typical\": \"2.0\""));
}

/// A sample step of a prismatic joint uses the given lengths.
#[test]
fn a_plain_joint_is_sampled_at_its_own_values() {
    let mut program = polar::program();
    let steps = &mut program.blocks[0].cases[1].steps;
    steps[0] = Step::Sample { joint: JointValue::Plain(0), values: vec![0.25, 0.0] };
    program.validate().unwrap();
    let answers = program.solve_numbers(&[0.0, 0.3, 0.0]).unwrap();
    assert_eq!(answers.len(), 1);
    assert_eq!(answers[0].q, [0.0, 0.0]);
}
