//! Where closed curves of solutions are searched ([`closed_search`]): a joint whose values are a grid, and sections.
//!
//! Short closed curves are around joint values at which the rows of the task's Jacobian are dependent. The directions in which joints then move without moving
//! the tip are a plane, and a short closed curve is nearly an ellipse in it. On many arms a joint has the same value at all such joint values, so that each short
//! curve around them passes this value.

use nalgebra::{DMatrix, DVector};

use super::{Part, RedundantChain};
use crate::solver::{ClosedSearch, MOST_SECTIONS, Section};
use groebot_algebra::random::SplitMix64;
use groebot_robot::kinematics::Chain;
use groebot_robot::spatial::Screw;

/// The number of random joint vectors from which dependent ones are searched, and of steps of Newton's method.
const STARTS: usize = 300;
const STEPS: usize = 40;
/// Maximal length of a step.
const LONGEST: f64 = 0.5;
/// Joint values this far beyond limits are near enough to them for closed curves within limits.
const BESIDE: f64 = 0.2;
/// A joint has one value at joint vectors whose values differ by at most this.
const EQUAL: f64 = 1e-3;
/// The least share of joint vectors for which a section is made.
const LEAST: f64 = 0.04;
/// Of the sections with at least this share of the most joint vectors, that of a quick solver is chosen.
const AS_MANY: f64 = 0.9;
/// Another joint than the planner's is the grid if it moves so many times as far; so many times with a slower solver.
const FARTHER: [f64; 2] = [1.5, 2.5];
/// Joint vectors are counted by the quantile of how far a joint moves.
const QUANTILE: f64 = 0.1;

/// Joint values at which the rows of the task's Jacobian are dependent.
struct Dependent {
    q: Vec<f64>,
    /// By joint, the largest share of its rate in a motion of unit length that does not move the tip.
    moves: Vec<f64>,
}

/// The search for a chain with one redundant joint. `is_slow` tells whether the solver with a joint given is an eigenvalue problem.
pub(super) fn closed_search(
    chain: &Chain,
    redundancy: &RedundantChain,
    is_slow: impl Fn(usize) -> bool,
) -> Option<ClosedSearch> {
    if redundancy.parts.contains(&Part::Scanned) {
        return None;
    }
    let arm = Arm { chain, redundancy };
    let dependent = arm.dependent();
    let (sections, rest) = arm.sections(&dependent, &is_slow);
    let rest: Vec<&Dependent> = if rest.len() * 10 < dependent.len() { dependent.iter().collect() } else { rest };
    Some(ClosedSearch { grid: arm.grid(&rest, is_slow), sections })
}

struct Arm<'a> {
    chain: &'a Chain,
    redundancy: &'a RedundantChain,
}

