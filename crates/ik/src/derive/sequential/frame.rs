//! The parts that every program of a chain has, for any method.

use super::checks::checks;
use super::layout::Layout;
use crate::derive::closure::Mechanism;
use crate::solver::{Block, Case, Joint, JointValue, Operand, Program, Step, TipTask, Unit};
use groebot_robot::document::word;
use groebot_robot::kinematics::{Chain, LengthUnit};

/// A program of `chain` without the blocks that find joints: the target, the joints, the blocks that set given joints, the checks.
pub(in crate::derive) fn frame_of(chain: &Chain, mechanism: &Mechanism) -> Program {
    let layout = Layout::new(mechanism, chain.length_unit());
    let blocks = mechanism.given().iter().map(|&joint| given(mechanism, &layout, joint)).collect();
    Program { blocks, ..framed(chain, mechanism, layout) }
}

/// Same as [`frame_of`], with a layout to which blocks have added unknowns.
pub(super) fn framed(chain: &Chain, mechanism: &Mechanism, layout: Layout) -> Program {
    let reach = reach(chain);
    Program {
        name: word(chain.name()),
        checks: checks(mechanism, &layout, reach),
        joints: joints(chain, &layout),
        tasks: vec![TipTask::of(chain)],
        given_joints: layout.given_joints,
        inputs: layout.inputs,
        conditions: layout.conditions,
        parameters: layout.parameters,
        unknowns: layout.unknowns,
        scale: reach,
        capacity: 1,
        ..Program::default()
    }
}

/// The size of the chain's positions; one if all are zero.
pub(super) fn reach(chain: &Chain) -> f64 {
    let first = chain.joints().first().map_or(0.0, |joint| joint.location().coords.norm());
    let reach = chain.reach() + first;
    if reach > 0.0 { reach } else { 1.0 }
}

/// The joints with their units and their values as functions of the unknowns.
fn joints(chain: &Chain, layout: &Layout) -> Vec<Joint> {
    let unit = |value: &JointValue| match (value, chain.length_unit()) {
        (JointValue::Angle { .. }, _) => Unit::Radian,
        (JointValue::Plain(_), LengthUnit::Metre) => Unit::Metre,
        (JointValue::Plain(_), LengthUnit::Millimetre) => Unit::Millimetre,
    };
    let joint = |(joint, value): (&groebot_robot::kinematics::Joint, &JointValue)| Joint {
        name: joint.name.clone(),
        unit: unit(value),
        value: *value,
    };
    chain.joints().iter().zip(&layout.joints).map(joint).collect()
}

/// The block that sets a given joint to its input value.
pub(super) fn given(mechanism: &Mechanism, layout: &Layout, joint: usize) -> Block {
    let unknowns = match layout.joints[joint] {
        JointValue::Angle { cosine, sine } => vec![cosine, sine],
        JointValue::Plain(unknown) => vec![unknown],
    };
    let values = layout.given[joint].iter().map(|&parameter| Operand::Parameter(parameter));
    let steps = unknowns.into_iter().zip(values).map(|(unknown, value)| Step::Set { unknown, value }).collect();
    let label = mechanism.joints()[joint].name.as_str();
    let case = Case { label: "given".to_owned(), steps, ..Case::default() };
    Block::numbered(label, Vec::new(), vec![case])
}
