//! The real roots of a polynomial of degree 4, 3 or 2, by its leading coefficient. Its names are intentionally difficult.

use crate::codegen::builder::*;
use groebot_ik::solver::{About, Case, Checks, Joint, JointValue, Program, Rule, Unit};

/// Coefficients of the monic polynomial with these roots, constant term first.
pub fn with_roots(roots: [f64; 4]) -> [f64; 5] {
    let mut line = [1.0, 0.0, 0.0, 0.0, 0.0];
    for root in roots {
        for i in (0..5).rev() {
            line[i] = if i > 0 { line[i - 1] } else { 0.0 } - root * line[i];
        }
    }
    line
}

pub fn program() -> Program {
    let names = ["r0", "double", "fn", "NAN", "p"];
    let joint = Joint { name: "\"t\" */ ??/ \\ \u{e4}".into(), unit: Unit::One, value: JointValue::Plain(0) };
    Program {
        name: "quartic".into(),
        about: Some(About { base: Some("*/ ??/".into()), ..About::default() }),
        tasks: vec![],
        given_joints: vec![],
        inputs: names.map(|name| input(name, Unit::One)).to_vec(),
        parameters: (0..5).map(|i| rule(names[i], Rule::Input(i))).collect(),
        unknowns: vec!["angle".into()],
        joints: vec![joint],
        scale: 1.0,
        conditions: vec![],
        blocks: one_block(vec![case()]),
        checks: checks(),
        preference: None,
        capacity: 4,
        isolated: None,
        nearby: false,
        described: None,
        redundancy: None,
    }
}

fn case() -> Case {
    let line = |length: usize| (0..length).map(parameter).collect::<Vec<_>>();
    let polynomials = vec![line(5), line(4), line(3)];
    let steps = vec![roots(0, polynomials)];
    let label = "generic".into();
    Case { label, guard_code: vec![], guards: vec![], steps, pivot: None, free: vec![], open: false, first_branch: 0 }
}

fn checks() -> Checks {
    let mut code = Code::default();
    let t = unknown(0);
    let mut powers = vec![constant(1.0)];
    for i in 0..4 {
        let next = code.mul(powers[i], t);
        powers.push(next);
    }
    let terms: Vec<_> = (0..5).map(|i| code.mul(parameter(i), powers[i])).collect();
    let (value, scale) = code.equation(&terms);
    let slopes: Vec<_> = (1..5).map(|i| code.product(&[constant(i as f64), parameter(i), powers[i - 1]])).collect();
    let slope = code.sum(&slopes);
    Checks {
        code: code.take(),
        residuals: vec![value],
        scales: vec![scale],
        jacobian: vec![vec![slope]],
        short: Vec::new(),
    }
}
