//! One target: [`solve_one`], [`solve_one_by_pairs`], [`nearest_to`].

use crate::answers::Answers;
use crate::conditions::conform;
use crate::described::{along_ideal, solve_described};
use crate::effort::MOST_STEPS;
use crate::exactly::solve_ideal;
use crate::limits::{Aim, nearest};
use crate::mechanism::{Answered, Inputs, Joint, Mechanism};
use crate::nearest::{Best, Search};
use crate::problem::Problem;
use crate::solution::{Error, Pairs, Solution};
use crate::steps::Steps;
use crate::storage::Array;
use crate::trigonometry::cosine_and_sine;

/// Same as [`crate::Solve::solve`].
#[inline]
pub(crate) fn solve_one<M: Mechanism>(
    mechanism: &M,
    target: &Inputs<M>,
    out: &mut [Solution<M>],
    steps: &mut Steps,
) -> Result<usize, Error> {
    match mechanism.facts().within {
        None => solve_ideal(mechanism, target, out, steps),
        Some(within) => {
            let mut target = target.clone();
            conform(mechanism.facts().conditions, target.as_mut())?;
            Ok(solve_described(mechanism, &target, within, out, steps)?.0)
        }
    }
}

/// Same as [`crate::Solve::solve_pairs`].
pub(crate) fn solve_one_by_pairs<M: Mechanism>(
    mechanism: &M,
    target: &Inputs<M>,
    out: &mut [Pairs<M>],
) -> Result<usize, Error> {
    if mechanism.facts().within.is_none() {
        let mut conforming = target.clone();
        conform(mechanism.facts().conditions, conforming.as_mut())?;
        let p = mechanism.parameters(&conforming);
        let mut steps = Steps::at_most(MOST_STEPS);
        let mut answers = Answers::new(Problem::new(mechanism, &p, &mut steps), &mut [], Some(&mut *out));
        answers.find()?;
        let (count, are_all) = (answers.count, answers.are_all_pairs());
        if are_all {
            out[..count].sort_unstable_by_key(|pairs| pairs.branch);
            return Ok(count);
        }
    }
    let mut list: Answered<M, Solution<M>> = Array::by(mechanism.facts().capacity, |_| Solution::empty(mechanism));
    let count = solve_one(mechanism, target, list.as_mut(), &mut Steps::at_most(MOST_STEPS))?.min(out.len());
    for (pairs, solution) in out.iter_mut().zip(list.as_ref()).take(count) {
        *pairs = pairs_of(mechanism, solution);
    }
    Ok(count)
}

/// A solution by cosines and sines.
pub(crate) fn pairs_of<M: Mechanism>(mechanism: &M, solution: &Solution<M>) -> Pairs<M> {
    let facts = mechanism.facts();
    let joints = Array::by(facts.joints.len(), |i| {
        let value = solution.q.as_ref()[i];
        if matches!(facts.joints[i], Joint::Angle(_)) { cosine_and_sine(value) } else { [value, 0.0] }
    });
    Pairs {
        joints,
        residual: solution.residual,
        branch: solution.branch,
        free: solution.free,
        settled: solution.settled,
    }
}

/// Same as [`crate::Solve::nearest_to`].
pub(crate) fn nearest_to<M: Mechanism>(
    mechanism: &M,
    target: &Inputs<M>,
    aim: &Aim<'_, M>,
    out: &mut [Solution<M>],
) -> Result<Option<(Solution<M>, f64)>, Error> {
    let count = solve_one(mechanism, target, out, &mut Steps::at_most(MOST_STEPS))?;
    let (list, facts) = (&out[..count], mechanism.facts());
    let listed = nearest(&facts, list, aim).map(|(k, turned)| Best::listed(turned, list, k));
    let member = list.iter().position(|answer| answer.free != 0);
    let known = member.or(listed.as_ref().and_then(Best::member)).unwrap_or(0);
    let best = if facts.has_extras || count == 0 || !aim.is_finite() {
        listed
    } else {
        let mut target = target.clone();
        conform(facts.conditions, target.as_mut())?;
        let (p, mut steps) = (mechanism.parameters(&target), Steps::at_most(MOST_STEPS));
        if facts.within.is_some() {
            along_ideal(mechanism, &p, list, (aim, listed), &mut steps)
        } else {
            let mut search = Search { problem: Problem::new(mechanism, &p, &mut steps), aim, best: listed };
            if member.is_some() {
                search.all(list)
            } else {
                search.beside()
            }
            search.best
        }
    };
    Ok(best.map(|best| {
        let like = best.member().unwrap_or(known);
        best.solution(&list[like])
    }))
}
