//! What every program of a chain has, however its joints are found.

use super::checks::checks;
use super::layout::Layout;
use super::program::{joints, reach};
use crate::derive::closure::Mechanism;
use crate::kinematics::Chain;
use crate::solver::Program;

/// A program of `chain` with everything but blocks: the target, the joints, the checks.
pub(in crate::derive) fn frame_of(chain: &Chain, mechanism: &Mechanism) -> Program {
    framed(chain, mechanism, Layout::new(mechanism, chain.length_unit()))
}

/// The same with the unknowns that blocks have laid out.
pub(super) fn framed(chain: &Chain, mechanism: &Mechanism, layout: Layout) -> Program {
    let reach = reach(chain);
    Program {
        name: chain.name().to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
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
        blocks: Vec::new(),
        preference: None,
    }
}
