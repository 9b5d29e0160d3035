//! Twists, the Lie algebra se(3): exponential RH0 (2-7), bracket (2-3), change of frame (2-10).

use std::ops::{Add, Mul, Neg, Sub};

use nalgebra::{Translation3, Vector3, Vector6};

use super::{Axis, Pose, Screw, moment, rotation};
use crate::Result;

/// An element of se(3), linear part first: RH0 (2-5).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist {
    /// Linear part: the velocity of the point at the frame's origin, per unit of motion.
    pub v: Vector3<f64>,
    /// Angular part: the axis of rotation times its rate; zero for a pure translation.
    pub w: Vector3<f64>,
}

impl Twist {
    /// The zero twist.
    pub fn zero() -> Self {
        Twist { v: Vector3::zeros(), w: Vector3::zeros() }
    }

    /// The twist with the coordinates (v, w).
    pub fn from_vector(vector: &Vector6<f64>) -> Self {
        Twist { v: vector.fixed_rows::<3>(0).into_owned(), w: vector.fixed_rows::<3>(3).into_owned() }
    }

    /// The coordinates (v, w), RH0 (2-5).
    pub fn to_vector(&self) -> Vector6<f64> {
        let (v, w) = (self.v, self.w);
        Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z)
    }

    /// The rigid transform `exp(twist * magnitude)`, RH0 (2-7), for `w` of any length.
    ///
    /// The translation is `u + B a x u + C a x (a x u)` with `a = w * magnitude`, `u = v * magnitude`, which is
    /// accurate for small `w` too. Equation (2-7) as printed is valid only for `w` of length one.
    pub fn exp(&self, magnitude: f64) -> Pose {
        let (a, u) = (self.w * magnitude, self.v * magnitude);
        let angle = a.norm();
        let turned = a.cross(&u);
        let d = u + turned * (rotation::sinc(angle / 2.0).powi(2) / 2.0) + a.cross(&turned) * sine_defect(angle);
        Pose::from_parts(Translation3::from(d), rotation::exp(&a))
    }

    /// The Lie bracket, RH0 (2-3): the twist of `x^ y^ - y^ x^`, where `x^` is the matrix
    /// [`wedge`](super::matrix::wedge) of `x`.
    #[must_use]
    pub fn bracket(&self, other: &Twist) -> Twist {
        Twist { v: self.w.cross(&other.v) - other.w.cross(&self.v), w: self.w.cross(&other.w) }
    }

    /// Transforms the twist from frame b to frame a: `Ad_g` RH0 (2-10) applied to it, where `g` is `a_from_b`.
    #[must_use]
    pub fn transform(&self, a_from_b: &Pose) -> Twist {
        let w = a_from_b.rotation * self.w;
        Twist { v: a_from_b.rotation * self.v + a_from_b.translation.vector.cross(&w), w }
    }

    /// The screw axis of the twist, by its point nearest to the origin, RH0 (2-12).
    ///
    /// For a pure translation it is the line through the origin along `v`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`](crate::ErrorKind::BadValue) when the twist is zero or not finite.
    pub fn axis(&self) -> Result<Axis> {
        moment::axis(&self.w, &self.v).map_err(|error| error.with_context("twist"))
    }

    /// Translation per rotation `w.v / w.w`, in metres per radian; infinite when `w` is zero, RH0 (2-11).
    pub fn pitch(&self) -> f64 {
        moment::pitch(&self.w, &self.v)
    }

    /// The length of `w` \[rad\]; when `w` is zero the length of `v` \[m\], RH0 (2-13).
    pub fn magnitude(&self) -> f64 {
        moment::magnitude(&self.w, &self.v)
    }

    /// The twist of magnitude one with the same direction; zero for the zero twist.
    #[must_use]
    pub fn unit(&self) -> Twist {
        let magnitude = self.magnitude();
        if magnitude == 0.0 { *self } else { Twist { v: self.v / magnitude, w: self.w / magnitude } }
    }
}

impl Axis {
    /// The unit twist of this axis, RH0 (2-25).
    pub fn twist(&self) -> Twist {
        let w = self.direction().into_inner();
        Twist { v: -w.cross(&self.point().coords), w }
    }
}

impl Screw {
    /// The unit twist of the joint: RH0 (2-25) when revolute, (2-26) when prismatic.
    pub fn twist(&self) -> Twist {
        match self {
            Screw::Revolute(axis) => axis.twist(),
            Screw::Prismatic(direction) => Twist { v: direction.into_inner(), w: Vector3::zeros() },
        }
    }
}

impl Add for Twist {
    type Output = Twist;

    fn add(self, other: Twist) -> Twist {
        Twist { v: self.v + other.v, w: self.w + other.w }
    }
}

impl Sub for Twist {
    type Output = Twist;

    fn sub(self, other: Twist) -> Twist {
        self + -other
    }
}

impl Neg for Twist {
    type Output = Twist;

    fn neg(self) -> Twist {
        Twist { v: -self.v, w: -self.w }
    }
}

impl Mul<f64> for Twist {
    type Output = Twist;

    fn mul(self, factor: f64) -> Twist {
        Twist { v: self.v * factor, w: self.w * factor }
    }
}

/// `(x - sin(x)) / x^3`. Its cancellation error is small relative to the `u` to which it is added.
fn sine_defect(x: f64) -> f64 {
    if x.abs() < 1e-3 { 1.0 / 6.0 - x * x / 120.0 } else { (x - x.sin()) / x.powi(3) }
}
