//! A numeric inverse-kinematics oracle: damped least squares (Levenberg 1944, Marquardt 1963) from many starting
//! points.
//!
//! It uses only a residual function, so it can verify any solver. It does not prove completeness: a solution without a
//! starting point that converges to it is not found.

use std::f64::consts::TAU;

use nalgebra::{Cholesky, DMatrix, DVector};

use crate::spatial::angle;
use crate::{Error, ErrorKind, Result};

/// Settings of the search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oracle {
    /// Number of starting points. They are evenly spread and always the same.
    pub seeds: usize,
    /// Maximum number of steps from each starting point.
    pub iterations: usize,
    /// Maximum Euclidean norm of the residual of a solution, in the residual's own unit.
    pub tolerance: f64,
    /// Solutions are equal when each angle differs by at most this value \[rad\], modulo whole turns, and each
    /// displacement by at most this fraction of its starting range.
    pub distinct: f64,
}

/// Type of an unknown, one for each joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unknown {
    /// An angle \[rad\]. The residual has the period 2 pi in it.
    Angle,
    /// A displacement. The search starts between these two values and may leave them.
    Displacement {
        /// The lower end of the starting range.
        low: f64,
        /// The upper end of the starting range.
        high: f64,
    },
}

/// A solution of the oracle.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Solution {
    /// The joint values; each angle in (-pi, pi] \[rad\].
    pub q: Vec<f64>,
    /// Euclidean norm of the residual at `q`.
    pub residual: f64,
}

impl Default for Oracle {
    /// 100 starting points, 200 steps, residual 1e-11, angles 1e-6 rad.
    fn default() -> Self {
        Oracle { seeds: 100, iterations: 200, tolerance: 1e-11, distinct: 1e-6 }
    }
}

/// A point of the search with its residual.
struct State {
    q: DVector<f64>,
    residual: DVector<f64>,
    norm: f64,
}

impl Oracle {
    /// Searches the distinct zeros of `residual`, a smooth function of `joints` angles \[rad\] with period 2 pi in
    /// each.
    ///
    /// `residual` always returns a vector of the same length. Entries that are not finite end the search from that
    /// starting point. A continuum of zeros gives about as many solutions as starting points.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `joints` is zero.
    pub fn solve(&self, joints: usize, residual: impl Fn(&[f64]) -> Vec<f64>) -> Result<Vec<Solution>> {
        self.search(&vec![Unknown::Angle; joints], residual)
    }

    /// Same as [`Oracle::solve`], but for angles and displacements.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when there is no unknown, or a range is empty or not finite.
    pub fn search(&self, unknowns: &[Unknown], residual: impl Fn(&[f64]) -> Vec<f64>) -> Result<Vec<Solution>> {
        if unknowns.is_empty() {
            return Err(Error::new(ErrorKind::BadValue, "an oracle needs at least one joint"));
        }
        for unknown in unknowns {
            unknown.check()?;
        }
        let mut found = Vec::new();
        for start in seeds(unknowns, self.seeds) {
            if let Some(answer) = self.descend(start, unknowns, &residual) {
                self.keep(&mut found, unknowns, answer);
            }
        }
        Ok(found)
    }

    /// Adds `answer` to `found`, or replaces an equal, less accurate one.
    fn keep(&self, found: &mut Vec<Solution>, unknowns: &[Unknown], answer: Solution) {
        let same = |other: &&mut Solution| {
            let mut pairs = unknowns.iter().zip(answer.q.iter().zip(&other.q));
            pairs.all(|(unknown, (a, b))| unknown.difference(*a, *b) <= self.distinct)
        };
        match found.iter_mut().find(same) {
            Some(other) if answer.residual < other.residual => *other = answer,
            Some(_) => {}
            None => found.push(answer),
        }
    }

    /// The zero to which the descent from `start` converges, if it does.
    fn descend(
        &self,
        start: DVector<f64>,
        unknowns: &[Unknown],
        residual: &impl Fn(&[f64]) -> Vec<f64>,
    ) -> Option<Solution> {
        let mut state = State::new(start, residual)?;
        let mut damping = 1e-3;
        for _ in 0..self.iterations {
            let Some(better) = state.improve(&mut damping, residual) else { break };
            state = better;
        }
        let q = unknowns.iter().zip(&state.q).map(|(unknown, &q)| unknown.normal(q)).collect();
        (state.norm <= self.tolerance).then_some(Solution { q, residual: state.norm })
    }
}

