//! The program of six axes: one block that finds all joints together.

use super::layout;
use crate::derive::closure::Mechanism;
use crate::derive::lift::frame_of;
use crate::kinematics::Chain;
use crate::solver::template::{Formulation, Layout, ROOM, Rigid, SixAxes, SixAxesParts};
use crate::solver::{Block, Chart, Operand, Program, Step};
use crate::{Error, ErrorKind, Result};

/// The program of `chain` by these formulations.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a chain that is not of six joints; as [`SixAxes::new`] and [`Mechanism::new`].
pub(super) fn program(chain: &Chain, formulations: Vec<Formulation>, dimension: usize) -> Result<Program> {
    let mechanism = Mechanism::new(chain)?;
    let frame = frame_of(chain, &mechanism);
    let unsupported = |text: &str| Error::new(ErrorKind::Unsupported, text);
    let Layout { lines, slides, length } = layout(chain);
    let joints: Vec<_> = frame.joints.iter().map(|joint| joint.value).collect();
    let step = SixAxes::new(SixAxesParts {
        length,
        lines,
        slides,
        tip: tip(chain),
        formulations,
        joints: joints.try_into().map_err(|_| unsupported("six joints are needed"))?,
        target: std::array::from_fn(Operand::Parameter),
    })?;
    let chart = Chart {
        label: "six axes".to_owned(),
        guard_code: Vec::new(),
        guards: Vec::new(),
        pivot: None,
        steps: vec![Step::SixAxes(Box::new(step))],
        free: Vec::new(),
        open: false,
        first_branch: 0,
    };
    let program = Program {
        blocks: vec![Block::numbered("all joints", Vec::new(), vec![chart])],
        capacity: ROOM,
        isolated: Some(dimension),
        ..frame
    };
    program.validate().map_err(|error| unsupported(error.message()))?;
    Ok(program)
}

/// The tip in the base frame at zero.
fn tip(chain: &Chain) -> Rigid {
    let pose = chain.base_from_tip();
    let rotation = pose.rotation.to_rotation_matrix();
    Rigid {
        rotation: std::array::from_fn(|i| std::array::from_fn(|j| rotation[(i, j)])),
        translation: pose.translation.vector.into(),
    }
}
