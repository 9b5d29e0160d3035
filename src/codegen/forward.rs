//! Forward kinematics and the equations' values as text: where the equations compare the tip with the target, they call the function of
//! the tip.

use serde::Serialize;

use super::body::Scene;
use super::code::Code;
use super::printer::reads_places;
use crate::solver::{Forward, JointValue, Operand, Reached};

/// The function of the tip, and how the target follows from it.
#[derive(Serialize)]
pub(super) struct ForwardText {
    lines: Vec<String>,
    /// What equations compare with the target's numbers, in their order.
    pub values: Vec<String>,
    /// By input: an expression of `reached`, which holds the values, and of `q`.
    inputs: Vec<String>,
    reads_at: bool,
    reads_values: bool,
}

impl ForwardText {
    /// The text for a program that has solutions and forward kinematics.
    pub fn new(scene: &Scene<'_>, forward: &Forward) -> Self {
        let operands: Vec<Operand> = forward.equations.iter().flatten().map(|(value, _)| *value).collect();
        let (lines, mut rows) = scene.checks(&[&operands]);
        let values = rows.pop().unwrap_or_default();
        let inputs: Vec<String> = forward.inputs.iter().map(|input| expression(*input, &operands)).collect();
        ForwardText {
            reads_at: lines.iter().chain(&values).any(|line| reads_places(line)),
            reads_values: inputs.iter().any(|input| input.contains("reached[")),
            lines,
            values,
            inputs,
        }
    }
}

/// Whether an input is an angle of what is reached.
pub(super) fn aims(forward: &Forward) -> bool {
    forward.inputs.iter().any(|input| matches!(input, Reached::Angle { .. }))
}

fn expression(input: Reached, operands: &[Operand]) -> String {
    let at = |value: Operand| {
        let place = operands.iter().position(|operand| *operand == value);
        format!("reached[{}]", place.expect("what is reached is compared by an equation"))
    };
    match input {
        Reached::Value(value) => at(value),
        Reached::Angle { cosine, sine } => format!("angle({}, {})", at(cosine), at(sine)),
        Reached::Joint(joint) => format!("q[{joint}]"),
    }
}

/// The forward kinematics of a program, if its file can have them: an angle among them needs the functions of joint angles.
pub(super) fn printed_forward(scene: &Scene<'_>) -> Option<Forward> {
    let forward = scene.program.forward().filter(|forward| !forward.inputs.is_empty())?;
    let turns = scene.program.joints.iter().any(|joint| matches!(joint.value, JointValue::Angle { .. }));
    (turns || !aims(&forward)).then_some(forward)
}

/// The equations' values with their code, and their `sizes` (none are asked for without answers).
pub(super) fn equations(scene: &Scene<'_>, forward: Option<&Forward>, sizes: &[Operand]) -> (Code, Vec<String>) {
    let checks = &scene.program.checks;
    let compared: Vec<Option<(Operand, usize)>> =
        forward.map_or_else(|| vec![None; checks.residuals.len()], |forward| forward.equations.clone());
    let open: Vec<Operand> =
        checks.residuals.iter().zip(&compared).filter(|(_, c)| c.is_none()).map(|(r, _)| *r).collect();
    let (lines, mut rows) = scene.checks(&[&open, sizes]);
    let sizes = rows.pop().unwrap_or_default();
    let mut open = rows.concat().into_iter();
    let mut places = 0..;
    let values: Vec<String> = compared
        .iter()
        .filter_map(|compared| match compared {
            None => open.next(),
            Some((_, parameter)) => {
                let field = scene.language.field(&scene.names.parameters[*parameter]);
                places.next().map(|place: usize| format!("reached[{place}] - {field}"))
            }
        })
        .collect();
    let read = [values.as_slice(), sizes.as_slice()].concat();
    let code = Code::new(scene.language, lines, read);
    (Code { values, reads_at: code.reads_at || forward.is_some(), ..code }, sizes)
}
