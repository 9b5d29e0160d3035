//! The final form of the list of solutions: no more than a target can have, sorted by branch.

use crate::answers::Answers;
use crate::mechanism::Mechanism;
use crate::solution::{Error, Solution};
use crate::steps::settle;
use crate::tolerances::MERGING;

impl<M: Mechanism> Answers<'_, M> {
    /// Whether the target has its maximal number of isolated solutions.
    pub fn are_all(&self) -> bool {
        let count = self.out[..self.count].iter().filter(|answer| answer.is_isolated()).count();
        self.problem.facts().isolated.is_some_and(|most| count >= most)
    }

    /// Brings all solutions into their final form and returns their number.
    #[inline(always)]
    pub fn conclude(&mut self) -> Result<usize, Error> {
        self.unite();
        self.sort();
        self.mark_choice();
        settle(self.problem.steps, &mut self.out[..self.count])
    }

    /// Merges the nearest two isolated solutions while there are more than a target can have: at a singular configuration rounding makes several of one. The
    /// better one is kept.
    fn unite(&mut self) {
        let Some(most) = self.problem.facts().isolated else { return };
        while self.count > most && self.out[..self.count].iter().filter(|answer| answer.is_isolated()).count() > most {
            let (mut least, mut worse) = (f64::INFINITY, 0);
            for second in 0..self.count {
                for first in 0..second {
                    let (a, b) = (&self.out[first], &self.out[second]);
                    let distance = self.problem.facts().farthest(a.q.as_ref(), b.q.as_ref());
                    if a.is_isolated() && b.is_isolated() && distance < least {
                        (least, worse) = (distance, if a.relative > b.relative { first } else { second });
                    }
                }
            }
            self.retain(|i| i != worse);
        }
    }

    /// Insertion sort by branch.
    fn sort(&mut self) {
        for end in 1..self.count {
            for place in (1..=end).rev() {
                if self.out[place - 1].branch <= self.out[place].branch {
                    break;
                }
                self.out.swap(place - 1, place);
            }
        }
    }

    /// Marks the solutions that the source would select.
    fn mark_choice(&mut self) {
        let Some(preference) = self.problem.facts().preference else { return };
        let sign = if preference.greatest { -1.0 } else { 1.0 };
        let value = |answer: &Solution<M>| sign * self.problem.place(&answer.q).as_ref()[preference.place];
        let answers = &mut self.out[..self.count];
        let least = answers.iter().map(value).fold(f64::INFINITY, f64::min);
        for answer in answers {
            answer.chosen = value(answer) <= least + MERGING.joints;
        }
    }
}
