//! Test by forward kinematics whether joint values are among a solver's solutions: near one, or connected to one by a path on which the tip does not move.

use std::f64::consts::{PI, TAU};

use groebot_runtime::Solve;
use groebot_runtime::mechanism::Joints;
use groebot_runtime::storage::Array;
use nalgebra::{DMatrix, DVector};

/// Joint values of a solution, and its free joints as a set.
#[derive(Clone, Debug)]
pub struct Answer {
    pub q: Vec<f64>,
    pub free: u32,
}

/// Joint values nearer than this are one solution. A residual of 1e-14 moves the joints of a double root by its square root, and those of higher roots farther.
const NEAR: f64 = 1e-5;
/// Joint values nearer than this may be one solution, if all values between them also reach the target.
const BLUR: f64 = 5e-2;
/// Maximum residual of a member of a self-motion after correction.
const MEMBER: f64 = 1e-11;
/// Singular values below this fraction of the largest one are zero.
const RANK: f64 = 1e-8;
/// Maximum number of corrections of a member.
const CORRECTIONS: usize = 12;
/// Steps of a path \[rad\]: the shorter one is used if the longer one fails.
const STEPS: [f64; 2] = [0.1, 0.0125];
/// Distance from the solution at which a path has arrived.
const ARRIVED: f64 = 1e-5;
/// The longest and the shortest step along a curve \[rad\], and the maximum number of steps.
const LONGEST: f64 = 0.1;
const SHORTEST: f64 = 1e-5;
const PACES: usize = 1000;

/// A robot with revolute joints only.
pub struct Chain<'a, M: Solve>(pub &'a M);

