//! Arbitrary names: reserved words of the languages, of their libraries and of the printed files.

use std::collections::BTreeSet;
use std::fs;

use super::builder::*;
use super::harness::{compare, compile_c, compile_solver, rustc, write_pair};
use super::samples::{pan_tilt, quartic, wrist};
use super::{ikfast, stored};
use groebot_ik::codegen::{self, c99::Pair, dynamics, ikfast::Options};
use groebot_ik::solver::{Case, Checks, Joint, JointValue, Program, Rule, Step, Unit};
use groebot_robot::dynamics::{Base, Equations};
use groebot_robot::model::Robot;

/// Every word of a printed file, including comments.
fn words(text: &str) -> BTreeSet<String> {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
        .filter(|word| !word.is_empty())
        .map(str::to_owned)
        .collect()
}

/// A program whose parameters and unknowns have these names. Its equation reads all of them: `t + sum x_i - sum p_i = 0`.
fn named(names: &[String]) -> Program {
    let mut code = Code::default();
    let count = names.len();
    let mut terms: Vec<_> = (0..=count).map(unknown).collect();
    for i in 0..count {
        terms.push(code.sub(constant(0.0), parameter(i)));
    }
    let (value, scale) = code.equation(&terms);
    let checks = Checks {
        code: code.take(),
        residuals: vec![value],
        scales: vec![scale],
        jacobian: vec![vec![constant(1.0)]],
        short: Vec::new(),
    };
    let mut steps: Vec<Step> = (0..=count)
        .map(|i| Step::Set { unknown: i, value: if i < count { parameter(i) } else { constant(0.0) } })
        .collect();
    steps.push(Step::Compute(vec![]));
    let (label, guards) = ("all".into(), vec![away("1", constant(1.0), constant(1.0))]);
    let case =
        Case { label, guard_code: vec![], guards, steps, pivot: None, free: vec![], open: false, first_branch: 0 };
    let joint = Joint { name: "t".into(), unit: Unit::One, value: JointValue::Plain(count) };
    Program {
        name: "names".into(),
        about: None,
        tasks: vec![],
        given_joints: vec![],
        inputs: vec![input("a", Unit::One)],
        parameters: names.iter().map(|name| rule(name, Rule::Input(0))).collect(),
        unknowns: names.iter().cloned().chain(["t".into()]).collect(),
        joints: vec![joint],
        scale: 1.0,
        conditions: vec![],
        blocks: one_block(vec![case]),
        checks,
        preference: None,
        capacity: 1,
        isolated: None,
        nearby: false,
        described: None,
        redundancy: None,
    }
}

#[test]
fn every_word_of_a_printed_file_is_a_possible_name() {
    let mut names = BTreeSet::new();
    for program in [quartic::program(), wrist::program(true), pan_tilt::program()] {
        names.extend(words(&codegen::rust::emit(&program)));
        names.extend(words(&codegen::c99::Pair::new(&program, "names").source));
    }
    names.extend(words("while async gen dyn Self None Some union register restrict inline asm typeof bool unix linux"));
    names.extend(words(
        "INFINITY NULL M_PI DBL_MAX errno isnan fabs r12 roots3 choice0_1 i7 __x _y 9 q0 EXTRAS NONE_FREE",
    ));
    names.extend(["c 1", "c_1", "\u{3b8}", "a-b", "a+b", "??/", "*/"].map(str::to_owned));
    let names: Vec<String> = names.into_iter().collect();
    assert!(names.len() > 200);
    let targets: Vec<Vec<f64>> = (0..10).map(|i| vec![f64::from(i) - 4.5]).collect();
    for names in names.chunks(700) {
        compare(&named(names), &targets);
    }
}

#[test]
fn names_that_are_words_stay() {
    let text = codegen::rust::emit(&named(&["px".into(), "KneeCosine".into()]));
    assert!(text.contains("[px, KneeCosine]"), "{text}");
    assert!(text.contains("let KneeCosine_ = KneeCosine;"), "unknowns are apart from parameters: {text}");
}

