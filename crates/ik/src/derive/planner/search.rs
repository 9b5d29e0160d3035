//! The search for the order of the joints: dynamic programming over sets of known joints.
//!
//! The set of known joints decides which equations determine another joint; the values of the known joints do not matter. So the best path from each set is
//! computed once, at random targets modulo a prime, where zero tests are exact.

use std::collections::HashMap;

use super::eliminated::{eliminations, followers};
use super::one_joint::{Candidate, best_step};
use super::types::PlanStep;
use crate::derive::samples::sampled_relations::{SampledRelations, members, set};
use crate::{Result, Watch};

/// The sets of joints from which the search may eliminate joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// No elimination.
    OneJoint,
    /// Sets of at most this many unknown joints, if no joint is found alone.
    WhereStuck(usize),
    /// Sets of at most this many unknown joints, at every point of the search.
    Everywhere(usize),
}

/// The cost of a path: first the product of the solutions of its steps, then the sum of their efforts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Cost {
    solutions: usize,
    effort: usize,
}

/// The best path from a set of known joints: its cost and its first step. There is no step at the end.
#[derive(Clone, Debug)]
struct Onward {
    cost: Cost,
    step: Option<PlanStep>,
}

/// The state of the search.
pub struct Search<'a, 'b> {
    sampled: &'a mut SampledRelations<'b>,
    reach: Reach,
    watch: &'a Watch,
    all: u32,
    paths: HashMap<u32, Option<Onward>>,
}

impl<'a, 'b> Search<'a, 'b> {
    pub fn new(sampled: &'a mut SampledRelations<'b>, reach: Reach, watch: &'a Watch) -> Self {
        let all = (1_u32 << sampled.mechanism.joints().len()) - 1;
        Search { sampled, reach, watch, all, paths: HashMap::new() }
    }

    /// The steps of the path with the fewest solutions; `None` if no path finds all joints.
    ///
    /// # Errors
    /// The error of the watch if it stops the search.
    pub fn steps(mut self) -> Result<Option<Vec<PlanStep>>> {
        let mut known = set(self.sampled.mechanism.given());
        if self.explore(known)?.is_none() {
            return Ok(None);
        }
        let mut steps = Vec::new();
        while let Some(Some(Onward { step: Some(step), .. })) = self.paths.get(&known) {
            known |= 1 << step.joint;
            steps.push(step.clone());
        }
        Ok(Some(steps))
    }

    /// The least cost from the set `known` to the end.
    fn explore(&mut self, known: u32) -> Result<Option<Cost>> {
        if let Some(onward) = self.paths.get(&known) {
            return Ok(onward.as_ref().map(|onward| onward.cost));
        }
        self.watch.check()?;
        self.watch.report("plan", self.paths.len(), (self.all & !known).count_ones() as usize);
        let mut best: Option<Onward> = None;
        if known == self.all {
            best = Some(Onward { cost: Cost { solutions: 1, effort: 0 }, step: None });
        }
        for (step, effort) in self.candidates(known)? {
            let Some(rest) = self.explore(known | 1 << step.joint)? else { continue };
            let cost = Cost { solutions: step.degree * rest.solutions, effort: effort + rest.effort };
            if best.as_ref().is_none_or(|best| cost < best.cost) {
                best = Some(Onward { cost, step: Some(step) });
            }
        }
        let cost = best.as_ref().map(|onward| onward.cost);
        self.paths.insert(known, best);
        Ok(cost)
    }

    /// The steps to try. A step with one solution is taken at once, because more known joints never make the remaining search worse.
    fn candidates(&mut self, known: u32) -> Result<Vec<Candidate>> {
        let mut alone = Vec::new();
        for joint in members(self.all & !known) {
            alone.extend(best_step(self.sampled, joint, known)?);
        }
        if let Some(unique) = alone.iter().filter(|(step, _)| step.degree == 1).min_by_key(|(_, effort)| *effort) {
            return Ok(vec![unique.clone()]);
        }
        let size = match self.reach {
            Reach::Everywhere(size) => size,
            Reach::WhereStuck(size) if alone.is_empty() => size,
            _ => return Ok(alone),
        };
        let unknown = self.all & !known;
        for joints in (1..=unknown).filter(|joints| joints & !unknown == 0) {
            if self.is_together(joints, size) {
                alone.extend(eliminations(self.sampled, joints, known, self.watch)?);
            }
        }
        Ok(alone)
    }

    /// Whether these joints may be found together: two or more, of which at most `size` follow none of the others.
    fn is_together(&self, joints: u32, size: usize) -> bool {
        let count = joints.count_ones() as usize;
        let led = followers(self.sampled.mechanism, joints).count_ones() as usize;
        count > 1 && count - led <= size
    }
}