impl<M: Solve> Chain<'_, M> {
    pub fn joints(&self) -> usize {
        self.0.facts().joints.len()
    }

    pub fn row(&self, q: &[f64]) -> Joints<M> {
        Array::by(q.len(), |i| q[i])
    }

    /// The pose of the tip: a position in units of the robot's size, and a rotation.
    fn tip(&self, q: &[f64]) -> DVector<f64> {
        let facts = self.0.facts();
        let tip = self.0.forward(&self.row(q)).expect("a chain has forward kinematics");
        DVector::from_iterator(
            facts.inputs,
            tip.as_ref().iter().enumerate().map(|(i, x)| if i < 3 { x / facts.scale } else { *x }),
        )
    }

    /// The derivatives of the tip's pose by the joints, by central differences.
    fn slopes(&self, q: &[f64], moving: &[usize]) -> DMatrix<f64> {
        const WAY: f64 = 1e-5;
        let columns: Vec<DVector<f64>> = moving
            .iter()
            .map(|&joint| {
                let at = |path: f64| {
                    let mut q = q.to_vec();
                    q[joint] += path;
                    self.tip(&q)
                };
                (at(WAY) - at(-WAY)) / (2.0 * WAY)
            })
            .collect();
        DMatrix::from_columns(&columns)
    }

    /// The determinant of the Jacobian of the tip's position and rotation.
    pub fn determinant(&self, q: &[f64]) -> f64 {
        let all: Vec<usize> = (0..self.joints()).collect();
        let (slopes, tip) = (self.slopes(q, &all), self.tip(q));
        let turn = |joint: usize, [a, b]: [usize; 2]| -> f64 {
            (0..3).map(|k| slopes[(3 + 3 * a + k, joint)] * tip[3 + 3 * b + k]).sum()
        };
        let rows = |i: usize, joint: usize| {
            if i < 3 { slopes[(i, joint)] } else { turn(joint, [[2, 1], [0, 2], [1, 0]][i - 3]) }
        };
        DMatrix::from_fn(6, 6, rows).determinant()
    }

    /// Whether joint values are in a list of solutions.
    pub fn is_reported(&self, q: &[f64], answers: &[Answer]) -> bool {
        let target = self.tip(q);
        answers.iter().any(|answer| distance(&answer.q, q) <= NEAR)
            || answers.iter().any(|answer| answer.free != 0 && self.leads_to(&target, q, answer))
            || answers.iter().any(|answer| distance(&answer.q, q) <= BLUR && self.is_joined(&target, q, &answer.q))
            || answers.iter().any(|answer| answer.free != 0 && self.runs_to(&target, q, &answer.q))
    }

    /// Whether joint values next to the straight line between two points reach the target.
    fn is_joined(&self, target: &DVector<f64>, a: &[f64], b: &[f64]) -> bool {
        let width = distance(a, b);
        let all: Vec<usize> = (0..self.joints()).collect();
        [0.25, 0.5, 0.75].iter().all(|share| {
            let between: Vec<f64> = a.iter().zip(b).map(|(a, b)| a + share * difference(*b, *a)).collect();
            let found = self.corrected(target, between.clone(), &all, None);
            found.is_some_and(|found| distance(&found, &between) <= width * width.max(1e-2))
        })
    }

    /// Whether the free joints can be moved from their values in `q` to those of a solution, in either direction of rotation, while the others hold the tip.
    fn leads_to(&self, target: &DVector<f64>, q: &[f64], answer: &Answer) -> bool {
        let free: Vec<usize> = (0..self.joints()).filter(|joint| answer.free >> joint & 1 == 1).collect();
        let others: Vec<usize> = (0..self.joints()).filter(|joint| !free.contains(joint)).collect();
        let short: Vec<f64> = free.iter().map(|&joint| difference(answer.q[joint], q[joint])).collect();
        let long: Vec<f64> = short.iter().map(|path| path - TAU.copysign(*path)).collect();
        let arrives = |path: &[f64], step: f64| {
            let steps = (path.iter().fold(0.0, |most, path| f64::max(most, path.abs())) / step).ceil().max(1.0);
            let end = (1..=steps as usize).try_fold(q.to_vec(), |mut at, k| {
                for (&joint, path) in free.iter().zip(path) {
                    at[joint] = q[joint] + path * k as f64 / steps;
                }
                self.corrected(target, at, &others, None)
            });
            end.is_some_and(|end| distance(&end, &answer.q) <= ARRIVED)
        };
        STEPS.iter().any(|step| [&short, &long].iter().any(|path| arrives(path, *step)))
    }

    /// Whether the curve through `q` of joint values with the same target passes through a solution.
    fn runs_to(&self, target: &DVector<f64>, q: &[f64], answer: &[f64]) -> bool {
        let Some(ahead) = self.tangent(q) else { return false };
        [1.0, -1.0].into_iter().any(|side| self.runs(target, q, &ahead * side, answer))
    }

    fn runs(&self, target: &DVector<f64>, q: &[f64], mut ahead: DVector<f64>, answer: &[f64]) -> bool {
        let (mut at, mut pace) = (q.to_vec(), LONGEST);
        for _ in 0..PACES {
            if distance(&at, answer) <= 2.0 * pace {
                let apart = DVector::from_iterator(q.len(), answer.iter().zip(&at).map(|(a, b)| difference(*a, *b)));
                let passed = self.beside(target, &at, &ahead, ahead.dot(&apart));
                if passed.is_some_and(|passed| distance(&passed, answer) <= ARRIVED) {
                    return true;
                }
            }
            let next = self.beside(target, &at, &ahead, pace).and_then(|next| {
                let tangent = self.tangent(&next)?;
                let side = tangent.dot(&ahead).signum();
                Some((next, tangent * side))
            });
            match next.filter(|(_, next)| next.dot(&ahead) > 0.9) {
                Some(next) => ((at, ahead), pace) = (next, f64::min(2.0 * pace, LONGEST)),
                None if pace > SHORTEST => pace /= 2.0,
                None => return false,
            }
        }
        false
    }

    /// The direction in which singular joints can move; `None` if there are several or none.
    fn tangent(&self, q: &[f64]) -> Option<DVector<f64>> {
        let all: Vec<usize> = (0..self.joints()).collect();
        let slopes = self.slopes(q, &all);
        let parts = slopes.svd(false, true);
        let mut order: Vec<usize> = (0..all.len()).collect();
        order.sort_by(|a, b| parts.singular_values[*a].total_cmp(&parts.singular_values[*b]));
        let is_one = parts.singular_values[order[0]] < 1e-7;
        is_one.then(|| parts.v_t.expect("it is computed").row(order[0]).transpose())
    }

    fn beside(&self, target: &DVector<f64>, q: &[f64], ahead: &DVector<f64>, path: f64) -> Option<Vec<f64>> {
        let all: Vec<usize> = (0..self.joints()).collect();
        let moved = q.iter().zip(ahead.iter()).map(|(q, ahead)| q + path * ahead).collect();
        self.corrected(target, moved, &all, Some(ahead))
    }

    /// The member next to `q`, by Gauss-Newton steps of the moving joints without a component along `across`.
    fn corrected(
        &self,
        target: &DVector<f64>,
        mut q: Vec<f64>,
        moving: &[usize],
        across: Option<&DVector<f64>>,
    ) -> Option<Vec<f64>> {
        for _ in 0..CORRECTIONS {
            let missed = self.tip(&q) - target;
            if missed.amax() <= 1e-14 {
                break;
            }
            let mut slopes = self.slopes(&q, moving);
            let mut right = missed;
            if let Some(across) = across {
                let rows = slopes.nrows();
                slopes = slopes.insert_row(rows, 0.0);
                slopes.row_mut(rows).copy_from(&across.transpose());
                right = right.insert_row(rows, 0.0);
            }
            let parts = slopes.svd(true, true);
            let least = RANK * parts.singular_values.max();
            let step = parts.solve(&right, least).ok()?;
            for (&joint, step) in moving.iter().zip(step.iter()) {
                q[joint] -= step;
            }
            if step.amax() < 1e-13 {
                break;
            }
        }
        ((self.tip(&q) - target).amax() <= MEMBER).then_some(q)
    }

    /// The residual of a solution.
    pub fn missed(&self, q: &[f64], answer: &Answer) -> f64 {
        (self.tip(&answer.q) - self.tip(q)).amax()
    }
}

/// The difference of two angles by the shorter rotation.
fn difference(a: f64, b: f64) -> f64 {
    let path = a - b;
    path - TAU * ((path + PI) / TAU).floor()
}

/// The largest difference of two rows of angles.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most, (a, b)| f64::max(most, difference(*a, *b).abs()))
}
