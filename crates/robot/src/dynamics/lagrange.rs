//! The matrices of the Lagrange equations `M q'' + C q' + N = torques` on a fixed base, by Lie groups: RH0 2.4, (2-38) to (2-45).

use nalgebra::{DMatrix, Matrix6};

use super::Model;
use crate::Result;
use crate::spatial::{Pose, Twist, pose};

impl Model {
    /// The inertia matrix `M(q)`, n x n, symmetric: half of `q'. M q'` is the kinetic energy on a fixed base, RH0
    /// (2-38), (2-39).
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] unless `q` has one finite value per joint.
    pub fn inertia(&self, q: &[f64]) -> Result<DMatrix<f64>> {
        let n = self.joints().len();
        (0..=n).try_fold(DMatrix::zeros(n, n), |sum, body| Ok(sum + self.body_inertia(body, q)?))
    }

    /// The contribution of a body to the inertia matrix at `q`, n x n: `J' mu J` with its body Jacobian, RH0 (2-39).
    /// Body 0 is the base, `k + 1` is moved by joint `k`.
    ///
    /// # Errors
    /// Those of [`Model::body_jacobian`].
    pub fn body_inertia(&self, body: usize, q: &[f64]) -> Result<DMatrix<f64>> {
        let jacobian = self.body_jacobian(body, &Pose::identity(), q)?;
        let weighted = self.transformed_inertia(body)? * &jacobian;
        Ok(jacobian.transpose() * weighted)
    }

    /// The transformed inertia of a body, 6x6, RH0 (2-45): its generalised inertia in the base frame, at the zero configuration.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] when there is no such body.
    pub fn transformed_inertia(&self, body: usize) -> Result<Matrix6<f64>> {
        self.check_body(body)?;
        Ok(self.bodies[body].generalised())
    }

    /// The manipulator adjoint `A_ij` at `q`, 6x6, RH0 (2-44), for joints i and j: the inverse adjoint of the motion of
    /// the joints after `j` up to `i`. It is the identity when `i = j`, and zero when `j` does not move `i`.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] when there is no such joint, or unless `q` has one finite value per joint.
    pub fn adjoint(&self, i: usize, j: usize, q: &[f64]) -> Result<Matrix6<f64>> {
        self.check(q)?;
        self.check_body(i.max(j) + 1)?;
        let path = self.path(i + 1);
        let Some(start) = path.iter().position(|joint| *joint == j) else { return Ok(Matrix6::zeros()) };
        let later = &path[start + 1..];
        let moved = later.iter().fold(Pose::identity(), |pose, k| pose * self.joints()[*k].screw.exp(q[*k]));
        Ok(pose::adjoint_inverse(&moved))
    }

    /// The Coriolis matrix `C(q, q')`, n x n, RH0 (2-42), with Christoffel symbols: `M' - 2 C` is skew-symmetric, and
    /// `C q'` are the centrifugal and Coriolis torques of the Lagrange equations (2-37).
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] unless `q` and `velocity` have one finite value per joint.
    pub fn coriolis(&self, q: &[f64], velocity: &[f64]) -> Result<DMatrix<f64>> {
        self.check(velocity).map_err(|error| error.with_context("velocity"))?;
        let slopes = self.inertia_derivatives(q)?;
        let symbol = |i: usize, j: usize, k: usize| slopes[k][(i, j)] + slopes[j][(i, k)] - slopes[i][(k, j)];
        let n = q.len();
        Ok(DMatrix::from_fn(n, n, |i, j| (0..n).map(|k| symbol(i, j, k) * velocity[k]).sum::<f64>() / 2.0))
    }

    /// The partial derivatives of the inertia matrix at `q`, RH0 (2-43): for each joint k the n x n matrix `dM / dq_k`.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] unless `q` has one finite value per joint.
    pub fn inertia_derivatives(&self, q: &[f64]) -> Result<Vec<DMatrix<f64>>> {
        self.check(q)?;
        let n = q.len();
        let mut slopes = vec![DMatrix::zeros(n, n); n];
        for body in 1..=n {
            self.add_slopes_of(body, q, &mut slopes)?;
        }
        Ok(slopes)
    }

    /// Adds the terms of a body in the sum of RH0 (2-43). Its `A_lk [A_ki x_i, x_k]`, zero unless i < k, is computed as
    /// `[A_li x_i, A_lk x_k]`, because an adjoint preserves brackets. `A_li x_i` is column i of a body Jacobian.
    fn add_slopes_of(&self, body: usize, q: &[f64], slopes: &mut [DMatrix<f64>]) -> Result<()> {
        let carried = self.body_jacobian(body, &Pose::identity(), q)?;
        let mass = self.transformed_inertia(body)?;
        let twists: Vec<Twist> = carried.column_iter().map(|x| Twist::from_vector(&x.into_owned())).collect();
        let path = self.path(body);
        for (place, &k) in path.iter().enumerate() {
            for &i in &path[..place] {
                let half = mass * twists[i].bracket(&twists[k]).to_vector();
                for &j in &path {
                    let term = half.dot(&carried.column(j));
                    slopes[k][(i, j)] += term;
                    slopes[k][(j, i)] += term;
                }
            }
        }
        Ok(())
    }
}
