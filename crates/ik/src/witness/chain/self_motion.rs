//! Self-motions of one parameter at singular targets: whether there is one, whether a path in it leads to a solution, and which solutions are equal up to a
//! self-motion.

use crate::tolerances::WITNESS;
use nalgebra::{DMatrix, DVector};

use super::model::Configuration;
use super::singular::{least_squares, null_vector};
use groebot_robot::kinematics::Solution;
use groebot_runtime::tolerances::MERGING;

/// The distance along the null vector at which a self-motion is tested.
const PROBE: f64 = 0.05;
/// The number of such distances over which a self-motion must continue. If two axes are out of line by 1e-6 rad, there is a double solution instead. Its error
/// is 1e-12 times the square of the distance, which is initially less than rounding.
const PROBES: usize = 4;
/// Steps of a path \[rad, or fractions of the reach\]. Shorter ones are used if longer ones fail.
pub(super) const STEPS: [f64; 3] = [0.2, 0.05, 0.0125];
/// The maximum number of corrections of one member.
const CORRECTIONS: usize = 20;
/// The maximum bend of a path between two joint vectors: a fraction of its length, or of the square of its length if that is greater.
const STRAIGHT: f64 = 1e-2;
/// The longest and the shortest step along a curve, and the maximum number of steps.
const LONGEST: f64 = 0.1;
const PACES: usize = 2000;
/// The minimum cosine of the angle between a curve's directions before and after a step.
const STEADY: f64 = 0.9;

/// Paths of joint vectors with the same target.
pub(super) trait SelfMotions: Configuration {
    /// Whether `q` is on a curve of joint vectors with the same target.
    fn is_in_self_motion(&self, target: &[f64], q: &[f64]) -> bool {
        self.tangent(q).is_some_and(|tangent| self.goes_on(target, q, tangent))
    }

    /// Whether the curve continues from `q` in the direction `ahead`.
    fn goes_on(&self, target: &[f64], q: &[f64], mut ahead: DVector<f64>) -> bool {
        let mut at = q.to_vec();
        (0..PROBES).all(|_| {
            let next = self.stepped(target, &at, &ahead, (PROBE, WITNESS.rounding));
            next.is_some_and(|(next, on)| {
                (at, ahead) = (next, on);
                true
            })
        })
    }

    /// The direction in which joints that are singular within rounding can move.
    fn tangent(&self, q: &[f64]) -> Option<DVector<f64>> {
        if self.sigma(q) > WITNESS.member { None } else { null_vector(self.jacobian(q)) }
    }

    /// The member next to `q` moved by `distance` along the unit vector `ahead`, and no farther along it. Its error is at most `tolerance`.
    fn moved_along(
        &self,
        target: &[f64],
        q: &[f64],
        ahead: &DVector<f64>,
        distance: f64,
        tolerance: f64,
    ) -> Option<Vec<f64>> {
        let mut moved = q.to_vec();
        for (&joint, share) in self.unknown().iter().zip(ahead.iter()) {
            moved[joint] += distance * share * self.unit(joint);
        }
        let across = |_: &[f64]| DMatrix::from_row_slice(1, ahead.len(), ahead.as_slice());
        self.corrected(target, moved, self.unknown(), &across, tolerance)
    }

    /// Whether `b` is the same solution as `a`, and within the distance at which a solver merges solutions.
    fn is_same(&self, target: &[f64], a: &[f64], b: &[f64]) -> bool {
        self.distance(a, b) <= MERGING.blur && self.matches(target, a, b)
    }

    /// Whether `b` is the same solution as `a`, or a member of its self-motion.
    ///
    /// The distance is at most 1e-9 if `a` is ordinary, otherwise max(1e-7, 1e-13 / sigma). It may also be up to four times the error of `a` over sigma, but
    /// then a path between the two must reach the target everywhere.
    fn matches(&self, target: &[f64], a: &[f64], b: &[f64]) -> bool {
        let (distance, sigma) = (self.distance(a, b), self.sigma(a));
        if sigma > WITNESS.ordinary {
            return distance <= WITNESS.equal;
        }
        let miss = f64::max(WITNESS.exact, 4.0 * self.residual(target, a));
        distance <= (miss / sigma).max(WITNESS.moved) && self.is_joined(target, a, b, WITNESS.residual)
    }

