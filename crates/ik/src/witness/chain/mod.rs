//! The check of a chain's solver by independent witnesses: forward kinematics of the chain, joint values that made the target, the exact number of real
//! solutions, the screw solver, a numeric oracle. Main type: [`Check`].
//!
//! Differences of solutions use lengths as fractions of the reach and angles in radians. See [`Fault`] for the possible faults.

mod count;
pub mod coupled;
mod exact;
mod form;
mod model;
mod rational;
mod round;
mod self_motion;
mod singular;
mod targets;

use super::report::{Fault, Kind, Report, Row, Verdict};
use super::screws::Screws;
use super::{DUPLICATE, Draws, FOLLOWS, Judged, MOVED, ORACLE, Options, SEEDS, SINGULAR, TIE, faults_of_each, share};
use crate::solver::Program;
use crate::{ErrorKind, Result, Watch};
use count::Counter;
use groebot_robot::kinematics::{Chain, Solution, Task};
use model::{Configuration, EXACT, Model, ORDINARY, RESIDUAL, SHARP};
use rational::Rationals;
use self_motion::{MEMBER, STEPS, SelfMotions};
use targets::{Target, Targets};

/// The number of rows, from the first, whose round targets are also searched numerically.
const SEARCHED: usize = 48;

/// A solver under check, with targets given as numbers.
///
/// Inputs are in the order of a derived program: position, then rotation by rows or direction, then the given joints.
pub trait Solver {
    /// All joint vectors of the target, with or without the given joints.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] if the target is in a known gap of the solver. Other errors end the check.
    fn solve(&self, inputs: &[f64]) -> Result<Vec<Solution>>;
}

impl Solver for Program {
    fn solve(&self, inputs: &[f64]) -> Result<Vec<Solution>> {
        Program::solve_numbers(self, inputs)
    }
}

/// The screw solver of a chain as a [`Solver`].
pub struct ByScrews(Screws);

impl ByScrews {
    /// `None` if screw theory does not solve the chain.
    pub fn new(chain: &Chain) -> Option<Self> {
        Screws::new(chain).map(ByScrews)
    }
}

impl Solver for ByScrews {
    fn solve(&self, inputs: &[f64]) -> Result<Vec<Solution>> {
        self.0.solve(inputs)
    }
}

/// The check of one solver of a chain.
pub struct Check<'a> {
    model: &'a dyn Configuration,
    solver: &'a dyn Solver,
    bound: Option<usize>,
    screws: Option<Box<dyn Solver + 'a>>,
    options: Options,
    /// The maximum error of a solution, for overdetermined tasks (more numbers than independent joints): a fraction of the reach, and rad.
    tolerance: f64,
    watch: &'a Watch,
}

impl<'a> Check<'a> {
    /// Checks `solver`, which solves `chain` for its task, at targets of all kinds. `bound` is the certified number of complex solutions, if it is known. The
    /// first [`Options::exact`] random targets come from rational joint values, where solutions are counted exactly.
    ///
    /// # Errors
    /// Those of the solver, except for gaps. The error of `watch` if it stops the check. Failed checks are in the report.
    pub fn run(
        chain: &Chain,
        solver: &dyn Solver,
        bound: Option<usize>,
        options: &Options,
        watch: &Watch,
    ) -> Result<Report> {
        Check::run_within(chain, solver, bound, (options, RESIDUAL), watch)
    }

