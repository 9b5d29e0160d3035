//! The solver of a printed file as that of a joint with a given value ([`solve_part`]).

use super::arm::{MOST_JOINTS, Member, Members, Q, Target};
use crate::solution::{Error, Solution};
use crate::solve::Solve;
use crate::storage::Array;

/// Adds all solutions of the target with the solver's joint given at `value`, the last number of its own target. `room` has the solver's capacity.
///
/// # Errors
///
/// Those of [`Solve::solve`].
pub fn solve_part<S: Solve>(
    solver: &S,
    target: &Target,
    value: f64,
    room: &mut [Solution<S>],
    out: &mut Members,
) -> Result<(), Error> {
    let inputs = solver.facts().inputs;
    let numbers = Array::by(inputs, |i| if i + 1 < inputs { target[i] } else { value });
    let count = solver.solve(&numbers, room)?;
    for solution in &room[..count] {
        let mut q: Q = [0.0; MOST_JOINTS];
        q[..solution.q.as_ref().len()].copy_from_slice(solution.q.as_ref());
        out.push(Member { q, free: solution.free, settled: solution.settled });
    }
    Ok(())
}
