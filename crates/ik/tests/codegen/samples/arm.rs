//! An arm with a rotating base and two links: nested root steps, a case with a free joint, an open case, and cases in another order than their branches.

use crate::codegen::builder::*;
use groebot_ik::solver::{Case, Checks, Guard, Operand, Preference, Program, Rule, Step, Unit};
use groebot_robot::kinematics::Task;

const UPPER: f64 = 0.5;
const LOWER: f64 = 0.4;

const H: usize = 0;
const C1: usize = 1;
const S1: usize = 2;
const C2: usize = 3;
const S2: usize = 4;
const C3: usize = 5;
const S3: usize = 6;

/// The tool in the base's frame, m.
pub fn tool([turn, shoulder, elbow]: [f64; 3]) -> [f64; 3] {
    let out = UPPER * shoulder.cos() + LOWER * (shoulder + elbow).cos();
    [out * turn.cos(), out * turn.sin(), UPPER * shoulder.sin() + LOWER * (shoulder + elbow).sin()]
}

pub fn program() -> Program {
    let mut code = Code::default();
    let (xx, yy) = (code.mul(parameter(0), parameter(0)), code.mul(parameter(1), parameter(1)));
    let value = code.add(xx, yy);
    let distance = Rule::Root { code: code.take(), value };
    Program {
        name: "turning_arm".into(),
        about: None,
        tasks: tip(Task::Position),
        given_joints: vec![],
        inputs: ["x", "y", "z"].map(|name| input(name, Unit::Metre)).to_vec(),
        parameters: vec![
            rule("x", Rule::Input(0)),
            rule("y", Rule::Input(1)),
            rule("z", Rule::Input(2)),
            rule("d", distance),
        ],
        unknowns: ["h", "c1", "s1", "c2", "s2", "c3", "s3"].map(String::from).to_vec(),
        joints: vec![angle("turn", C1, S1), angle("shoulder", C2, S2), angle("elbow", C3, S3)],
        scale: UPPER + LOWER,
        conditions: vec![],
        blocks: one_block(vec![on_axis(), generic(), at_origin()]),
        checks: checks(),
        preference: Some(Preference { unknown: S3, greatest: false }),
        capacity: 6,
        isolated: None,
        nearby: false,
        described: None,
        redundancy: None,
    }
}

fn generic() -> Case {
    let mut code = Code::default();
    let [x, y, z, d] = [0, 1, 2, 3].map(parameter);
    let (dd, zz) = (code.mul(d, d), code.mul(z, z));
    let square = code.add(dd, zz);
    let scale = code.mul(Operand::Magnitude, Operand::Magnitude);
    let guard_code = code.take();
    let minus_dd = code.sub(constant(0.0), dd);
    let mut steps = vec![Step::Compute(code.take()), roots(H, vec![vec![minus_dd, constant(0.0), constant(1.0)]])];
    let (c1, s1) = (code.div(x, unknown(H)), code.div(y, unknown(H)));
    steps.extend([
        Step::Compute(code.take()),
        Step::Set { unknown: C1, value: c1 },
        Step::Set { unknown: S1, value: s1 },
    ]);
    steps.extend(links(&mut code, square));
    let guards = vec![away("d", d, Operand::Magnitude), away("d^2 + z^2", square, scale)];
    Case { label: "generic".into(), guard_code, guards, steps, pivot: None, free: vec![], open: false, first_branch: 0 }
}

