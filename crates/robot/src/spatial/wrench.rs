//! Wrenches, the dual of se(3): forces and torques on a rigid body, RH0 2.1.3.

use std::ops::{Add, Neg, Sub};

use nalgebra::{Vector3, Vector6};

use super::{Axis, Pose, Twist, moment};
use crate::Result;

/// A generalised force, linear part first: RH0 (2-16).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench {
    /// The force \[N\].
    pub f: Vector3<f64>,
    /// The torque about the frame's origin \[N m\].
    pub tau: Vector3<f64>,
}

impl Wrench {
    /// The zero wrench.
    pub fn zero() -> Self {
        Wrench { f: Vector3::zeros(), tau: Vector3::zeros() }
    }

    /// The wrench with the coordinates (f, tau).
    pub fn from_vector(vector: &Vector6<f64>) -> Self {
        Wrench { f: vector.fixed_rows::<3>(0).into_owned(), tau: vector.fixed_rows::<3>(3).into_owned() }
    }

    /// The coordinates (f, tau), RH0 (2-16).
    pub fn to_vector(&self) -> Vector6<f64> {
        let (f, tau) = (self.f, self.tau);
        Vector6::new(f.x, f.y, f.z, tau.x, tau.y, tau.z)
    }

    /// The power `f.v + tau.w` \[W\] on a body that moves with `twist` \[m/s, rad/s\], given in the same frame.
    pub fn power(&self, twist: &Twist) -> f64 {
        self.f.dot(&twist.v) + self.tau.dot(&twist.w)
    }

    /// Transforms the wrench from frame b to frame a. It is the dual of [`Twist::transform`], so the power is
    /// unchanged.
    #[must_use]
    pub fn transform(&self, a_from_b: &Pose) -> Wrench {
        let f = a_from_b.rotation * self.f;
        Wrench { f, tau: a_from_b.rotation * self.tau + a_from_b.translation.vector.cross(&f) }
    }

    /// The axis of the wrench, along the force, by its point nearest to the origin, RH0 (2-18).
    ///
    /// For a pure couple it is the line through the origin along `tau`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`](crate::ErrorKind::BadValue) when the wrench is zero or not finite.
    pub fn axis(&self) -> Result<Axis> {
        moment::axis(&self.f, &self.tau).map_err(|error| error.with_context("wrench"))
    }

    /// Torque per force `f.tau / f.f` \[m\]; infinite when `f` is zero, RH0 (2-17).
    pub fn pitch(&self) -> f64 {
        moment::pitch(&self.f, &self.tau)
    }

    /// The length of `f` \[N\]; when `f` is zero the length of `tau` \[N m\], RH0 (2-19).
    pub fn magnitude(&self) -> f64 {
        moment::magnitude(&self.f, &self.tau)
    }
}

impl Add for Wrench {
    type Output = Wrench;

    fn add(self, other: Wrench) -> Wrench {
        Wrench { f: self.f + other.f, tau: self.tau + other.tau }
    }
}

impl Sub for Wrench {
    type Output = Wrench;

    fn sub(self, other: Wrench) -> Wrench {
        self + -other
    }
}

impl Neg for Wrench {
    type Output = Wrench;

    fn neg(self) -> Wrench {
        Wrench { f: -self.f, tau: -self.tau }
    }
}