    /// Whether joint vectors next to the straight line from `a` to `b` reach the target, within `missed`.
    fn is_joined(&self, target: &[f64], a: &[f64], b: &[f64], missed: f64) -> bool {
        let none = |_: &[f64]| DMatrix::zeros(0, self.unknown().len());
        let width = self.distance(a, b);
        [0.25, 0.5, 0.75].iter().all(|share| {
            let point = |joint: usize| a[joint] + share * self.difference(joint, b[joint], a[joint]);
            let between: Vec<f64> = (0..a.len()).map(point).collect();
            let found = self.corrected(target, between.clone(), self.unknown(), &none, missed);
            found.is_some_and(|found| self.distance(&found, &between) <= width * width.max(STRAIGHT))
        })
    }

    /// Whether the free joints of `answer` can move from their values in `q` to those in `answer`, in either direction, along a self-motion.
    ///
    /// The other joints keep the tip at the target, within `missed`, and end at the solution. The path has steps of `step`. Next to a double root, `missed`
    /// allows an error of its square root in the other joints.
    fn leads_to(&self, target: &[f64], q: &[f64], answer: &Solution, (step, missed): (f64, f64)) -> bool {
        let Solution { q: end, free, .. } = answer;
        let short: Vec<f64> = free.iter().map(|&joint| self.difference(joint, end[joint], q[joint])).collect();
        let round = |(angle, &joint): (&f64, &usize)| {
            if self.turns(joint) { angle - std::f64::consts::TAU.copysign(*angle) } else { *angle }
        };
        let long: Vec<f64> = short.iter().zip(free).map(round).collect();
        [short, long].iter().any(|displacements| {
            let led = self.led(target, q, (free, displacements), (step, missed));
            led.is_some_and(|led| self.distance(&led, end) <= missed.sqrt())
        })
    }

    /// The end of the path on which the free joints move by `displacements` in such steps.
    fn led(
        &self,
        target: &[f64],
        q: &[f64],
        (free, displacements): (&[usize], &[f64]),
        (step, missed): (f64, f64),
    ) -> Option<Vec<f64>> {
        let others: Vec<usize> = self.unknown().iter().copied().filter(|joint| !free.contains(joint)).collect();
        let units = free.iter().map(|&joint| self.unit(joint));
        let longest = displacements.iter().zip(units).map(|(value, unit)| value.abs() / unit).fold(0.0, f64::max);
        let steps = (longest / step).ceil().max(1.0);
        let none = |_: &[f64]| DMatrix::zeros(0, others.len());
        (1..=steps as usize).try_fold(q.to_vec(), |mut at, step| {
            for (&joint, displacement) in free.iter().zip(displacements) {
                at[joint] = q[joint] + displacement * step as f64 / steps;
            }
            self.corrected(target, at, &others, &none, missed)
        })
    }

    /// Whether the curve of joint vectors with the same target through `q` also contains `answer`, in either direction. It continues where a free joint reaches
    /// the end of its part of the circle and turns back while the others change to another branch.
    fn runs_to(&self, target: &[f64], q: &[f64], answer: &[f64]) -> bool {
        let tangent = self.tangent(q);
        tangent.is_some_and(|ahead| {
            [ahead.clone(), -ahead].into_iter().any(|direction| self.runs(target, q, direction, answer))
        })
    }

