//! Derivatives that the run time computes from values, compared with those in a program, which come from differentiated polynomials.

use crate::codegen::random;
use crate::codegen::stored::{all, joint_values};
use groebot_ik::solver::{JointValue, Operand, Operation, Program};

/// The values of operands for these values of parameters and unknowns.
fn values(program: &Program, parameters: &[f64], unknowns: &[f64], operands: &[Operand]) -> Vec<f64> {
    let mut registers = vec![0.0; program.checks.code.len()];
    let of = |operand: Operand, registers: &[f64]| match operand {
        Operand::Constant(value) => value,
        Operand::Parameter(index) => parameters[index],
        Operand::Unknown(index) => unknowns[index],
        Operand::Register(index) => registers[index],
        Operand::Magnitude => parameters[parameters.len() - 1],
    };
    for line in &program.checks.code {
        registers[line.target] = match line.operation {
            Operation::Add(a, b) => of(a, &registers) + of(b, &registers),
            Operation::Sub(a, b) => of(a, &registers) - of(b, &registers),
            Operation::Mul(a, b) => of(a, &registers) * of(b, &registers),
            Operation::Div(a, b) => of(a, &registers) / of(b, &registers),
            Operation::Abs(a) => of(a, &registers).abs(),
            Operation::Sqrt(a) => of(a, &registers).max(0.0).sqrt(),
        };
    }
    operands.iter().map(|&operand| of(operand, &registers)).collect()
}

#[test]
fn derivatives_from_values_are_those_of_the_polynomials() {
    let (mut compared, mut programs) = (0, 0);
    for stored in all() {
        let (program, solver) = (&stored.program, stored.program.solver());
        let mut has_derivatives = false;
        for q in joint_values(program, 20, random()) {
            let target = solver.reached(&q).unwrap_or_else(|| vec![0.3; program.inputs.len()]);
            let parameters = solver.parameters(&target).unwrap();
            let Some(found) = solver.derivatives(&target, &q).unwrap() else { continue };
            has_derivatives = true;
            let mut unknowns = vec![0.0; program.unknowns.len()];
            for (joint, &q) in program.joints.iter().zip(&q) {
                match joint.value {
                    JointValue::Angle { cosine, sine } => (unknowns[cosine], unknowns[sine]) = (q.cos(), q.sin()),
                    JointValue::Plain(unknown) => unknowns[unknown] = q,
                }
            }
            let size = parameters.iter().fold(program.scale, |size: f64, p| size.max(p.abs()));
            for (row, operands) in found.iter().zip(&program.checks.jacobian) {
                let expected = values(program, &parameters, &unknowns, operands);
                for (found, expected) in row.iter().zip(expected) {
                    let name = &stored.name;
                    assert!((found - expected).abs() <= 1e-14 * size.max(1.0), "{name}: {found} and {expected}");
                    compared += 1;
                }
            }
        }
        programs += usize::from(has_derivatives);
    }
    assert!(programs > 35 && compared > 40_000, "{programs} programs, {compared} derivatives");
}
