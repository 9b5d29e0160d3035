//! The check of a chain's solver by independent witnesses: forward kinematics of the chain, joint values that made the target, the exact number of real
//! solutions, the screw solver, a numeric oracle. Main function: [`check_chain`].
//!
//! Differences of solutions use lengths as fractions of the reach and angles in radians. See [`Fault`] for the possible faults.

mod arcs;
mod count;
pub mod coupled;
mod exact;
mod form;
pub(super) mod model;
mod rational;
mod round;
mod self_motion;
pub(super) mod singular;
mod targets;

use super::check::{ByScrews, Check, Solver, Subject};
use super::{Fault, Kind, Options, Report};
use crate::tolerances::WITNESS;
use crate::{Result, Watch};
pub use arcs::check_arcs;
use count::Counter;
use groebot_robot::kinematics::{Chain, Solution, Task};
use model::{Configuration, Model};
use rational::Rationals;
use self_motion::{STEPS, SelfMotions};
use targets::Targets;

/// Checks `solver`, which solves `chain` for its task, at targets of all kinds. `bound` is the certified number of complex solutions, if it is known. The
/// first [`Options::exact`] random targets come from rational joint values, where solutions are counted exactly.
///
/// # Errors
/// Those of the solver, except for gaps. The error of `watch` if it stops the check. Failed checks are in the report.
pub fn check_chain<'w>(
    chain: &Chain,
    solver: &dyn Solver,
    bound: Option<usize>,
    options: &Options,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Report> {
    let watch = Watch::or_none(watch);
    check_within(chain, solver, bound, (options, WITNESS.residual), watch)
}

/// Same as [`check_chain`], but for a chain as described, whose ideal chain decides which solutions exist. Its solutions may miss their targets by `tolerance`
/// (a fraction of the reach, and rad).
///
/// # Errors
/// As [`check_chain`].
pub fn check_within<'w>(
    chain: &Chain,
    solver: &dyn Solver,
    bound: Option<usize>,
    (options, tolerance): (&Options, f64),
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Report> {
    let watch = Watch::or_none(watch);
    let model = Model::new(chain);
    let mut rationals = Rationals::new(Counter::new(chain, &model.given), options.seed);
    let mut targets = Targets::new(&model, options.draws, options.seed);
    // The angle of a joint that follows another one is not always at a rational point of the circle.
    let follows = chain.joints().iter().any(|joint| joint.mimic.is_some());
    let is_counted = !follows && chain.task() != Task::PositionPitchRoll;
    let exact = if is_counted { options.exact } else { 0 };
    let subject = Moving { model: &model, bound, tolerance };
    let check = Check { subject: &subject, solver, screws: ByScrews::boxed(chain), options: *options, watch };
    let joints = chain.joints().iter().map(|joint| joint.name.clone()).collect();
    check.report(model.input_names(), joints, &mut |number| {
        rationals.in_place_of(&model, targets.draw(number), exact, watch)
    })
}

/// A chain, or coupled chains, under check.
struct Moving<'a> {
    model: &'a dyn Configuration,
    /// The certified number of complex solutions, if it is known.
    bound: Option<usize>,
    /// The maximum error of a solution, for overdetermined tasks (more numbers than independent joints): a fraction of the reach, and rad.
    tolerance: f64,
}

impl Moving<'_> {
    /// Whether `q` and `b` are one solution of a chain as described. This holds if a pose at which two solutions meet is within the tolerance. All joint values
    /// between them then reach the target within the tolerance.
    fn are_one_in_tolerance(&self, target: &[f64], q: &[f64], b: &[f64]) -> bool {
        let open = self.tolerance.sqrt();
        self.is_described()
            && self.model.sigma(q) <= open
            && self.model.distance(q, b) <= 2.0 * open
            && self.model.is_joined(target, q, b, self.tolerance)
    }

    /// Whether the chain is described inexactly, so that solutions may miss their targets. The ideal chain decides which solutions exist.
    fn is_described(&self) -> bool {
        self.tolerance > WITNESS.residual
    }

    /// Whether `q` is a member of a self-motion that one of the solutions represents. On the path between them, a described chain may miss the target by the
    /// tolerance of a solution, because only the ideal chain has the self-motion.
    fn is_member(&self, target: &[f64], answers: &[Solution], q: &[f64]) -> bool {
        let self_motions = || answers.iter().filter(|answer| !answer.free.is_empty());
        let missed = if self.is_described() { self.tolerance } else { WITNESS.member };
        let leads = |answer: &Solution, step: f64| self.model.leads_to(target, q, answer, (step, missed));
        self_motions().any(|answer| self.model.matches(target, q, &answer.q))
            || STEPS.into_iter().any(|step| self_motions().any(|answer| leads(answer, step)))
            || self_motions().any(|answer| self.model.runs_to(target, q, &answer.q))
    }

    /// Whether `b` is the same solution as `a`. For a chain as described, two solvers may give different joint values with errors within the tolerance.
    fn are_same(&self, target: &[f64], a: &[f64], b: &[f64]) -> bool {
        let open = 2.0 * self.tolerance / self.model.sigma(a).max(self.tolerance.sqrt());
        self.model.is_same(target, a, b) || (self.is_described() && self.model.distance(a, b) <= open)
    }
}

