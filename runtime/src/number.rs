//! What a solver computes with: one number ([`f64`]), or those of several targets or candidates at once ([`Lanes`]).

use core::array::from_fn;
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Sub};

use crate::arithmetic::Arithmetic;
use crate::roots::{self, Roots};
use crate::tolerances::{BESIDE, GRAZING, MEETING, NEAR, TANGENT, TINY};
use crate::trigonometry;

/// A number on the left of an operation with several.
pub trait With<N>: Add<N, Output = N> + Sub<N, Output = N> + Mul<N, Output = N> + Div<N, Output = N> {}

impl<N> With<N> for f64 where f64: Add<N, Output = N> + Sub<N, Output = N> + Mul<N, Output = N> + Div<N, Output = N> {}

/// One number, or several at once. Operations are those of IEEE 754, one after the other as they are written, so that each of several numbers is, to
/// the last bit, what it would be alone.
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
    /// Whether something is so.
    type Truth: Copy + BitAnd<Output = Self::Truth> + BitOr<Output = Self::Truth>;
    /// Whether a candidate may have others next to it, or is none.
    type Doubt: Copy + BitOr<Output = Self::Doubt>;
    /// No doubt.
    const SURE: Self::Doubt;

    /// The number, everywhere.
    fn of(number: f64) -> Self;
    /// By number.
    fn each(self, other: Self, value: impl Fn(f64, f64) -> f64) -> Self;
    /// Whether something is so, by number.
    fn is(self, other: Self, is_so: impl Fn(f64, f64) -> bool) -> Self::Truth;
    /// The number where something is so, and another elsewhere.
    #[must_use]
    fn or(self, other: Self, is_so: Self::Truth) -> Self;
    /// The real roots of `x^2 + constant`, ascending; a miss that counts as none is up to `tangent` of the square of the unknown's typical size `scale`.
    fn roots_of_square(constant: Self, scale: Self, tangent: f64) -> Roots<Self, 2>;
    /// The real roots of the first polynomial whose leading coefficient counts, or of the last one, ascending; coefficients from the constant on.
    fn real_roots<const D: usize>(polynomials: &[&[Self]], scale: Self) -> Roots<Self, D>;

    /// What is computed of numbers one by one; nothing of several targets, which such programs do not solve at once.
    fn alone<A, const L: usize>(numbers: &[Self; L], value: impl FnOnce(&[f64; L]) -> A) -> Option<A>;
    /// Whether an answer may have others next to it.
    fn doubt_of(is_close: bool) -> Self::Doubt;

    /// The real roots of `x^2 + constant`, whose typical size is `scale`.
    #[inline(always)]
    fn square_roots(constant: Self, scale: Self) -> Roots<Self, 2> {
        Self::roots_of_square(constant, scale, TANGENT)
    }

    /// The same behind roots of polynomials of higher degree, which are less exact.
    #[inline(always)]
    fn grazing_roots(constant: Self, scale: Self) -> Roots<Self, 2> {
        Self::roots_of_square(constant, scale, GRAZING)
    }

    /// The magnitude.
    #[inline(always)]
    #[must_use]
    fn abs(self) -> Self {
        self.each(self, |a, _| a.abs())
    }

    /// The greater one; the other one of a number and what is none.
    #[inline(always)]
    #[must_use]
    fn max(self, other: Self) -> Self {
        self.each(other, f64::max)
    }

    /// The greater of two numbers; the first where one is not a number.
    #[inline(always)]
    #[must_use]
    fn greater(self, other: Self) -> Self {
        self.each(other, |a, b| if b > a { b } else { a })
    }

    /// The lesser of two numbers; the first where one is not a number.
    #[inline(always)]
    #[must_use]
    fn lesser(self, other: Self) -> Self {
        self.each(other, |a, b| if b < a { b } else { a })
    }

    /// The greatest among a positive number and magnitudes.
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

    /// The square root, zero of a number below zero.
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

    /// Where a factor is as near zero as a stratum reaches.
    #[inline(always)]
    fn near(self, scale: Self) -> Guard<Self> {
        Guard { here: self.abs().at_most(scale * NEAR), beside: self.abs().at_most(scale * BESIDE) }
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

/// Where a case's guards hold.
#[derive(Clone, Copy, Debug)]
pub struct Guard<N: Number> {
    /// As near a stratum as it reaches.
    pub here: N::Truth,
    /// The same where the cases before have lost nothing.
    pub beside: N::Truth,
}

impl<N: Number> Guard<N> {
    /// A claim to be the best conditioned of a group: the pivot's magnitude, or -1 elsewhere.
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

impl Number for f64 {
    type Truth = bool;
    type Doubt = bool;
    const SURE: bool = false;

    #[inline(always)]
    fn of(number: f64) -> f64 {
        number
    }

    #[inline(always)]
    fn each(self, other: f64, value: impl Fn(f64, f64) -> f64) -> f64 {
        value(self, other)
    }

    #[inline(always)]
    fn is(self, other: f64, is_so: impl Fn(f64, f64) -> bool) -> bool {
        is_so(self, other)
    }

    #[inline(always)]
    fn or(self, other: f64, is_so: bool) -> f64 {
        if is_so { self } else { other }
    }

    #[inline(always)]
    fn roots_of_square(constant: f64, scale: f64, tangent: f64) -> Roots<f64, 2> {
        roots::of_square(constant, scale, tangent)
    }

    fn real_roots<const D: usize>(polynomials: &[&[f64]], scale: f64) -> Roots<f64, D> {
        roots::of_the_leading(polynomials, scale)
    }

    #[inline(always)]
    fn alone<A, const L: usize>(numbers: &[f64; L], value: impl FnOnce(&[f64; L]) -> A) -> Option<A> {
        Some(value(numbers))
    }

    #[inline(always)]
    fn doubt_of(is_close: bool) -> bool {
        is_close
    }

    #[inline(always)]
    fn is_away(self, scale: f64) -> bool {
        self.abs() > TINY * scale
    }
}

/// Numbers that operations take at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lanes<const W: usize>(pub [f64; W]);

macro_rules! by_lane {
    ($($operation:ident $name:ident $sign:tt)*) => {
        $(
            impl<const W: usize> $operation for Lanes<W> {
                type Output = Lanes<W>;
                #[inline(always)]
                fn $name(self, other: Lanes<W>) -> Lanes<W> {
                    Lanes(from_fn(|i| self.0[i] $sign other.0[i]))
                }
            }
            impl<const W: usize> $operation<f64> for Lanes<W> {
                type Output = Lanes<W>;
                #[inline(always)]
                fn $name(self, other: f64) -> Lanes<W> {
                    Lanes(self.0.map(|number| number $sign other))
                }
            }
            impl<const W: usize> $operation<Lanes<W>> for f64 {
                type Output = Lanes<W>;
                #[inline(always)]
                fn $name(self, other: Lanes<W>) -> Lanes<W> {
                    Lanes(other.0.map(|number| self $sign number))
                }
            }
        )*
    };
}

by_lane!(Add add + Sub sub - Mul mul * Div div /);

impl<const W: usize> Neg for Lanes<W> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Lanes(self.0.map(|number| -number))
    }
}

