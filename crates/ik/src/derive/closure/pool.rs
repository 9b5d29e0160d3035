//! All relations of a loop: every cut of it as run . A . tail . B, with all invariants of the run and the tail.

use std::collections::HashMap;
use std::ops::Range;

use super::feature::{Features, leaves};
use super::mechanism::{Mechanism, ScrewJoint};
use super::relation::{Letter, Measure, Object, Relation, Word};
use super::vector;
use groebot_robot::kinematics::ExactVector;

impl Mechanism {
    /// The relations of joints that follow others, then those of the loop. Each occurs once, and those with few joints come first.
    ///
    /// For each invariant only the longest run and tail are used; shorter ones give the same polynomials. An empty run or tail keeps everything fixed; three
    /// directions adapted to the neighbouring joint are used for it.
    pub fn relations(&self) -> Vec<Relation> {
        let count = self.joints().len();
        let ranges = |from: usize| (from..=count).flat_map(move |start| (start..=count).map(move |end| start..end));
        let mut relations = Vec::new();
        let mut tails = HashMap::new();
        for run in ranges(0) {
            // The neighbour of the run depends on whether there are joints between the run and the tail.
            let fixed = [false, true].map(|between| self.run_features(&run, between));
            for tail in ranges(run.end) {
                let between = run.end < tail.start;
                let fixed = &fixed[usize::from(between)];
                if !fixed.is_empty() {
                    let key = (tail.start, tail.end, between);
                    let moved = tails.entry(key).or_insert_with(|| self.tail_features(&tail, between));
                    Cut { mechanism: self, run: run.clone(), tail }.relate(fixed, moved, &mut relations);
                }
            }
        }
        self.couplings().into_iter().chain(sorted(relations)).collect()
    }

    fn row(&self, range: &Range<usize>) -> Vec<&ScrewJoint> {
        self.joints()[range.clone()].iter().collect()
    }

    /// The invariants of the run. `between` is whether there are joints between it and the tail.
    fn run_features(&self, run: &Range<usize>, between: bool) -> Features {
        let next = Some(run.end).filter(|&next| between && next < self.joints().len());
        let neighbour = self.axis(next.or(run.start.checked_sub(1)));
        match &self.row(run)[..] {
            [] => Features::of_nothing(&neighbour, Vec::new()),
            row => Features::of(row, &neighbour),
        }
    }

    /// The invariants of the tail, including the motions that the task does not constrain.
    fn tail_features(&self, tail: &Range<usize>, between: bool) -> Features {
        let count = self.joints().len();
        let mut row = self.row(tail);
        if tail.end == count {
            row.extend(self.unseen());
        }
        let neighbour = if between { Some(tail.start - 1) } else { Some(tail.end).filter(|&next| next < count) };
        if row.is_empty() {
            let point = neighbour.map_or_else(vector::zero, |joint| self.joints()[joint].point.clone());
            return Features::of_nothing(&self.axis(neighbour), vec![point]);
        }
        Features::of(&row, &self.axis(neighbour))
    }

    fn axis(&self, joint: Option<usize>) -> ExactVector {
        joint.map_or_else(|| vector::unit(2), |joint| self.joints()[joint].axis.clone())
    }
}

/// The relations without duplicates. Those with few joints and short words come first.
fn sorted(mut relations: Vec<Relation>) -> Vec<Relation> {
    relations.sort_by_cached_key(|relation| {
        let letters = relation.left.0.len() + relation.right.0.len();
        (relation.joints().len(), letters, relation.left.clone(), relation.right.clone(), relation.measure)
    });
    let mut unique: Vec<Relation> = Vec::with_capacity(relations.len());
    for relation in relations {
        let alike = |own: &&Relation| own.left == relation.left && own.right == relation.right;
        if !unique.iter().rev().take_while(alike).any(|own| *own == relation) {
            unique.push(relation);
        }
    }
    unique
}

/// A run and a tail after it. The arc between them does not contain the target; the other arc does.
struct Cut<'a> {
    mechanism: &'a Mechanism,
    run: Range<usize>,
    tail: Range<usize>,
}

impl Cut<'_> {
    /// Adds the relations of this cut. Unconstrained motions come after the last joint and belong to the tail. Prismatic joints do not change directions.
    fn relate(&self, fixed: &Features, moved: &Features, relations: &mut Vec<Relation>) {
        let unseen = self.mechanism.unseen();
        let after = self.tail.end < self.mechanism.joints().len();
        if after && unseen.iter().any(ScrewJoint::is_revolute) {
            return;
        }
        let only_angles = after && !unseen.is_empty();
        for (measure, fixed, moved) in fixed.pairs(moved) {
            if (measure == Measure::Angle || !only_angles) && self.is_widest(measure, &fixed, &moved) {
                relations.extend(self.relation(measure, fixed, moved));
            }
        }
    }

    /// Whether neither the run nor the tail can be extended.
    fn is_widest(&self, measure: Measure, fixed: &Object, moved: &Object) -> bool {
        let joints = self.mechanism.joints();
        let stays = |place: usize, object: &Object| leaves(&joints[place], object, measure);
        let (between, before, after) =
            (self.run.end < self.tail.start, self.run.start > 0, self.tail.end < joints.len());
        let run = between && stays(self.run.end, fixed) || before && stays(self.run.start - 1, fixed);
        let tail = between && stays(self.tail.start - 1, moved) || after && stays(self.tail.end, moved);
        !(run || tail)
    }

    /// The relation, unless it is trivial. Letters that cannot change a direction are removed.
    fn relation(&self, measure: Measure, fixed: Object, moved: Object) -> Option<Relation> {
        let joints = self.mechanism.joints();
        let turns = |letter: &Letter| {
            measure != Measure::Angle || letter.joint().is_none_or(|joint| joints[joint].is_revolute())
        };
        let left = (self.run.end..self.tail.start).map(Letter::Joint).filter(turns).collect();
        let before = (0..self.run.start).map(Letter::Inverse).rev();
        let after = (self.tail.end..joints.len()).map(Letter::Inverse).rev();
        let right = before.chain([Letter::Target]).chain(after).filter(turns).collect();
        let relation = Relation { measure, fixed, moved, left: Word(left), right: Word(right) };
        (!relation.joints().is_empty()).then_some(relation)
    }
}
