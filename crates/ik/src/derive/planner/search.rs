//! The search for the order of the joints: dynamic programming over sets of known joints.
//!
//! Which equations determine a joint depends on which joints are known, not on their values; so the best way on from each set is
//! found once, at random targets modulo a prime, where zero is zero.

use std::collections::HashMap;

use super::eliminated::{eliminations, followers};
use super::one_joint::{Candidate, best_step};
use super::types::PlanStep;
use crate::derive::samples::sights::{Sights, members, set};
use crate::{Result, Watch};

/// Where the search may eliminate joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// Nowhere.
    OneJoint,
    /// So many unknown joints together, where no joint is found alone.
    WhereStuck(usize),
    /// So many unknown joints together, everywhere.
    Everywhere(usize),
}

/// First the number of solutions that the steps give together, then their effort.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Cost {
    solutions: usize,
    effort: usize,
}

/// The way on from a set of known joints; no step at the end.
#[derive(Clone, Debug)]
struct Onward {
    cost: Cost,
    step: Option<PlanStep>,
}

/// The search.
pub struct Search<'a, 'b> {
    sights: &'a mut Sights<'b>,
    reach: Reach,
    watch: &'a Watch,
    all: u32,
    ways: HashMap<u32, Option<Onward>>,
}

impl<'a, 'b> Search<'a, 'b> {
    pub fn new(sights: &'a mut Sights<'b>, reach: Reach, watch: &'a Watch) -> Self {
        let all = (1_u32 << sights.mechanism.joints().len()) - 1;
        Search { sights, reach, watch, all, ways: HashMap::new() }
    }

    /// The steps with the fewest solutions together; `None` when there is no way to the end.
    ///
    /// # Errors
    /// What the watch stops with.
    pub fn steps(mut self) -> Result<Option<Vec<PlanStep>>> {
        let mut known = set(self.sights.mechanism.given());
        if self.explore(known)?.is_none() {
            return Ok(None);
        }
        let mut steps = Vec::new();
        while let Some(Some(Onward { step: Some(step), .. })) = self.ways.get(&known) {
            known |= 1 << step.joint;
            steps.push(step.clone());
        }
        Ok(Some(steps))
    }

    /// The least cost from the set `known` to the end.
    fn explore(&mut self, known: u32) -> Result<Option<Cost>> {
        if let Some(onward) = self.ways.get(&known) {
            return Ok(onward.as_ref().map(|onward| onward.cost));
        }
        self.watch.check()?;
        self.watch.report("plan", self.ways.len(), (self.all & !known).count_ones() as usize);
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
        self.ways.insert(known, best);
        Ok(cost)
    }

    /// The steps to try. A step with one solution is taken at once: to know more never hurts.
    fn candidates(&mut self, known: u32) -> Result<Vec<Candidate>> {
        let mut alone = Vec::new();
        for joint in members(self.all & !known) {
            alone.extend(best_step(self.sights, joint, known)?);
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
                alone.extend(eliminations(self.sights, joints, known, self.watch)?);
            }
        }
        Ok(alone)
    }

    /// Whether so many joints are found together: two or more, of which at most `size` follow none of the others.
    fn is_together(&self, joints: u32, size: usize) -> bool {
        let count = joints.count_ones() as usize;
        let led = followers(self.sights.mechanism, joints).count_ones() as usize;
        count > 1 && count - led <= size
    }
}
