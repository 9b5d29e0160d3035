//! Complete reports: derived programs pass, damaged ones fail.

use groebot_ik::Watch;
use groebot_ik::derive::equations::compile::compile;
use groebot_ik::solver::{Instruction, Operand, Operation, Program, Step};
use groebot_ik::witness::{Fault, Kind, Options, Verdict, check_equations};

use super::{assert_passes, check, derive, from_text, read, two_link_text};

#[test]
fn the_seed_mechanisms_pass_in_both_orders() {
    for folder in ["nao_leg_sagittal", "nao_arm_planar"] {
        let source = read(folder);
        let derivation = derive(&source);
        let requested =
            compile(&source.system.clone().unwrap(), &derivation.equations().unwrap().method.requested).unwrap();
        for program in [derivation.program(), &requested] {
            let report = assert_passes(&source, program, 150);
            let summary = report.summary();
            println!("{folder}: {summary}");
            assert_eq!(summary.rows, 150);
            assert_eq!(summary.exact, 40);
            assert_eq!(summary.oracle, 10);
            assert_eq!(summary.screw, if source.chain.is_some() { 150 } else { 0 });
        }
    }
}

#[test]
fn a_report_has_all_kinds_of_rows_and_the_same_bytes_every_time() {
    let source = read("nao_leg_sagittal");
    let program = derive(&source).program().clone();
    let report = check(&source, &program, 60);
    for wanted in [Kind::Random, Kind::Boundary, Kind::Far] {
        assert!(report.rows.iter().any(|row| row.kind == wanted), "no row is {wanted}");
    }
    assert!(report.rows.iter().any(|row| matches!(row.kind, Kind::Stratum(_))));
    assert!(report.rows.iter().any(|row| row.kind == Kind::Far && row.solutions == 0 && row.oracle == Some(0)));
    assert_eq!(report.to_csv(), check(&source, &program, 60).to_csv());
    assert_eq!(report.to_csv().lines().count(), 61);
    let heading = "kind,px,pz,HipPitch,KneePitch,solutions,exact,screw,oracle,worst_residual,nearest,verdict";
    assert_eq!(report.to_csv().lines().next(), Some(heading));
}

#[test]
fn equal_lengths_pass_with_the_self_motion_at_the_base() {
    let source = from_text(&two_link_text("100", "200"));
    let report = assert_passes(&source, derive(&source).program(), 150);
    let at_base = report.rows.iter().filter(|row| row.target == [0.0, 0.0]);
    assert!(at_base.clone().count() > 0, "no row is the base");
    assert!(at_base.clone().all(|row| row.solutions == 1 && row.screw == Some(1)));
}

/// NAO (6.7.12), (6.7.13) with the lengths as parameters that are assumed positive.
const SYMBOLIC: &str = r#"
name = "symbolic_leg"
[[parameter]]
name = "px"
[[parameter]]
name = "pz"
[[parameter]]
name = "L1"
positive = true
[[parameter]]
name = "L2"
positive = true
[[joint]]
name = "hip"
cosine = "c3"
sine = "s3"
[[joint]]
name = "knee"
cosine = "c4"
sine = "s4"
[[equation]]
equation = "L2*(s3*c4 + c3*s4) + L1*s3 - px = 0"
[[equation]]
equation = "L2*(c3*c4 - s3*s4) + L1*c3 - pz = 0"
"#;

#[test]
fn symbolic_lengths_pass() {
    let source = from_text(SYMBOLIC);
    assert_passes(&source, derive(&source).program(), 150);
}

const THREE: &str = r#"
name = "three_revolute"
[task]
kind = "planar_pose"
plane = "xy"
[[joint]]
name = "a"
type = "revolute"
axis = [0, 0, 1]
point = [0, 0, 0]
[[joint]]
name = "b"
type = "revolute"
axis = [0, 0, 1]
point = [0.5, 0, 0]
[[joint]]
name = "c"
type = "revolute"
axis = [0, 0, 1]
point = [0.9, 0, 0]
[tip]
point = [1.1, 0, 0]
"#;

const SLIDING: &str = r#"
name = "turn_and_slide"
[task]
kind = "planar_position"
plane = "xy"
[[joint]]
name = "turn"
type = "revolute"
axis = [0, 0, 1]
point = [0, 0, 0]
[[joint]]
name = "slide"
type = "prismatic"
axis = [1, 0, 0]
point = [0, 0, 0]
[tip]
point = [0.5, 0.2, 0]
"#;

#[test]
#[ignore = "its derivation takes minutes"]
fn a_planar_pose_of_three_joints_passes() {
    let source = from_text(THREE);
    let start = std::time::Instant::now();
    let program = derive(&source).program().clone();
    println!("derived in {:?}, {} cases", start.elapsed(), program.cases().count());
    let report = assert_passes(&source, &program, 100);
    println!("{}", report.summary());
    assert_eq!(report.summary().exact, 0, "a cosine of a double is not rational");
}

