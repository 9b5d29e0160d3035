//! The search for an order of subproblems: which joints to solve first, from the geometry of the chain alone.
//!
//! The equations that exist after some joints are known depend on which they are, not on their values. So the best
//! continuation from each set of known joints is computed once, by trying every step of [`super::step`] at two sample
//! configurations. A step is accepted when the joint values of both samples are among its solutions.

use std::collections::HashMap;

use smallvec::SmallVec;

use super::feature::{Feature, Scale, features, last_features};
use super::parallel_pairs;
use super::reduced::{Goal, Reduced};
use super::step::{Kind, Relation, Step};
use crate::spatial::{Half, angle};

/// Tolerance for finding a sample's own value \[rad, or lengths of the chain\].
const FOUND: f64 = 1e-6;

/// A configuration and its loop.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    pub q: Vec<f64>,
    pub start: Reduced,
}

/// The best continuation from a set of known joints.
#[derive(Clone)]
struct Continuation {
    cost: Cost,
    step: Option<Step>,
    next: u32,
}

/// First the number of solutions of all steps together, then their difficulty.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
struct Cost {
    answers: usize,
    effort: usize,
}

/// The search.
pub(super) struct Search<'a> {
    pub samples: &'a [Sample],
    pub scale: Scale,
    avoided: Option<Move>,
    continuations: HashMap<u32, Option<Continuation>>,
}

/// The effect of a step: the sets of known joints before and after it.
pub(super) type Move = [u32; 2];

impl<'a> Search<'a> {
    pub fn new(samples: &'a [Sample], scale: Scale) -> Self {
        Search { samples, scale, avoided: None, continuations: HashMap::new() }
    }

    /// A search that avoids steps with this effect.
    pub fn avoiding(self, avoided: Move) -> Self {
        Search { avoided: Some(avoided), ..self }
    }

    /// The steps of the best plan with their effects; `None` when no order of the known subproblems solves this chain.
    pub fn plan(mut self) -> Option<Vec<(Step, Move)>> {
        self.explore(0)?;
        let mut steps = Vec::new();
        let mut known = 0;
        while let Some(Some(Continuation { step: Some(step), next, .. })) = self.continuations.get(&known) {
            steps.push((step.clone(), [known, *next]));
            known = *next;
        }
        Some(steps)
    }

    /// The least cost from the set `known` to the end.
    fn explore(&mut self, known: u32) -> Option<Cost> {
        if let Some(continuation) = self.continuations.get(&known) {
            return continuation.as_ref().map(|continuation| continuation.cost);
        }
        let loops: Vec<Reduced> = self.samples.iter().map(|sample| sample.with(known)).collect();
        let mut best = None;
        if loops[0].row.is_empty() {
            best = Some(Continuation { cost: Cost { answers: 1, effort: 0 }, step: None, next: known });
        }
        for step in candidates(&loops[0], self.scale) {
            let next = step.solved(&loops[0]).iter().fold(known, |set, joint| set | 1 << joint);
            if self.avoided == Some([known, next]) || !self.holds(&step, &loops) {
                continue;
            }
            let Some(rest) = self.explore(next) else { continue };
            let own = step.cost(&loops[0]);
            let cost = Cost { answers: own.answers * rest.answers, effort: own.effort + rest.effort };
            if best.as_ref().is_none_or(|best| cost < best.cost) {
                best = Some(Continuation { cost, step: Some(step), next });
            }
        }
        let cost = best.as_ref().map(|continuation| continuation.cost);
        self.continuations.insert(known, best);
        cost
    }

    /// Whether the step finds the values of every sample.
    fn holds(&self, step: &Step, loops: &[Reduced]) -> bool {
        self.samples.iter().zip(loops).all(|(sample, reduced)| {
            let joints = step.solved(reduced);
            let found = |answer: &super::step::Answer| {
                joints.iter().zip(answer).all(|(&joint, value)| {
                    value.is_some_and(|value| sample.differs(joint, value) <= FOUND * self.scale.length.max(1.0))
                })
            };
            step.solve(reduced).is_some_and(|answers| answers.iter().any(found))
        })
    }
}

impl Sample {
    /// The loop with the joints of the set `known` at their values.
    fn with(&self, known: u32) -> Reduced {
        let mut reduced = self.start.clone();
        for (joint, &q) in self.q.iter().enumerate().filter(|(joint, _)| known >> joint & 1 == 1) {
            if let Some(place) = reduced.place(joint) {
                reduced.absorb(place, Half::new(q));
            }
        }
        reduced
    }

    fn differs(&self, joint: usize, value: f64) -> f64 {
        let slides = self.start.place(joint).is_some_and(|place| self.start.row[place].screw.axis().is_none());
        match slides {
            false => angle::difference(self.q[joint], value).abs(),
            true => (self.q[joint] - value).abs(),
        }
    }
}

impl Step {
    /// The maximum number of solutions. `reduced` is a loop that the step fits.
    pub fn most_answers(&self, reduced: &Reduced) -> usize {
        self.cost(reduced).answers
    }

    fn cost(&self, reduced: &Reduced) -> Cost {
        let row = reduced.cut_at(self.end);
        let slides = self.unknown.iter().all(|&place| row[place].screw.axis().is_none());
        let (answers, effort) = match (&self.kind, self.unknown.len()) {
            (Kind::Last, _) => (1, 1),
            (Kind::ToPoint(_), 1) => (1, 2),
            (Kind::ToDirection(_), 1) => (1, 3),
            (Kind::ToPoint(_), 2) if slides => (1, 4),
            (Kind::ToPoint(_), 2) => (2, 4),
            (Kind::ToDirection(_), 2) => (2, 5),
            (Kind::ToPoint(_), _) if slides => (1, 6),
            (Kind::ToPoint(_) | Kind::ToDirection(_), _) => (4, 20),
            (Kind::Between(relation), _) if slides && relation.is_about_a_plane() => (1, 3),
            (Kind::Between(relation), _) if relation.is_about_points() => (2, 3),
            (Kind::Between(_), _) => (2, 4),
            (Kind::Around(_) | Kind::ToPlane(_), _) => (4, 21),
            (Kind::ThreePairs, _) => (16, 40),
        };
        Cost { answers, effort }
    }
}

