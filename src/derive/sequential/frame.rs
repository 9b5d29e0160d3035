//! What every program of a chain has, however its joints are found.

use super::checks::checks;
use super::layout::Layout;
use super::program::{given, joints, reach};
use crate::derive::closure::Mechanism;
use crate::document::word;
use crate::kinematics::Chain;
use crate::solver::Program;

/// A program of `chain` with everything but blocks that find joints: the target, the joints, the given ones where they are told to be,
/// the checks.
pub(in crate::derive) fn frame_of(chain: &Chain, mechanism: &Mechanism) -> Program {
    let layout = Layout::new(mechanism, chain.length_unit());
    let blocks = mechanism.given().iter().map(|&joint| given(mechanism, &layout, joint)).collect();
    Program { blocks, ..framed(chain, mechanism, layout) }
}

/// The same with the unknowns that blocks have laid out.
pub(super) fn framed(chain: &Chain, mechanism: &Mechanism, layout: Layout) -> Program {
    let reach = reach(chain);
    Program {
        name: word(chain.name()),
        format: Program::FORMAT,
        about: None,
        checks: checks(mechanism, &layout, reach),
        joints: joints(chain, &layout),
        inputs: layout.inputs,
        conditions: layout.conditions,
        parameters: layout.parameters,
        unknowns: layout.unknowns,
        scale: reach,
        capacity: 1,
        isolated: None,
        nearby: false,
        blocks: Vec::new(),
        preference: None,
    }
}
