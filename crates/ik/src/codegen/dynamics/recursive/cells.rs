//! The layout of cells: frames, masses and motions of bodies.

use crate::codegen::dynamics::loops::Step;
use crate::codegen::dynamics::tape::Recorded;
use groebot_robot::dynamics::recursions::{ArticulatedInertia, Composite};
use groebot_robot::dynamics::{Body, Frame, Freedom, Mass, Scalar, Six};

/// The index in a row of the table of a body's mass parameters, and of the inertia of its rotor.
pub(super) const WEIGHS: usize = 12;
pub(super) const ROTOR: usize = 22;

/// Six numbers in the order of the cells.
pub(super) fn numbers(six: &Six<Recorded>) -> impl Iterator<Item = Recorded> + '_ {
    (0..6).map(|at| six.at(at).clone())
}

/// Reads a frame.
pub(super) fn frame(step: &mut Step, row: &str) -> Frame<Recorded> {
    let list = step.list::<12>(row, 0);
    let entry = |at: usize| list[at].clone();
    Frame {
        rotation: std::array::from_fn(|i| std::array::from_fn(|j| entry(3 * i + j))),
        position: std::array::from_fn(|i| entry(9 + i)),
    }
}

/// Writes a frame.
pub(super) fn write_frame(step: &mut Step, row: &str, frame: Frame<Recorded>) {
    step.write_list(row, 0, frame.rotation.into_iter().flatten().chain(frame.position));
}

/// Reads the ten mass parameters.
pub(super) fn mass(step: &mut Step, row: &str, from: usize) -> Mass<Recorded> {
    Mass::of(step.list::<10>(row, from))
}

/// A body with this type of joint. Its frame and mass are not read where they are not needed.
pub(super) fn body(freedom: Freedom) -> Body<Recorded> {
    Body { parent: None, freedom, frame: Frame::identity(), mass: Mass::of(std::array::from_fn(|_| Recorded::zero())) }
}

/// The number of values of a composite: its mass parameters, their rate of change (without the mass itself), its
/// momentum.
pub(super) const COMPOSITE: usize = 25;

pub(super) fn composite(step: &mut Step, row: &str) -> Composite<Recorded> {
    let changes = step.list::<9>(row, 10);
    let rate = Mass::of(std::array::from_fn(|at| at.checked_sub(1).map_or(Recorded::zero(), |at| changes[at].clone())));
    Composite { mass: mass(step, row, 0), rate, momentum: step.six(row, 19) }
}

pub(super) fn composite_numbers(composite: &Composite<Recorded>) -> Vec<Recorded> {
    let rate = composite.rate.numbers().into_iter().skip(1);
    composite.mass.numbers().into_iter().chain(rate).chain(numbers(&composite.momentum)).collect()
}

pub(super) fn articulated_inertia(step: &mut Step, row: &str) -> ArticulatedInertia<Recorded> {
    let mut matrix = |from: usize| {
        let list = step.list::<9>(row, from);
        std::array::from_fn(|i| std::array::from_fn(|j| list[3 * i + j].clone()))
    };
    ArticulatedInertia { linear: matrix(0), coupling: matrix(9), angular: matrix(18) }
}

pub(super) fn inertia_numbers(inertia: ArticulatedInertia<Recorded>) -> impl Iterator<Item = Recorded> {
    [inertia.linear, inertia.coupling, inertia.angular].into_iter().flatten().flatten()
}
