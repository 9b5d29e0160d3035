//! Arithmetic of a solver: one number ([`f64`]), or those of several targets or candidates at once ([`crate::Lanes`]). Main type: [`Number`].

use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Sub};

use crate::arithmetic::Arithmetic;
use crate::tolerances::{ACCEPTANCE, ROOTS, STRATA};
use crate::trigonometry;

/// A scalar operand on the left of an operation with several numbers.
pub trait With<N>: Add<N, Output = N> + Sub<N, Output = N> + Mul<N, Output = N> + Div<N, Output = N> {}

impl<N> With<N> for f64 where f64: Add<N, Output = N> + Sub<N, Output = N> + Mul<N, Output = N> + Div<N, Output = N> {}

/// One number, or several at once. Operations are those of IEEE 754 in the written order. Each of several numbers is bitwise equal to what it would be alone.
pub trait Number:
    Copy
    + 'static
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// A truth value for each number.
    type Truth: Copy + BitAnd<Output = Self::Truth> + BitOr<Output = Self::Truth>;
    /// Whether a candidate may have others close to it, or does not exist.
    type Doubt: Copy + BitOr<Output = Self::Doubt>;
    /// No doubt.
    const SURE: Self::Doubt;

    /// The given number in all lanes.
    fn of(number: f64) -> Self;
    /// Applies a function to each pair of numbers.
    fn each(self, other: Self, value: impl Fn(f64, f64) -> f64) -> Self;
    /// Compares each pair of numbers.
    fn is(self, other: Self, is_so: impl Fn(f64, f64) -> bool) -> Self::Truth;
    /// Selects the number where `is_so` is true, and the other one elsewhere.
    #[must_use]
    fn or(self, other: Self, is_so: Self::Truth) -> Self;
    /// The real roots of `x^2 + constant`, ascending. A negative radicand counts as zero up to `tangent` times the square of the unknown's typical size
    /// `scale`.
    fn roots_of_square(constant: Self, scale: Self, tangent: f64) -> Roots<Self, 2>;
    /// The real roots, ascending, of the first polynomial with a significant leading coefficient, or of the last one. Coefficients begin with the constant
    /// term.
    fn real_roots<const D: usize>(polynomials: &[&[Self]], scale: Self) -> Roots<Self, D>;
    /// The real roots of a polynomial in the tangent of half an angle. A double root may miss the axis by rounding times a power of `spread`: terms are
    /// weighted with `spread` times the greater of the tangent and one.
    fn half_angle_roots<const D: usize>(polynomial: &[Self], spread: Self) -> Roots<Self, D>;

    /// Applies a function to scalars. `None` for several targets at once: programs that need it solve targets one by one.
    fn alone<A, const L: usize>(numbers: &[Self; L], value: impl FnOnce(&[f64; L]) -> A) -> Option<A>;
    /// Whether a solution may have others close to it.
    fn doubt_of(is_close: bool) -> Self::Doubt;

    /// The real roots of `x^2 + constant`, whose typical size is `scale`.
    #[inline(always)]
    fn square_roots(constant: Self, scale: Self) -> Roots<Self, 2> {
        Self::roots_of_square(constant, scale, ROOTS.tangent)
    }

    /// Same as [`Number::square_roots`], with a larger tolerance, after roots of polynomials of higher degree.
    #[inline(always)]
    fn grazing_roots(constant: Self, scale: Self) -> Roots<Self, 2> {
        Self::roots_of_square(constant, scale, ACCEPTANCE.unsettled)
    }

    /// The magnitude.
    #[inline(always)]
    #[must_use]
    fn abs(self) -> Self {
        self.each(self, |a, _| a.abs())
    }

    /// The greater one; if one is NaN, the other one.
    #[inline(always)]
    #[must_use]
    fn max(self, other: Self) -> Self {
        self.each(other, f64::max)
    }

    /// The greater of two numbers; the first where one is NaN.
    #[inline(always)]
    #[must_use]
    fn greater(self, other: Self) -> Self {
        self.each(other, |a, b| if b > a { b } else { a })
    }

    /// The lesser of two numbers; the first where one is NaN.
    #[inline(always)]
    #[must_use]
    fn lesser(self, other: Self) -> Self {
        self.each(other, |a, b| if b < a { b } else { a })
    }

    /// The greatest of a positive number and the magnitudes of others.
    #[inline(always)]
    fn largest(least: f64, others: &[Self]) -> Self {
        others.iter().fold(Self::of(least), |largest, other| largest.greater(other.abs()))
    }

    /// The number where another is below a limit, and zero elsewhere.
    #[inline(always)]
    #[must_use]
    fn where_below(self, other: Self, limit: f64) -> Self {
        self.each(other, |a, b| if b < limit { a } else { 0.0 })
    }

    /// The square root; zero of a negative number.
    #[inline(always)]
    #[must_use]
    fn root(self) -> Self {
        self.each(self, |a, _| Arithmetic::sqrt(f64::max(a, 0.0)))
    }

    /// The cosine of an angle in rad.
    #[must_use]
    fn cos(self) -> Self {
        self.each(self, |a, _| trigonometry::cosine(a))
    }

    /// The sine of an angle in rad.
    #[must_use]
    fn sin(self) -> Self {
        self.each(self, |a, _| trigonometry::sine(a))
    }

    /// Whether it is at most a limit.
    #[inline(always)]
    fn at_most(self, limit: Self) -> Self::Truth {
        self.is(limit, |a, b| a <= b)
    }

    /// Whether it is more than a limit.
    #[inline(always)]
    fn exceeds(self, limit: Self) -> Self::Truth {
        self.is(limit, |a, b| a > b)
    }

    /// Where a factor is so close to zero that the case of a stratum runs.
    #[inline(always)]
    fn near(self, scale: Self) -> Guard<Self> {
        Guard { here: self.abs().at_most(scale * STRATA.near), beside: self.abs().at_most(scale * STRATA.beside) }
    }

    /// Where a factor is not zero.
    #[inline(always)]
    fn away(self, scale: Self) -> Guard<Self> {
        let here = self.is_away(scale);
        Guard { here, beside: here }
    }

    /// Whether a factor is not zero.
    fn is_away(self, scale: Self) -> Self::Truth;
}

