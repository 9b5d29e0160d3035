//! Many targets, several at once in lanes.

use groebot_runtime::angles::{FAR_APART, acute, unfold};
use groebot_runtime::conditions::are_fulfilled;
use groebot_runtime::lanes::{Doubt, Lanes, Mask};
use groebot_runtime::registers::in_widest;
use groebot_runtime::storage::Storage;
use groebot_runtime::{Facts, Joint, Mechanism, Number};

use super::super::batch::Solved;
use super::super::code::Line;
use super::super::shaped::Shaped;
use super::super::spare::with_spare;
use super::execute::{MOST, Outcome, Row, WIDTH};
use super::{MOST_INPUTS, Ordinary, is_unsound, misses};

/// The candidates of several targets.
struct Bundle<'a> {
    own: &'a Ordinary,
    memory: &'a mut [Row],
    outcome: Outcome,
    /// By candidate and joint.
    q: &'a mut [Row],
    residuals: [Lanes<WIDTH>; MOST],
}

impl<S: Storage + 'static> Shaped<S> {
    /// Reports the solutions of these targets: those of ordinary ones from this code, the others one by one.
    pub fn solve_bundles(&self, own: &Ordinary, targets: &[f64], take: &mut dyn FnMut(Solved<'_>)) {
        let facts = self.facts();
        with_spare(|memory: &mut Vec<Row>| {
            let mut bundle = Bundle::new(own, &facts, memory);
            for targets in targets.chunks(facts.inputs * WIDTH) {
                bundle.find(&facts, targets);
                for (lane, target) in targets.chunks(facts.inputs).enumerate() {
                    if bundle.outcome.doubt.0[lane] == 0 {
                        bundle.pass(facts.joints.len(), lane, take);
                        take(Solved::Target { refused: None });
                    } else {
                        self.single(target, take);
                    }
                }
            }
        });
    }
}

impl<'a> Bundle<'a> {
    fn new(own: &'a Ordinary, facts: &Facts<'_>, memory: &'a mut Vec<Row>) -> Self {
        let (size, candidates) = (own.many.size, own.branches.len() * facts.joints.len());
        own.many.begin(memory, size + candidates);
        let (memory, q) = memory.split_at_mut(size);
        Bundle { own, memory, outcome: Outcome::NONE, q, residuals: [Lanes([0.0; WIDTH]); MOST] }
    }

    /// Finds the solutions of 1 to [`WIDTH`] targets.
    fn find(&mut self, facts: &Facts<'_>, targets: &[f64]) {
        let fine = in_widest(
            #[inline(always)]
            || self.load(facts, targets),
        );
        self.own.many.run(self.memory, &mut self.outcome);
        self.outcome.doubt = self.outcome.doubt | fine.inverted();
        in_widest(
            #[inline(always)]
            || self.assess(facts),
        );
    }

    /// Writes the numbers of targets, and returns whether they are valid.
    #[inline(always)]
    fn load(&mut self, facts: &Facts<'_>, targets: &[f64]) -> Mask<WIDTH> {
        let mut numbers = [Lanes([0.0; WIDTH]); MOST_INPUTS];
        let numbers = &mut numbers[..facts.inputs];
        for lane in 0..WIDTH {
            let first = lane * facts.inputs % targets.len();
            for (row, number) in numbers.iter_mut().zip(&targets[first..]) {
                row.0[lane] = *number;
            }
        }
        let fine = are_fulfilled(facts.conditions, numbers);
        self.own.many.load(self.memory, |index| numbers[index]);
        fine
    }

    /// Marks targets that are not ordinary, and computes the joint values.
    #[inline(always)]
    fn assess(&mut self, facts: &Facts<'_>) {
        for row in 0..self.own.many.rows {
            let [residual, relative] = self.own.measure(&self.own.many, self.memory, row);
            for twin in 0..self.own.twins {
                self.residuals[row * self.own.twins + twin] = residual;
            }
            let roots = self.roots(row * self.own.twins);
            let wrong = (misses(relative) | roots.close) & roots.dead.inverted();
            self.outcome.doubt = self.outcome.doubt | wrong;
        }
        self.tell_apart(facts);
        self.find_joints(facts);
    }

    #[inline(always)]
    fn roots(&self, candidate: usize) -> Doubt<WIDTH> {
        self.outcome.roots[candidate / 2]
    }

    /// A number of a candidate.
    #[inline(always)]
    fn number(&self, candidate: usize, place: usize) -> Lanes<WIDTH> {
        let number = self.memory[self.own.many.places[place].at(candidate / self.own.twins)].0;
        if self.own.turned[place] && candidate % 2 == 1 { -number } else { number }
    }

    #[inline(always)]
    fn pair(&self, candidate: usize, [c, s]: [usize; 2]) -> [Lanes<WIDTH>; 2] {
        [self.number(candidate, c), self.number(candidate, s)]
    }

    /// Marks targets with two candidates close to each other. Twins have equal distances to others.
    #[inline(always)]
    fn tell_apart(&mut self, facts: &Facts<'_>) {
        let (mut doubt, twins) = (self.outcome.doubt, self.own.twins);
        for k in (0..self.own.branches.len()).step_by(twins) {
            for other in (0..k + twins).filter(|&other| other != k) {
                let mut near = (self.roots(k).dead | self.roots(other).dead).inverted();
                for &i in facts.last_first {
                    let Joint::Angle(pair) = facts.joints[i] else { continue };
                    let [c, s] = self.pair(k, pair);
                    let [other_c, other_s] = self.pair(other, pair);
                    let (c, s) = (c * other_c, s * other_s);
                    near = near & Lanes::of(FAR_APART).exceeds(c + s).inverted();
                    if !near.any() {
                        break;
                    }
                }
                doubt = doubt | near;
            }
        }
        self.outcome.doubt = doubt;
    }

    /// Computes the joint values. Angles that differ only in sign are computed once.
    #[inline(always)]
    fn find_joints(&mut self, facts: &Facts<'_>) {
        let mut doubt = self.outcome.doubt;
        for (i, joint) in facts.joints.iter().enumerate() {
            let (mut wrong, mut size) = (Mask::NONE, Lanes::of(0.0));
            for k in 0..self.own.branches.len() {
                let is_new = k % facts.runs[i] == 0;
                if is_new || matches!(joint, Joint::Length(_)) {
                    wrong = is_unsound(*joint, |place| self.number(k, place));
                }
                let value = match *joint {
                    Joint::Angle(pair) => {
                        let [c, s] = self.pair(k, pair);
                        size = if is_new { acute(c.abs(), s.abs()) } else { size };
                        unfold(size, c, s)
                    }
                    Joint::Length(place) => self.number(k, place),
                };
                self.q[k * facts.joints.len() + i] = Line(value);
                doubt = doubt | (wrong & self.roots(k).dead.inverted());
            }
        }
        self.outcome.doubt = doubt;
    }

    /// Passes the solutions of the target in a lane to `take`.
    #[inline(always)]
    fn pass(&self, joints: usize, lane: usize, take: &mut dyn FnMut(Solved<'_>)) {
        let mut q = [0.0; crate::MAX_JOINTS];
        let q = &mut q[..joints];
        for (k, &branch) in self.own.branches.iter().enumerate() {
            if self.roots(k).dead.0[lane] != 0 {
                continue;
            }
            for (q, row) in q.iter_mut().zip(&self.q[k * joints..]) {
                *q = row.0.0[lane];
            }
            take(Solved::Answer { q, residual: self.residuals[k].0[lane], branch, free: 0, settled: true });
        }
    }
}
