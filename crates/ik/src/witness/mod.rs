//! Numeric checks of a derived program by independent witnesses:
//! * the original equations in floating point;
//! * joint values that made the target;
//! * forward kinematics;
//! * the exact number of real roots (Sturm);
//! * the screw solver;
//! * a numeric oracle.

mod accuracy;
pub mod chain;
mod derivation;
mod exact;
mod model;
mod newton;
mod random;
mod report;
mod screws;
mod targets;

pub use accuracy::{Accuracy, Class};
pub use derivation::{check, check_round};
pub use report::{Fault, Kind, Report, Row, Summary, Verdict};

use crate::derive::Source;
use crate::solver::{Program, Solver};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::kinematics::Solution;
use groebot_robot::kinematics::oracle::Oracle;
use model::{EXACT, Model, ORDINARY, RESIDUAL};
use screws::Screws;
use targets::{Target, Targets};

/// The distance (rad, or a fraction of the typical length) below which two solutions are duplicates.
const DUPLICATE: f64 = 5e-8;
/// The maximum of the scaled Jacobian's smallest singular value where a joint may be reported as free.
const SINGULAR: f64 = 1e-5;
/// The smallest singular value above which the number of solutions is compared with the exact one. If the distance to a singular configuration is less than
/// about its square, rounding decides whether there are two solutions or none.
const TIE: f64 = 1e-4;
/// The accuracy of the oracle's ordinary solutions (rad, or a fraction of the typical length).
const ORACLE: f64 = 1e-6;
/// The numbers of the oracle's starting points: at first, and again before it reports a fault.
const SEEDS: [usize; 2] = [60, 600];
/// The joint displacement by which a round target is moved (rad, or a fraction of the typical length).
const MOVED: f64 = 1e-7;
/// The maximum distance of an ordinary solution of the moved target from one of the target itself, in multiples of `MOVED / sigma`.
const FOLLOWS: f64 = 10.0;

/// The extent of a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// The number of targets.
    pub targets: usize,
    /// The number of rows, from the first, at which the numeric oracle is used.
    pub oracle: usize,
    /// The number of rows, from the first, at which real solutions are counted exactly.
    pub exact: usize,
    /// The random seed. Equal seeds give equal reports.
    pub seed: u64,
    /// The kinds of targets.
    pub draws: Draws,
}

/// The kinds of targets of a check.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Draws {
    /// All kinds in turn.
    #[default]
    All,
    /// Only round targets. The numeric oracle searches all of them, unless [`Options::oracle`] is zero.
    Round,
}

impl Default for Options {
    /// 500 targets, 20 with the oracle, 50 with exact counts.
    fn default() -> Self {
        Options { targets: 500, oracle: 20, exact: 50, seed: 1, draws: Draws::All }
    }
}

/// The check of a program against its source.
pub struct Check<'a> {
    source: &'a Source,
    program: &'a Program,
    solver: Solver,
    model: &'a Model<'a>,
    screws: Option<Screws>,
    options: Options,
    watch: &'a Watch,
}

