//! A serial manipulator with masses and its inertia matrix, RH0 (2-39), (2-44), (2-45).

use nalgebra::{DMatrix, Matrix6};

use super::LinkInertia;
use crate::kinematics::jacobian::{self, Jacobian};
use crate::spatial::{Pose, Screw, pose};
use crate::{Error, ErrorKind, Result};

/// A rigid body that one joint carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// The frame of the link at the zero configuration.
    pub base_from_link: Pose,
    /// What it weighs, in that frame.
    pub inertia: LinkInertia,
}

/// A serial chain with a body behind each joint. Metres, kilograms, radians; links are counted from 0 at the base.
#[derive(Clone, Debug, PartialEq)]
pub struct Manipulator {
    screws: Vec<Screw>,
    bodies: Vec<Body>,
}

impl Manipulator {
    /// The chain of `screws` from base to tip, in the base frame at the zero configuration \[m\]; `bodies[i]` moves
    /// with the joints `0..=i`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when there are not as many bodies as screws, none, or a frame that is not finite.
    pub fn new(screws: Vec<Screw>, bodies: Vec<Body>) -> Result<Self> {
        if screws.is_empty() || screws.len() != bodies.len() {
            let text = format!("{} joints and {} bodies: give one body for each joint", screws.len(), bodies.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        if let Some(link) = bodies.iter().position(|body| !is_finite(&body.base_from_link)) {
            return Err(Error::new(ErrorKind::BadValue, format!("link {link}: its frame is not finite")));
        }
        Ok(Manipulator { screws, bodies })
    }

    /// The screws of the joints, from base to tip.
    pub fn screws(&self) -> &[Screw] {
        &self.screws
    }

    /// The bodies, from base to tip.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// The body Jacobian of the frame of `link` at `q`, RH0 (2-24): 6xn, zero in the columns of the joints behind it.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when there is no such link, or `q` has not one finite value per joint.
    pub fn link_jacobian(&self, link: usize, q: &[f64]) -> Result<Jacobian> {
        let body = self.body(link)?;
        jacobian::check(&self.screws, q)?;
        let moving = jacobian::body(&self.screws[..=link], &body.base_from_link, &q[..=link])?;
        Ok(moving.resize_horizontally(q.len(), 0.0))
    }

    /// What `link` adds to the inertia matrix at `q`, n x n: `J' mu J` with its body Jacobian, RH0 (2-39).
    ///
    /// # Errors
    /// As [`Manipulator::link_jacobian`].
    pub fn link_inertia(&self, link: usize, q: &[f64]) -> Result<DMatrix<f64>> {
        let jacobian = self.link_jacobian(link, q)?;
        let weighted = self.body(link)?.inertia.generalised() * &jacobian;
        Ok(jacobian.transpose() * weighted)
    }

    /// The inertia matrix `M(q)`, n x n, symmetric: half of `q'. M q'` is the kinetic energy, RH0 (2-38), (2-39).
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `q` has not one finite value per joint.
    pub fn inertia(&self, q: &[f64]) -> Result<DMatrix<f64>> {
        let n = self.bodies.len();
        (0..n).try_fold(DMatrix::zeros(n, n), |sum, link| Ok(sum + self.link_inertia(link, q)?))
    }

    /// The transformed inertia of `link`, 6x6, RH0 (2-45): its generalised inertia in the base frame, at the zero
    /// configuration.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when there is no such link.
    pub fn transformed_inertia(&self, link: usize) -> Result<Matrix6<f64>> {
        let body = self.body(link)?;
        let link_from_base = pose::adjoint_inverse(&body.base_from_link);
        Ok(link_from_base.transpose() * body.inertia.generalised() * link_from_base)
    }

    /// The manipulator adjoint `A_ij` at `q`, 6x6, RH0 (2-44): the inverse adjoint of the motion of the joints behind
    /// `j` up to `i`; the identity when `i = j`, zero when `i < j`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when there is no such joint, or `q` has not one finite value per joint.
    pub fn adjoint(&self, i: usize, j: usize, q: &[f64]) -> Result<Matrix6<f64>> {
        jacobian::check(&self.screws, q)?;
        self.body(i.max(j))?;
        if i < j {
            return Ok(Matrix6::zeros());
        }
        let moved = (j + 1..=i).fold(Pose::identity(), |pose, k| pose * self.screws[k].exp(q[k]));
        Ok(pose::adjoint_inverse(&moved))
    }

    fn body(&self, link: usize) -> Result<&Body> {
        let count = self.bodies.len();
        let text = || format!("there is no link {link}; the links are counted from 0 to {}", count - 1);
        self.bodies.get(link).ok_or_else(|| Error::new(ErrorKind::BadValue, text()))
    }
}

fn is_finite(pose: &Pose) -> bool {
    pose.translation.vector.iter().chain(pose.rotation.coords.iter()).all(|x| x.is_finite())
}