/// Steps of the two links, given `h` and `square = h^2 + z^2`.
fn links(code: &mut Code, square: Operand) -> Vec<Step> {
    let (h, z) = (unknown(H), parameter(2));
    let reach = code.sub(square, constant(UPPER * UPPER + LOWER * LOWER));
    let c3 = code.div(reach, constant(2.0 * UPPER * LOWER));
    let cc = code.mul(c3, c3);
    let rest = code.sub(cc, constant(1.0));
    let mut steps = vec![
        Step::Compute(code.take()),
        Step::Set { unknown: C3, value: c3 },
        roots(S3, vec![vec![rest, constant(0.0), constant(1.0)]]),
    ];
    let lower = code.mul(constant(LOWER), unknown(C3));
    let along = code.add(constant(UPPER), lower);
    let across = code.mul(constant(LOWER), unknown(S3));
    let (ha, zb) = (code.mul(h, along), code.mul(z, across));
    let (za, hb) = (code.mul(z, along), code.mul(h, across));
    let (c, s) = (code.add(ha, zb), code.sub(za, hb));
    let (c2, s2) = (code.div(c, square), code.div(s, square));
    steps.extend([
        Step::Compute(code.take()),
        Step::Set { unknown: C2, value: c2 },
        Step::Set { unknown: S2, value: s2 },
    ]);
    steps
}

/// On the axis of the first joint, which is free there.
fn on_axis() -> Case {
    let mut code = Code::default();
    let square = code.mul(parameter(2), parameter(2));
    let scale = code.mul(Operand::Magnitude, Operand::Magnitude);
    let guard_code = code.take();
    let mut steps: Vec<Step> =
        [(H, 0.0), (C1, 1.0), (S1, 0.0)].map(|(unknown, value)| Step::Set { unknown, value: constant(value) }).to_vec();
    steps.extend(links(&mut code, square));
    let guards = vec![near("d", parameter(3), Operand::Magnitude), away("z^2", square, scale)];
    Case { label: "d = 0".into(), guard_code, guards, steps, pivot: None, free: vec![0], open: false, first_branch: 4 }
}

fn at_origin() -> Case {
    let guards: Vec<Guard> =
        [("d", 3), ("z", 2)].map(|(text, index)| near(text, parameter(index), Operand::Magnitude)).to_vec();
    let label = "d = z = 0".into();
    Case { label, guard_code: vec![], guards, steps: vec![], pivot: None, free: vec![], open: true, first_branch: 6 }
}

fn checks() -> Checks {
    let mut code = Code::default();
    let [c1, s1, c2, s2, c3, s3] = [C1, S1, C2, S2, C3, S3].map(unknown);
    let (upper, lower) = (constant(UPPER), constant(LOWER));
    let (cc, ss) = (code.product(&[lower, c2, c3]), code.product(&[lower, s2, s3]));
    let (sc, cs) = (code.product(&[lower, s2, c3]), code.product(&[lower, c2, s3]));
    let (u, v) = (code.mul(upper, c2), code.mul(upper, s2));
    let (lower_out, lower_up) = (code.sub(cc, ss), code.add(sc, cs));
    let (out, up) = (code.add(u, lower_out), code.add(v, lower_up));
    let minus = [0, 1, 2].map(|index| code.sub(constant(0.0), parameter(index)));
    let minus_ss = code.sub(constant(0.0), ss);
    let row = |code: &mut Code, factor: Operand, target: Operand| {
        let terms = [u, cc, minus_ss].map(|term| code.mul(factor, term));
        code.equation(&[terms[0], terms[1], terms[2], target])
    };
    let (x, y) = (row(&mut code, c1, minus[0]), row(&mut code, s1, minus[1]));
    let z = code.equation(&[v, sc, cs, minus[2]]);
    let (down, lower_down) = (code.sub(constant(0.0), up), code.sub(constant(0.0), lower_up));
    let s1_out = code.mul(s1, out);
    let x_row = [code.sub(constant(0.0), s1_out), code.mul(c1, down), code.mul(c1, lower_down)];
    let y_row = [code.mul(c1, out), code.mul(s1, down), code.mul(s1, lower_down)];
    Checks {
        code: code.take(),
        residuals: vec![x.0, y.0, z.0],
        scales: vec![x.1, y.1, z.1],
        jacobian: vec![x_row.to_vec(), y_row.to_vec(), vec![constant(0.0), out, lower_out]],
        short: Vec::new(),
    }
}