impl<'a> Check<'a> {
    /// Checks `program` at targets of all kinds against `source`, from which it was derived.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for an invalid program, or one with other inputs or joints than the source. [`ErrorKind::Unsupported`] if no reachable target is
    /// found. The error of `watch` if it stops the check. Failed checks are in the report.
    pub fn run(source: &Source, program: &Program, options: &Options, watch: &Watch) -> Result<Report> {
        program.validate()?;
        let system = equations(source)?;
        if program.inputs.len() != system.inputs.len() || program.joints.len() != system.joints.len() {
            let text = "the program has other inputs or joints than its source; derive it again";
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        // If the equations contain no lengths, a program's scale is nearly zero.
        let unit = if program.scale > 1e-9 { program.scale } else { 1.0 };
        let model = Model::new(system, unit);
        let screws = source.chain.as_ref().and_then(Screws::new);
        let check =
            Check { source, program, solver: program.solver(), model: &model, screws, options: *options, watch };
        let mut targets = Targets::new(&model, program, options.draws, options.seed);
        let mut rows = Vec::with_capacity(options.targets);
        for number in 0..options.targets {
            watch.check()?;
            watch.report("check", number, options.targets - number);
            let target = targets.draw(number).ok_or_else(|| {
                Error::new(
                    ErrorKind::Unsupported,
                    "no target was found that random joint values reach; check the equations",
                )
            })?;
            rows.push(check.row(number, target)?);
        }
        Ok(Report {
            inputs: system.inputs.iter().map(|input| input.name.clone()).collect(),
            joints: system.joints.iter().map(|joint| joint.name.clone()).collect(),
            rows,
        })
    }

    fn row(&self, number: usize, target: Target) -> Result<Row> {
        let Target { kind, inputs: target, joints } = target;
        let answers = match self.solver.solve_numbers(&target) {
            Ok(answers) => Some(answers),
            Err(error) if error.kind() == ErrorKind::Unsupported => None,
            Err(error) => return Err(error),
        };
        let mut row = Row::open(number, kind, target, joints, answers.as_deref());
        if let Some(answers) = answers {
            let known = answers.iter().map(|answer| answer.q.as_slice()).chain(row.joints.as_deref());
            row.is_singular = known.into_iter().any(|q| self.model.sigma(&row.target, q) <= SINGULAR);
            let faults = self.faults(number, &mut row, &answers)?;
            row.verdict = if faults.is_empty() { Verdict::Pass } else { Verdict::Fail(faults) };
        }
        Ok(row)
    }

    fn faults(&self, number: usize, row: &mut Row, answers: &[Solution]) -> Result<Vec<Fault>> {
        let mut faults = self.each(row, answers);
        faults.extend(self.together(&row.target, answers));
        if let Some(q) = &row.joints {
            let target = &row.target;
            row.nearest = answers.iter().map(|answer| self.gap(target, q, answer)).reduce(f64::min);
            let found = answers.iter().any(|answer| self.represents(target, answer, q));
            faults.extend((!found).then_some(Fault::Missing));
        }
        if number < self.options.exact {
            row.exact = exact::count(self.model.system, &row.target, self.watch)?;
            let wrong = row.exact.is_some_and(|exact| exact != answers.len()) && !self.is_tie(row, answers);
            faults.extend(wrong.then_some(Fault::Count));
        }
        if let Some(screws) = &self.screws {
            let others = screws.solve(&row.target)?;
            row.screw = Some(others.len());
            faults.extend((!self.agrees(&row.target, answers, &others)).then_some(Fault::Screw));
        }
        let is_searched = row.kind.is_round() && self.options.draws == Draws::Round && self.options.oracle > 0;
        if number < self.options.oracle || is_searched {
            let (count, agrees) = self.oracle(&row.target, answers)?;
            row.oracle = Some(count);
            faults.extend((!agrees).then_some(Fault::Oracle));
        }
        if row.kind.is_round() {
            faults.extend((!self.agrees_when_moved(row, answers)?).then_some(Fault::Moved));
        }
        Ok(faults)
    }

    /// Whether each ordinary solution of a reached target that is moved by [`MOVED`] is next to one of these.
    fn agrees_when_moved(&self, row: &Row, answers: &[Solution]) -> Result<bool> {
        let Some(q) = &row.joints else { return Ok(true) };
        let sizes = self.model.joint_sizes(&row.target);
        let moved: Vec<f64> = (0..q.len()).map(|joint| q[joint] + MOVED * share(joint) * sizes[joint]).collect();
        let Some(moved_target) = self.model.inputs_at(&moved, &row.target) else { return Ok(true) };
        let others = match self.solver.solve_numbers(&moved_target) {
            Err(error) if error.kind() == ErrorKind::Unsupported => return Ok(true),
            others => others?,
        };
        Ok(others.iter().all(|other| {
            let sigma = self.model.sigma(&moved_target, &other.q);
            let near =
                |answer: &Solution| self.model.distance(&moved_target, &other.q, &answer.q) <= FOLLOWS * MOVED / sigma;
            sigma <= ORDINARY || answers.iter().any(near)
        }))
    }

    /// Checks each solution alone, and records the largest residual.
    fn each(&self, row: &mut Row, answers: &[Solution]) -> Vec<Fault> {
        let target = row.target.clone();
        faults_of_each(row, answers, |answer| {
            self.model.is_well_formed(&answer.q).then(|| {
                let misfit = self.model.misfit(&target, &answer.q);
                let chain = self.source.chain.as_ref();
                let missed = chain.map_or(0.0, |chain| screws::misplacement(chain, &answer.q, &target));
                let is_too_free = !answer.free.is_empty() && self.model.sigma(&target, &answer.q) > SINGULAR;
                Judged { residual: misfit, is_missed: misfit.max(missed) > RESIDUAL, is_too_free }
            })
        })
    }

    /// Checks the solutions as a set.
    fn together(&self, target: &[f64], answers: &[Solution]) -> Vec<Fault> {
        let twice = |(index, a): (usize, &Solution)| {
            answers[..index].iter().any(|b| self.model.distance(target, &a.q, &b.q) <= DUPLICATE)
        };
        let duplicate = answers.iter().enumerate().any(twice).then_some(Fault::Duplicate);
        let bound = (answers.len() > self.program.bound()).then_some(Fault::Bound);
        duplicate.into_iter().chain(bound).collect()
    }

    /// `answer` with its free joints at the values of `q`.
    fn member(answer: &Solution, q: &[f64]) -> Vec<f64> {
        let pick = |(joint, value): (usize, &f64)| if answer.free.contains(&joint) { q[joint] } else { *value };
        answer.q.iter().enumerate().map(pick).collect()
    }

    /// The distance of `q` from `answer`, without free joints.
    fn gap(&self, target: &[f64], q: &[f64], answer: &Solution) -> f64 {
        self.model.distance(target, q, &Self::member(answer, q))
    }

    /// Whether `q` is `answer`, or a member of the self-motion that it represents.
    fn represents(&self, target: &[f64], answer: &Solution, q: &[f64]) -> bool {
        if answer.free.is_empty() {
            return self.model.matches(target, q, &answer.q);
        }
        let member = Self::member(answer, q);
        if self.model.misfit(target, &member) <= RESIDUAL {
            return self.model.matches(target, q, &member);
        }
        // The other joints move with the free ones. Without solving, it is only known that `q` is in some self-motion.
        self.model.sigma(target, q) <= SINGULAR
    }

    /// Whether the number of solutions depends on rounding.
    fn is_tie(&self, row: &Row, answers: &[Solution]) -> bool {
        let known = answers.iter().map(|answer| answer.q.as_slice()).chain(row.joints.as_deref());
        known.into_iter().any(|q| self.model.sigma(&row.target, q) <= TIE)
    }

    /// Whether the solutions and those of the screw solver match in both directions. Solutions of targets that are out of reach by less than 1e-11 may be
    /// missing on the other side.
    fn agrees(&self, target: &[f64], answers: &[Solution], others: &[Solution]) -> bool {
        let covers = |some: &[Solution], answer: &Solution| {
            let sure = self.model.misfit(target, &answer.q) <= EXACT;
            !sure || some.iter().any(|other| self.represents(target, other, &answer.q))
        };
        answers.iter().all(|answer| covers(others, answer)) && others.iter().all(|other| covers(answers, other))
    }

    /// The number of the oracle's solutions, and whether they agree with ours at ordinary configurations.
    fn oracle(&self, target: &[f64], answers: &[Solution]) -> Result<(usize, bool)> {
        let mut verdict = (0, false);
        for seeds in SEEDS {
            let found = self.search(target, seeds)?;
            verdict = (found.len(), self.agrees_with_search(target, answers, &found));
            if verdict.1 {
                break;
            }
        }
        Ok(verdict)
    }

    /// The oracle's joint vectors. The value of a plain joint is its typical size times the tangent of half the oracle's angle.
    fn search(&self, target: &[f64], seeds: usize) -> Result<Vec<Vec<f64>>> {
        let sizes = self.model.joint_sizes(target);
        let joints = |angles: &[f64]| -> Vec<f64> {
            let value = |(joint, angle): (usize, &f64)| {
                if self.model.is_angle(joint) { *angle } else { sizes[joint] * (0.5 * angle).tan() }
            };
            angles.iter().enumerate().map(value).collect()
        };
        let oracle = Oracle { seeds, ..Oracle::default() };
        let found = oracle.solve(sizes.len(), |angles| self.model.shares(target, &joints(angles)))?;
        Ok(found.iter().map(|answer| joints(&answer.q)).collect())
    }

    fn agrees_with_search(&self, target: &[f64], answers: &[Solution], found: &[Vec<f64>]) -> bool {
        let ordinary = |q: &[f64]| self.model.sigma(target, q) > ORDINARY;
        let near = |a: &[f64], b: &[f64]| self.model.distance(target, a, b) <= ORACLE;
        let ours = |q: &Vec<f64>| !ordinary(q) || answers.iter().any(|answer| near(q, &answer.q));
        let theirs = |answer: &Solution| !ordinary(&answer.q) || found.iter().any(|q| near(q, &answer.q));
        found.iter().all(ours) && answers.iter().all(theirs)
    }
}

/// The fraction of [`MOVED`] by which joint `number` moves. All joints have different fractions.
fn share(number: usize) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    2.0 * (GOLDEN * (number as f64 + 1.0)).fract() - 1.0
}