/// Names of robots that C, C++, Rust, their libraries or the run time reserve, or whose prefix is reserved, and some that are not words.
const ROBOTS: &str = "class new int _x std main fn Self NULL M errno gb Gb groebot Groebot groebot_six_axes groebot_redundant groebot_dynamics 9 r\u{f6}b";

/// C of two files and of one, C++ that includes the header, C++ for IKFast's callers, and Rust.
#[test]
fn a_robot_may_have_any_name() {
    let stored = stored::named(&["planar_2r"]).remove(0);
    for name in ROBOTS.split_whitespace() {
        let program = Program { name: name.to_owned(), ..stored.program.clone() };
        let folder = ikfast::folder(&program, &Options::default());
        let write = |file: &str, text: &str| fs::write(folder.path().join(file), text).unwrap();
        write_pair(folder.path(), &Pair::new(&program, "5_solver"));
        let main = "#include \"5_solver.h\"\nint main(void) { return 0; }\n";
        write("main.c", main);
        write("header.cpp", main);
        write("single.c", &codegen::single_file::c(&program, "single.c", false));
        write("5_solver.rs", &codegen::rust::emit(&program));
        let runtime = format!("-I{}", super::harness::c_runtime().display());
        let compiled = compile_solver(&program, folder.path(), &[], "c99")
            .and_then(|()| compile_c(folder.path(), &["-fsyntax-only", "single.c"]))
            .and_then(|()| ikfast::compile(folder.path(), &["-std=c++11", "-fsyntax-only", &runtime, "header.cpp"]))
            .and_then(|()| ikfast::compile(folder.path(), &["-std=c++17", "-fsyntax-only", "5_ikfast.cpp"]))
            .and_then(|()| rustc(folder.path(), &["--crate-type=lib", "--emit=metadata", "5_solver.rs"]));
        if compiled.is_none() {
            return;
        }
    }
}

/// The same test for equations of motion, whose joints have such names too.
#[test]
fn a_robot_of_equations_of_motion_may_have_any_name() {
    let names: Vec<&str> = ROBOTS.split_whitespace().collect();
    let described = include_str!("../../../../tests/corpus/dynamics/rrp.urdf");
    for (place, name) in names.iter().enumerate() {
        let mut parts = Robot::from_urdf(described).unwrap().parts().clone();
        parts.name = (*name).to_owned();
        parts
            .joints
            .iter_mut()
            .enumerate()
            .for_each(|(joint, own)| own.name = names[(place + joint) % names.len()].to_owned());
        parts.actuators.clear();
        let robot = Robot::new(parts).unwrap();
        let equations = Equations::unchecked(&robot, Base::Fixed).unwrap().without_friction();
        let functions = vec![dynamics::Function::Inverse];
        let form = dynamics::Form::Straight;
        let printed =
            dynamics::Printed { name: robot.name(), equations: &equations, remarks: Vec::new(), functions, form };
        let folder = tempfile::tempdir().unwrap();
        let write = |file: &str, text: &str| fs::write(folder.path().join(file), text).unwrap();
        let [header, source] = printed.c99("motion").unwrap();
        write("motion.h", &header);
        write("motion.c", &source);
        write("main.cpp", "#include \"motion.h\"\nint main() { return 0; }\n");
        write("motion.rs", &printed.rust().unwrap());
        let runtime = format!("-I{}", super::harness::c_runtime().display());
        let compiled = compile_c(folder.path(), &["-c", "motion.c"])
            .and_then(|()| ikfast::compile(folder.path(), &["-std=c++11", "-fsyntax-only", &runtime, "main.cpp"]))
            .and_then(|()| rustc(folder.path(), &["--crate-type=lib", "--emit=metadata", "motion.rs"]));
        if compiled.is_none() {
            return;
        }
    }
}