    /// Same as [`Check::run`], but for a chain as described, whose ideal chain decides which solutions exist. Its solutions may miss their targets by
    /// `tolerance` (a fraction of the reach, and rad).
    ///
    /// # Errors
    /// As [`Check::run`].
    pub fn run_within(
        chain: &Chain,
        solver: &dyn Solver,
        bound: Option<usize>,
        (options, tolerance): (&Options, f64),
        watch: &Watch,
    ) -> Result<Report> {
        let model = Model::new(chain);
        let screws = ByScrews::new(chain).map(|screws| Box::new(screws) as Box<dyn Solver>);
        let mut rationals = Rationals::new(Counter::new(chain, &model.given), options.seed);
        let mut targets = Targets::new(&model, options.draws, options.seed);
        // The angle of a joint that follows another one is not always at a rational point of the circle.
        let follows = chain.joints().iter().any(|joint| joint.mimic.is_some());
        let is_counted = !follows && chain.task() != Task::PositionPitchRoll;
        let exact = if is_counted { options.exact } else { 0 };
        let check = Check { model: &model, solver, bound, screws, options: *options, tolerance, watch };
        let rows = check.rows(&mut |number| rationals.in_place_of(&model, targets.draw(number), exact, watch))?;
        Ok(Report {
            inputs: model.input_names(),
            joints: chain.joints().iter().map(|joint| joint.name.clone()).collect(),
            rows,
        })
    }

    /// The rows of the targets that `draw` returns for their numbers, each with its exact number of solutions if that was counted.
    fn rows(&self, draw: &mut dyn FnMut(usize) -> Result<(Target, Option<usize>)>) -> Result<Vec<Row>> {
        let mut rows = Vec::with_capacity(self.options.targets);
        for number in 0..self.options.targets {
            self.watch.check()?;
            self.watch.report("check", number, self.options.targets - number);
            let (target, exact) = draw(number)?;
            rows.push(self.row(number, target, exact)?);
        }
        Ok(rows)
    }

    fn row(&self, number: usize, target: Target, exact: Option<usize>) -> Result<Row> {
        let Target { kind, inputs, joints } = target;
        let answers = match self.solver.solve(&inputs) {
            Ok(answers) => Some(answers),
            Err(error) if error.kind() == ErrorKind::Unsupported => None,
            Err(error) => return Err(error.with_context(format!("row {}, {kind}", number + 1))),
        };
        let mut row = Row { exact, ..Row::open(number, kind, inputs, joints, answers.as_deref()) };
        if let Some(answers) = answers {
            let answers = self.completed(&row.target, answers);
            let faults = self.faults(number, &mut row, &answers)?;
            row.verdict = if faults.is_empty() { Verdict::Pass } else { Verdict::Fail(faults) };
        }
        Ok(row)
    }

    fn faults(&self, number: usize, row: &mut Row, answers: &[Solution]) -> Result<Vec<Fault>> {
        let mut faults = self.each(row, answers);
        if faults.contains(&Fault::Range) {
            return Ok(faults);
        }
        let is_singular = |q: &[f64]| self.model.sigma(q) <= ORDINARY;
        row.is_singular =
            row.joints.as_deref().into_iter().chain(answers.iter().map(|answer| answer.q.as_slice())).any(is_singular);
        faults.extend(self.together(answers));
        faults.extend(self.known(row, answers));
        let wrong = row.exact.is_some_and(|exact| exact != answers.len()) && !self.is_tie(row, answers);
        faults.extend(wrong.then_some(Fault::Count));
        if let Some(screws) = &self.screws {
            match screws.solve(&row.target) {
                Err(error) if error.kind() == ErrorKind::Unsupported => {}
                Err(error) => return Err(error),
                Ok(others) => {
                    row.screw = Some(others.len());
                    row.is_singular |= others.iter().any(|other| is_singular(&other.q));
                    faults.extend((!self.agrees(&row.target, answers, &others)).then_some(Fault::Screw));
                }
            }
        }
        if number < self.options.oracle {
            let (count, agrees) = self.oracle(&row.target, answers)?;
            row.oracle = Some(count);
            faults.extend((!agrees).then_some(Fault::Oracle));
        }
        if row.kind.is_round() {
            faults.extend(self.round(number, row, answers)?);
        }
        Ok(faults)
    }