#[test]
fn a_prismatic_chain_passes() {
    let source = from_text(SLIDING);
    let report = assert_passes(&source, derive(&source).program(), 100);
    println!("{}", report.summary());
    assert_eq!(report.summary().exact, 40);
}

#[test]
fn a_wrong_length_is_found() {
    let source = read("nao_leg_sagittal");
    let other = from_text(&two_link_text("100", "203"));
    let report = check(&source, derive(&other).program(), 20);
    let faults = faults(&report.rows[0].verdict);
    assert!([Fault::Residual, Fault::Missing, Fault::Screw, Fault::Oracle].iter().all(|f| faults.contains(f)));
    assert!(report.failures().count() >= 15);
    assert!(report.to_csv().contains("FAIL"));
}

fn faults(verdict: &Verdict) -> Vec<Fault> {
    match verdict {
        Verdict::Fail(faults) => faults.clone(),
        _ => Vec::new(),
    }
}

/// The program without one of its cases.
fn without(program: &Program, case: usize) -> Program {
    let mut program = program.clone();
    program.blocks[0].cases.remove(case);
    program.capacity = program.cases().map(Program::branches).sum();
    program
}

#[test]
fn a_case_that_is_left_out_is_missed() {
    let seed = read("nao_leg_sagittal");
    let equal = from_text(&two_link_text("100", "200"));
    let requested =
        compile(&seed.system.clone().unwrap(), &derive(&seed).equations().unwrap().method.requested).unwrap();
    let labels: Vec<&str> = requested.cases().map(|case| case.label.as_str()).collect();
    assert!(labels.contains(&"pz = 0"), "{labels:?}");
    for (source, program) in [(&seed, requested), (&equal, derive(&equal).program().clone())] {
        for (index, case) in program.cases().enumerate() {
            println!("{}: {}", source.system.clone().unwrap().name, case.label);
            let report = check(source, &without(&program, index), 150);
            let missed = report.failures().filter(|row| faults(&row.verdict).contains(&Fault::Missing)).count();
            assert!(missed > 0, "nobody misses the case `{}`", case.label);
        }
    }
}

#[test]
fn a_lost_root_is_found() {
    let source = read("nao_leg_sagittal");
    let mut program = derive(&source).program().clone();
    for case in &mut program.blocks[0].cases {
        for step in &mut case.steps {
            if let Step::Roots { polynomials, .. } = step {
                // Without its highest coefficient, a quadratic has one root, which is wrong.
                for coefficients in polynomials {
                    coefficients.pop();
                }
            }
        }
    }
    program.capacity = program.cases().map(Program::branches).sum();
    assert!(check(&source, &program, 20).failures().count() > 10);
}

/// Every sign of the equations' code is changed, one at a time.
#[test]
fn a_changed_sign_in_the_equations_is_found() {
    let source = read("nao_leg_sagittal");
    let program = derive(&source).program().clone();
    let residuals = program.checks.residuals.clone();
    let used: Vec<usize> = (0..program.checks.code.len())
        .filter(|&index| feeds(&program.checks.code, index, &residuals))
        .filter(|&index| swapped(program.checks.code[index].operation).is_some())
        .collect();
    assert!(!used.is_empty());
    for index in used {
        let mut damaged = program.clone();
        let instruction = &mut damaged.checks.code[index];
        instruction.operation = swapped(instruction.operation).unwrap();
        assert!(
            check(&source, &damaged, 20).failures().count() > 0,
            "{instruction:?} is not missed",
            instruction = damaged.checks.code[index]
        );
    }
}

fn swapped(operation: Operation) -> Option<Operation> {
    match operation {
        Operation::Add(a, b) => Some(Operation::Sub(a, b)),
        Operation::Sub(a, b) => Some(Operation::Add(a, b)),
        _ => None,
    }
}

/// Whether one of the results depends on register `index`.
fn feeds(code: &[Instruction], index: usize, results: &[Operand]) -> bool {
    let mut tainted = vec![false; code.len()];
    for instruction in code {
        let (a, b) = instruction.operation.operands();
        let reads = |operand: Operand| matches!(operand, Operand::Register(r) if tainted[r]);
        tainted[instruction.target] = instruction.target == index || reads(a) || b.is_some_and(reads);
    }
    results.iter().any(|result| matches!(result, Operand::Register(r) if tainted[*r]))
}

#[test]
fn a_program_of_another_mechanism_is_refused() {
    let (leg, symbolic) = (read("nao_leg_sagittal"), from_text(SYMBOLIC));
    let program = derive(&symbolic).program().clone();
    let error = check_equations(&leg, &program, &Options::default(), &Watch::none()).unwrap_err();
    assert_eq!(error.kind(), groebot_ik::ErrorKind::BadValue);
}
