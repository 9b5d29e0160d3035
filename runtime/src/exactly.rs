//! All joint values with which the equations of a mechanism hold: [`solve_ideal`].

use crate::answers::Answers;
use crate::conditions::conform;
use crate::mechanism::{Inputs, Mechanism};
use crate::problem::Problem;
use crate::solution::{Error, Solution};
use crate::steps::Steps;

/// Finds all joint values with which the equations hold.
#[inline]
pub(crate) fn solve_ideal<M: Mechanism>(
    mechanism: &M,
    target: &Inputs<M>,
    out: &mut [Solution<M>],
    steps: &mut Steps,
) -> Result<usize, Error> {
    let mut target = target.clone();
    conform(mechanism.facts().conditions, target.as_mut())?;
    let mut count = 0;
    let is_ordinary = mechanism.ordinary(&target, &mut |q, [residual, relative], branch| {
        if let Some(place) = out.get_mut(count) {
            *place = Solution { q, residual, relative, branch, chosen: false, free: 0, settled: true };
        }
        count += 1;
    });
    if is_ordinary && count <= out.len() {
        return Ok(count);
    }
    let p = mechanism.parameters(&target);
    let mut answers = Answers::new(Problem::new(mechanism, &p, steps), out, None);
    answers.find()?;
    answers.conclude()
}