    /// Faults of the set of solutions at a round target: solutions of a search, and of a slightly moved target, that are not among them.
    fn round(&self, number: usize, row: &mut Row, answers: &[Solution]) -> Result<Vec<Fault>> {
        let mut faults = Vec::new();
        let is_early = number < SEARCHED || self.options.draws == Draws::Round;
        if self.options.oracle > 0 && is_early && row.oracle.is_none() {
            let found = self.model.search(&row.target, SEEDS[0])?;
            let is_ours = |q: &Vec<f64>| self.model.sigma(q) <= ORDINARY || self.is_near(q, answers, ORACLE);
            row.oracle = Some(found.len());
            faults.extend((!found.iter().all(is_ours)).then_some(Fault::Oracle));
        }
        faults.extend((!self.agrees_when_moved(row, answers)?).then_some(Fault::Moved));
        Ok(faults)
    }

    /// Whether each ordinary solution of a reached target that is moved by [`MOVED`] is next to one of these.
    fn agrees_when_moved(&self, row: &Row, answers: &[Solution]) -> Result<bool> {
        let Some(mut q) = row.joints.clone().or_else(|| answers.first().map(|answer| answer.q.clone())) else {
            return Ok(true);
        };
        for (number, &joint) in self.model.unknown().iter().enumerate() {
            q[joint] += MOVED * share(number) * self.model.unit(joint);
        }
        self.model.settle(&mut q);
        let moved = self.model.target(&q);
        let others = match self.solver.solve(&moved) {
            Err(error) if error.kind() == ErrorKind::Unsupported => return Ok(true),
            others => self.completed(&moved, others?),
        };
        Ok(others.iter().all(|other| {
            let sigma = self.model.sigma(&other.q);
            sigma <= ORDINARY || self.is_near(&other.q, answers, FOLLOWS * MOVED / sigma)
        }))
    }

    fn completed(&self, target: &[f64], answers: Vec<Solution>) -> Vec<Solution> {
        answers.into_iter().map(|answer| self.model.completed(target, answer)).collect()
    }

    fn is_near(&self, q: &[f64], answers: &[Solution], within: f64) -> bool {
        answers.iter().any(|answer| self.model.distance(q, &answer.q) <= within)
    }

    /// Checks each solution alone, and records the largest residual.
    fn each(&self, row: &mut Row, answers: &[Solution]) -> Vec<Fault> {
        let target = row.target.clone();
        faults_of_each(row, answers, |answer| {
            self.model.is_well_formed(&answer.q).then(|| {
                let residual = self.model.residual(&target, &answer.q);
                let is_too_free = !answer.free.is_empty() && self.model.sigma(&answer.q) > SINGULAR;
                Judged { residual, is_missed: residual > self.tolerance, is_too_free }
            })
        })
    }

    /// Checks the solutions as a set.
    fn together(&self, answers: &[Solution]) -> Vec<Fault> {
        let twice = |(index, a): (usize, &Solution)| {
            answers[..index].iter().any(|b| self.model.distance(&a.q, &b.q) <= DUPLICATE)
        };
        let duplicate = answers.iter().enumerate().any(twice).then_some(Fault::Duplicate);
        // Several members may represent one self-motion.
        let single = answers.iter().filter(|answer| answer.free.is_empty()).count();
        let bound = self.bound.is_some_and(|bound| single > bound).then_some(Fault::Bound);
        duplicate.into_iter().chain(bound).collect()
    }

