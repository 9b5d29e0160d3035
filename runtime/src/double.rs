//! [`Number`](crate::number::Number) for a single `f64`.

use crate::number::{Number, Roots, Scale};
use crate::roots;
use crate::tolerances::STRATA;

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
        roots::of_the_leading(polynomials, Scale::typical(scale))
    }

    fn half_angle_roots<const D: usize>(polynomial: &[f64], spread: f64) -> Roots<f64, D> {
        roots::of_the_leading(&[polynomial], Scale::half_angle(spread))
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
        self.abs() > STRATA.denominator * scale
    }
}
