//! Fraction of each joint's range that has solutions, for a redundant chain: [`Chain::shares`].
//!
//! The joints of a redundant chain can move while the tip is fixed: the self-motion. A joint that moves through its
//! whole range in the self-motion can be given any value. An elbow, whose angle follows from the distance to the
//! target, moves little.

use std::f64::consts::{PI, TAU};

use nalgebra::DVector;

use super::screw::ScrewSolver;
use super::{Chain, JointKind, Target};

/// Number of random poses that are followed.
const POSES: usize = 16;
/// Number of random poses for a counted fraction.
const COUNTED: usize = 250;
/// Step of the joint \[rad, or units of the reach\].
const STEP: f64 = 0.05;
/// Maximum motion of any joint in a step.
const LONGEST: f64 = 0.2;
/// A joint reverses where its component of the self-motion that moves it most is below this value.
const TURNS_BACK: f64 = 0.02;
/// A singular value below this fraction of the greatest counts as zero.
const RANK: f64 = 1e-6;

/// Random values of a chain's joints.
struct Draws<'a> {
    chain: &'a Chain,
    state: u64,
}

impl Draws<'_> {
    /// A value of each joint.
    fn posture(&mut self) -> Vec<f64> {
        let mut q: Vec<f64> = (0..self.chain.joints().len()).map(|joint| self.value(joint)).collect();
        self.chain.follow(&mut q);
        q
    }

    /// A random value in a joint's range, by the generator of Park and Miller 1988.
    fn value(&mut self, joint: usize) -> f64 {
        self.state = self.state * 48_271 % 2_147_483_647;
        let (low, high) = self.chain.range(joint);
        low + self.state as f64 / 2_147_483_647.0 * (high - low)
    }
}

impl Chain {
    /// For each joint the fraction of its range that the self-motion covers while the tip and the joints `held` are
    /// fixed. The range is between the limits, or a whole turn. It is the mean over random reachable poses, each
    /// followed until the joint reverses. It is zero for held joints and mimic joints. Values that no continuous motion
    /// reaches are not counted.
    #[doc(hidden)]
    pub fn shares(&self, held: &[usize]) -> Vec<f64> {
        let mut shares = vec![0.0; self.joints().len()];
        let is_free = |joint: &usize| !held.contains(joint) && self.leader(*joint).is_none();
        let mut draws = self.draws();
        for _ in 0..POSES {
            let q = draws.posture();
            for (joint, share) in shares.iter_mut().enumerate().filter(|(joint, _)| is_free(joint)) {
                *share += self.swept(&q, joint, held) / POSES as f64;
            }
        }
        shares
    }

    /// The range of a joint: between its limits, a whole turn, or the reach in both directions.
    fn range(&self, joint: usize) -> (f64, f64) {
        let joint = &self.joints()[joint];
        let reach = self.reach();
        match (joint.limits.filter(|(low, high)| low < high), joint.kind) {
            (Some(limits), JointKind::Prismatic) => limits,
            (Some((low, high)), JointKind::Revolute) if high - low < TAU => (low, high),
            (_, JointKind::Revolute) => (-PI, PI),
            (None, JointKind::Prismatic) => (-reach, reach),
        }
    }

    /// The fraction of random values of `joint`, and of random reachable poses with the joints `given`, that have
    /// solutions; `None` when the screw solver does not support the chain.
    #[doc(hidden)]
    pub fn counted_share(&self, given: &[usize], joint: usize) -> Option<f64> {
        let leads = |place: &usize| self.leader(*place).is_none();
        let mut places: Vec<usize> = given.iter().copied().chain([joint]).filter(leads).collect();
        places.sort_unstable();
        let names = places.iter().map(|&place| self.joints()[place].name.clone()).collect();
        let restricted = self.with_task(self.task(), self.direction().clone(), names).ok()?;
        let solver = ScrewSolver::within(&restricted, 0.0).ok()?;
        let mut draws = self.draws();
        let mut solved = 0;
        for _ in 0..COUNTED {
            let mut q = draws.posture();
            let target = Target::reached(&restricted, &q).ok()?;
            q[joint] = draws.value(joint);
            let values: Vec<f64> = places.iter().map(|&place| q[place]).collect();
            solved += usize::from(!solver.solve_given(&target, &values).ok()?.is_empty());
        }
        Some(solved as f64 / COUNTED as f64)
    }