impl Unknown {
    fn check(self) -> Result<()> {
        match self {
            Unknown::Displacement { low, high } if !(low < high && (high - low).is_finite()) => {
                let text = format!("a displacement from {low} to {high}: give finite ends, the lower one first");
                Err(Error::new(ErrorKind::BadValue, text))
            }
            _ => Ok(()),
        }
    }

    /// The difference of two values: \[rad\], or as a fraction of the starting range.
    fn difference(self, a: f64, b: f64) -> f64 {
        match self {
            Unknown::Angle => angle::difference(a, b).abs(),
            Unknown::Displacement { low, high } => ((a - b) / (high - low)).abs(),
        }
    }

    fn normal(self, q: f64) -> f64 {
        match self {
            Unknown::Angle => angle::wrap(q),
            Unknown::Displacement { .. } => q,
        }
    }

    /// The value at the fraction `share` in \[0, 1) of the starting range.
    fn start(self, share: f64) -> f64 {
        match self {
            Unknown::Angle => angle::wrap(TAU * share),
            Unknown::Displacement { low, high } => low + (high - low) * share,
        }
    }
}

impl State {
    /// A state at `q`; `None` when the residual is not finite.
    fn new(q: DVector<f64>, residual: &impl Fn(&[f64]) -> Vec<f64>) -> Option<State> {
        let residual = DVector::from_vec(residual(q.as_slice()));
        let norm = residual.norm();
        norm.is_finite().then_some(State { q, residual, norm })
    }

    /// A state with a smaller residual after one damped step. `damping` is adapted to the success of the step.
    fn improve(&self, damping: &mut f64, residual: &impl Fn(&[f64]) -> Vec<f64>) -> Option<State> {
        const MOST: f64 = 1e8;
        const LEAST: f64 = 1e-15;
        let jacobian = self.jacobian(residual)?;
        let normal = jacobian.tr_mul(&jacobian);
        let gradient = jacobian.tr_mul(&self.residual);
        let scale = normal.diagonal().amax().max(f64::MIN_POSITIVE);
        while *damping <= MOST {
            let damped = &normal + DMatrix::identity(self.q.len(), self.q.len()) * (*damping * scale);
            let step = Cholesky::new(damped).map(|factor| factor.solve(&gradient));
            let next = step.and_then(|step| State::new(&self.q - step, residual));
            if let Some(better) = next.filter(|next| next.norm < self.norm) {
                *damping = (*damping / 10.0).max(LEAST);
                return Some(better);
            }
            *damping *= 10.0;
        }
        None
    }

    /// The Jacobian of the residual by central differences, one column per joint; `None` when the residual changes its
    /// length.
    fn jacobian(&self, residual: &impl Fn(&[f64]) -> Vec<f64>) -> Option<DMatrix<f64>> {
        // The cube root of the machine precision balances truncation and rounding.
        let step = f64::EPSILON.cbrt();
        let mut jacobian = DMatrix::zeros(self.residual.len(), self.q.len());
        for joint in 0..self.q.len() {
            let moved = |by: f64| {
                let mut q = self.q.clone();
                q[joint] += by;
                Some(DVector::from_vec(residual(q.as_slice()))).filter(|r| r.len() == self.residual.len())
            };
            jacobian.set_column(joint, &((moved(step)? - moved(-step)?) / (2.0 * step)));
        }
        Some(jacobian)
    }
}

/// `count` points spread evenly over the starting ranges: the Kronecker sequence whose steps are the powers of 1/x,
/// where x^(n + 1) = x + 1 for n unknowns (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences").
fn seeds(unknowns: &[Unknown], count: usize) -> impl Iterator<Item = DVector<f64>> + '_ {
    let joints = unknowns.len();
    let root = (0..64).fold(1.5_f64, |x, _| (1.0 + x).powf(1.0 / (joints as f64 + 1.0)));
    let share = move |seed: usize, joint: usize| (root.powi(-(joint as i32 + 1)) * (seed as f64 + 0.5)).fract();
    (0..count).map(move |seed| DVector::from_fn(joints, |joint, _| unknowns[joint].start(share(seed, joint))))
}
