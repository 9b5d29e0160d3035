//! Identification with physically consistent bodies. Main type: [`Nearest`].
//!
//! Ten inertial parameters are physically consistent exactly when the 4 x 4 pseudo-inertia has no negative eigenvalue
//! (P. M. Wensing, S. Kim and J.-J. E. Slotine, IEEE Robotics and Automation Letters 3, 2018). The least squares over
//! consistent bodies are a convex problem, solved by an interior-point method. Its Newton steps minimise the squares
//! plus `mu` times the entropic divergence from given bodies (T. Lee, P. M. Wensing and F. C. Park, IEEE Trans.
//! Robotics 36, 2020), with `mu` decreasing to zero. Among bodies that explain the torques equally well, this selects
//! those near the given ones.

use nalgebra::{DMatrix, DVector, Matrix4};

/// Tolerance of the final sum of squares above its minimum: absolute, in units of the noise, and relative.
const GAP: [f64; 2] = [1e-2, 1e-4];
/// Factor by which `mu` decreases per stage, maximum number of stages, and maximum number of Newton steps per stage.
const FALL: f64 = 0.1;
const STAGES: usize = 60;
const STEPS: usize = 200;
/// Newton decrement below which full steps are taken, and the one at which a stage ends.
const FULL: f64 = 0.25;
const NEAR: f64 = 0.1;
/// Minimum mass and extent of a given body, relative to the mean of all bodies. They keep the body in the interior of
/// the feasible set.
const LEAST: f64 = 1e-3;

/// Consistent bodies that explain the torques best.
pub(super) struct Nearest {
    /// Ten inertial parameters for each body.
    pub(super) parameters: Vec<f64>,
    /// Their sum of squared residuals.
    pub(super) squares: f64,
    /// Lower bound of the sum of squares over all consistent bodies, estimated from its decrease along the central
    /// path.
    pub(super) least: f64,
    pub(super) is_converged: bool,
}

/// The least-squares problem `|matrix pi - right|^2` over the ten inertial parameters of each body.
pub(super) struct Problem {
    pub(super) matrix: DMatrix<f64>,
    pub(super) right: DVector<f64>,
}

/// A point of the central path.
struct Point<'a> {
    problem: &'a Problem,
    /// The inverses of the given bodies.
    given: Vec<Matrix4<f64>>,
    bodies: Vec<Matrix4<f64>>,
}

impl Problem {
    /// Minimises the sum over consistent bodies, with a preference for those near the given ones.
    pub(super) fn solve(&self, given: &[f64]) -> Nearest {
        let bodies = inside(given);
        let inverses: Option<Vec<Matrix4<f64>>> = bodies.iter().map(|body| body.try_inverse()).collect();
        let Some(given) = inverses else {
            return Nearest { parameters: given.to_vec(), squares: f64::INFINITY, least: 0.0, is_converged: false };
        };
        let mut point = Point { problem: self, given, bodies };
        let mut mu = point.squares().max(GAP[0]) / (4 * point.bodies.len()) as f64;
        let (mut least, mut is_converged, mut before) = (0.0, false, f64::INFINITY);
        for _ in 0..STAGES {
            let is_centre = point.centre(mu);
            let squares = point.squares();
            if is_centre {
                // The remaining decrease is less than twice the decrease of this stage.
                least = (squares - (mu * point.width()).max(2.0 * (before - squares))).max(0.0);
            }
            is_converged = squares - least <= GAP[0] + GAP[1] * squares;
            if is_converged || !is_centre {
                break;
            }
            (mu, before) = (FALL * mu, squares);
        }
        Nearest { parameters: point.parameters().as_slice().to_vec(), squares: point.squares(), least, is_converged }
    }
}