impl Relation {
    /// The indices of the rest that are involved: those outside the run. For a direction only rotations are.
    fn outside(&self, rest: usize, turns: &[usize]) -> SmallVec<[usize; 3]> {
        let run = self.start..self.start + self.length;
        let turned = |place: &usize| !matches!(self.run, Feature::Direction(_)) || turns.contains(place);
        (0..rest).filter(|place| !run.contains(place)).filter(turned).collect()
    }

    /// Whether the step compares two points, as in the thesis' subproblems.
    pub fn is_about_points(&self) -> bool {
        matches!((self.run, self.tail), (Feature::Point(_), Feature::Point(_)))
    }

    /// Whether the step compares a point and a plane.
    pub fn is_about_a_plane(&self) -> bool {
        matches!(self.run, Feature::Component(_)) || matches!(self.tail, Feature::Component(_))
    }
}

/// All candidate steps of the loop, whether or not they determine their joints.
fn candidates(reduced: &Reduced, scale: Scale) -> Vec<Step> {
    let count = reduced.row.len();
    let mut steps = Vec::new();
    let ends = match reduced.goal {
        Goal::Pose(_) => 1..=count,
        Goal::Point { .. } => count..=count,
    };
    if matches!(reduced.goal, Goal::Pose(_)) && parallel_pairs::fits(&reduced.row) {
        steps.push(Step { end: count, tail: 0, kind: Kind::ThreePairs, unknown: (0..count).collect() });
    }
    for end in ends.rev() {
        let row = reduced.cut_at(end);
        for tail in 0..=end {
            let at = |kind, unknown| Step { end, tail, kind, unknown };
            let (rest, last) = row.split_at(count - tail);
            let turns: SmallVec<[usize; 3]> = (0..rest.len()).filter(|&i| rest[i].screw.axis().is_some()).collect();
            if tail == 0 && count == 1 && matches!(reduced.goal, Goal::Pose(_)) {
                steps.push(at(Kind::Last, SmallVec::from_slice(&[0])));
            }
            let found = last_features(last, &reduced.goal, scale);
            for feature in &found {
                match *feature {
                    Feature::Point(spot) if (1..=3).contains(&rest.len()) => {
                        steps.push(at(Kind::ToPoint(spot), (0..rest.len()).collect()));
                    }
                    Feature::Direction(line) if (1..=2).contains(&turns.len()) => {
                        steps.push(at(Kind::ToDirection(line), turns.clone()));
                    }
                    Feature::Component(line) if rest.len() == 3 && turns.len() == 3 => {
                        steps.push(at(Kind::ToPlane(line), SmallVec::from_slice(&[1, 2])));
                    }
                    _ => {}
                }
            }
            // A run may not extend across the cut, because the pose is there.
            let seam = count - end;
            let runs = (0..rest.len()).flat_map(|start| (start + 1..=rest.len()).map(move |stop| (start, stop)));
            for (start, stop) in runs.filter(|&(start, stop)| start >= seam || stop <= seam) {
                let relations = pairs(&features(&rest[start..stop], scale), &found, start, stop - start);
                let made = relative(rest.len(), &turns, &relations);
                steps.extend(made.into_iter().map(|(kind, unknown)| at(kind, unknown)));
            }
        }
    }
    steps
}

/// Every relation of a feature of the run with one of the tail.
fn pairs(run: &[Feature], tail: &[Feature], start: usize, length: usize) -> Vec<Relation> {
    let fits = |a: &Feature, b: &Feature| {
        use Feature::{Component, Direction, Point};
        matches!((a, b), (Point(_), Point(_) | Component(_)) | (Component(_), Point(_)) | (Direction(_), Direction(_)))
    };
    let all = run.iter().flat_map(|a| tail.iter().filter(|b| fits(a, b)).map(|b| (*a, *b)));
    all.map(|(run, tail)| Relation { start, length, run, tail }).collect()
}

/// The steps from the relations of one run and one tail: one joint remains, or one on each side.
fn relative(rest: usize, turns: &[usize], relations: &[Relation]) -> Vec<(Kind, SmallVec<[usize; 3]>)> {
    let left: Vec<_> = relations.iter().map(|relation| relation.outside(rest, turns)).collect();
    let mut steps = Vec::new();
    for (i, (first, places)) in relations.iter().zip(&left).enumerate() {
        match places[..] {
            [_] => steps.push((Kind::Between(*first), places.clone())),
            [before, after] if before < first.start && after > first.start => {
                if !(turns.contains(&before) && turns.contains(&after)) {
                    continue;
                }
                let others = (i + 1..relations.len()).filter(|&j| left[j] == *places);
                steps.extend(others.map(|j| (Kind::Around([*first, relations[j]]), places.clone())));
            }
            _ => {}
        }
    }
    steps
}

/// A typical length of the screws and the tip, and the length that counts as zero.
pub(super) fn scale_of(reduced: &Reduced, reach: f64) -> Scale {
    let length = if reach > 0.0 { reach } else { 1.0 };
    let far = reduced.row.iter().filter_map(|m| m.screw.axis()).map(|axis| axis.point().coords.norm());
    Scale { length, tolerance: 1e-9 * far.fold(length, f64::max) }
}