impl Arm<'_> {
    fn count(&self) -> usize {
        self.chain.joints().len()
    }

    fn is_solved(&self, joint: usize) -> bool {
        matches!(self.redundancy.parts[joint], Part::Main | Part::Derived(_))
    }

    fn slides(&self, joint: usize) -> bool {
        matches!(self.chain.screws()[joint], Screw::Prismatic(_))
    }

    /// The range of a joint, at most a turn or two reaches.
    fn range(&self, joint: usize) -> [f64; 2] {
        let half = if self.slides(joint) { self.chain.reach() } else { std::f64::consts::PI };
        match self.chain.joints()[joint].limits {
            Some((low, high)) if high - low < 2.0 * half => [low, high],
            _ => [-half, half],
        }
    }

    /// The value of a joint, moved by whole turns next to its range.
    fn beside(&self, joint: usize, value: f64) -> f64 {
        let [low, high] = self.range(joint);
        let turn = std::f64::consts::TAU;
        if self.slides(joint) { value } else { value - turn * ((value - 0.5 * (low + high)) / turn).round() }
    }

    fn random(&self, random: &mut SplitMix64) -> Vec<f64> {
        (0..self.count()).map(|joint| self.range(joint)).map(|[low, high]| random.between(low, high)).collect()
    }

    /// Joint values within limits, or next to them, with dependent rows.
    fn dependent(&self) -> Vec<Dependent> {
        let mut random = SplitMix64::new(0);
        let starts: Vec<Vec<f64>> = (0..STARTS).map(|_| self.random(&mut random)).collect();
        let is_within = |found: &Dependent| {
            found.q.iter().enumerate().all(|(joint, value)| {
                let [low, high] = self.range(joint);
                *value >= low - BESIDE && *value <= high + BESIDE
            })
        };
        starts.into_iter().filter_map(|start| self.descend(start)).filter(is_within).collect()
    }

    /// Newton's method, with least steps, for joint values and a unit vector `u` with `J^T u = 0`.
    fn descend(&self, mut q: Vec<f64>) -> Option<Dependent> {
        let jacobian = |q: &[f64]| self.chain.task_jacobian(q, &[]);
        let (n, m) = (self.count(), self.chain.task().freedoms());
        // The step of central differences for which their errors of rounding and of the method are alike.
        let difference = f64::EPSILON.cbrt();
        let mut u = jacobian(&q).svd(true, false).u?.column(m - 1).into_owned();
        for _ in 0..STEPS {
            let now = jacobian(&q);
            let values = now.tr_mul(&u);
            if values.amax() < f64::EPSILON.sqrt() {
                return self.moves(&now).map(|moves| Dependent {
                    q: q.iter().enumerate().map(|(joint, value)| self.beside(joint, *value)).collect(),
                    moves,
                });
            }
            let mut slopes = DMatrix::zeros(n + 1, n + m);
            for joint in 0..n {
                let mut at = |step: f64| {
                    let value = q[joint];
                    q[joint] = value + step;
                    let product = jacobian(&q).tr_mul(&u);
                    q[joint] = value;
                    product
                };
                let slope = (at(difference) - at(-difference)) / (2.0 * difference);
                slopes.view_mut((0, joint), (n, 1)).copy_from(&slope);
            }
            slopes.view_mut((0, n), (n, m)).copy_from(&now.transpose());
            slopes.view_mut((n, n), (1, m)).copy_from(&u.transpose());
            let mut residual = DVector::zeros(n + 1);
            residual.rows_mut(0, n).copy_from(&values);
            let step = slopes.tr_mul(&(&slopes * slopes.transpose()).lu().solve(&residual)?);
            let share = (LONGEST / step.amax()).min(1.0);
            (0..n).for_each(|joint| q[joint] -= share * step[joint]);
            u = (u - share * step.rows(n, m)).normalize();
        }
        None
    }

    /// How far each joint moves; `None` if the rank is less than one below the number of rows.
    fn moves(&self, jacobian: &DMatrix<f64>) -> Option<Vec<f64>> {
        let svd = jacobian.clone().svd(false, true);
        let rank = jacobian.nrows() - 1;
        let rows = svd.v_t?;
        if rank > 0 && svd.singular_values[rank - 1] < EQUAL * svd.singular_values[0] {
            return None;
        }
        let share = |joint: usize| (1.0 - rows.column(joint).rows(0, rank).norm_squared()).max(0.0).sqrt();
        Some((0..self.count()).map(share).collect())
    }

    /// Sections that pass most of the joint vectors, and the other joint vectors.
    fn sections<'d>(
        &self,
        dependent: &'d [Dependent],
        is_slow: &impl Fn(usize) -> bool,
    ) -> (Vec<Section>, Vec<&'d Dependent>) {
        let mut rest: Vec<&Dependent> = dependent.iter().collect();
        let mut sections: Vec<Section> = Vec::new();
        let mut barren: Vec<Section> = Vec::new();
        while sections.len() < MOST_SECTIONS {
            let candidates: Vec<(Section, usize)> = (0..self.count())
                .filter(|&joint| self.is_solved(joint))
                .map(|joint| most(joint, &rest, &barren))
                .collect();
            let greatest = candidates.iter().map(|(_, count)| *count).max().unwrap_or(0);
            if greatest as f64 <= LEAST * dependent.len() as f64 || greatest < 3 {
                break;
            }
            let as_many = |(_, count): &&(Section, usize)| *count as f64 >= AS_MANY * greatest as f64;
            let Some((section, _)) =
                candidates.iter().filter(as_many).min_by_key(|(section, _)| is_slow(section.joint))
            else {
                break;
            };
            if self.is_passed(section) {
                rest.retain(|found| (found.q[section.joint] - section.value).abs() > EQUAL);
                sections.push(section.clone());
            } else {
                barren.push(section.clone());
                if barren.len() > MOST_SECTIONS {
                    break;
                }
            }
        }
        (sections, rest)
    }

    /// Whether targets in general have solutions in a section: it is within limits, and the other joints move the tip in all directions.
    fn is_passed(&self, section: &Section) -> bool {
        let [low, high] = self.range(section.joint);
        let mut random = SplitMix64::new(1);
        let mut least = || {
            let mut q = self.random(&mut random);
            q[section.joint] = section.value;
            self.chain.task_jacobian(&q, &[section.joint]).singular_values().min()
        };
        section.value >= low && section.value <= high && (0..5).any(|_| least() > 0.1 * EQUAL)
    }

    /// The joint that moves farthest relative to its range, or the planner's joint if that moves nearly as far.
    fn grid(&self, dependent: &[&Dependent], is_slow: impl Fn(usize) -> bool) -> usize {
        let main = self.redundancy.parts.iter().position(|part| *part == Part::Main).unwrap_or(0);
        if dependent.is_empty() {
            return main;
        }
        let far = |joint: usize| {
            let mut moves: Vec<f64> = dependent.iter().map(|found| found.moves[joint]).collect();
            moves.sort_by(f64::total_cmp);
            let [low, high] = self.range(joint);
            moves[(QUANTILE * moves.len() as f64) as usize] / (high - low)
        };
        let needed = |joint: usize| FARTHER[usize::from(is_slow(joint) && !is_slow(main))] * far(main);
        let better = (0..self.count()).filter(|&joint| joint != main && self.is_solved(joint));
        let better = better.filter(|&joint| far(joint) > needed(joint));
        better.max_by(|&a, &b| far(a).total_cmp(&far(b))).unwrap_or(main)
    }
}

/// The value that a joint has in most joint vectors, rounded, and in how many. The number is 0 if the section is one of `barren`.
fn most(joint: usize, dependent: &[&Dependent], barren: &[Section]) -> (Section, usize) {
    let mut values: Vec<f64> = dependent.iter().map(|found| found.q[joint]).collect();
    values.sort_by(f64::total_cmp);
    let is_barren =
        |value: f64| barren.iter().any(|section| section.joint == joint && (section.value - value).abs() <= EQUAL);
    let (mut best, mut count, mut first) = (0.0, 0, 0);
    for last in 0..values.len() {
        while values[last] - values[first] > EQUAL {
            first += 1;
        }
        let middle = values[(first + last) / 2];
        if last + 1 - first > count && !is_barren(middle) {
            (best, count) = (middle, last + 1 - first);
        }
    }
    // The last digits depend on the machine. The sum makes 0 of -0.
    (Section { joint, value: (best * 1e6).round() / 1e6 + 0.0 }, count)
}