impl Point<'_> {
    fn parameters(&self) -> DVector<f64> {
        DVector::from_iterator(10 * self.bodies.len(), self.bodies.iter().flat_map(numbers))
    }

    fn residual(&self) -> DVector<f64> {
        &self.problem.matrix * self.parameters() - &self.problem.right
    }

    fn squares(&self) -> f64 {
        self.residual().norm_squared()
    }

    /// Bound of the sum of squares above its minimum for `mu` = 1 near the end of the central path: four for each body,
    /// plus the pull of the given bodies.
    fn width(&self) -> f64 {
        let pull: f64 = self.bodies.iter().zip(&self.given).map(|(body, given)| (given * body).trace()).sum();
        4.0 * self.bodies.len() as f64 + 2.0 * pull
    }

    /// Minimises the sum of squares plus `mu` times the divergence. Returns whether it converged.
    fn centre(&mut self, mu: f64) -> bool {
        for _ in 0..STEPS {
            match self.step(mu) {
                Some(decrement) if decrement < NEAR => return true,
                Some(_) => {}
                None => return false,
            }
        }
        false
    }

    /// One Newton step. Returns its decrement. In the frame of each body's own factor, `P = L (1 + S) L'`, the
    /// divergence has the identity as Hessian.
    fn step(&mut self, mu: f64) -> Option<f64> {
        let factors: Vec<Matrix4<f64>> =
            self.bodies.iter().map(|body| body.cholesky().map(|factor| factor.l())).collect::<Option<_>>()?;
        let mut slopes = DMatrix::zeros(self.problem.right.len(), 10 * factors.len());
        let mut pull = DVector::zeros(10 * factors.len());
        for (at, (factor, given)) in factors.iter().zip(&self.given).enumerate() {
            let own = self.problem.matrix.columns(10 * at, 10) * frame(factor);
            slopes.columns_mut(10 * at, 10).copy_from(&own);
            let slope = factor.transpose() * given * factor - Matrix4::identity();
            pull.rows_mut(10 * at, 10).copy_from(&coordinates(&slope));
        }
        // Solves the least squares |slopes x + residual|^2 + mu/2 |x + pull|^2 with the smaller normal matrix.
        let mut square = &slopes * slopes.transpose();
        (0..square.nrows()).for_each(|at| square[(at, at)] += 0.5 * mu);
        let missing = &slopes * &pull - self.residual();
        let step = slopes.transpose() * square.cholesky()?.solve(&missing) - pull;
        let decrement = (2.0 * (&slopes * &step).norm_squared() / mu + step.norm_squared()).sqrt();
        let length = if decrement < FULL { 1.0 } else { 1.0 / (1.0 + decrement) };
        for (at, factor) in factors.iter().enumerate() {
            let change = symmetric(&step.as_slice()[10 * at..10 * at + 10]);
            self.bodies[at] += factor * change * factor.transpose() * length;
        }
        decrement.is_finite().then_some(decrement)
    }
}

/// The pseudo-inertia of ten inertial parameters: the mass, the first moments, the inertia tensor xx, xy, yy, xz, yz,
/// zz.
fn pseudo_inertia(numbers: &[f64]) -> Matrix4<f64> {
    let [m, x, y, z, xx, xy, yy, xz, yz, zz] = std::array::from_fn(|i| numbers[i]);
    let half = 0.5 * (xx + yy + zz);
    #[rustfmt::skip]
    let pseudo = Matrix4::new(
        half - xx, -xy, -xz, x,
        -xy, half - yy, -yz, y,
        -xz, -yz, half - zz, z,
        x, y, z, m,
    );
    pseudo
}

/// Whether a linear form in the inertial parameters, ten coefficients for each body, is nonnegative for all consistent
/// bodies. This holds if the matrices `Y` of the form `trace(Y P)` have no negative eigenvalue.
pub(super) fn is_never_negative(coefficients: &[f64]) -> bool {
    coefficients.chunks_exact(10).all(|body| {
        let [m, x, y, z, xx, xy, yy, xz, yz, zz] = std::array::from_fn(|i| body[i]);
        #[rustfmt::skip]
        let dual = 0.5 * Matrix4::new(
            2.0 * (yy + zz), -xy, -xz, x,
            -xy, 2.0 * (xx + zz), -yz, y,
            -xz, -yz, 2.0 * (xx + yy), z,
            x, y, z, 2.0 * m,
        );
        let least =
            nalgebra::SymmetricEigen::try_new(dual, f64::EPSILON, 1000).map(|factors| factors.eigenvalues.min());
        least.is_some_and(|least| least >= -1e-12 * dual.amax())
    })
}

