//! Numbers modulo a prime with arithmetic operators ([`Residue`]).

use std::ops::{Add, Mul, Neg, Sub};

use groebot_algebra::number::{BigRational, Field, Ring, Zp};
use groebot_robot::kinematics::ExactVector;

/// An element of a prime field, stored with its field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residue {
    /// The element.
    pub value: u64,
    field: Zp,
}

impl Residue {
    /// The element `value`, which must be less than the modulus.
    pub fn new(value: u64, field: Zp) -> Self {
        Residue { value, field }
    }

    /// The image of a rational number. `None` if the prime divides its denominator.
    pub fn image(number: &BigRational, field: Zp) -> Option<Self> {
        field.from_rational(number).map(|value| Residue { value, field })
    }

    /// The image of a vector.
    pub fn vector([x, y, z]: &ExactVector, field: Zp) -> Option<[Self; 3]> {
        Some([Residue::image(x, field)?, Residue::image(y, field)?, Residue::image(z, field)?])
    }

    /// `1 / self`; `None` for zero.
    pub fn inverse(self) -> Option<Self> {
        self.field.inverse(&self.value).map(|value| Residue { value, ..self })
    }
}

impl Add for Residue {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Residue { value: Ring::add(&self.field, &self.value, &other.value), ..self }
    }
}

impl Sub for Residue {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Residue { value: Ring::sub(&self.field, &self.value, &other.value), ..self }
    }
}

impl Mul for Residue {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Residue { value: Ring::mul(&self.field, &self.value, &other.value), ..self }
    }
}

impl Neg for Residue {
    type Output = Self;
    fn neg(self) -> Self {
        Residue { value: Ring::neg(&self.field, &self.value), ..self }
    }
}
