//! A spherical wrist, `R = Rz(q1) Ry(q2) Rz(q3)`: three blocks, a self-motion where axes coincide, and a group of cases of which the best runs.

use std::f64::consts::FRAC_PI_4;

use crate::codegen::builder::*;
use groebot_ik::solver::{Block, Case, Checks, Condition, JointValue, Operand, Pivot, Program, Rule, Step, Unit};
use groebot_robot::kinematics::Task;

const C2: usize = 0;
const S2: usize = 1;
const C1: usize = 2;
const S1: usize = 3;
const C3: usize = 4;
const S3: usize = 5;

/// The rotation by rows.
pub fn rotation(q: [f64; 3]) -> [f64; 9] {
    let ([c1, c2, c3], [s1, s2, s3]) = (q.map(f64::cos), q.map(f64::sin));
    [
        c1 * c2 * c3 - s1 * s3,
        -c1 * c2 * s3 - s1 * c3,
        c1 * s2,
        s1 * c2 * c3 + c1 * s3,
        -s1 * c2 * s3 + c1 * c3,
        s1 * s2,
        -s2 * c3,
        s2 * s3,
        c2,
    ]
}

/// A gantry that carries the wrist: inputs `px, py, pz`, then the rotation; the prismatic joints come first.
pub fn carried() -> Program {
    let mut program = program(false);
    let names = ["px", "py", "pz"];
    program.name = "gantry".into();
    program.tasks = tip(Task::Pose);
    program.inputs.splice(0..0, names.map(|name| input(name, Unit::Metre)));
    program.conditions = vec![Condition::Rotation(3)];
    for (index, parameter) in program.parameters.iter_mut().enumerate() {
        parameter.rule = Rule::Input(3 + index);
    }
    program.parameters.extend((0..3).map(|i| rule(names[i], Rule::Input(i))));
    program.unknowns.extend(["x", "y", "z"].map(String::from));
    program.joints.splice(0..0, (0..3).map(|i| length(["x", "y", "z"][i], 6 + i)));
    let place = (0..3).map(|i| Step::Set { unknown: 6 + i, value: parameter(9 + i) }).collect();
    program.blocks.push(Block::numbered("slides", vec![], vec![case("generic", place)]));
    let free = &mut program.blocks[1].cases[1].free;
    *free = vec![free[0] + 3];
    let checks = &mut program.checks;
    let mut code = Code::after(checks.code.len());
    for row in &mut checks.jacobian {
        row.splice(0..0, [constant(0.0); 3]);
    }
    for i in 0..3 {
        checks.residuals.push(code.sub(unknown(6 + i), parameter(9 + i)));
        checks.scales.push(Operand::Magnitude);
        checks.jacobian.push((0..6).map(|j| constant(f64::from(u8::from(i == j)))).collect());
    }
    checks.code.extend(code.take());
    program
}

/// The element in a row and column, counted from 1.
fn r(row: usize, column: usize) -> Operand {
    parameter(3 * (row - 1) + column - 1)
}

/// The program. With `gap`, there is no derivation of the last block where `r33` is near a half.
pub fn program(gap: bool) -> Program {
    let name = |i: usize| format!("r{}{}", i / 3 + 1, i % 3 + 1);
    Program {
        name: "wrist".into(),
        about: None,
        tasks: tip(Task::Rotation),
        given_joints: vec![],
        inputs: (0..9).map(|i| input(&name(i), Unit::One)).collect(),
        conditions: vec![Condition::Rotation(0)],
        parameters: (0..9).map(|i| rule(&name(i), Rule::Input(i))).collect(),
        unknowns: ["c2", "s2", "c1", "s1", "c3", "s3"].map(String::from).to_vec(),
        joints: vec![angle("q1", C1, S1), angle("q2", C2, S2), angle("q3", C3, S3)],
        scale: 1.0,
        blocks: vec![middle(), first(), last(gap)],
        checks: checks(),
        preference: None,
        capacity: 4,
        isolated: None,
        nearby: false,
        described: None,
        redundancy: None,
    }
}

fn case(label: &str, steps: Vec<Step>) -> Case {
    let (pivot, free) = (None, vec![]);
    Case { label: label.into(), guard_code: vec![], guards: vec![], pivot, steps, free, open: false, first_branch: 0 }
}

/// `s2^2 = r13^2 + r23^2`, `c2 = r33`.
fn middle() -> Block {
    let mut code = Code::default();
    let (xx, yy) = (code.mul(r(1, 3), r(1, 3)), code.mul(r(2, 3), r(2, 3)));
    let square = code.add(xx, yy);
    let minus_square = code.sub(constant(0.0), square);
    let steps = vec![
        Step::Compute(code.take()),
        Step::Set { unknown: C2, value: r(3, 3) },
        Step::Roots {
            unknown: S2,
            polynomials: vec![vec![minus_square, constant(0.0), constant(1.0)]],
            typical: Some(constant(2.0)),
            half_angle: false,
        },
    ];
    Block::numbered("q2", vec![], vec![case("generic", steps)])
}

