//! Newton's method with damping for the error, within bounds (D. P. Bertsekas, "Projected Newton methods for optimization problems with simple
//! constraints", SIAM Journal on Control and Optimization 20, 1982). Main type: [`Descent`].

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::measure::Measure;
use crate::tolerances::CLOSEST;

/// The greatest number of steps from a starting point.
const STEPS: usize = 80;
/// The greatest damping, relative to the largest second derivative.
const MOST_DAMPING: f64 = 1e8;
/// Rounding error of an error, relative to it.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The search from one point.
pub(super) struct Descent<'a> {
    pub measure: &'a Measure<'a>,
    /// By unknown joint, its bounds.
    bounds: Option<Vec<[f64; 2]>>,
    /// The search with a smaller weight of rotation, whose end is the start of this one.
    easier: Option<Box<Descent<'a>>>,
}

/// The end of a search.
#[derive(Clone, Debug)]
pub(super) struct End {
    pub q: Vec<f64>,
    /// [`Measure::error`].
    pub error: f64,
    pub is_minimum: bool,
}

/// A point of the search.
struct Point {
    values: DVector<f64>,
    error: f64,
    gradient: DVector<f64>,
    /// The indices of unknown joints that no bound holds.
    free: Vec<usize>,
}

impl Point {
    /// The largest derivative by a free joint.
    fn slope(&self) -> f64 {
        self.free.iter().fold(0.0, |most, &k| f64::max(most, self.gradient[k].abs()))
    }
}