/// The truth values of a case's guards.
#[derive(Clone, Copy, Debug)]
pub struct Guard<N: Number> {
    /// Near the stratum.
    pub here: N::Truth,
    /// Within rounding of the stratum, which suffices where the cases before have lost nothing.
    pub beside: N::Truth,
}

impl<N: Number> Guard<N> {
    /// The claim of a pivot in a group: its magnitude where the guard holds, or -1 elsewhere.
    #[inline(always)]
    pub fn claim(self, pivot: N) -> N {
        pivot.abs().or(N::of(-1.0), self.here)
    }
}

impl<N: Number> BitAnd for Guard<N> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Guard { here: self.here & other.here, beside: self.beside & other.beside }
    }
}

/// Real roots, ascending.
#[derive(Clone, Copy, Debug)]
pub struct Roots<N: Number, const D: usize> {
    pub(crate) values: [N; D],
    pub(crate) count: usize,
    pub(crate) doubts: [N::Doubt; D],
}

impl<N: Number, const D: usize> Roots<N, D> {
    /// Their values.
    #[inline(always)]
    pub fn as_slice(&self) -> &[N] {
        &self.values[..self.count]
    }

    /// How many there are.
    #[inline(always)]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Whether the root with this index is close to another, is double, or does not exist.
    #[inline(always)]
    pub fn doubt(&self, index: usize) -> N::Doubt {
        self.doubts[index]
    }
}

/// The magnitudes at which a polynomial's terms are evaluated, to distinguish a double root from a miss.
#[derive(Clone, Copy)]
pub(crate) struct Scale {
    /// The unknown's typical size.
    pub typical: f64,
    /// Factor for the greater of the typical size and the root.
    pub spread: f64,
}

impl Scale {
    #[inline(always)]
    pub fn typical(size: f64) -> Self {
        Scale { typical: size, spread: 1.0 }
    }

    #[inline(always)]
    pub fn half_angle(spread: f64) -> Self {
        Scale { typical: 1.0, spread }
    }

    /// The magnitude at which terms are evaluated near the root `x`.
    #[inline(always)]
    pub fn at(self, x: f64) -> f64 {
        self.spread * f64::max(self.typical, x.abs())
    }
}