/// `(c1, s1) = (r13, r23) / s2`; free where `s2 = 0`.
fn first() -> Block {
    let mut code = Code::default();
    let (c1, s1) = (code.div(r(1, 3), unknown(S2)), code.div(r(2, 3), unknown(S2)));
    let steps =
        vec![Step::Compute(code.take()), Step::Set { unknown: C1, value: c1 }, Step::Set { unknown: S1, value: s1 }];
    let guards = vec![away("s2", unknown(S2), constant(1.0))];
    let generic = Case { guards, ..case("generic", steps) };
    let values = (0..8).map(|k| f64::from(k) * FRAC_PI_4).collect();
    let sample = Step::Sample { joint: JointValue::Angle { cosine: C1, sine: S1 }, values };
    let guards = vec![near("s2", unknown(S2), constant(1.0))];
    let straight = Case { guards, free: vec![0], ..case("s2 = 0", vec![sample]) };
    Block::numbered("q1", vec![], vec![generic, straight])
}

/// `Rz(-q1) R` has the second row `(s3, c3, 0)`. The greater of the two is found first, which makes no difference here.
fn last(gap: bool) -> Block {
    let mut code = Code::default();
    let mut turned = |column: usize| {
        let (back, forth) = (code.mul(unknown(S1), r(1, column)), code.mul(unknown(C1), r(2, column)));
        code.sub(forth, back)
    };
    let (s3, c3) = (turned(1), turned(2));
    let block_code = code.take();
    let sine = Step::Set { unknown: S3, value: s3 };
    let cosine = Step::Set { unknown: C3, value: c3 };
    let doubled = code.mul(constant(2.0), c3);
    let claim = |label: &str, guard_code, value, steps| Case {
        guard_code,
        pivot: Some(Pivot { group: 7, value }),
        ..case(label, steps)
    };
    let half = code.div(doubled, constant(2.0));
    let mut cases = vec![
        claim("by the sine", vec![], s3, vec![sine.clone(), cosine.clone()]),
        claim("by the cosine", code.take(), half, vec![cosine, sine]),
    ];
    if gap {
        let mut code = Code::after(6);
        let miss = code.sub(r(3, 3), constant(0.5));
        let guards = vec![near("r33 - 1/2", miss, constant(1.0))];
        cases.push(Case { guard_code: code.take(), guards, open: true, ..case("r33 = 1/2", vec![]) });
    }
    Block::numbered("q3", block_code, cases)
}

/// All nine elements.
fn checks() -> Checks {
    let mut code = Code::default();
    let [c1, s1, c2, s2, c3, s3] = [C1, S1, C2, S2, C3, S3].map(unknown);
    let minus = |code: &mut Code, a: Operand| code.sub(constant(0.0), a);
    let (cc, cs, sc, ss) = (code.mul(c1, c2), code.mul(c1, s2), code.mul(s1, c2), code.mul(s1, s2));
    let (minus_s1, minus_s2, minus_s3) = (minus(&mut code, s1), minus(&mut code, s2), minus(&mut code, s3));
    let (minus_c3, minus_c2) = (minus(&mut code, c3), minus(&mut code, c2));
    let minus_ss = minus(&mut code, ss);
    let zero = constant(0.0);
    // Columns of Rz(q1) Ry(q2), of its derivatives by q1 and q2, and their products with Rz(q3) and its derivative.
    let x = [cc, sc, minus_s2];
    let y = [minus_s1, c1, zero];
    let z = [cs, ss, c2];
    let minus_sc = minus(&mut code, sc);
    let minus_c1 = minus(&mut code, c1);
    let by_first = [[minus_sc, cc, zero], [minus_c1, minus_s1, zero], [minus_ss, cs, zero]];
    let minus_cs = minus(&mut code, cs);
    let by_middle = [[minus_cs, minus_ss, minus_c2], [zero; 3], [cc, sc, minus_s2]];
    let mut turned = |[x, y, z]: [[Operand; 3]; 3], [c, s, minus_s]: [Operand; 3], one: bool| -> Vec<Operand> {
        let mut rows = Vec::new();
        for i in 0..3 {
            let (xc, ys) = (code.mul(x[i], c), code.mul(y[i], s));
            let (xs, yc) = (code.mul(x[i], minus_s), code.mul(y[i], c));
            rows.extend([code.add(xc, ys), code.add(xs, yc), if one { z[i] } else { zero }]);
        }
        rows
    };
    let values = turned([x, y, z], [c3, s3, minus_s3], true);
    let columns = [
        turned(by_first, [c3, s3, minus_s3], true),
        turned(by_middle, [c3, s3, minus_s3], true),
        turned([x, y, z], [minus_s3, c3, minus_c3], false),
    ];
    let residuals = (0..9).map(|i| code.sub(values[i], parameter(i))).collect();
    let jacobian = (0..9).map(|i| columns.iter().map(|column| column[i]).collect()).collect();
    Checks { code: code.take(), residuals, scales: vec![constant(1.0); 9], jacobian, short: Vec::new() }
}
