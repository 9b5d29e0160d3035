//! Counting of solutions, place by place. Main type: [`Survey`].

use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use nalgebra::Point3;
use rayon::prelude::*;

use super::map::{Entry, ReachMap};
use super::poses::Poses;
use super::redundant::{AnyWithin, Found};
use super::request::{Measure, Request};
use crate::solver::{JointValue, Program, Solved, Solver};
use crate::tolerances::REACH;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::kinematics::{Ball, Chain, Solution};
use groebot_runtime::tolerances::ACCEPTANCE;

/// Number of targets that are solved at once.
const PIECE: usize = 2048;
/// The same of a redundant arm, whose targets take longer.
const REDUNDANT_PIECE: usize = 64;

/// A solver for many targets.
pub trait Solves: Sync {
    /// Passes the solutions for targets to `take`, one after the other. The solutions of each target are followed by its end.
    ///
    /// # Errors
    /// Same as [`Solver::solve_each`].
    fn each(&self, targets: &[f64], take: &mut dyn FnMut(Solved<'_>)) -> Result<()>;

    /// The solutions within limits, as [`Solver::solve_within`].
    ///
    /// # Errors
    /// Same as [`Solver::solve_within`].
    fn within(&self, target: &[f64], limits: &[[f64; 2]]) -> Result<Vec<Solution>>;
}

impl Solves for Solver {
    fn each(&self, targets: &[f64], take: &mut dyn FnMut(Solved<'_>)) -> Result<()> {
        self.solve_each(targets, take)
    }

    fn within(&self, target: &[f64], limits: &[[f64; 2]]) -> Result<Vec<Solution>> {
        self.solve_within(target, limits)
    }
}

/// The computation of a map.
pub struct Survey<'a> {
    solver: &'a dyn Solves,
    program: &'a Program,
    /// The solver of a redundant arm without the value of its given joint.
    arm: Option<AnyWithin>,
    /// The chain whose manipulability is measured.
    chain: Option<&'a Chain>,
    /// A ball that the tip cannot leave.
    ball: Option<Ball>,
    request: &'a Request,
    poses: Poses,
    /// By joint, whether it is revolute.
    turns: Vec<bool>,
    limits: Option<Vec<[f64; 2]>>,
}

/// Intermediate results for one target.
#[derive(Default)]
struct Target {
    answers: u32,
    /// Whether a member of a self-motion was beyond the limits: another member may be within.
    strides: bool,
    is_open: bool,
    best: f64,
}

impl<'a> Survey<'a> {
    /// Prepares a map from a solver, its program, the chain of the program if there is one, and the options.
    ///
    /// Without the value of the given joint, the targets of a redundant arm are solved by the program's redundant solver instead of `solver`
    /// ([`RedundantSolver::any_within`](crate::solver::redundant::RedundantSolver::any_within), or that of its scanning solver).
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a task without a position, for inputs other than one tip's position, orientation and given joints, for manipulability
    /// without a chain, and for a redundant arm without given values unless the measure is [`Measure::Limits`]. [`ErrorKind::BadValue`]:
    /// - there are no orientations, or more than 10^6
    /// - the number of given values is not that of the given joints
    /// - there are several places on an axis without a coordinate in the task
    /// - limits are invalid, or missing in the description
    pub fn new(
        solver: &'a dyn Solves,
        program: &'a Program,
        chain: Option<&'a Chain>,
        request: &'a Request,
    ) -> Result<Self> {
        let arm = AnyWithin::new(program, request)?;
        let poses = Poses::new(program, request)?;
        let turns: Vec<bool> =
            program.joints.iter().map(|joint| matches!(joint.value, JointValue::Angle { .. })).collect();
        if let Some(chain) = chain.filter(|chain| chain.joints().len() != turns.len()) {
            let text = format!("{} has {} joints, its chain {}", program.name, turns.len(), chain.joints().len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let turning = chain.filter(|_| poses.are_in_space() && turns.iter().all(|turns| *turns));
        let wider = |chain: &Chain, ball: Ball| Ball { radius: ball.radius + REACH.beyond * chain.reach(), ..ball };
        let ball = turning.map(|chain| wider(chain, chain.ball()));
        let wrist = turning.and_then(|chain| Some(wider(chain, chain.wrist_ball()?)));
        let poses = match wrist {
            Some(wrist) => poses.within(wrist),
            None => poses,
        };
        let chain = chain.filter(|_| request.measure == Measure::Manipulability);
        if request.measure == Measure::Manipulability && chain.is_none() {
            let text = "manipulability requires the chain of the solver; give the folder of its derivation";
            return Err(Error::new(ErrorKind::Unsupported, text));
        }
        let limits = match (&request.limits, request.measure) {
            (None, Measure::Limits) => Some(Request::described(program)?),
            (limits, _) => limits.clone(),
        };
        if let Some(limits) = &limits {
            check(limits, program)?;
        }
        Ok(Survey { solver, program, arm, chain, ball, request, poses, turns, limits })
    }

    /// Number of orientations at each place.
    pub fn orientations(&self) -> usize {
        self.poses.orientations()
    }

    /// Counts the solutions at the places with these indices, on rayon's threads. The result depends neither on the number of threads nor on other places.
    ///
    /// # Errors
    /// [`Watch::check`], and those of [`Solves::each`].
    ///
    /// # Panics
    /// If the grid does not have these places.
    pub fn entries<'w>(&self, places: Range<usize>, watch: impl Into<Option<&'w Watch>>) -> Result<Vec<Entry>> {
        let watch = Watch::or_none(watch);
        assert!(places.end <= self.request.grid.places(), "the grid has {} places", self.request.grid.places());
        let share = (self.at_once() / self.orientations()).max(1);
        let done = AtomicUsize::new(0);
        let mut entries = vec![Entry::default(); places.len()];
        entries.par_chunks_mut(share).enumerate().try_for_each(|(number, entries)| {
            watch.check()?;
            self.fill(places.start + number * share, entries, watch)?;
            let done = done.fetch_add(entries.len(), Ordering::Relaxed) + entries.len();
            watch.report("reach: places", done, places.len() - done);
            Ok::<_, Error>(())
        })?;
        Ok(entries)
    }

    /// The map of all places.
    ///
    /// # Errors
    /// Same as [`Survey::entries`].
    pub fn map<'w>(&self, watch: impl Into<Option<&'w Watch>>) -> Result<ReachMap> {
        let watch = Watch::or_none(watch);
        let entries = self.entries(0..self.request.grid.places(), watch)?;
        Ok(ReachMap::of(self.program, self.request, self.orientations(), entries))
    }

    /// Number of targets that are solved at once.
    fn at_once(&self) -> usize {
        if self.arm.is_some() { REDUNDANT_PIECE } else { PIECE }
    }

    /// Counts at the places from index `first` on.
    fn fill(&self, first: usize, entries: &mut [Entry], watch: &Watch) -> Result<()> {
        let mut sums = vec![0.0; entries.len()];
        let (mut targets, mut kept) = (Vec::new(), Vec::new());
        let mut place = 0;
        while place < entries.len() {
            // A run of consecutive places that may be reached.
            let run = (place..entries.len()).take_while(|place| !self.is_beyond(first + place)).count();
            let numbers = (first + place) * self.orientations()..(first + place + run) * self.orientations();
            for start in numbers.clone().step_by(self.at_once()) {
                watch.check()?;
                self.poses.write(start..numbers.end.min(start + self.at_once()), &mut targets, &mut kept);
                let take = |number: usize, target: &Target| {
                    let place = kept[number] / self.orientations() - first;
                    let entry = &mut entries[place];
                    entry.reached += u32::from(target.answers > 0);
                    entry.answers = entry.answers.saturating_add(target.answers);
                    entry.open += u32::from(target.is_open);
                    entry.best = entry.best.max(target.best as f32);
                    sums[place] += target.best;
                };
                match &self.arm {
                    Some(arm) => self.redundant_piece(arm, &targets, watch, take)?,
                    None => self.piece(&targets, take)?,
                }
            }
            place += run + 1;
        }
        for (entry, sum) in entries.iter_mut().zip(sums) {
            entry.mean = (sum / f64::from(entry.reached.max(1))) as f32;
        }
        Ok(())
    }

    /// Whether a place is out of reach of the chain.
    fn is_beyond(&self, place: usize) -> bool {
        let at = Point3::from(self.request.grid.at(place));
        self.ball.is_some_and(|ball| !ball.holds(&at))
    }

    /// Solves targets. Each result is passed to `take` with its index.
    fn piece(&self, targets: &[f64], mut take: impl FnMut(usize, &Target)) -> Result<()> {
        let inputs = self.poses.inputs();
        let (mut number, mut target, mut failed) = (0, Target::default(), None);
        self.solver.each(targets, &mut |solved| match solved {
            Solved::Answer { q, free, .. } => self.answer(q, free, &mut target),
            Solved::Target { refused } => {
                if target.strides {
                    match self.stride(&targets[number * inputs..][..inputs]) {
                        Ok(found) => target = found,
                        Err(error) => failed = Some(error),
                    }
                }
                match refused {
                    Some(error) if error.kind() != ErrorKind::Unsupported => failed = Some(error),
                    refused => target.is_open = refused.is_some(),
                }
                take(number, &target);
                (number, target) = (number + 1, Target::default());
            }
        })?;
        failed.map_or(Ok(()), Err)
    }

    /// Searches one solution of each target of a redundant arm. Each result is passed to `take` with its index.
    fn redundant_piece(
        &self,
        arm: &AnyWithin,
        targets: &[f64],
        watch: &Watch,
        mut take: impl FnMut(usize, &Target),
    ) -> Result<()> {
        for (number, target) in targets.chunks_exact(self.poses.inputs()).enumerate() {
            watch.check()?;
            let found = match arm.find(target) {
                Err(error) if error.kind() == ErrorKind::Unsupported => Found::Unsure,
                found => found?,
            };
            let (answers, is_open) = (u32::from(found == Found::Solution), found == Found::Unsure);
            take(number, &Target { answers, is_open, ..Target::default() });
        }
        Ok(())
    }

    fn answer(&self, q: &[f64], free: u32, target: &mut Target) {
        if self.limits.as_ref().is_none_or(|limits| has_turn_within(&self.turns, q, limits)) {
            self.count(q, target);
        } else {
            target.strides |= free != 0;
        }
    }

    fn count(&self, q: &[f64], target: &mut Target) {
        target.answers += 1;
        if let Some(chain) = self.chain {
            target.best = target.best.max(chain.manipulability(q));
        }
    }

    /// The result for a target whose self-motions are followed to find members within the limits.
    fn stride(&self, numbers: &[f64]) -> Result<Target> {
        let mut target = Target::default();
        for solution in self.solver.within(numbers, self.limits.as_deref().unwrap_or_default())? {
            self.count(&solution.q, &mut target);
        }
        Ok(target)
    }
}

/// Checks that there is a pair of limits for each joint, the lower one first.
fn check(limits: &[[f64; 2]], program: &Program) -> Result<()> {
    let joints = &program.joints;
    let text = match limits.iter().position(|[low, high]| low.is_nan() || high.is_nan() || low > high) {
        _ if limits.len() != joints.len() => {
            format!("{} pairs of limits; {} has {} joints", limits.len(), program.name, joints.len())
        }
        Some(joint) => {
            let [low, high] = limits[joint];
            format!("limits of `{}`: from {low} to {high}; give the lower one first", joints[joint].name)
        }
        None => return Ok(()),
    };
    Err(Error::new(ErrorKind::BadValue, text))
}

/// Whether each joint is within its limits, an angle with at least one of its turns.
fn has_turn_within(turns: &[bool], q: &[f64], limits: &[[f64; 2]]) -> bool {
    turns.iter().zip(q).zip(limits).all(|((turns, value), [low, high])| {
        let (low, high) = (low - ACCEPTANCE.input, high + ACCEPTANCE.input);
        match turns {
            false => (low..=high).contains(value),
            true => ((low - value) / TAU).ceil() <= ((high - value) / TAU).floor(),
        }
    })
}
