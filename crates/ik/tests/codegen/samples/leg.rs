//! A leg with two links in its sagittal plane: one case, one quadratic root step.

use crate::codegen::builder::*;
use groebot_ik::solver::{Case, Checks, Operand, Preference, Program, Rule, Step, Unit};
use groebot_robot::kinematics::{Plane, Task};

const THIGH: f64 = 0.1;
const SHIN: f64 = 0.1029;

const C4: usize = 0;
const C3: usize = 1;
const S3: usize = 2;
const S4: usize = 3;

/// The foot in the hip's frame, m.
pub fn foot(hip: f64, knee: f64) -> [f64; 2] {
    [THIGH * hip.sin() + SHIN * (hip + knee).sin(), THIGH * hip.cos() + SHIN * (hip + knee).cos()]
}

pub fn program() -> Program {
    Program {
        name: "leg".into(),
        about: None,
        tasks: tip(Task::PlanarPosition { plane: Plane::Xz }),
        given_joints: vec![],
        inputs: vec![input("px", Unit::Metre), input("pz", Unit::Metre)],
        parameters: vec![rule("px", Rule::Input(0)), rule("pz", Rule::Input(1))],
        unknowns: ["c4", "c3", "s3", "s4"].map(String::from).to_vec(),
        joints: vec![angle("HipPitch", C3, S3), angle("KneePitch", C4, S4)],
        scale: THIGH + SHIN,
        conditions: vec![],
        blocks: one_block(vec![case()]),
        checks: checks(),
        preference: Some(Preference { unknown: S4, greatest: true }),
        capacity: 2,
        isolated: None,
        nearby: false,
        described: None,
        redundancy: None,
    }
}

fn case() -> Case {
    let mut code = Code::default();
    let (px, pz) = (parameter(0), parameter(1));
    let (xx, zz) = (code.mul(px, px), code.mul(pz, pz));
    let square = code.add(xx, zz);
    let scale = code.mul(Operand::Magnitude, Operand::Magnitude);
    let guard_code = code.take();
    let reach = code.sub(square, constant(THIGH * THIGH + SHIN * SHIN));
    let cosine = code.div(reach, constant(2.0 * THIGH * SHIN));
    let knee = Step::Compute(code.take());
    let c4 = unknown(C4);
    let c4_square = code.mul(c4, c4);
    let rest = code.sub(c4_square, constant(1.0));
    let square_of_sine = Step::Compute(code.take());
    let s3 = hip(&mut code, [px, pz], -1.0, square);
    let c3 = hip(&mut code, [pz, px], 1.0, square);
    Case {
        label: "generic".into(),
        guard_code,
        guards: vec![away("px^2 + pz^2", square, scale)],
        steps: vec![
            knee,
            Step::Set { unknown: C4, value: cosine },
            square_of_sine,
            roots(S4, vec![vec![rest, constant(0.0), constant(1.0)]]),
            Step::Compute(code.take()),
            Step::Set { unknown: S3, value: s3 },
            Step::Set { unknown: C3, value: c3 },
        ],
        pivot: None,
        free: vec![],
        open: false,
        first_branch: 0,
    }
}

/// `(THIGH a + SHIN (a c4 + sign b s4)) / square`.
fn hip(code: &mut Code, [a, b]: [Operand; 2], sign: f64, square: Operand) -> Operand {
    let thigh = code.mul(constant(THIGH), a);
    let (first, second) = (code.mul(a, unknown(C4)), code.mul(b, unknown(S4)));
    let signed = code.mul(constant(sign), second);
    let sum = code.add(first, signed);
    let shin = code.mul(constant(SHIN), sum);
    let all = code.add(thigh, shin);
    code.div(all, square)
}

fn checks() -> Checks {
    let mut code = Code::default();
    let [c4, c3, s3, s4] = [C4, C3, S3, S4].map(unknown);
    let l2 = constant(SHIN);
    let (cs, sc) = (code.product(&[l2, c3, s4]), code.product(&[l2, c4, s3]));
    let (cc, ss) = (code.product(&[l2, c3, c4]), code.product(&[l2, s3, s4]));
    let (thigh_x, thigh_z) = (code.mul(constant(THIGH), s3), code.mul(constant(THIGH), c3));
    let (px, pz) = (code.sub(constant(0.0), parameter(0)), code.sub(constant(0.0), parameter(1)));
    let minus_ss = code.sub(constant(0.0), ss);
    let x = code.equation(&[cs, sc, thigh_x, px]);
    let z = code.equation(&[cc, minus_ss, thigh_z, pz]);
    let x_by_knee = code.sub(cc, ss);
    let x_by_hip = code.add(x_by_knee, thigh_z);
    let shin_x = code.add(cs, sc);
    let z_by_knee = code.sub(constant(0.0), shin_x);
    let z_by_hip = code.sub(z_by_knee, thigh_x);
    Checks {
        code: code.take(),
        residuals: vec![x.0, z.0],
        scales: vec![x.1, z.1],
        jacobian: vec![vec![x_by_hip, x_by_knee], vec![z_by_hip, z_by_knee]],
        short: Vec::new(),
    }
}