    /// Random values in the joints' ranges, always the same.
    fn draws(&self) -> Draws<'_> {
        Draws { chain: self, state: 1 }
    }

    /// The fraction of its range that `joint` covers from `q`.
    fn swept(&self, q: &[f64], joint: usize, held: &[usize]) -> f64 {
        let (low, high) = self.range(joint);
        let [back, forth] = [-1.0, 1.0].map(|direction| self.driven(q, joint, direction, held));
        let (start, end) = (q[joint] - back, q[joint] + forth);
        let overlap = |turn: f64| (end.min(high + turn) - start.max(low + turn)).max(0.0);
        let turns = if self.joints()[joint].kind == JointKind::Revolute { &[-TAU, 0.0, TAU][..] } else { &[0.0] };
        let covered: f64 = turns.iter().map(|turn| overlap(*turn)).sum();
        (covered / (high - low)).min(1.0)
    }

    /// The distance that `joint` can move from `q` in one direction while the tip is fixed: at most a turn, or twice
    /// the reach.
    fn driven(&self, q: &[f64], joint: usize, direction: f64, held: &[usize]) -> f64 {
        let unit = self.unit(joint);
        let most = if self.joints()[joint].kind == JointKind::Revolute { TAU } else { 2.0 * unit };
        let (mut at, mut gone) = (q.to_vec(), 0.0);
        while gone < most {
            // The midpoint rule. The remaining motion of the tip does not affect the fraction.
            let middle =
                self.self_motion(&at, joint, held).map(|motion| self.stepped(&at, &motion, joint, 0.5 * direction));
            let Some(motion) = middle.and_then(|middle| self.self_motion(&middle, joint, held)) else { break };
            let next = self.stepped(&at, &motion, joint, direction);
            gone += (next[joint] - at[joint]).abs();
            at = next;
        }
        gone.min(most)
    }

    /// `q` after a step of `motion` in which `joint` moves by `direction` steps, or less where others would move too far.
    fn stepped(&self, q: &[f64], motion: &DVector<f64>, joint: usize, direction: f64) -> Vec<f64> {
        let length = (STEP / motion[joint]).min(LONGEST / motion.amax());
        let step = |(i, value): (usize, &f64)| value + direction * length * motion[i] * self.unit(i);
        let mut next: Vec<f64> = q.iter().enumerate().map(step).collect();
        self.follow(&mut next);
        next
    }

    /// The unit motion of all joints (radians, and units of the reach) that leaves the tip and the joints `held` fixed
    /// and moves `joint` most, forwards; `None` where it moves it too little.
    fn self_motion(&self, q: &[f64], joint: usize, held: &[usize]) -> Option<DVector<f64>> {
        let svd = self.coupled_jacobian(q, held).svd(false, true);
        let greatest = svd.singular_values.amax();
        let mut wish = DVector::zeros(q.len());
        wish[joint] = 1.0;
        for (value, row) in svd.singular_values.iter().zip(svd.v_t?.row_iter()) {
            if *value > RANK * greatest {
                wish -= row.transpose() * row[joint];
            }
        }
        let follow = (0..q.len()).filter(|joint| self.leader(*joint).is_some());
        held.iter().copied().chain(follow).for_each(|other| wish[other] = 0.0);
        let share = wish[joint].max(0.0).sqrt();
        (share > TURNS_BACK).then(|| wish / share)
    }

    /// One radian, or the reach.
    fn unit(&self, joint: usize) -> f64 {
        let slides = self.joints()[joint].kind == JointKind::Prismatic;
        if slides && self.reach() > 0.0 { self.reach() } else { 1.0 }
    }
}
