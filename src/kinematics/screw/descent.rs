//! Newton's method on half the squared miss of an equation, damped so that the miss never grows: it polishes answers that
//! are nearly right and finds the nearest values where there are none.
//!
//! Source: Nocedal and Wright, Numerical Optimization, 2nd edition (2006), sections 3.4 (damping by multiples of the identity).

use nalgebra::{SMatrix, SVector};

/// How far an equation in `N` unknowns is from being solved at some point.
pub(super) struct Miss<const N: usize> {
    /// The length of the difference of both sides.
    pub size: f64,
    /// The gradient of half its square.
    pub gradient: SVector<f64, N>,
    /// The second derivatives of half its square.
    pub hessian: SMatrix<f64, N, N>,
}

impl<const N: usize> Miss<N> {
    /// Newton's step with `damping` added to the diagonal; `None` when the matrix is not positive definite.
    fn step(&self, damping: f64) -> Option<SVector<f64, N>> {
        let matrix = self.hessian + SMatrix::identity() * damping;
        matrix.cholesky().map(|factors| factors.solve(&-self.gradient))
    }

    /// Whether this is a smaller miss, or the same to rounding and nearer to a minimum.
    fn improves(&self, other: &Miss<N>) -> bool {
        let equal = self.size <= other.size * (1.0 + 2.0 * f64::EPSILON);
        self.size < other.size || (equal && self.gradient.norm() < 0.5 * other.gradient.norm())
    }
}

/// A miss that rounding alone makes, for sides of length one.
const NEGLIGIBLE: f64 = f64::EPSILON;

/// How often a step is tried again with more damping.
const TRIALS: usize = 10;

/// The point that at most `steps` steps down from `start` lead to, and the size of the miss there.
pub(super) fn descend<const N: usize>(
    start: SVector<f64, N>,
    steps: usize,
    miss: impl Fn(&SVector<f64, N>) -> Miss<N>,
) -> (SVector<f64, N>, f64) {
    let (mut point, mut here, mut damping) = (start, miss(&start), 0.0);
    for _ in 0..steps {
        if here.size <= NEGLIGIBLE {
            break;
        }
        let Some((next, there)) = step_down(&point, &here, &mut damping, &miss) else { break };
        (point, here) = (next, there);
    }
    (point, here.size)
}

/// The first improvement that some damping brings; `damping` adapts.
fn step_down<const N: usize>(
    point: &SVector<f64, N>,
    here: &Miss<N>,
    damping: &mut f64,
    miss: impl Fn(&SVector<f64, N>) -> Miss<N>,
) -> Option<(SVector<f64, N>, Miss<N>)> {
    let scale = here.hessian.norm();
    for _ in 0..TRIALS {
        if let Some(step) = here.step(*damping) {
            let next = point + step;
            let there = miss(&next);
            if there.improves(here) {
                *damping = if *damping > 1e-12 * scale { *damping / 30.0 } else { 0.0 };
                return Some((next, there));
            }
            if step.norm() <= f64::EPSILON || here.size <= 1e-15 {
                return None;
            }
        }
        *damping = (*damping * 30.0).max(1e-10 * scale);
    }
    None
}
