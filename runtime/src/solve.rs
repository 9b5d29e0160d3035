//! Public functions of a mechanism's solver: [`Solve`].

use crate::answers::Answers;
use crate::batch::solve_widest;
use crate::conditions::conform;
use crate::described::{reached, read_off, solve_described, within_limits};
use crate::effort::MOST_STEPS;
use crate::joints::place;
use crate::limits::{self, Aim, strides_within, turned_within};
use crate::mechanism::{Condition, Inputs, Joints, Mechanism};
use crate::placement::Placement;
use crate::problem::Problem;
use crate::singly::{nearest_to, pairs_of, solve_one, solve_one_by_pairs};
use crate::solution::{Error, Pairs, Solution};
use crate::steps::Steps;

/// Inverse kinematics of a mechanism.
///
/// For a pose task, a target is the pose of the tip in the base frame: twelve numbers, the position and the rotation by rows. Other tasks have their own
/// numbers. Units are metres and radians unless the mechanism's file specifies others. Angles of solutions are in (-pi, pi].
pub trait Solve: Mechanism {
    /// Writes all solutions for `target` to the front of `out`, ordered by branch, and returns their number: 0 when the target is out of reach. Branch numbers
    /// are consistent from target to target. If `out` is too short, it receives the best ones.
    ///
    /// # Errors
    /// See [`Error`]; the content of `out` is then undefined.
    fn solve(&self, target: &Inputs<Self>, out: &mut [Solution<Self>]) -> Result<usize, Error> {
        self.solve_bounded(target, MOST_STEPS, out)
    }

    /// Same as [`Solve::solve`], with at most `steps` [steps](MOST_STEPS) of polishing, to bound the time for a target. When they are used up, its solutions
    /// are not [settled](Solution::settled).
    ///
    /// # Errors
    /// Same as [`Solve::solve`]; [`Error::Unsettled`] where no solution was found before.
    fn solve_bounded(&self, target: &Inputs<Self>, steps: usize, out: &mut [Solution<Self>]) -> Result<usize, Error> {
        solve_one(self, target, out, &mut Steps::at_most(steps))
    }

    /// Same as [`Solve::solve`], but where there is no solution, returns the joint values with the least relative residual, if polishing led to any. These are
    /// not a solution, as their residual shows.
    ///
    /// # Errors
    /// Same as [`Solve::solve`].
    fn solve_or_nearest(
        &self,
        target: &Inputs<Self>,
        out: &mut [Solution<Self>],
    ) -> Result<(usize, Option<Solution<Self>>), Error> {
        let mut target = target.clone();
        conform(self.facts().conditions, target.as_mut())?;
        let mut steps = Steps::at_most(MOST_STEPS);
        if let Some(within) = self.facts().within {
            return solve_described(self, &target, within, out, &mut steps);
        }
        let p = self.parameters(&target);
        let mut answers = Answers::new(Problem::new(self, &p, &mut steps), out, None);
        answers.find()?;
        let count = answers.conclude()?;
        let nearest = answers.nearest.take().filter(|_| count == 0);
        let solution = |(q, fit): (Joints<Self>, crate::problem::Fit)| Solution {
            q,
            residual: fit.residual,
            relative: fit.relative,
            branch: 0,
            chosen: false,
            free: 0,
            settled: true,
        };
        Ok((count, nearest.map(solution)))
    }

    /// Same as [`Solve::solve`], by cosines and sines. At ordinary targets no arc tangent is computed. Where a candidate must be polished, or two are close to
    /// each other, the cosines and sines are those of the angles that [`Solve::solve`] finds.
    ///
    /// # Errors
    /// Same as [`Solve::solve`].
    fn solve_pairs(&self, target: &Inputs<Self>, out: &mut [Pairs<Self>]) -> Result<usize, Error> {
        solve_one_by_pairs(self, target, out)
    }

    /// A solution by cosines and sines.
    fn pairs_of(&self, solution: &Solution<Self>) -> Pairs<Self> {
        pairs_of(self, solution)
    }

    /// Same as [`Solve::solve`], for a target whose first 12 numbers are world_from_tool, the pose of a tool in a world frame. The values of
    /// given joints are after them.
    ///
    /// # Errors
    /// As [`Solve::solve`]; [`Error::NotPose`] if the task is not the pose of one tip.
    fn solve_placed(
        &self,
        placement: &Placement,
        target: &Inputs<Self>,
        out: &mut [Solution<Self>],
    ) -> Result<usize, Error> {
        if !matches!(self.facts().conditions, [Condition::Rotation(3)]) {
            return Err(Error::NotPose);
        }
        let (mut target, mut world_from_tool) = (target.clone(), [0.0; 12]);
        world_from_tool.copy_from_slice(&target.as_ref()[..12]);
        target.as_mut()[..12].copy_from_slice(&placement.target(&world_from_tool));
        self.solve(&target, out)
    }

    /// Same as [`Solve::solve`], for many targets; the lanes of a vector register process several at once. The solutions of a target follow those of the target
    /// before in `out`. An entry of `counts` is their number, or the error. Returns the number of solved targets. These are all, unless `counts` is shorter or
    /// `out` has no room for the solutions of the next one.
    ///
    /// Each solution is bitwise equal to that of [`Solve::solve`], which also solves all targets here that are not ordinary.
    fn solve_batch(
        &self,
        targets: &[Inputs<Self>],
        out: &mut [Solution<Self>],
        counts: &mut [Result<usize, Error>],
    ) -> usize {
        solve_widest(self, targets, out, counts)
    }

    /// Same as [`Solve::solve_batch`], by cosines and sines. Each solution is bitwise equal to that of [`Solve::solve_pairs`].
    fn solve_pairs_batch(
        &self,
        targets: &[Inputs<Self>],
        out: &mut [Pairs<Self>],
        counts: &mut [Result<usize, Error>],
    ) -> usize {
        solve_widest(self, targets, out, counts)
    }

