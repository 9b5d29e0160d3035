//! All relations of a loop: every way to cut it as run . A . tail . B, with all that the run and the tail leave in place.

use std::collections::HashSet;
use std::ops::Range;

use super::feature::{Features, leaves};
use super::mechanism::{Mechanism, ScrewJoint};
use super::relation::{Letter, Measure, Object, Relation, Word};
use super::vector;
use crate::kinematics::ExactVector;

impl Mechanism {
    /// The relations of the loop, each once, those with few joints first.
    ///
    /// For each thing that stays in place only the longest run and tail are taken: the others give the same polynomials. An
    /// empty run or tail leaves everything in place; three directions adapted to the joint beside it are taken.
    pub fn relations(&self) -> Vec<Relation> {
        let count = self.joints().len();
        let mut relations = Vec::new();
        for start in 0..=count {
            for end in start..=count {
                for tail_start in end..=count {
                    for tail_end in tail_start..=count {
                        Cut { mechanism: self, run: start..end, tail: tail_start..tail_end }.relate(&mut relations);
                    }
                }
            }
        }
        let mut seen = HashSet::new();
        relations.retain(|relation| seen.insert(relation.clone()));
        relations.sort_by_key(|relation| (relation.joints().len(), relation.left.0.len() + relation.right.0.len()));
        relations
    }
}

/// A run and a tail behind it. The arc between them holds no target; the other arc does.
struct Cut<'a> {
    mechanism: &'a Mechanism,
    run: Range<usize>,
    tail: Range<usize>,
}

impl Cut<'_> {
    /// Adds what this cut says. What the task does not see stands behind the last joint and belongs to the tail.
    fn relate(&self, relations: &mut Vec<Relation>) {
        if self.tail.end < self.mechanism.joints().len() && !self.mechanism.unseen().is_empty() {
            return;
        }
        for (measure, fixed, moved) in self.run_features().pairs(&self.tail_features()) {
            if self.is_widest(measure, &fixed, &moved) {
                relations.extend(self.relation(measure, fixed, moved));
            }
        }
    }

    fn row(&self, range: &Range<usize>) -> Vec<&ScrewJoint> {
        self.mechanism.joints()[range.clone()].iter().collect()
    }

    /// What the run leaves in place.
    fn run_features(&self) -> Features {
        let between = self.run.end < self.tail.start;
        let beside = if between { Some(self.run.end) } else { self.run.start.checked_sub(1) };
        match &self.row(&self.run)[..] {
            [] => Features::of_nothing(&self.axis(beside), Vec::new()),
            row => Features::of(row, &self.axis(beside)),
        }
    }

    /// What the tail leaves in place, together with the motions that the task does not see.
    fn tail_features(&self) -> Features {
        let count = self.mechanism.joints().len();
        let mut row = self.row(&self.tail);
        if self.tail.end == count {
            row.extend(self.mechanism.unseen());
        }
        let between = self.run.end < self.tail.start;
        let beside = if between { Some(self.tail.start - 1) } else { Some(self.tail.end).filter(|&next| next < count) };
        if row.is_empty() {
            let point = beside.map_or_else(vector::zero, |joint| self.mechanism.joints()[joint].point.clone());
            return Features::of_nothing(&self.axis(beside), vec![point]);
        }
        Features::of(&row, &self.axis(beside))
    }

    fn axis(&self, joint: Option<usize>) -> ExactVector {
        joint.map_or_else(|| vector::unit(2), |joint| self.mechanism.joints()[joint].axis.clone())
    }

    /// Whether neither the run nor the tail can be made longer.
    fn is_widest(&self, measure: Measure, fixed: &Object, moved: &Object) -> bool {
        let joints = self.mechanism.joints();
        let stays = |place: usize, object: &Object| leaves(&joints[place], object, measure);
        let (between, before, behind) =
            (self.run.end < self.tail.start, self.run.start > 0, self.tail.end < joints.len());
        let run = between && stays(self.run.end, fixed) || before && stays(self.run.start - 1, fixed);
        let tail = between && stays(self.tail.start - 1, moved) || behind && stays(self.tail.end, moved);
        !(run || tail)
    }

    /// The relation, unless it says nothing: letters that cannot change a direction are left out.
    fn relation(&self, measure: Measure, fixed: Object, moved: Object) -> Option<Relation> {
        let joints = self.mechanism.joints();
        let turns = |letter: &Letter| {
            measure != Measure::Angle || letter.joint().is_none_or(|joint| joints[joint].is_revolute())
        };
        let left = (self.run.end..self.tail.start).map(Letter::Joint).filter(turns).collect();
        let before = (0..self.run.start).map(Letter::Inverse).rev();
        let behind = (self.tail.end..joints.len()).map(Letter::Inverse).rev();
        let right = before.chain([Letter::Target]).chain(behind).filter(turns).collect();
        let relation = Relation { measure, fixed, moved, left: Word(left), right: Word(right) };
        (!relation.joints().is_empty()).then_some(relation)
    }
}