/// The equations of a source that is solved as one system.
fn equations(source: &Source) -> Result<&crate::derive::System> {
    let text = "the source has no equations to be solved together";
    source.system.as_ref().ok_or_else(|| Error::new(ErrorKind::BadValue, text).in_file(&source.path))
}

/// The check of a single solution.
struct Judged {
    /// The residual for the row.
    residual: f64,
    /// Whether the solution misses its target.
    is_missed: bool,
    /// Whether it has free joints at a regular configuration.
    is_too_free: bool,
}

/// The faults of single solutions. `judge` returns `None` for a malformed one. Records the largest residual.
fn faults_of_each(row: &mut Row, answers: &[Solution], judge: impl Fn(&Solution) -> Option<Judged>) -> Vec<Fault> {
    let mut faults = Vec::new();
    let mut add = |wrong: bool, fault: Fault| {
        if wrong && !faults.contains(&fault) {
            faults.push(fault);
        }
    };
    for answer in answers {
        let Some(judged) = judge(answer) else {
            add(true, Fault::Range);
            continue;
        };
        row.worst_residual = Some(row.worst_residual.map_or(judged.residual, |worst| worst.max(judged.residual)));
        add(judged.is_missed, Fault::Residual);
        add(judged.is_too_free, Fault::Free);
    }
    faults
}
