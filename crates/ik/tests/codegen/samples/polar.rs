//! A polar arm with a target in a rotated frame: a prismatic joint, cosine and sine parameters, three equations for two joints, and an unknown that is not a
//! joint.

use crate::codegen::builder::*;
use groebot_ik::solver::{Case, Checks, Operand, Preference, Program, Rule, Step, Unit};

const RHO: usize = 0;
const C: usize = 1;
const S: usize = 2;
const SQUARE: usize = 3;

pub fn program() -> Program {
    let mut code = Code::default();
    let (uu, ww) = (code.mul(parameter(0), parameter(0)), code.mul(parameter(1), parameter(1)));
    let value = code.add(uu, ww);
    let distance = Rule::Root { code: code.take(), value };
    Program {
        name: "polar".into(),
        about: None,
        tasks: vec![],
        given_joints: vec![],
        inputs: vec![input("u", Unit::Metre), input("alpha", Unit::Radian), input("w", Unit::Metre)],
        parameters: vec![
            rule("u", Rule::Input(0)),
            rule("w", Rule::Input(2)),
            rule("cos alpha", Rule::Cosine(1)),
            rule("sin alpha", Rule::Sine(1)),
            rule("d", distance),
        ],
        unknowns: ["rho", "c", "s", "square"].map(String::from).to_vec(),
        joints: vec![angle("turn", C, S), length("slide", RHO)],
        scale: 0.5,
        conditions: vec![],
        blocks: one_block(vec![generic(), at_pole()]),
        checks: checks(),
        preference: Some(Preference { unknown: RHO, greatest: true }),
        capacity: 5,
        isolated: None,
        nearby: false,
        described: None,
        redundancy: None,
    }
}

/// The point in the base's frame.
fn point(code: &mut Code) -> [Operand; 2] {
    let [u, w, ca, sa] = [0, 1, 2, 3].map(parameter);
    let (uc, ws) = (code.mul(u, ca), code.mul(w, sa));
    let (us, wc) = (code.mul(u, sa), code.mul(w, ca));
    [code.sub(uc, ws), code.add(us, wc)]
}

fn generic() -> Case {
    let mut code = Code::default();
    let [x, y] = point(&mut code);
    let square = code.mul(parameter(4), parameter(4));
    let minus_square = code.sub(constant(0.0), square);
    let start = code.take();
    // (c - x / rho) (c + 1), whose second root the check rejects unless it is a solution, or the plain linear polynomial.
    let ratio = code.div(x, unknown(RHO));
    let minus_ratio = code.sub(constant(0.0), ratio);
    let middle = code.sub(constant(1.0), ratio);
    let lead = code.sub(constant(1.0), constant(0.0));
    let inner = code.take();
    let minus_x = code.sub(constant(0.0), x);
    let s = code.div(y, unknown(RHO));
    Case {
        label: "generic */ \\".into(),
        guard_code: vec![],
        guards: vec![away("d", parameter(4), Operand::Magnitude)],
        steps: vec![
            Step::Compute(start),
            Step::Set { unknown: SQUARE, value: square },
            roots(RHO, vec![vec![minus_square, constant(0.0), constant(1.0)]]),
            Step::Compute(inner),
            Step::Compute(code.take()),
            roots(C, vec![vec![minus_x, unknown(RHO)], vec![minus_ratio, middle, lead]]),
            Step::Set { unknown: S, value: s },
        ],
        pivot: None,
        free: vec![],
        open: false,
        first_branch: 0,
    }
}

fn at_pole() -> Case {
    let values = [(RHO, 0.0), (C, 1.0), (S, 0.0), (SQUARE, 0.0)];
    Case {
        label: "d = 0".into(),
        guard_code: vec![],
        guards: vec![near("d", parameter(4), Operand::Magnitude)],
        steps: values.map(|(unknown, value)| Step::Set { unknown, value: constant(value) }).to_vec(),
        pivot: None,
        free: vec![0],
        open: false,
        first_branch: 4,
    }
}

fn checks() -> Checks {
    let mut code = Code::default();
    let [x, y] = point(&mut code);
    let [rho, c, s] = [RHO, C, S].map(unknown);
    let (rc, rs, rr) = (code.mul(rho, c), code.mul(rho, s), code.mul(rho, rho));
    let minus = [x, y, unknown(SQUARE), s, rs].map(|value| code.sub(constant(0.0), value));
    let first = code.equation(&[rc, minus[0]]);
    let second = code.equation(&[rs, minus[1]]);
    let third = code.equation(&[rr, minus[2]]);
    let by_slide = code.mul(constant(2.0), rho);
    Checks {
        code: code.take(),
        residuals: vec![first.0, second.0, third.0],
        scales: vec![first.1, second.1, third.1],
        jacobian: vec![vec![minus[4], c], vec![rc, s], vec![constant(0.0), by_slide]],
        short: Vec::new(),
    }
}
