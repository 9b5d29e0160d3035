//! The check of a program that solves equations as one system: [`check_equations`].

use super::chain::model::Joints;
use super::check::{ByScrews, Check, Subject};
use super::model::Model;
use super::report::{Fault, Report};
use super::targets::Targets;
use super::{Options, exact, screws};
use crate::derive::Source;
use crate::solver::Program;
use crate::tolerances::WITNESS;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::kinematics::oracle::Oracle;
use groebot_robot::kinematics::{Chain, Solution};

/// Checks `program` at targets of all kinds against `source`, from which it was derived.
///
/// # Errors
/// [`ErrorKind::BadValue`] for an invalid program, or one with other inputs or joints than the source. [`ErrorKind::Unsupported`] if no reachable target is
/// found. The error of `watch` if it stops the check. Failed checks are in the report.
pub fn check_equations<'w>(
    source: &Source,
    program: &Program,
    options: &Options,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Report> {
    let watch = Watch::or_none(watch);
    program.validate()?;
    let text = "the source has no equations to be solved together";
    let none = || Error::new(ErrorKind::BadValue, text).in_file(&source.path);
    let system = source.system.as_ref().ok_or_else(none)?;
    if program.inputs.len() != system.inputs.len() || program.joints.len() != system.joints.len() {
        let text = "the program has other inputs or joints than its source; derive it again";
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    // If the equations contain no lengths, a program's scale is nearly zero.
    let unit = if program.scale > WITNESS.equal { program.scale } else { 1.0 };
    let chain = source.chain.as_ref();
    let subject = InEquations { model: Model::new(system, unit), chain, bound: program.bound() };
    let (solver, screws) = (program.solver(), chain.and_then(ByScrews::boxed));
    let check = Check { subject: &subject, solver: &solver, screws, options: *options, watch };
    let mut targets = Targets::new(&subject.model, program, options.draws, options.seed);
    let unreached = "no target was found that random joint values reach; check the equations";
    let inputs = system.inputs.iter().map(|input| input.name.clone()).collect();
    let joints = system.joints.iter().map(|joint| joint.name.clone()).collect();
    check.report(inputs, joints, &mut |number| {
        let target = targets.draw(number).ok_or_else(|| Error::new(ErrorKind::Unsupported, unreached))?;
        Ok((target, None))
    })
}

/// Equations, with their chain if they have one.
struct InEquations<'a> {
    model: Model<'a>,
    chain: Option<&'a Chain>,
    /// The number of branches of the program's largest case.
    bound: usize,
}

impl InEquations<'_> {
    /// Whether `q` is `answer`, or a member of the self-motion that it represents.
    fn represents(&self, target: &[f64], answer: &Solution, q: &[f64]) -> bool {
        if answer.free.is_empty() {
            return self.model.matches(target, q, &answer.q);
        }
        let member = member(answer, q);
        if self.model.misfit(target, &member) <= WITNESS.residual {
            return self.model.matches(target, q, &member);
        }
        // The other joints move with the free ones. Without solving, it is only known that `q` is in some self-motion.
        self.model.sigma(target, q) <= WITNESS.free
    }
}

/// `answer` with its free joints at the values of `q`.
fn member(answer: &Solution, q: &[f64]) -> Vec<f64> {
    let pick = |(joint, value): (usize, &f64)| if answer.free.contains(&joint) { q[joint] } else { *value };
    answer.q.iter().enumerate().map(pick).collect()
}

impl Subject for InEquations<'_> {
    fn singular(&self) -> f64 {
        WITNESS.free
    }

    fn searches_completely(&self) -> bool {
        true
    }

    fn is_well_formed(&self, q: &[f64]) -> bool {
        self.model.is_well_formed(q)
    }

    fn sigma(&self, target: &[f64], q: &[f64]) -> f64 {
        self.model.sigma(target, q)
    }

    fn distance(&self, target: &[f64], a: &[f64], b: &[f64]) -> f64 {
        self.model.distance(target, a, b)
    }

    fn residual(&self, target: &[f64], q: &[f64]) -> (f64, bool) {
        let misfit = self.model.misfit(target, q);
        let missed = self.chain.map_or(0.0, |chain| screws::misplacement(chain, q, target));
        (misfit, misfit.max(missed) > WITNESS.residual)
    }

    fn are_too_many(&self, answers: &[Solution]) -> bool {
        answers.len() > self.bound
    }

    /// Free joints do not contribute to the distance.
    fn known(&self, target: &[f64], answers: &[Solution], q: &[f64]) -> (Option<f64>, Option<Fault>) {
        let gap = |answer: &Solution| self.model.distance(target, q, &member(answer, q));
        let is_found = answers.iter().any(|answer| self.represents(target, answer, q));
        (answers.iter().map(gap).reduce(f64::min), (!is_found).then_some(Fault::Missing))
    }

    fn covers(&self, target: &[f64], some: &[Solution], answer: &Solution) -> bool {
        let is_sure = self.model.misfit(target, &answer.q) <= WITNESS.exact;
        !is_sure || some.iter().any(|other| self.represents(target, other, &answer.q))
    }

    fn is_found_by_screws(&self, _: &Solution) -> bool {
        true
    }

    fn moved_target(&self, target: &[f64], q: Vec<f64>, shift: &dyn Fn(usize) -> f64) -> Option<Vec<f64>> {
        let sizes = self.model.joint_sizes(target);
        let moved: Vec<f64> = (0..q.len()).map(|joint| q[joint] + shift(joint) * sizes[joint]).collect();
        self.model.inputs_at(&moved, target)
    }

    /// The value of a plain joint is its typical size times the tangent of half the oracle's angle.
    fn search(&self, target: &[f64], seeds: usize) -> Result<Vec<Vec<f64>>> {
        let sizes = self.model.joint_sizes(target);
        let joints = |angles: &[f64]| -> Vec<f64> {
            let value = |(joint, angle): (usize, &f64)| {
                if self.model.turns(joint) { *angle } else { sizes[joint] * (0.5 * angle).tan() }
            };
            angles.iter().enumerate().map(value).collect()
        };
        let oracle = Oracle { seeds, ..Oracle::default() };
        let found = oracle.solve(sizes.len(), |angles| self.model.shares(target, &joints(angles)))?;
        Ok(found.iter().map(|answer| joints(&answer.q)).collect())
    }

    fn count(&self, target: &[f64], watch: &Watch) -> Result<Option<usize>> {
        exact::count(self.model.system, target, watch)
    }
}
