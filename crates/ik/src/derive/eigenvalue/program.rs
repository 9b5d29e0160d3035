//! The program of six axes: one block that finds all joints together.

use groebot_runtime::six_axes::{ROOM, Rigid};

use super::given::{Between, Six};
use super::layout;
use crate::derive::closure::Mechanism;
use crate::derive::equations::assemble::Assembler;
use crate::derive::sequential::frame_of;
use crate::solver::eigenvalue::{Formulation, GivenAxis, Layout, SixAxes, SixAxesParts};
use crate::solver::{Block, Case, Operand, Program, Step};
use crate::{Error, ErrorKind, Result};
use groebot_robot::kinematics::Chain;

/// The program of `chain`, whose six joints are found by these formulations.
///
/// # Errors
/// As [`SixAxes::new`], [`Mechanism::new`] and [`Six::target`].
pub(super) fn program(chain: &Chain, six: &Six, formulations: Vec<Formulation>, dimension: usize) -> Result<Program> {
    let mechanism = Mechanism::new(chain)?;
    let frame = frame_of(chain, &mechanism);
    let unsupported = |text: &str| Error::new(ErrorKind::Unsupported, text);
    let Layout { lines, slides, length } = layout(&six.chain);
    // The operands of a given joint are those that its block assigns to its unknowns.
    let value = |joint: usize| {
        let block = mechanism.given().iter().position(|given| *given == joint);
        block.map_or_else(Vec::new, |block| set_to(&frame.blocks[block]))
    };
    let mut assembler = Assembler::default();
    let axis = |between: &Between| Ok(GivenAxis { axis: between.line, value: between.value(&value(between.place))? });
    let given = six.between.iter().map(axis).collect::<Result<_>>()?;
    let target = six.target(chain, std::array::from_fn(Operand::Parameter), value, &mut assembler)?;
    let step = SixAxes::new(SixAxesParts {
        length,
        lines,
        slides,
        tip: tip(chain),
        formulations,
        within: 0.0,
        joints: six.places.map(|place| frame.joints[place].value),
        target,
        given,
    })?;
    let case = Case { label: "six axes".to_owned(), steps: vec![Step::SixAxes(Box::new(step))], ..Case::default() };
    let mut blocks = frame.blocks.clone();
    blocks.push(Block::numbered("all joints", assembler.take(), vec![case]));
    let program = Program { blocks, capacity: ROOM, isolated: Some(dimension), nearby: false, ..frame };
    program.validate().map_err(|error| unsupported(error.message()))?;
    Ok(program)
}

/// Sets the distance from this robot to the one on which solutions are polished: in rad, and as a fraction of the reach.
///
/// # Errors
/// As [`SixAxes::new`].
pub(super) fn within(program: &mut Program, within: f64) -> Result<()> {
    for step in program.blocks.iter_mut().flat_map(|block| &mut block.cases).flat_map(|case| &mut case.steps) {
        if let Step::SixAxes(six) = step {
            **six = six.within(within)?;
        }
    }
    Ok(())
}

/// The operands that a block assigns to unknowns.
fn set_to(block: &Block) -> Vec<Operand> {
    let steps = block.cases.iter().flat_map(|case| &case.steps);
    let value = |step: &Step| if let Step::Set { value, .. } = step { Some(*value) } else { None };
    steps.filter_map(value).collect()
}

/// The tip in the base frame in the zero configuration.
pub(super) fn tip(chain: &Chain) -> Rigid {
    let pose = chain.base_from_tip();
    let rotation = pose.rotation.to_rotation_matrix();
    Rigid {
        rotation: std::array::from_fn(|i| std::array::from_fn(|j| rotation[(i, j)])),
        translation: pose.translation.vector.into(),
    }
}
