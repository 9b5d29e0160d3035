//! Scalar types of the recursions. Main type: [`Scalar`].

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A scalar of the recursions: a double, a [dual number](Dual), or any type with addition and multiplication.
pub trait Scalar: Clone + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self> {
    /// Zero.
    fn zero() -> Self;
    /// One.
    fn one() -> Self;
    /// Half of this number.
    #[must_use]
    fn half(&self) -> Self;
}

/// A scalar with division, for forward dynamics.
pub trait Divisible: Scalar + Div<Output = Self> {}

impl<S: Scalar + Div<Output = S>> Divisible for S {}

macro_rules! scalars {
    ($($float:ty)*) => {
        $(
            impl Scalar for $float {
                fn zero() -> $float {
                    0.0
                }

                fn one() -> $float {
                    1.0
                }

                fn half(&self) -> $float {
                    0.5 * self
                }
            }
        )*
    };
}

scalars!(f64 f32);

/// A dual number: a value and its derivative along one direction. Every operation propagates both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<S> {
    /// The value.
    pub value: S,
    /// The derivative.
    pub slope: S,
}

impl<S: Scalar> Dual<S> {
    /// A constant: its derivative is zero.
    pub fn constant(value: S) -> Self {
        Dual { value, slope: S::zero() }
    }
}

impl<S: Scalar> Add for Dual<S> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Dual { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl<S: Scalar> Sub for Dual<S> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Dual { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl<S: Scalar> Mul for Dual<S> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let slope = self.value.clone() * other.slope + self.slope * other.value.clone();
        Dual { value: self.value * other.value, slope }
    }
}

impl<S: Divisible> Div for Dual<S> {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let value = self.value / other.value.clone();
        let slope = (self.slope - value.clone() * other.slope) / other.value;
        Dual { value, slope }
    }
}

impl<S: Scalar> Neg for Dual<S> {
    type Output = Self;

    fn neg(self) -> Self {
        Dual { value: -self.value, slope: -self.slope }
    }
}

impl<S: Scalar> Scalar for Dual<S> {
    fn zero() -> Self {
        Dual::constant(S::zero())
    }

    fn one() -> Self {
        Dual::constant(S::one())
    }

    fn half(&self) -> Self {
        Dual { value: self.value.half(), slope: self.slope.half() }
    }
}