    /// The largest magnitude among the equations' values at joint values `q`: zero where `q` reaches `target`. NaN when a target number is not finite, a
    /// condition does not hold or an equation's value is NaN. Also NaN where equations read numbers that follow from no joint.
    fn residual(&self, target: &Inputs<Self>, q: &Joints<Self>) -> f64 {
        let (mut target, facts) = (target.clone(), self.facts());
        if facts.has_extras || conform(facts.conditions, target.as_mut()).is_err() {
            return f64::NAN;
        }
        let (p, at) = (self.parameters(&target), place::<Self>(&facts, q, None));
        let values = if facts.within.is_some() { self.described(&p, &at) } else { self.values(&p, &at) };
        let larger = |largest: f64, value: &f64| if largest >= value.abs() { largest } else { value.abs() };
        let are_numbers = !values.as_ref().iter().any(|value| value.is_nan());
        if are_numbers { values.as_ref().iter().fold(0.0, larger) } else { f64::NAN }
    }

    /// The target that joint values `q` reach. `None` for equations that do not compare the tip with the target.
    fn forward(&self, q: &Joints<Self>) -> Option<Inputs<Self>> {
        let facts = self.facts();
        (facts.reached.len() == facts.inputs).then(|| match facts.within {
            None => read_off::<Self>(&facts, &self.tip(&place::<Self>(&facts, q, None)), q),
            Some(_) => reached(self, q),
        })
    }

    /// Same as [`Solve::solve`], for the solutions that have a turn within `limits`. Each is moved there by as few turns of each angle as possible. A member of
    /// a self-motion outside of the limits is moved along it in steps of 0.1, one free joint at a time.
    ///
    /// # Errors
    /// Same as [`Solve::solve`].
    fn solve_within(
        &self,
        target: &Inputs<Self>,
        limits: &Joints<Self, [f64; 2]>,
        out: &mut [Solution<Self>],
    ) -> Result<usize, Error> {
        let count = self.solve(target, out)?;
        let (mut target, facts) = (target.clone(), self.facts());
        conform(facts.conditions, target.as_mut())?;
        let p = self.parameters(&target);
        let mut kept = 0;
        for k in 0..count {
            let mut steps = Steps::at_most(MOST_STEPS);
            if facts.within.is_some() {
                let Some((q, residual)) = within_limits(self, &p, &out[k], limits) else { continue };
                (out[k].q, out[k].residual) = (q, residual);
            } else if let Some(q) = turned_within::<Self>(&facts, &out[k].q, limits) {
                out[k].q = q;
            } else if facts.has_extras {
                continue;
            } else if let Some((q, residual)) = strides_within(&mut Problem::new(self, &p, &mut steps), &out[k], limits)
            {
                (out[k].q, out[k].residual) = (q, residual);
            } else {
                continue;
            }
            out.swap(kept, k);
            kept += 1;
        }
        Ok(kept)
    }

    /// The number of turns of `q` within `limits`: joint values that differ from it by whole turns of its angles. Limits hold within 1e-9, because rounding may
    /// move a joint beyond its limit. An angle that lacks a limit counts once. 0 when `q` cannot be brought within `limits`; at most [`limits::MOST_TURNS`].
    fn count_turns(&self, q: &Joints<Self>, limits: &Joints<Self, [f64; 2]>) -> usize {
        limits::count_turns(&self.facts(), q.as_ref(), limits.as_ref())
    }

    /// The turn of `q` with this index, which must be below their number. The last joint changes fastest.
    fn turn(&self, q: &Joints<Self>, limits: &Joints<Self, [f64; 2]>, index: usize) -> Joints<Self> {
        let mut turned = q.clone();
        limits::turn(&self.facts(), turned.as_mut(), limits.as_ref(), index);
        turned
    }

    /// The index of the solution that is nearest to `reference` after turns within `limits`, the first of equals, and its nearest turn. `None` when no solution
    /// is within `limits`. The distance is the sum of the joints' squared differences, each times its non-negative weight.
    ///
    /// A member of a self-motion is used as listed. [`Solve::nearest_to`] searches the whole self-motion.
    fn nearest(
        &self,
        list: &[Solution<Self>],
        reference: &Joints<Self>,
        weights: &Joints<Self>,
        limits: &Joints<Self, [f64; 2]>,
    ) -> Option<(usize, Joints<Self>)> {
        let (index, turned) = limits::nearest(&self.facts(), list, &Aim { reference, weights, limits })?;
        Some((index, turned.q))
    }

    /// The solution of `target` that is nearest to `reference` after turns within `limits`, and its distance: the sum of the joints' squared differences, each
    /// times its non-negative weight. Its angles are not wrapped. `None` when no solution is within `limits`. `out` has room for all solutions.
    ///
    /// At a singular target the self-motions are searched, too. Where one is a curve, its nearest place within limits is found; where it is a surface, a local
    /// minimum of the distance. The steps along a curve are at most 0.2 rad. Where no solution has a free joint, this is [`Solve::solve`] and
    /// [`Solve::nearest`].
    ///
    /// # Errors
    /// Same as [`Solve::solve`].
    fn nearest_to(
        &self,
        target: &Inputs<Self>,
        reference: &Joints<Self>,
        weights: &Joints<Self>,
        limits: &Joints<Self, [f64; 2]>,
        out: &mut [Solution<Self>],
    ) -> Result<Option<(Solution<Self>, f64)>, Error> {
        nearest_to(self, target, &Aim { reference, weights, limits }, out)
    }
}

impl<M: Mechanism> Solve for M {}
