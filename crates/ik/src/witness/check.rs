//! The check of a solver, the same for equations, chains and coupled chains. Main types: [`Check`], and [`Subject`], which defines a correct solution.

use super::report::{Fault, Kind, Report, Row, Verdict};
use super::screws::Screws;
use super::{Draws, Options};
use crate::solver::Program;
use crate::tolerances::WITNESS;
use crate::{ErrorKind, Result, Watch};
use groebot_robot::kinematics::{Chain, Solution};

/// The numbers of the oracle's starting points: at first, and again before it reports a fault.
const SEEDS: [usize; 2] = [60, 600];
/// The number of rows, from the first, whose round targets are also searched numerically.
const SEARCHED: usize = 48;
/// The maximum distance of an ordinary solution of the moved target from one of the target itself, in multiples of `WITNESS.moved / sigma`.
const FOLLOWS: f64 = 10.0;

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

impl Solver for crate::solver::Solver {
    fn solve(&self, inputs: &[f64]) -> Result<Vec<Solution>> {
        self.solve_numbers(inputs)
    }
}

/// The screw solver of a chain as a [`Solver`].
pub struct ByScrews(Screws);

impl ByScrews {
    /// `None` if screw theory does not solve the chain.
    pub fn new(chain: &Chain) -> Option<Self> {
        Screws::new(chain).map(ByScrews)
    }

    /// Same as [`ByScrews::new`], for [`Check`].
    pub(super) fn boxed<'a>(chain: &Chain) -> Option<Box<dyn Solver + 'a>> {
        ByScrews::new(chain).map(|screws| Box::new(screws) as Box<dyn Solver>)
    }
}

impl Solver for ByScrews {
    fn solve(&self, inputs: &[f64]) -> Result<Vec<Solution>> {
        self.0.solve(inputs)
    }
}

/// A target, and the joint values that made it, if any.
pub(super) struct Target {
    pub kind: Kind,
    pub inputs: Vec<f64>,
    pub joints: Option<Vec<f64>>,
}

/// The interface to the mechanism of a solver under check. It is independent of the solver.
pub(super) trait Subject {
    /// The maximum of the smallest singular value of a row that counts as singular.
    fn singular(&self) -> f64;

    /// Whether a search of a round target must find all ordinary solutions.
    fn searches_completely(&self) -> bool;

    /// Whether `q` has a finite value for each joint, angles in (-pi, pi].
    fn is_well_formed(&self, q: &[f64]) -> bool;

    /// The smallest singular value of the scaled Jacobian.
    fn sigma(&self, target: &[f64], q: &[f64]) -> f64;

    /// The largest difference of two joint vectors: rad, or a fraction of the typical length.
    fn distance(&self, target: &[f64], a: &[f64], b: &[f64]) -> f64;

    /// The residual of a solution, and whether it misses its target.
    fn residual(&self, target: &[f64], q: &[f64]) -> (f64, bool);

    /// Whether there are more solutions than are possible.
    fn are_too_many(&self, answers: &[Solution]) -> bool;

    /// The distance of the nearest solution from the joint values that made the target, and the fault if none represents them.
    fn known(&self, target: &[f64], answers: &[Solution], q: &[f64]) -> (Option<f64>, Option<Fault>);

    /// Whether one of the solutions `some` represents `answer`, or `answer` is not certainly a solution.
    fn covers(&self, target: &[f64], some: &[Solution], answer: &Solution) -> bool;

    /// Whether the screw solver certainly has `answer` if it is correct.
    fn is_found_by_screws(&self, answer: &Solution) -> bool;

    /// The target that `q` reaches with each joint moved by a fraction of a displacement; `shift` gives that displacement for the number of a joint.
    fn moved_target(&self, target: &[f64], q: Vec<f64>, shift: &dyn Fn(usize) -> f64) -> Option<Vec<f64>>;

    /// The joint vectors that the numeric oracle finds from `seeds` starting points.
    ///
    /// # Errors
    /// As [`groebot_robot::kinematics::oracle::Oracle::search`].
    fn search(&self, target: &[f64], seeds: usize) -> Result<Vec<Vec<f64>>>;

    /// The exact number of distinct real solutions, if it is counted at any target.
    ///
    /// # Errors
    /// The error with which `watch` stops the count.
    fn count(&self, _target: &[f64], _watch: &Watch) -> Result<Option<usize>> {
        Ok(None)
    }