/// The ten inertial parameters of a pseudo-inertia.
fn numbers(p: &Matrix4<f64>) -> [f64; 10] {
    let trace = p[(0, 0)] + p[(1, 1)] + p[(2, 2)];
    let [m, x, y, z] = [3, 0, 1, 2].map(|i| p[(i, 3)]);
    let [xx, yy, zz] = [0, 1, 2].map(|i| trace - p[(i, i)]);
    [m, x, y, z, xx, -p[(0, 1)], yy, -p[(0, 2)], -p[(1, 2)], zz]
}

/// Coordinates of a symmetric matrix such that their sum of squares is that of the matrix' entries.
const ENTRIES: [(usize, usize); 10] = [(0, 0), (1, 1), (2, 2), (3, 3), (0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];

fn weight((i, j): (usize, usize)) -> f64 {
    if i == j { 1.0 } else { std::f64::consts::SQRT_2 }
}

fn coordinates(matrix: &Matrix4<f64>) -> DVector<f64> {
    DVector::from_iterator(10, ENTRIES.iter().map(|entry| weight(*entry) * matrix[*entry]))
}

fn symmetric(coordinates: &[f64]) -> Matrix4<f64> {
    let mut matrix = Matrix4::zeros();
    for (&(i, j), value) in ENTRIES.iter().zip(coordinates) {
        let entry = value / weight((i, j));
        (matrix[(i, j)], matrix[(j, i)]) = (entry, entry);
    }
    matrix
}

/// The ten inertial parameters of `L S L'` for each coordinate of `S`.
fn frame(factor: &Matrix4<f64>) -> DMatrix<f64> {
    let mut columns = DMatrix::zeros(10, 10);
    for (at, &(i, j)) in ENTRIES.iter().enumerate() {
        let [a, b] = [i, j].map(|column| factor.column(column).into_owned());
        let both = (a * b.transpose() + b * a.transpose()) / (2.0 * if i == j { 1.0 } else { 1.0 / weight((i, j)) });
        columns.column_mut(at).copy_from_slice(&numbers(&both));
    }
    columns
}

/// Bodies near the given ones whose pseudo-inertias are positive definite.
fn inside(given: &[f64]) -> Vec<Matrix4<f64>> {
    let all: Vec<Matrix4<f64>> = given.chunks_exact(10).map(pseudo_inertia).collect();
    let extent = |p: &Matrix4<f64>| (p[(0, 0)] + p[(1, 1)] + p[(2, 2)]).max(0.0);
    let mass: f64 = all.iter().map(|p| p[(3, 3)].max(0.0)).sum();
    // Without any mass: a kilogram and a decimetre.
    let (mean, square) = if mass > 0.0 {
        let spread: f64 = all.iter().map(extent).sum();
        (mass / all.len() as f64, if spread > 0.0 { spread / mass } else { 0.01 })
    } else {
        (1.0, 0.01)
    };
    let sizes = nalgebra::Vector4::new(square.sqrt(), square.sqrt(), square.sqrt(), 1.0) * mean.sqrt();
    let scale = Matrix4::from_diagonal(&sizes);
    let inverse = Matrix4::from_diagonal(&sizes.map(|size| 1.0 / size));
    let lifted = |p: &Matrix4<f64>| {
        let unit = inverse * p * inverse;
        let Some(mut factors) = nalgebra::SymmetricEigen::try_new(unit, f64::EPSILON, 1000) else {
            return scale * scale;
        };
        factors.eigenvalues.iter_mut().for_each(|value| *value = value.max(LEAST));
        scale * factors.recompose() * scale
    };
    all.iter().map(lifted).collect()
}