    /// Same as [`SelfMotions::runs_to`], but only in the direction `ahead`. The curve's bends limit the steps.
    fn runs(&self, target: &[f64], q: &[f64], mut ahead: DVector<f64>, answer: &[f64]) -> bool {
        let (mut at, mut pace) = (q.to_vec(), LONGEST);
        for _ in 0..PACES {
            if self.distance(&at, answer) <= 2.0 * pace && self.passes(target, &at, &ahead, answer) {
                return true;
            }
            match self
                .stepped(target, &at, &ahead, (pace, WITNESS.member))
                .filter(|(_, next)| next.dot(&ahead) > STEADY)
            {
                Some(next) => ((at, ahead), pace) = (next, f64::min(2.0 * pace, LONGEST)),
                None if pace > WITNESS.near => pace /= 2.0,
                None => return false,
            }
        }
        false
    }

    /// Whether `answer` is on the curve from `at` along `ahead`, within a small distance.
    fn passes(&self, target: &[f64], at: &[f64], ahead: &DVector<f64>, answer: &[f64]) -> bool {
        let apart = |&joint: &usize| self.difference(joint, answer[joint], at[joint]) / self.unit(joint);
        let distance = ahead.dot(&DVector::from_iterator(ahead.len(), self.unknown().iter().map(apart)));
        self.moved_along(target, at, ahead, distance, WITNESS.member)
            .is_some_and(|passed| self.distance(&passed, answer) <= WITNESS.near)
    }

    /// The point of the curve next to `at` moved by `distance` along the unit vector `ahead`, and the curve's direction there. Its error is at most
    /// `tolerance`.
    fn stepped(
        &self,
        target: &[f64],
        at: &[f64],
        ahead: &DVector<f64>,
        (distance, tolerance): (f64, f64),
    ) -> Option<(Vec<f64>, DVector<f64>)> {
        let next = self.moved_along(target, at, ahead, distance, tolerance)?;
        let tangent = null_vector(self.jacobian(&next))?;
        let side = tangent.dot(ahead).signum();
        Some((next, tangent * side))
    }

    /// The member next to `q`, by Gauss-Newton in the joints `moving` only. The rows of `across` (one column for each moving joint) are directions in which it
    /// must not move.
    fn corrected(
        &self,
        target: &[f64],
        mut q: Vec<f64>,
        moving: &[usize],
        across: &dyn Fn(&[f64]) -> DMatrix<f64>,
        tolerance: f64,
    ) -> Option<Vec<f64>> {
        self.settle(&mut q);
        let fixed = across(&q);
        for _ in 0..CORRECTIONS {
            if self.residual(target, &q) <= tolerance {
                break;
            }
            let slopes = self.slopes(target, &q, moving);
            let rows = slopes.nrows();
            let mut system = slopes.insert_rows(rows, fixed.nrows(), 0.0);
            system.rows_mut(rows, fixed.nrows()).copy_from(&fixed);
            let mut missed = DVector::from_vec(self.misses(target, &q));
            missed = missed.insert_rows(rows, fixed.nrows(), 0.0);
            let step = least_squares(system, &missed, WITNESS.rank)?;
            for (&joint, step) in moving.iter().zip(step.iter()) {
                q[joint] -= step * self.unit(joint);
            }
            self.settle(&mut q);
        }
        (self.residual(target, &q) <= tolerance).then_some(q)
    }

    /// Central differences of the errors by the joints `moving`, in their units.
    fn slopes(&self, target: &[f64], q: &[f64], moving: &[usize]) -> DMatrix<f64> {
        let width = f64::EPSILON.cbrt();
        let column = |&joint: &usize| {
            let moved = |by: f64| {
                let mut q = q.to_vec();
                q[joint] += by * self.unit(joint);
                self.settle(&mut q);
                DVector::from_vec(self.misses(target, &q))
            };
            (moved(width) - moved(-width)) / (2.0 * width)
        };
        let columns: Vec<DVector<f64>> = moving.iter().map(column).collect();
        if columns.is_empty() {
            return DMatrix::zeros(self.misses(target, q).len(), 0);
        }
        DMatrix::from_columns(&columns)
    }
}

impl<M: Configuration + ?Sized> SelfMotions for M {}