impl Subject for Moving<'_> {
    fn singular(&self) -> f64 {
        WITNESS.ordinary
    }

    fn searches_completely(&self) -> bool {
        false
    }

    fn is_well_formed(&self, q: &[f64]) -> bool {
        self.model.is_well_formed(q)
    }

    fn sigma(&self, _: &[f64], q: &[f64]) -> f64 {
        self.model.sigma(q)
    }

    fn distance(&self, _: &[f64], a: &[f64], b: &[f64]) -> f64 {
        self.model.distance(a, b)
    }

    fn residual(&self, target: &[f64], q: &[f64]) -> (f64, bool) {
        let residual = self.model.residual(target, q);
        (residual, residual > self.tolerance)
    }

    /// Several members may represent one self-motion, so only solutions without free joints are counted.
    fn are_too_many(&self, answers: &[Solution]) -> bool {
        let single = answers.iter().filter(|answer| answer.free.is_empty()).count();
        self.bound.is_some_and(|bound| single > bound)
    }

    /// There is also a fault if a self-motion with the joint values is not reported as one.
    fn known(&self, target: &[f64], answers: &[Solution], q: &[f64]) -> (Option<f64>, Option<Fault>) {
        if self.is_member(target, answers, q) {
            return (None, None);
        }
        let gap = |answer: &Solution| self.model.distance(q, &answer.q);
        let nearest = answers.iter().filter(|answer| answer.free.is_empty()).map(gap).reduce(f64::min);
        if self.model.is_in_self_motion(target, q) {
            return (nearest, Some(Fault::SelfMotion));
        }
        let is_same = |answer: &Solution| {
            self.model.is_same(target, q, &answer.q) || self.are_one_in_tolerance(target, q, &answer.q)
        };
        (nearest, (!answers.iter().any(is_same)).then_some(Fault::Missing))
    }

    fn covers(&self, target: &[f64], some: &[Solution], answer: &Solution) -> bool {
        let least = if self.model.sigma(&answer.q) > WITNESS.ordinary { WITNESS.exact } else { WITNESS.rounding };
        let is_sure = self.model.residual(target, &answer.q) <= least;
        let is_same = |other: &Solution| self.are_same(target, &answer.q, &other.q);
        !is_sure || some.iter().any(is_same) || self.is_member(target, some, &answer.q)
    }

    /// The screw solver loses solutions next to singular configurations and for overdetermined tasks (more numbers than independent joints). There, forward
    /// kinematics alone checks ours.
    fn is_found_by_screws(&self, answer: &Solution) -> bool {
        let jacobian = self.model.jacobian(&answer.q);
        self.model.sigma(&answer.q) > WITNESS.ordinary && jacobian.nrows() <= jacobian.ncols()
    }

    fn moved_target(&self, _: &[f64], mut q: Vec<f64>, shift: &dyn Fn(usize) -> f64) -> Option<Vec<f64>> {
        for (number, &joint) in self.model.unknown().iter().enumerate() {
            q[joint] += shift(number) * self.model.unit(joint);
        }
        self.model.settle(&mut q);
        Some(self.model.target(&q))
    }

    fn search(&self, target: &[f64], seeds: usize) -> Result<Vec<Vec<f64>>> {
        self.model.search(target, seeds)
    }

    fn completed(&self, target: &[f64], answer: Solution) -> Solution {
        self.model.completed(target, answer)
    }
}

/// Targets from rational joint values with the exact number of distinct real solutions.
pub use rational::{Counted, count_exactly};

fn is_random(kind: &Kind) -> bool {
    *kind == Kind::Random
}
