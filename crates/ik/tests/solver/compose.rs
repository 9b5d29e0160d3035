//! Two programs on one actuator, composed into one.

use std::f64::consts::{FRAC_PI_2, PI};

use super::assert_joints;
use crate::codegen::builder::*;
use crate::codegen::samples::{pan_tilt, polar};
use groebot_ik::ErrorKind;
use groebot_ik::solver::{Block, Case, Checks, GivenJoint, Program, Rule, Step, Unit};

fn case(steps: Vec<Step>) -> Case {
    Case {
        label: "generic".into(),
        guard_code: vec![],
        guards: vec![],
        pivot: None,
        steps,
        free: vec![],
        open: false,
        first_branch: 0,
    }
}

/// A prismatic joint at `d = x cos(pan)`, with pan given.
fn slide() -> Program {
    let mut code = Code::default();
    let d = code.mul(parameter(2), unknown(0));
    let block = Block::numbered("d", code.take(), vec![case(vec![Step::Set { unknown: 2, value: d }])]);
    let set = |unknown| Step::Set { unknown, value: parameter(unknown) };
    let mut code = Code::default();
    let product = code.mul(parameter(2), unknown(0));
    let cosine = code.sub(unknown(0), parameter(0));
    let sine = code.sub(unknown(1), parameter(1));
    let position = code.sub(unknown(2), product);
    let fall = code.sub(constant(0.0), unknown(1));
    let slope = code.mul(parameter(2), unknown(1));
    let checks = Checks {
        code: code.take(),
        residuals: vec![cosine, sine, position],
        scales: vec![constant(1.0); 3],
        jacobian: vec![vec![fall, constant(0.0)], vec![unknown(0), constant(0.0)], vec![slope, constant(1.0)]],
        short: Vec::new(),
    };
    Program {
        name: "slide".into(),
        about: None,
        tasks: vec![],
        given_joints: vec![GivenJoint { joint: 0, input: 0 }],
        inputs: vec![input("pan", Unit::Radian), input("x", Unit::Metre)],
        conditions: vec![],
        parameters: vec![rule("c", Rule::Cosine(0)), rule("s", Rule::Sine(0)), rule("x", Rule::Input(1))],
        unknowns: ["c", "s", "d"].map(String::from).to_vec(),
        joints: vec![angle("pan", 0, 1), length("slide", 2)],
        scale: 2.0,
        blocks: vec![Block::numbered("pan", vec![], vec![case(vec![set(0), set(1)])]), block],
        checks,
        preference: None,
        capacity: 1,
        isolated: None,
        nearby: false,
        described: None,
        redundancy: None,
    }
}

fn both() -> Program {
    pan_tilt::program().followed_by(&slide().prefixed("b_"), &[(0, 0)]).unwrap()
}

#[test]
fn the_shared_actuator_stands_once_and_is_no_input() {
    let program = both();
    let inputs: Vec<&str> = program.inputs.iter().map(|input| input.name.as_str()).collect();
    assert_eq!(inputs, ["dx", "dy", "dz", "b_x"]);
    let joints: Vec<&str> = program.joints.iter().map(|joint| joint.name.as_str()).collect();
    assert_eq!(joints, ["pan", "tilt", "b_slide"]);
    assert_eq!(program.unknowns, ["h", "c1", "s1", "c2", "s2", "b_d"]);
    assert_eq!((program.parameters.len(), program.blocks.len(), program.checks.residuals.len()), (4, 3, 4));
    assert_eq!((program.scale, program.capacity), (2.0, 3));
    assert_eq!(Program::from_json(&program.to_json()).unwrap(), program);
}

/// Pan is 0 or pi, as in the test of the first program alone; the displacement is 0.7 or -0.7.
#[test]
fn the_second_program_runs_for_each_answer_of_the_first() {
    let answers = both().solve_numbers(&[0.6, 0.0, 0.8, 0.7]).unwrap();
    assert_eq!(answers.len(), 2, "{answers:?}");
    assert_joints(&answers[0], &[PI, 0.8_f64.atan2(-0.6), -0.7], 1e-15);
    assert_joints(&answers[1], &[0.0, 0.8_f64.atan2(0.6), 0.7], 1e-15);
}