/// Where something is so: all bits or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mask<const W: usize>(pub [u64; W]);

impl<const W: usize> Mask<W> {
    /// Nowhere.
    pub const NONE: Self = Mask([0; W]);

    /// Where it is not so.
    #[inline(always)]
    #[must_use]
    pub(crate) fn inverted(self) -> Self {
        Mask(self.0.map(|bits| !bits))
    }

    /// Where neither is so.
    #[inline(always)]
    pub(crate) fn or_not(self, other: Self) -> Self {
        (self | other).inverted()
    }

    /// Whether it is so anywhere.
    #[inline(always)]
    pub(crate) fn any(self) -> bool {
        self.0.iter().fold(0, |all, bits| all | bits) != 0
    }
}

impl<const W: usize> BitAnd for Mask<W> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Mask(from_fn(|i| self.0[i] & other.0[i]))
    }
}

impl<const W: usize> BitOr for Mask<W> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Mask(from_fn(|i| self.0[i] | other.0[i]))
    }
}

/// Where a candidate is none, for an equation on the way has no root, and where roots before are close to one another.
#[derive(Clone, Copy, Debug)]
pub struct Doubt<const W: usize> {
    pub(crate) dead: Mask<W>,
    pub(crate) close: Mask<W>,
}

impl<const W: usize> BitOr for Doubt<W> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Doubt { dead: self.dead | (other.dead & self.close.inverted()), close: self.close | other.close }
    }
}

impl<const W: usize> Number for Lanes<W> {
    type Truth = Mask<W>;
    type Doubt = Doubt<W>;
    const SURE: Doubt<W> = Doubt { dead: Mask::NONE, close: Mask::NONE };

    #[inline(always)]
    fn of(number: f64) -> Self {
        Lanes([number; W])
    }

    #[inline(always)]
    fn each(self, other: Self, value: impl Fn(f64, f64) -> f64) -> Self {
        Lanes(from_fn(|i| value(self.0[i], other.0[i])))
    }

    #[inline(always)]
    fn is(self, other: Self, is_so: impl Fn(f64, f64) -> bool) -> Mask<W> {
        Mask(from_fn(|i| if is_so(self.0[i], other.0[i]) { !0 } else { 0 }))
    }

    #[inline(always)]
    fn or(self, other: Self, is_so: Mask<W>) -> Self {
        Lanes(from_fn(|i| if is_so.0[i] != 0 { self.0[i] } else { other.0[i] }))
    }

    /// Where there are none, they are no numbers.
    #[inline(always)]
    fn roots_of_square(constant: Self, scale: Self, tangent: f64) -> Roots<Self, 2> {
        let dead = constant.at_most(tangent * constant.max(scale * scale)).inverted();
        let root = constant.each(constant, |a, _| Arithmetic::sqrt(-a));
        let close = root.exceeds(MEETING * scale).inverted();
        Roots { values: [-root, root], count: 2, doubts: [Doubt { dead, close }; 2] }
    }

    fn real_roots<const D: usize>(polynomials: &[&[Self]], scale: Self) -> Roots<Self, D> {
        roots::by_lane(polynomials, scale)
    }

    fn alone<A, const L: usize>(_: &[Self; L], _: impl FnOnce(&[f64; L]) -> A) -> Option<A> {
        None
    }

    #[inline(always)]
    fn doubt_of(is_close: bool) -> Doubt<W> {
        Doubt { dead: Mask::NONE, close: Mask([if is_close { !0 } else { 0 }; W]) }
    }

    /// What is no number is: it belongs to no candidate.
    #[inline(always)]
    fn is_away(self, scale: Self) -> Mask<W> {
        self.abs().at_most(TINY * scale).inverted()
    }
}