    /// The fault if the joint values that made the target are not among the solutions, or if a self-motion with them is not reported.
    fn known(&self, row: &mut Row, answers: &[Solution]) -> Option<Fault> {
        let (q, target) = (row.joints.as_ref()?, &row.target);
        let gap = |answer: &Solution| self.model.distance(q, &answer.q);
        let single = answers.iter().filter(|answer| answer.free.is_empty()).map(gap).reduce(f64::min);
        if self.is_member(target, answers, q) {
            return None;
        }
        row.nearest = single;
        if self.model.is_in_self_motion(target, q) {
            return Some(Fault::SelfMotion);
        }
        let is_same = |answer: &Solution| {
            self.model.is_same(target, q, &answer.q) || self.are_one_in_tolerance(target, q, &answer.q)
        };
        (!answers.iter().any(is_same)).then_some(Fault::Missing)
    }

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
        self.tolerance > RESIDUAL
    }

    /// Whether `q` is a member of a self-motion that one of the solutions represents. On the path between them, a described chain may miss the target by the
    /// tolerance of a solution, because only the ideal chain has the self-motion.
    fn is_member(&self, target: &[f64], answers: &[Solution], q: &[f64]) -> bool {
        let self_motions = || answers.iter().filter(|answer| !answer.free.is_empty());
        let missed = if self.is_described() { self.tolerance } else { MEMBER };
        let leads = |answer: &Solution, step: f64| self.model.leads_to(target, q, answer, (step, missed));
        self_motions().any(|answer| self.model.matches(target, q, &answer.q))
            || STEPS.into_iter().any(|step| self_motions().any(|answer| leads(answer, step)))
            || self_motions().any(|answer| self.model.runs_to(target, q, &answer.q))
    }

    /// Whether the number of solutions depends on rounding.
    fn is_tie(&self, row: &Row, answers: &[Solution]) -> bool {
        let known = answers.iter().map(|answer| answer.q.as_slice()).chain(row.joints.as_deref());
        known.into_iter().any(|q| self.model.sigma(q) <= TIE)
    }

    /// Whether the solutions agree with those of the screw solver.
    ///
    /// Each of its solutions must match one of ours, and each ordinary one of ours must match one of its. Solutions of targets that are only within a solver's
    /// tolerance of the workspace may be missing on the other side. The screw solver loses solutions next to singular configurations and for overdetermined
    /// tasks (more numbers than independent joints). There, forward kinematics alone checks ours.
    fn agrees(&self, target: &[f64], answers: &[Solution], others: &[Solution]) -> bool {
        let covers = |some: &[Solution], answer: &Solution| {
            let least = if self.model.sigma(&answer.q) > ORDINARY { EXACT } else { SHARP };
            let sure = self.model.residual(target, &answer.q) <= least;
            let is_same = |other: &Solution| self.are_same(target, &answer.q, &other.q);
            !sure || some.iter().any(is_same) || self.is_member(target, some, &answer.q)
        };
        let is_overdetermined = |answer: &Solution| {
            let jacobian = self.model.jacobian(&answer.q);
            jacobian.nrows() > jacobian.ncols()
        };
        let ours = |answer: &Solution| {
            self.model.sigma(&answer.q) <= ORDINARY || is_overdetermined(answer) || covers(others, answer)
        };
        answers.iter().all(ours) && others.iter().all(|other| covers(answers, other))
    }

    /// Whether `b` is the same solution as `a`. For a chain as described, two solvers may give different joint values with errors within the tolerance.
    fn are_same(&self, target: &[f64], a: &[f64], b: &[f64]) -> bool {
        let open = 2.0 * self.tolerance / self.model.sigma(a).max(self.tolerance.sqrt());
        self.model.is_same(target, a, b) || (self.is_described() && self.model.distance(a, b) <= open)
    }

    /// The number of the oracle's solutions, and whether they agree with ours at ordinary configurations.
    fn oracle(&self, target: &[f64], answers: &[Solution]) -> Result<(usize, bool)> {
        let mut verdict = (0, false);
        for seeds in SEEDS {
            let found = self.model.search(target, seeds)?;
            verdict = (found.len(), self.agrees_with_search(answers, &found));
            if verdict.1 {
                break;
            }
        }
        Ok(verdict)
    }

    fn agrees_with_search(&self, answers: &[Solution], found: &[Vec<f64>]) -> bool {
        let ordinary = |q: &[f64]| self.model.sigma(q) > ORDINARY;
        let ours = |q: &Vec<f64>| !ordinary(q) || self.is_near(q, answers, ORACLE);
        let near = |q: &Vec<f64>, answer: &Solution| self.model.distance(q, &answer.q) <= ORACLE;
        let theirs = |answer: &Solution| !ordinary(&answer.q) || found.iter().any(|q| near(q, answer));
        found.iter().all(ours) && answers.iter().all(theirs)
    }
}

/// Targets from rational joint values with the exact number of distinct real solutions.
pub use rational::{Counted, count_exactly};

fn is_random(kind: &Kind) -> bool {
    *kind == Kind::Random
}