/// For the direction straight up, pan is free; the displacement follows the reported member.
#[test]
fn a_free_shared_joint_stays_free() {
    let answers = both().solve_numbers(&[0.0, 0.0, 1.0, 0.7]).unwrap();
    assert_eq!(answers.len(), 1, "{answers:?}");
    assert_joints(&answers[0], &[0.0, FRAC_PI_2, 0.7], 1e-15);
    assert_eq!(answers[0].free, [0]);
}

/// Two prismatic joints on one actuator with one input `x`.
#[test]
fn inputs_of_one_name_are_one_input() {
    let mut next = slide().prefixed("b_");
    next.inputs[1].name = "x".into();
    let program = slide().followed_by(&next, &[(0, 0)]).unwrap();
    let inputs: Vec<&str> = program.inputs.iter().map(|input| input.name.as_str()).collect();
    assert_eq!(inputs, ["pan", "x"]);
    assert_eq!((program.parameters.len(), program.joints.len()), (3, 3));
    let answers = program.solve_numbers(&[0.3, 0.5]).unwrap();
    assert_eq!(answers.len(), 1, "{answers:?}");
    let reach = 0.5 * 0.3_f64.cos();
    assert_joints(&answers[0], &[0.3, reach, reach], 1e-15);
}

/// Without a shared actuator, all solutions of one program are combined with all of the other.
#[test]
fn without_shared_joints_the_answers_are_all_pairs() {
    let program = pan_tilt::program();
    let pairs = program.followed_by(&program.prefixed("b_"), &[]).unwrap();
    let (first, second) = (pan_tilt::direction(0.3, 0.4), pan_tilt::direction(-1.0, 0.2));
    let answers = pairs.solve_numbers(&[first, second].concat()).unwrap();
    assert_eq!(answers.len(), 4, "{answers:?}");
    for answer in &answers {
        for (q, target) in answer.q.chunks(2).zip([first, second]) {
            let reached = pan_tilt::direction(q[0], q[1]);
            assert!(reached.iter().zip(target).all(|(a, b)| (a - b).abs() < 1e-15), "{answer:?}");
        }
    }
    assert!(
        pairs.solve_numbers(&[first.as_slice(), &[0.0, 0.0, 1.5]].concat()).is_err(),
        "the second condition holds too"
    );
}

#[test]
fn what_cannot_be_shared_is_refused() {
    let program = pan_tilt::program();
    let refused = |next: &Program, shared: &[(usize, usize)]| {
        let error = program.followed_by(next, shared).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::BadValue);
        error.message().to_owned()
    };
    assert!(refused(&program, &[(0, 0)]).contains("`pan` is shared, but the next program finds it too"));
    assert!(refused(&slide(), &[(0, 1)]).contains("both must be revolute, or prismatic"));
    assert!(refused(&slide(), &[(2, 0)]).contains("no such joints"));
    assert!(refused(&slide(), &[(0, 2)]).contains("no such joints"));
    let mut odd = slide();
    odd.parameters[2].rule = Rule::Input(0);
    assert!(refused(&odd, &[(0, 0)]).contains("more than a shared joint"));
}

/// The nearest candidate of a polar arm whose position is outside its reachable ring, with a reachable displacement.
#[test]
fn the_nearest_candidate_is_none_where_there_are_only_answers() {
    assert_eq!(slide().nearest(&[0.3, 0.5]).unwrap(), None);
    assert!(polar::program().nearest(&[f64::NAN; 3]).is_err());
    let mut wrong = slide();
    wrong.checks.residuals[2] = constant(0.25);
    let nearest = wrong.nearest(&[0.3, 0.5]).unwrap().unwrap();
    assert_eq!((nearest.residual, nearest.relative), (0.25, 0.25));
    assert!((nearest.q[0] - 0.3).abs() < 0.3, "{nearest:?}");
}

/// The value of a given joint and a number with its name are two inputs.
#[test]
fn a_given_joint_is_no_number_of_its_name() {
    let mut next = slide();
    next.given_joints.clear();
    let program = slide().followed_by(&next, &[]).unwrap();
    let inputs: Vec<&str> = program.inputs.iter().map(|input| input.name.as_str()).collect();
    assert_eq!(inputs, ["pan", "x", "pan"]);
    assert_eq!(program.given_joints, [GivenJoint { joint: 0, input: 0 }]);
}
