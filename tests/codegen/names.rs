//! Any names: words of the languages, of their libraries and of the printed files themselves.

use std::collections::BTreeSet;

use super::builder::*;
use super::harness::compare;
use super::samples::{pan_tilt, quartic, wrist};
use groebot::codegen;
use groebot::solver::{Case, Checks, Joint, JointValue, Program, Rule, Step, Unit};

/// Every word of a printed file, comments included.
fn words(text: &str) -> BTreeSet<String> {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
        .filter(|word| !word.is_empty())
        .map(str::to_owned)
        .collect()
}

/// A program whose parameters and unknowns have these names, all of which the equation reads: `t + sum x_i - sum p_i = 0`.
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
