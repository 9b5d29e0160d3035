//! Twists, the Lie algebra se(3), and their exponential RH0 (2-7).

use nalgebra::{Quaternion, Translation3, UnitQuaternion, Vector3};

use super::Pose;

/// An element of se(3), linear part first: RH0 (2-5).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist {
    /// Linear part: the velocity of the point at the frame's origin, per unit of motion.
    pub v: Vector3<f64>,
    /// Angular part: the axis of rotation times its rate; zero for a pure translation.
    pub w: Vector3<f64>,
}

impl Twist {
    /// The rigid transform `exp(twist * magnitude)`, RH0 (2-7), for `w` of any length.
    ///
    /// The translation is `u + B a x u + C a x (a x u)` with `a = w * magnitude`, `u = v * magnitude`, so that
    /// it stays accurate when `w` is small; (2-7) as printed holds for `w` of length one only.
    pub fn exp(&self, magnitude: f64) -> Pose {
        let (a, u) = (self.w * magnitude, self.v * magnitude);
        let angle = a.norm();
        let half = angle / 2.0;
        let turned = a.cross(&u);
        let d = u + turned * (sinc(half).powi(2) / 2.0) + a.cross(&turned) * sine_defect(angle);
        let quaternion = Quaternion::from_parts(half.cos(), a * (sinc(half) / 2.0));
        Pose::from_parts(Translation3::from(d), UnitQuaternion::new_normalize(quaternion))
    }
}

/// `sin(x) / x`.
fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-4 { 1.0 - x * x / 6.0 } else { x.sin() / x }
}

/// `(x - sin(x)) / x^3`; what cancels is small against the `u` it is added to.
fn sine_defect(x: f64) -> f64 {
    if x.abs() < 1e-3 { 1.0 / 6.0 - x * x / 120.0 } else { (x - x.sin()) / x.powi(3) }
}