impl<'a> Descent<'a> {
    /// The search with these weights of rotation one after the other, within the limits of all joints; `None` without a weight.
    pub fn new(measures: &'a [Measure<'a>], limits: Option<&[[f64; 2]]>) -> Option<Self> {
        let (measure, easier) = measures.split_last()?;
        let bounds = limits.map(|limits| measure.unknown.iter().map(|&joint| limits[joint]).collect());
        Some(Descent { measure, bounds, easier: Descent::new(easier, limits).map(Box::new) })
    }

    /// The range of starting values of an unknown joint: its bounds if they are finite, a turn of an angle, the limits of a displacement or the reach.
    pub fn range(&self, unknown: usize) -> [f64; 2] {
        let joint = self.measure.unknown[unknown];
        let outline = &self.measure.outline().joints[joint];
        let half = if outline.is_angle { std::f64::consts::PI } else { self.measure.outline().scale };
        let bounds = self.bounds.as_ref().map(|bounds| bounds[unknown]);
        let own = bounds.or((!outline.is_angle).then_some(outline.limits)).unwrap_or([-half, half]);
        match own {
            [low, high] if low.is_finite() && high.is_finite() => [low, high],
            [low, _] if low.is_finite() => [low, low + 2.0 * half],
            [_, high] if high.is_finite() => [high - 2.0 * half, high],
            _ => [-half, half],
        }
    }

    /// Minimises the error from these values of the unknown joints.
    pub fn run(&self, start: &[f64]) -> Option<End> {
        let mut values = DVector::from_row_slice(start);
        if let Some(easier) = &self.easier {
            let end = easier.run(start)?;
            values.iter_mut().zip(&self.measure.unknown).for_each(|(value, &joint)| *value = end.q[joint]);
        }
        let mut point = self.point(self.clamped(values))?;
        let mut damping = 1e-3;
        for _ in 0..STEPS {
            let hessian = self.hessian(&point)?;
            match self.step(&point, &hessian, &mut damping) {
                Some(next) => point = next,
                None => break,
            }
        }
        let hessian = self.hessian(&point)?;
        let is_minimum = is_flat(&point, &hessian);
        Some(End { q: self.measure.whole(point.values.as_slice()), error: point.error, is_minimum })
    }

    /// A better point by one damped step; `None` where rounding is reached.
    fn step(&self, point: &Point, hessian: &DMatrix<f64>, damping: &mut f64) -> Option<Point> {
        if point.slope() == 0.0 {
            return None;
        }
        let gradient = DVector::from_iterator(point.free.len(), point.free.iter().map(|&k| point.gradient[k]));
        let most = hessian.diagonal().amax().max(f64::MIN_POSITIVE);
        while *damping <= MOST_DAMPING {
            let step = factored(hessian, *damping * most).map(|factor| factor.solve(&gradient));
            let next = step.and_then(|step| {
                let mut values = point.values.clone();
                point.free.iter().zip(step.iter()).for_each(|(&k, step)| values[k] -= step * self.unit(k));
                self.point(self.clamped(values))
            });
            // Where the error does not change within rounding the gradient shows progress.
            let is_better = |next: &Point| {
                next.error < point.error * (1.0 - ROUNDING)
                    || (next.error <= point.error * (1.0 + ROUNDING) && next.slope() < 0.5 * point.slope())
            };
            if let Some(better) = next.filter(is_better) {
                *damping = (*damping / 10.0).max(f64::EPSILON);
                return Some(better);
            }
            *damping = (*damping * 10.0).max(f64::EPSILON);
        }
        None
    }

    fn unit(&self, unknown: usize) -> f64 {
        self.measure.unit(self.measure.unknown[unknown])
    }

    fn point(&self, values: DVector<f64>) -> Option<Point> {
        let error = self.measure.error(&self.measure.whole(values.as_slice()))?;
        let gradient = DVector::from_vec(self.measure.gradient(values.as_slice())?);
        let is_held = |k: usize| {
            let [low, high] = self.bounds.as_ref().map_or([f64::NEG_INFINITY, f64::INFINITY], |bounds| bounds[k]);
            (values[k] <= low && gradient[k] >= 0.0) || (values[k] >= high && gradient[k] <= 0.0)
        };
        let free = (0..values.len()).filter(|&k| !is_held(k)).collect();
        Some(Point { values, error, gradient, free })
    }

    fn clamped(&self, mut values: DVector<f64>) -> DVector<f64> {
        if let Some(bounds) = &self.bounds {
            values.iter_mut().zip(bounds).for_each(|(value, [low, high])| *value = value.max(*low).min(*high));
        }
        values
    }

    /// Half the Hessian of the error by the free joints, by central differences of the gradient.
    fn hessian(&self, point: &Point) -> Option<DMatrix<f64>> {
        // The cube root of the machine precision balances truncation and rounding.
        let width = f64::EPSILON.cbrt();
        let count = point.free.len();
        let mut hessian = DMatrix::zeros(count, count);
        for (column, &k) in point.free.iter().enumerate() {
            let moved = |by: f64| {
                let mut values = point.values.clone();
                values[k] += by * self.unit(k);
                self.measure.gradient(values.as_slice())
            };
            let (more, less) = (moved(width)?, moved(-width)?);
            for (row, &i) in point.free.iter().enumerate() {
                hessian[(row, column)] = (more[i] - less[i]) / (2.0 * width);
            }
        }
        Some((&hessian + hessian.transpose()) * 0.5)
    }
}

/// Whether a point is a local minimum: the Hessian has no negative eigenvalue, and Newton's method predicts no decrease.
fn is_flat(point: &Point, hessian: &DMatrix<f64>) -> bool {
    if point.free.is_empty() {
        return true;
    }
    let gradient = DVector::from_iterator(point.free.len(), point.free.iter().map(|&k| point.gradient[k]));
    let most = hessian.diagonal().amax().max(f64::MIN_POSITIVE);
    let Some(factor) = factored(hessian, CLOSEST.curved * most) else { return false };
    gradient.dot(&factor.solve(&gradient)) <= CLOSEST.flat * point.error
}

/// The Cholesky factor of the matrix with `damping` added to its diagonal; `None` unless it is positive definite.
fn factored(matrix: &DMatrix<f64>, damping: f64) -> Option<Cholesky<f64, Dyn>> {
    let count = matrix.nrows();
    Cholesky::new(matrix + DMatrix::identity(count, count) * damping)
}