    /// A solution with the values of all joints.
    fn completed(&self, _target: &[f64], answer: Solution) -> Solution {
        answer
    }
}

/// The check of one solver.
pub(super) struct Check<'a> {
    pub subject: &'a dyn Subject,
    pub solver: &'a dyn Solver,
    pub screws: Option<Box<dyn Solver + 'a>>,
    pub options: Options,
    pub watch: &'a Watch,
}

/// The source of the targets of a check by their numbers, each with its exact number of solutions if that was counted.
type Draw<'a> = dyn FnMut(usize) -> Result<(Target, Option<usize>)> + 'a;

impl Check<'_> {
    /// The report of the targets that `draw` returns. `inputs` and `joints` are names.
    ///
    /// # Errors
    /// Those of the solver, except for gaps, and of `draw`. The error of the watch if it stops the check. Failed checks are in the report.
    pub fn report(&self, inputs: Vec<String>, joints: Vec<String>, draw: &mut Draw<'_>) -> Result<Report> {
        let mut rows = Vec::with_capacity(self.options.targets);
        for number in 0..self.options.targets {
            self.watch.check()?;
            self.watch.report("check", number, self.options.targets - number);
            let (target, exact) = draw(number)?;
            rows.push(self.row(number, target, exact)?);
        }
        Ok(Report { inputs, joints, rows })
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
        row.is_singular = self.any_joints(row, answers, self.subject.singular());
        faults.extend(self.together(&row.target, answers));
        if let Some(q) = &row.joints {
            let (nearest, fault) = self.subject.known(&row.target, answers, q);
            row.nearest = nearest;
            faults.extend(fault);
        }
        if number < self.options.exact && row.exact.is_none() {
            row.exact = self.subject.count(&row.target, self.watch)?;
        }
        let differs = row.exact.is_some_and(|exact| exact != answers.len());
        faults.extend((differs && !self.any_joints(row, answers, WITNESS.tie)).then_some(Fault::Count));
        faults.extend(self.by_screws(row, answers)?);
        let is_round = row.kind.is_round();
        let is_searched = is_round && self.searches_all() && self.subject.searches_completely();
        if number < self.options.oracle || is_searched {
            let (count, agrees) = self.oracle(&row.target, answers)?;
            row.oracle = Some(count);
            faults.extend((!agrees).then_some(Fault::Oracle));
        }
        if is_round {
            faults.extend(self.round(number, row, answers)?);
        }
        Ok(faults)
    }

    /// Whether the oracle searches every target.
    fn searches_all(&self) -> bool {
        self.options.oracle > 0 && self.options.draws == Draws::Round
    }

    /// Whether the smallest singular value is at most `bound` at a solution or at the joint values that made the target.
    fn any_joints(&self, row: &Row, answers: &[Solution], bound: f64) -> bool {
        let known = answers.iter().map(|answer| answer.q.as_slice()).chain(row.joints.as_deref());
        known.into_iter().any(|q| self.subject.sigma(&row.target, q) <= bound)
    }

    /// The fault if the solutions do not agree with those of the screw solver.
    ///
    /// Each of its solutions must match one of ours, and each of ours that it certainly finds must match one of its. Solutions of targets that are only within
    /// a solver's tolerance of the workspace may be missing on the other side.
    fn by_screws(&self, row: &mut Row, answers: &[Solution]) -> Result<Option<Fault>> {
        let Some(screws) = &self.screws else { return Ok(None) };
        let others = match screws.solve(&row.target) {
            Err(error) if error.kind() == ErrorKind::Unsupported => return Ok(None),
            others => others?,
        };
        let target = &row.target;
        row.screw = Some(others.len());
        row.is_singular |= others.iter().any(|other| self.subject.sigma(target, &other.q) <= self.subject.singular());
        let has = |answer: &Solution| {
            !self.subject.is_found_by_screws(answer) || self.subject.covers(target, &others, answer)
        };
        let agrees = answers.iter().all(has) && others.iter().all(|other| self.subject.covers(target, answers, other));
        Ok((!agrees).then_some(Fault::Screw))
    }

    /// Faults of the set of solutions at a round target: solutions of a search, and of a slightly moved target, that are not among them.
    fn round(&self, number: usize, row: &mut Row, answers: &[Solution]) -> Result<Vec<Fault>> {
        let mut faults = Vec::new();
        let is_early = self.options.oracle > 0 && number < SEARCHED || self.searches_all();
        if is_early && row.oracle.is_none() && !self.subject.searches_completely() {
            let found = self.subject.search(&row.target, SEEDS[0])?;
            row.oracle = Some(found.len());
            faults.extend((!self.has_found(&row.target, answers, &found)).then_some(Fault::Oracle));
        }
        faults.extend((!self.agrees_when_moved(row, answers)?).then_some(Fault::Moved));
        Ok(faults)
    }

    /// Whether each ordinary solution of a reached target that is moved by [`WITNESS.moved`] is next to one of these.
    fn agrees_when_moved(&self, row: &Row, answers: &[Solution]) -> Result<bool> {
        let q = row.joints.clone().or_else(|| answers.first().map(|answer| answer.q.clone()));
        let moved = q.and_then(|q| self.subject.moved_target(&row.target, q, &|number| WITNESS.moved * share(number)));
        let Some(moved) = moved else { return Ok(true) };
        let others = match self.solver.solve(&moved) {
            Err(error) if error.kind() == ErrorKind::Unsupported => return Ok(true),
            others => self.completed(&moved, others?),
        };
        Ok(others.iter().all(|other| {
            let sigma = self.subject.sigma(&moved, &other.q);
            sigma <= WITNESS.ordinary || self.is_near(&moved, &other.q, answers, FOLLOWS * WITNESS.moved / sigma)
        }))
    }

    fn completed(&self, target: &[f64], answers: Vec<Solution>) -> Vec<Solution> {
        answers.into_iter().map(|answer| self.subject.completed(target, answer)).collect()
    }

    fn is_near(&self, target: &[f64], q: &[f64], answers: &[Solution], within: f64) -> bool {
        answers.iter().any(|answer| self.subject.distance(target, q, &answer.q) <= within)
    }

    /// Checks each solution alone, and records the largest residual.
    fn each(&self, row: &mut Row, answers: &[Solution]) -> Vec<Fault> {
        let mut faults = Vec::new();
        let mut add = |wrong: bool, fault: Fault| {
            if wrong && !faults.contains(&fault) {
                faults.push(fault);
            }
        };
        for answer in answers {
            if !self.subject.is_well_formed(&answer.q) {
                add(true, Fault::Range);
                continue;
            }
            let (residual, is_missed) = self.subject.residual(&row.target, &answer.q);
            row.worst_residual = Some(row.worst_residual.map_or(residual, |worst| worst.max(residual)));
            add(is_missed, Fault::Residual);
            let is_free = !answer.free.is_empty();
            add(is_free && self.subject.sigma(&row.target, &answer.q) > WITNESS.free, Fault::Free);
        }
        faults
    }

    /// Checks the solutions as a set.
    fn together(&self, target: &[f64], answers: &[Solution]) -> Vec<Fault> {
        let twice = |(index, a): (usize, &Solution)| self.is_near(target, &a.q, &answers[..index], WITNESS.duplicate);
        let duplicate = answers.iter().enumerate().any(twice).then_some(Fault::Duplicate);
        duplicate.into_iter().chain(self.subject.are_too_many(answers).then_some(Fault::Bound)).collect()
    }

    /// The number of the oracle's solutions, and whether they agree with ours at ordinary configurations.
    fn oracle(&self, target: &[f64], answers: &[Solution]) -> Result<(usize, bool)> {
        let mut verdict = (0, false);
        for seeds in SEEDS {
            let found = self.subject.search(target, seeds)?;
            let near = |q: &Vec<f64>, answer: &Solution| self.subject.distance(target, q, &answer.q) <= WITNESS.near;
            let is_found = |answer: &Solution| {
                self.subject.sigma(target, &answer.q) <= WITNESS.ordinary || found.iter().any(|q| near(q, answer))
            };
            verdict = (found.len(), self.has_found(target, answers, &found) && answers.iter().all(is_found));
            if verdict.1 {
                break;
            }
        }
        Ok(verdict)
    }

    /// Whether the ordinary joint vectors among `found` are among the solutions.
    fn has_found(&self, target: &[f64], answers: &[Solution], found: &[Vec<f64>]) -> bool {
        let is_ours = |q: &Vec<f64>| {
            self.subject.sigma(target, q) <= WITNESS.ordinary || self.is_near(target, q, answers, WITNESS.near)
        };
        found.iter().all(is_ours)
    }
}

/// The fraction of [`WITNESS.moved`] by which joint `number` moves. All joints have different fractions.
fn share(number: usize) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    2.0 * (GOLDEN * (number as f64 + 1.0)).fract() - 1.0
}
