//! From candidates to answers: each is polished, measured by the equations, and merged with those equal to it.

use std::f64::consts::TAU;

use super::evaluate::Solution;
use super::frame::Frame;
use super::program::{JointValue, Program};
use super::refine::{self, Fit, Joints, NONE_FREE};
use super::walk::Path;
use super::{ADRIFT, BLUR, MAX_JOINTS, MERGE, NEAR, ROUNDING};

/// A solution with the largest share of an equation's value in its scale.
struct Answer {
    solution: Solution,
    relative: f64,
}

/// The answers so far.
pub(super) struct Answers<'a> {
    program: &'a Program,
    /// Holds what the equations read.
    frame: Frame<'a>,
    list: Vec<Answer>,
}

impl<'a> Answers<'a> {
    pub fn new(program: &'a Program, frame: Frame<'a>) -> Self {
        Answers { program, frame, list: Vec::new() }
    }

    pub fn into_solutions(self) -> Vec<Solution> {
        self.list.into_iter().map(|answer| answer.solution).collect()
    }

    /// Turns the unknowns into joints, polishes them, and keeps what solves the equations.
    pub fn propose(&mut self, path: &Path, unknowns: &[f64]) {
        self.frame.unknowns.copy_from_slice(unknowns);
        let mut q = [0.0; MAX_JOINTS];
        for (slot, joint) in q.iter_mut().zip(&self.program.joints) {
            *slot = joint_value(joint.value, unknowns);
        }
        let mut fit = refine::measure(self.program, &q, &mut self.frame);
        if path.free == NONE_FREE {
            refine::polish(self.program, &mut q, &mut fit, &NONE_FREE, &mut self.frame);
            self.around(path, &q, &fit);
        } else if !fit.accepted && fit.relative <= ADRIFT {
            refine::polish(self.program, &mut q, &mut fit, &path.free, &mut self.frame);
        }
        self.keep(path, &q, &fit);
    }

    /// Where a candidate stands at a singular configuration and misses the equations by little, it is a double root that rounding
    /// made of two: starts again from points to either side of it, as far as the square root of the miss leads.
    fn around(&mut self, path: &Path, q: &Joints, fit: &Fit) {
        if !(ROUNDING..=NEAR).contains(&fit.relative) {
            return;
        }
        for (joint, sign) in (0..self.program.joints.len()).flat_map(|joint| [(joint, -1.0), (joint, 1.0)]) {
            let mut start = *q;
            let way = 2.0 * sign * fit.relative.sqrt();
            start[joint] = match self.program.joints[joint].value {
                JointValue::Angle { .. } => refine::wrap(q[joint] + way),
                JointValue::Plain(_) => q[joint] + way * self.program.scale.max(q[joint].abs()),
            };
            let mut fit = refine::measure(self.program, &start, &mut self.frame);
            refine::polish(self.program, &mut start, &mut fit, &NONE_FREE, &mut self.frame);
            self.keep(path, &start, &fit);
        }
    }

    /// Adds an answer if the equations hold, in place of a worse equal one.
    fn keep(&mut self, path: &Path, q: &Joints, fit: &Fit) {
        if !fit.accepted {
            return;
        }
        let joints = 0..self.program.joints.len();
        let free: Vec<usize> = joints.clone().filter(|&joint| path.free[joint]).collect();
        let branch = self.free_branch(path, &free);
        let solution = Solution { q: q[joints].to_vec(), residual: fit.residual, branch, free, chosen: false };
        let mut answer = Answer { solution, relative: fit.relative };
        let equal: Vec<usize> = (0..self.list.len()).filter(|&other| self.is_one(other, &answer)).collect();
        if equal.iter().any(|&other| self.list[other].holds_against(&answer)) {
            return;
        }
        if let Some(&other) = equal.first() {
            answer.solution.branch = self.list[other].solution.branch;
        }
        equal.into_iter().rev().for_each(|other| drop(self.list.remove(other)));
        self.push(answer);
    }

    /// The branch number of an answer on `path`: a second root of a double one takes the next number that is not taken.
    fn free_branch(&self, path: &Path, free: &[usize]) -> usize {
        let taken = |branch: usize| self.list.iter().any(|answer| answer.solution.branch == branch);
        let next = (path.branch..path.last).find(|&branch| !taken(branch));
        if free.is_empty() { next.unwrap_or(path.branch) } else { path.branch }
    }

    /// Adds an answer; where there are too many, the worst is left out.
    fn push(&mut self, answer: Answer) {
        self.list.push(answer);
        if self.list.len() > self.program.capacity {
            let mut worst = 0;
            for (index, answer) in self.list.iter().enumerate() {
                if answer.relative >= self.list[worst].relative {
                    worst = index;
                }
            }
            self.list.remove(worst);
        }
    }

    /// Whether the answer with this index is the same as a new one: members of one family, or within [`MERGE`] with joints left
    /// out that are free in either, or one singular configuration.
    fn is_one(&mut self, other: usize, answer: &Answer) -> bool {
        let (a, b) = (&self.list[other].solution, &answer.solution);
        let family = !b.free.is_empty() && a.branch == b.branch && a.free == b.free;
        family || self.close(a, b, MERGE) || self.blurred(other, answer)
    }

    /// Whether two answers next to each other are one at a singular configuration, where the equations leave the joints open
    /// beyond [`MERGE`]: half-way between them the equations hold as well as at the worse of the two, or within rounding.
    fn blurred(&mut self, other: usize, answer: &Answer) -> bool {
        let (other, program) = (&self.list[other], self.program);
        let (a, b) = (&other.solution, &answer.solution);
        if !(a.free.is_empty() && b.free.is_empty() && self.close(a, b, BLUR)) {
            return false;
        }
        let mut middle = [0.0; MAX_JOINTS];
        for (joint, slot) in middle.iter_mut().enumerate().take(program.joints.len()) {
            *slot = b.q[joint] + 0.5 * difference(program, joint, &a.q, &b.q);
        }
        let bound = ROUNDING.max(other.relative).max(answer.relative);
        refine::measure(program, &middle, &mut self.frame).relative <= bound
    }

    fn close(&self, a: &Solution, b: &Solution, tolerance: f64) -> bool {
        let program = self.program;
        let close = |joint: usize| {
            let allowed = match program.joints[joint].value {
                JointValue::Angle { .. } => tolerance,
                JointValue::Plain(_) => tolerance * program.scale.max(a.q[joint].abs()),
            };
            difference(program, joint, &a.q, &b.q).abs() <= allowed
        };
        (0..a.q.len()).all(|joint| a.free.contains(&joint) || b.free.contains(&joint) || close(joint))
    }
}

impl Answer {
    /// Whether this answer stays where `other` is equal to it: the better one, and the first member of a family that holds within
    /// rounding.
    fn holds_against(&self, other: &Answer) -> bool {
        let family = !self.solution.free.is_empty() && self.solution.free == other.solution.free;
        self.relative <= if family { other.relative.max(ROUNDING) } else { other.relative }
    }
}

/// `a - b` for one joint, for an angle by the shorter way round.
fn difference(program: &Program, joint: usize, a: &[f64], b: &[f64]) -> f64 {
    let difference = a[joint] - b[joint];
    match program.joints[joint].value {
        JointValue::Angle { .. } => difference - TAU * (difference / TAU).round(),
        JointValue::Plain(_) => difference,
    }
}

fn joint_value(value: JointValue, unknowns: &[f64]) -> f64 {
    match value {
        JointValue::Angle { cosine, sine } => refine::half_open(unknowns[sine].atan2(unknowns[cosine])),
        JointValue::Plain(unknown) => unknowns[unknown],
    }
}
