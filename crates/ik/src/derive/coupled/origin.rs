//! The sources of the inputs of one chain's program in the solver of all chains. Main type: [`Origin`].

use crate::solver::Program;

/// The source of the value of a chain's input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Origin {
    /// The input of the whole solver with this index.
    Target(usize),
    /// The joint of the whole solver with this index.
    Joint(usize),
}

/// The origins of the inputs of a chain's own program `own`: inputs of the solver, by their `places`, and joints that are `found` before.
pub(super) fn origins(own: &Program, places: &[Option<usize>], found: &[Option<usize>]) -> Vec<Origin> {
    let joint =
        |input: usize| own.given_joints.iter().find(|given| given.input == input).and_then(|given| found[given.joint]);
    let origin =
        |(input, place): (usize, &Option<usize>)| joint(input).map(Origin::Joint).or(place.map(Origin::Target));
    places.iter().enumerate().filter_map(origin).collect()
}
