//! Linear and angular momentum of a system of bodies.

use std::iter::Sum;
use std::ops::Add;

use nalgebra::{Point3, Vector3};

/// The momentum of a system of bodies in the world frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Momentum {
    /// Mass times the velocity of the centre of mass \[kg m/s\].
    pub linear: Vector3<f64>,
    /// The angular momentum about the origin of the world frame \[kg m^2/s\].
    pub angular: Vector3<f64>,
}

impl Momentum {
    /// No momentum.
    pub fn zero() -> Self {
        Momentum { linear: Vector3::zeros(), angular: Vector3::zeros() }
    }

    /// The angular momentum about `point` \[m\]; about the centre of mass it is the centroidal one.
    pub fn about(&self, point: &Point3<f64>) -> Vector3<f64> {
        self.angular - point.coords.cross(&self.linear)
    }
}

impl Add for Momentum {
    type Output = Momentum;

    fn add(self, other: Momentum) -> Momentum {
        Momentum { linear: self.linear + other.linear, angular: self.angular + other.angular }
    }
}

impl Sum for Momentum {
    fn sum<I: Iterator<Item = Momentum>>(parts: I) -> Momentum {
        parts.fold(Momentum::zero(), Add::add)
    }
}
