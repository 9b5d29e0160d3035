//! The Coriolis matrix by Christoffel symbols, RH0 (2-42), (2-43).

use nalgebra::DMatrix;

use super::Manipulator;
use crate::Result;
use crate::kinematics::jacobian;
use crate::spatial::{Pose, Twist};

impl Manipulator {
    /// The Coriolis matrix `C(q, q')`, n x n, RH0 (2-42): `M' - 2 C` is skew, and `C q'` holds the centrifugal and the
    /// Coriolis torques of the Lagrange equations (2-37).
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`](crate::ErrorKind::BadValue) when `q` or `velocity` has not one finite value per joint.
    pub fn coriolis(&self, q: &[f64], velocity: &[f64]) -> Result<DMatrix<f64>> {
        jacobian::check(self.screws(), velocity).map_err(|error| error.with_context("velocity"))?;
        let slopes = self.inertia_derivatives(q)?;
        let symbol = |i: usize, j: usize, k: usize| slopes[k][(i, j)] + slopes[j][(i, k)] - slopes[i][(k, j)];
        let n = q.len();
        Ok(DMatrix::from_fn(n, n, |i, j| (0..n).map(|k| symbol(i, j, k) * velocity[k]).sum::<f64>() / 2.0))
    }

    /// The partial derivatives of the inertia matrix at `q`, RH0 (2-43): for each joint k the n x n matrix `dM / dq_k`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`](crate::ErrorKind::BadValue) when `q` has not one finite value per joint.
    pub fn inertia_derivatives(&self, q: &[f64]) -> Result<Vec<DMatrix<f64>>> {
        jacobian::check(self.screws(), q)?;
        let n = q.len();
        let mut slopes = vec![DMatrix::zeros(n, n); n];
        for link in 0..n {
            self.add_slopes_of(link, q, &mut slopes)?;
        }
        Ok(slopes)
    }

    /// Adds the terms of `link` in the sum of RH0 (2-43). Its `A_lk [A_ki x_i, x_k]`, zero unless i < k, is taken as
    /// `[A_li x_i, A_lk x_k]`: an adjoint keeps brackets. `A_li x_i` is column i of a body Jacobian.
    fn add_slopes_of(&self, link: usize, q: &[f64], slopes: &mut [DMatrix<f64>]) -> Result<()> {
        let carried = jacobian::body(&self.screws()[..=link], &Pose::identity(), &q[..=link])?;
        let mass = self.transformed_inertia(link)?;
        let twists: Vec<Twist> = carried.column_iter().map(|x| Twist::from_vector(&x.into_owned())).collect();
        for k in 0..=link {
            for i in 0..k {
                let half = mass * twists[i].bracket(&twists[k]).to_vector();
                for j in 0..=link {
                    let term = half.dot(&carried.column(j));
                    slopes[k][(i, j)] += term;
                    slopes[k][(j, i)] += term;
                }
            }
        }
        Ok(())
    }
}
