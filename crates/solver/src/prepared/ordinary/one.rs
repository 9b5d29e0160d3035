//! One target, with its candidates in lanes.

use groebot_runtime::angles::{FAR_APART, acute, unfold};
use groebot_runtime::lanes::{Lanes, Mask};
use groebot_runtime::mechanism::{Inputs, Joints};
use groebot_runtime::registers::in_widest;
use groebot_runtime::storage::{Array, Storage};
use groebot_runtime::{Facts, Joint, Mechanism, Number};

use super::super::shaped::Shaped;
use super::super::spare::with_spare;
use super::execute::{MOST, Outcome, Row, WIDTH};
use super::{Ordinary, is_unsound, misses};
use crate::MAX_JOINTS;

/// The maximal number of rows of candidates.
const ROWS: usize = MOST / WIDTH;

/// The candidates of a target.
struct Candidates {
    /// By joint and row.
    q: [[Lanes<WIDTH>; ROWS]; MAX_JOINTS],
    dead: [Mask<WIDTH>; ROWS],
    measures: [[Lanes<WIDTH>; 2]; ROWS],
}

impl<S: Storage + 'static> Shaped<S> {
    /// Same as [`Mechanism::ordinary`].
    #[inline]
    pub fn solve_ordinary(&self, target: &Inputs<Self>, take: &mut impl FnMut(Joints<Self>, [f64; 2], usize)) -> bool {
        let Some(own) = &self.ordinary else { return false };
        let mut found = Candidates {
            q: [[Lanes([0.0; WIDTH]); ROWS]; MAX_JOINTS],
            dead: [Mask::NONE; ROWS],
            measures: [[Lanes([0.0; WIDTH]); 2]; ROWS],
        };
        if !own.are_found(&self.facts(), target.as_ref(), &mut found) {
            return false;
        }
        let joints = self.facts().joints.len();
        for (k, &branch) in own.branches.iter().enumerate() {
            let (row, lane) = (k / WIDTH, k % WIDTH);
            if found.dead[row].0[lane] == 0 {
                let [residual, relative] = [found.measures[row][0].0[lane], found.measures[row][1].0[lane]];
                take(Array::by(joints, |i| found.q[i][row].0[lane]), [residual, relative], branch);
            }
        }
        true
    }
}

impl Ordinary {
    /// Finds the candidates of a target. Returns false if the target is not ordinary.
    fn are_found(&self, facts: &Facts<'_>, target: &[f64], found: &mut Candidates) -> bool {
        with_spare(|memory: &mut Vec<Row>| {
            let mut outcome = Outcome::NONE;
            self.one.begin(memory, self.one.size);
            self.one.load(memory, |index| Lanes([target[index]; WIDTH]));
            self.one.run(memory, &mut outcome);
            in_widest(
                #[inline(always)]
                || self.are_ordinary(memory, facts, &outcome, found) && self.are_apart(memory, facts, found),
            )
        })
    }

    /// Measures the candidates and computes their joint values. Returns false if one is in doubt.
    #[inline(always)]
    fn are_ordinary(&self, memory: &[Row], facts: &Facts<'_>, outcome: &Outcome, found: &mut Candidates) -> bool {
        let mut doubt = outcome.doubt;
        for row in 0..self.one.rows {
            let roots = outcome.roots[row];
            found.dead[row] = roots.dead;
            found.measures[row] = self.measure(&self.one, memory, row);
            let mut wrong = roots.close | misses(found.measures[row][1]);
            let number = |place: usize| memory[self.one.places[place].at(row)].0;
            for (joint, q) in facts.joints.iter().zip(&mut found.q) {
                wrong = wrong | is_unsound(*joint, number);
                q[row] = match *joint {
                    Joint::Angle([c, s]) => {
                        let (c, s) = (number(c), number(s));
                        unfold(acute(c.abs(), s.abs()), c, s)
                    }
                    Joint::Length(place) => number(place),
                };
            }
            doubt = doubt | (wrong & roots.dead.inverted());
        }
        !doubt.any()
    }

    /// Whether each two candidates differ in at least one angle.
    #[inline(always)]
    fn are_apart(&self, memory: &[Row], facts: &Facts<'_>, found: &Candidates) -> bool {
        let is_dead = |k: usize| found.dead[k / WIDTH].0[k % WIDTH] != 0;
        let number = |place: usize, k: usize| memory[self.one.places[place].at(k / WIDTH)].0.0[k % WIDTH];
        let candidates = self.branches.len();
        for k in 1..candidates {
            for other in 0..k {
                let mut are_apart = is_dead(k) || is_dead(other);
                // A loop, because a closure given to an iterator is not inlined here.
                for &i in facts.last_first {
                    if are_apart {
                        break;
                    }
                    let Joint::Angle([c, s]) = facts.joints[i] else { continue };
                    are_apart = number(c, k) * number(c, other) + number(s, k) * number(s, other) < FAR_APART;
                }
                if !are_apart {
                    return false;
                }
            }
        }
        true
    }
}
