//! Several numbers at once. Main type: [`Lanes`].

use core::array::from_fn;
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Sub};

use crate::arithmetic::Arithmetic;
use crate::number::{Number, Roots, Scale};
use crate::roots::{self, MOST};
use crate::tolerances::{ROOTS, STRATA};

/// `W` numbers on which operations act at once.
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

/// A truth value per lane: all bits set or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mask<const W: usize>(pub [u64; W]);

impl<const W: usize> Mask<W> {
    /// False in all lanes.
    pub const NONE: Self = Mask([0; W]);

    /// The negation.
    #[inline(always)]
    #[must_use]
    pub fn inverted(self) -> Self {
        Mask(self.0.map(|bits| !bits))
    }

    /// True where neither is true.
    #[inline(always)]
    pub(crate) fn or_not(self, other: Self) -> Self {
        (self | other).inverted()
    }

    /// Whether it is true in any lane.
    #[inline(always)]
    pub fn any(self) -> bool {
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

/// Lanes in which a candidate does not exist, because an equation has no root, and lanes in which earlier roots are close to each other.
#[derive(Clone, Copy, Debug)]
pub struct Doubt<const W: usize> {
    /// Where a candidate does not exist.
    pub dead: Mask<W>,
    /// Where earlier roots are close to each other.
    pub close: Mask<W>,
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

    /// A root that does not exist is NaN.
    #[inline(always)]
    fn roots_of_square(constant: Self, scale: Self, tangent: f64) -> Roots<Self, 2> {
        let dead = constant.at_most(tangent * constant.max(scale * scale)).inverted();
        let root = constant.each(constant, |a, _| Arithmetic::sqrt(-a));
        let close = root.exceeds(ROOTS.close * scale).inverted();
        Roots { values: [-root, root], count: 2, doubts: [Doubt { dead, close }; 2] }
    }

    fn real_roots<const D: usize>(polynomials: &[&[Self]], scale: Self) -> Roots<Self, D> {
        roots_by_lane(polynomials, |lane| Scale::typical(scale.0[lane]))
    }

    fn half_angle_roots<const D: usize>(polynomial: &[Self], spread: Self) -> Roots<Self, D> {
        roots_by_lane(&[polynomial], |lane| Scale::half_angle(spread.0[lane]))
    }

    fn alone<A, const L: usize>(_: &[Self; L], _: impl FnOnce(&[f64; L]) -> A) -> Option<A> {
        None
    }

    #[inline(always)]
    fn doubt_of(is_close: bool) -> Doubt<W> {
        Doubt { dead: Mask::NONE, close: Mask([if is_close { !0 } else { 0 }; W]) }
    }

    /// NaN counts as true: it belongs to no candidate.
    #[inline(always)]
    fn is_away(self, scale: Self) -> Mask<W> {
        self.abs().at_most(STRATA.denominator * scale).inverted()
    }
}

/// Finds the roots lane by lane. Lanes with fewer roots than others have none at the end.
fn roots_by_lane<const W: usize, const D: usize>(
    polynomials: &[&[Lanes<W>]],
    scale: impl Fn(usize) -> Scale,
) -> Roots<Lanes<W>, D> {
    let mut roots = Roots {
        values: [Lanes([f64::NAN; W]); D],
        count: D,
        doubts: [Doubt { dead: Mask([!0; W]), close: Mask::NONE }; D],
    };
    let mut numbers = [[0.0; MOST]; 4];
    for lane in 0..W {
        for (row, list) in numbers.iter_mut().zip(polynomials) {
            row.iter_mut().zip(*list).for_each(|(number, lanes)| *number = lanes.0[lane]);
        }
        let mut lists: [&[f64]; 4] = [&[]; 4];
        for (list, (row, given)) in lists.iter_mut().zip(numbers.iter().zip(polynomials)) {
            *list = &row[..given.len()];
        }
        let own: Roots<f64, D> = roots::of_the_leading(&lists[..polynomials.len().min(4)], scale(lane));
        for (index, root) in own.as_slice().iter().enumerate() {
            roots.values[index].0[lane] = *root;
            roots.doubts[index].dead.0[lane] = 0;
            roots.doubts[index].close.0[lane] = if own.doubts[index] { !0 } else { 0 };
        }
    }
    roots
}
