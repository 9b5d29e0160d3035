//! What every program of a chain has, however its joints are found.

use super::checks::checks;
use super::layout::Layout;
use super::program::{joints, reach};
use crate::derive::closure::Mechanism;
use crate::kinematics::Chain;
use crate::solver::Program;

/// A program of `chain` with everything but blocks: the target, the joints, the checks.
pub(in crate::derive) fn frame_of(chain: &Chain, mechanism: &Mechanism) -> Program {
    let (layout, reach) = (Layout::new(mechanism, chain.length_unit()), reach(chain));
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
