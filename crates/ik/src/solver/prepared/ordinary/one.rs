//! One target, with its candidates in lanes.

use groebot_runtime as runtime;
use groebot_runtime::angles::{FAR_APART, acute, unfold};
use groebot_runtime::lanes::{Lanes, Mask};
use groebot_runtime::mechanism::Inputs;
use groebot_runtime::registers::in_widest;
use groebot_runtime::storage::{Array, Storage};
use groebot_runtime::{Facts, Joint, Mechanism, Number};

use super::super::shaped::Shaped;
use super::super::spare::with_spare;
use super::execute::{MOST, Outcome, Row, WIDTH};
use super::{Ordinary, is_unsound, misses};

/// The maximal number of rows of candidates.
const ROWS: usize = MOST / WIDTH;

/// The candidates of a target.
struct Candidates {
    dead: [Mask<WIDTH>; ROWS],
    measures: [[Lanes<WIDTH>; 2]; ROWS],
}

impl<S: Storage + 'static> Shaped<S> {
    /// Writes the solutions of a target that fulfils its conditions, and returns their number; `None` if the target is
    /// not ordinary, or there is not enough room.
    #[inline]
    pub fn solve_ordinary(&self, target: &Inputs<Self>, out: &mut [runtime::Solution<Self>]) -> Option<usize> {
        let own = self.ordinary.as_ref()?;
        with_spare(|memory: &mut Vec<Row>| {
            own.one.begin(memory);
            in_widest(
                #[inline(always)]
                || self.solve_in(own, memory, target, out),
            )
        })
    }

    #[inline(always)]
    fn solve_in(
        &self,
        own: &Ordinary,
        memory: &mut [Row],
        target: &Inputs<Self>,
        out: &mut [runtime::Solution<Self>],
    ) -> Option<usize> {
        let (facts, mut outcome) = (self.facts(), Outcome::NONE);
        own.one.run(memory, |index| Lanes([target.as_ref()[index]; WIDTH]), &mut outcome);
        let found = own.candidates(memory, &facts, &outcome)?;
        own.are_apart(memory, &facts, &found).then_some(())?;
        let joints = facts.joints.len();
        let mut q = [[Lanes([0.0; WIDTH]); ROWS]; crate::solver::MAX_JOINTS];
        for (q, joint) in q.iter_mut().zip(facts.joints) {
            for row in 0..own.one.rows {
                let number = |place: usize| memory[own.one.places[place].at(row)].0;
                q[row] = match *joint {
                    Joint::Angle([c, s]) => {
                        let (c, s) = (number(c), number(s));
                        unfold(acute(c.abs(), s.abs()), c, s)
                    }
                    Joint::Length(place) => number(place),
                };
            }
        }
        let mut count = 0;
        for (k, &branch) in own.branches.iter().enumerate() {
            let (row, lane) = (k / WIDTH, k % WIDTH);
            if found.dead[row].0[lane] != 0 {
                continue;
            }
            let [residual, relative] = found.measures[row];
            let q = Array::by(joints, |i| q[i][row].0[lane]);
            *out.get_mut(count)? = runtime::Solution {
                q,
                residual: residual.0[lane],
                relative: relative.0[lane],
                branch,
                chosen: false,
                free: 0,
                settled: true,
            };
            count += 1;
        }
        Some(count)
    }
}

impl Ordinary {
    /// The candidates, if none is in doubt.
    #[inline(always)]
    fn candidates(&self, memory: &[Row], facts: &Facts<'_>, outcome: &Outcome) -> Option<Candidates> {
        let mut found = Candidates { dead: [Mask::NONE; ROWS], measures: [[Lanes([0.0; WIDTH]); 2]; ROWS] };
        let mut doubt = outcome.doubt;
        for row in 0..self.one.rows {
            let roots = outcome.roots[row];
            found.dead[row] = roots.dead;
            found.measures[row] = self.measure(&self.one, memory, row);
            let mut wrong = roots.close | misses(found.measures[row][1]);
            for joint in facts.joints {
                wrong = wrong | is_unsound(*joint, |place| memory[self.one.places[place].at(row)].0);
            }
            doubt = doubt | (wrong & roots.dead.inverted());
        }
        (!doubt.any()).then_some(found)
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
