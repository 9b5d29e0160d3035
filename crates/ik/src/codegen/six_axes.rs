//! The steps of a program that solve six joints together.

use crate::solver::eigenvalue::SixAxes;
use crate::solver::{Program, Step};

/// The steps of a program that solve six joints together, in the order of their numbers from 1.
pub(super) fn steps(program: &Program) -> Vec<&SixAxes> {
    let steps = program.cases().flat_map(|case| &case.steps);
    steps.filter_map(|step| if let Step::SixAxes(six) = step { Some(six.as_ref()) } else { None }).collect()
}
