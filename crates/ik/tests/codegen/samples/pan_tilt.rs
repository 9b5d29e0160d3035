//! A camera that points along a direction: two blocks, pan and tilt, and a self-motion where it points straight up or down.

use std::f64::consts::FRAC_PI_4;

use crate::codegen::builder::*;
use groebot_ik::solver::{Block, Case, Checks, Condition, JointValue, Program, Rule, Step, Unit};
use groebot_robot::kinematics::Task;

const H: usize = 0;
const C1: usize = 1;
const S1: usize = 2;
const C2: usize = 3;
const S2: usize = 4;

/// The direction of the camera.
pub fn direction(pan: f64, tilt: f64) -> [f64; 3] {
    [tilt.cos() * pan.cos(), tilt.cos() * pan.sin(), tilt.sin()]
}

pub fn program() -> Program {
    let names = ["dx", "dy", "dz"];
    Program {
        name: "pan_tilt".into(),
        about: None,
        tasks: tip(Task::Direction),
        given_joints: vec![],
        inputs: names.map(|name| input(name, Unit::One)).to_vec(),
        conditions: vec![Condition::Unit(0)],
        parameters: (0..3).map(|i| rule(names[i], Rule::Input(i))).collect(),
        unknowns: ["h", "c1", "s1", "c2", "s2"].map(String::from).to_vec(),
        joints: vec![angle("pan", C1, S1), angle("tilt", C2, S2)],
        scale: 1.0,
        blocks: vec![pan(), tilt()],
        checks: checks(),
        preference: None,
        capacity: 3,
        isolated: None,
        nearby: false,
        described: None,
        redundancy: None,
    }
}

/// `h^2 = dx^2 + dy^2`, and the direction of the point `(dx, dy) / h`.
fn pan() -> Block {
    let mut code = Code::default();
    let (dx, dy) = (parameter(0), parameter(1));
    let (xx, yy) = (code.mul(dx, dx), code.mul(dy, dy));
    let square = code.add(xx, yy);
    let block_code = code.take();
    let size = code.sqrt(square);
    let guard_code = code.take();
    let minus_square = code.sub(constant(0.0), square);
    let before = code.take();
    let (c1, s1) = (code.div(dx, unknown(H)), code.div(dy, unknown(H)));
    let generic = Case {
        label: "generic".into(),
        guard_code: guard_code.clone(),
        guards: vec![away("dx^2 + dy^2", square, constant(1.0))],
        pivot: None,
        steps: vec![
            Step::Compute(before),
            roots(H, vec![vec![minus_square, constant(0.0), constant(1.0)]]),
            Step::Compute(code.take()),
            Step::Set { unknown: C1, value: c1 },
            Step::Set { unknown: S1, value: s1 },
        ],
        free: vec![],
        open: false,
        first_branch: 0,
    };
    let values = (0..8).map(|k| f64::from(k) * FRAC_PI_4).collect();
    let pole = Case {
        label: "dx = dy = 0".into(),
        guard_code,
        guards: vec![near("sqrt(dx^2 + dy^2)", size, constant(1.0))],
        pivot: None,
        steps: vec![
            Step::Set { unknown: H, value: constant(0.0) },
            Step::Sample { joint: JointValue::Angle { cosine: C1, sine: S1 }, values },
        ],
        free: vec![0],
        open: false,
        first_branch: 0,
    };
    Block::numbered("pan", block_code, vec![generic, pole])
}

/// The direction in the panned frame.
fn tilt() -> Block {
    let mut code = Code::default();
    let (first, second) = (code.mul(unknown(C1), parameter(0)), code.mul(unknown(S1), parameter(1)));
    let along = code.add(first, second);
    let case = Case {
        label: "generic".into(),
        guard_code: vec![],
        guards: vec![],
        pivot: None,
        steps: vec![Step::Set { unknown: C2, value: along }, Step::Set { unknown: S2, value: parameter(2) }],
        free: vec![],
        open: false,
        first_branch: 0,
    };
    Block::numbered("tilt", code.take(), vec![case])
}

fn checks() -> Checks {
    let mut code = Code::default();
    let [c1, s1, c2, s2] = [C1, S1, C2, S2].map(unknown);
    let (cc, cs) = (code.mul(c2, c1), code.mul(c2, s1));
    let minus = [0, 1, 2].map(|i| code.sub(constant(0.0), parameter(i)));
    let equations = [(cc, minus[0]), (cs, minus[1]), (s2, minus[2])].map(|(a, b)| code.equation(&[a, b]));
    let minus_cs = code.sub(constant(0.0), cs);
    let (sc, ss) = (code.mul(s2, c1), code.mul(s2, s1));
    let minus_s = [sc, ss].map(|value| code.sub(constant(0.0), value));
    Checks {
        code: code.take(),
        residuals: equations.iter().map(|equation| equation.0).collect(),
        scales: vec![constant(1.0); 3],
        jacobian: vec![vec![minus_cs, minus_s[0]], vec![cc, minus_s[1]], vec![constant(0.0), c2]],
        short: Vec::new(),
    }
}
