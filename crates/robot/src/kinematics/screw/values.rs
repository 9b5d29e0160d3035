//! Results of the subproblems: all values of one joint, or of several, and the tolerances for reaching a target.
//!
//! Tolerances are relative to the *size* of a subproblem, the largest distance between its points (1 for directions).
//! It is at least 1.8e-3 times the distance of the moved points from the origin, because of the rounding of their
//! coordinates.
//! * a target out of reach by at most the [`Reach`] counts as reached, at the nearest end;
//! * a joint is *free* when moving it changes the required quantity by at most 1e-12 of the size;
//! * two values become one where the target is within 8 epsilon of the size of an end of its interval.
//!
//! Near an end the target's sensitivity to the joint is almost zero: a relative error e of the target gives an error of
//! about sqrt(e) of the angle. The reached point is accurate in all cases.

use std::ops::Deref;

use nalgebra::Point3;
use smallvec::SmallVec;

/// Tolerance of a target out of reach, relative to the size of the problem.
pub(crate) const TOLERANCE: f64 = 1e-12;

/// Distance of a target from an end of its interval, relative to the size of the problem, below which two values become
/// one.
pub(crate) const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The smallest size of a problem, relative to its points' distance from the origin. Its [`TOLERANCE`] is then the
/// coordinates' [`ROUNDING`].
pub(crate) const GRAIN: f64 = ROUNDING / TOLERANCE;

/// The size of a problem from the rounding of these points' coordinates, and at least their distance.
pub(super) fn displacement_size(p: &Point3<f64>, k: &Point3<f64>) -> f64 {
    let grain = GRAIN * p.coords.norm().max(k.coords.norm());
    let displacement = (k - p).norm();
    if displacement.is_nan() { displacement } else { displacement.max(grain) }
}

/// Treatment of a target out of reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach {
    /// A target out of reach by at most this value, relative to the size of the problem, counts as reached.
    Within(f64),
    /// At any distance: the values of the nearest point, in the sense of least squares.
    Closest,
}

impl Reach {
    /// Within 1e-12.
    pub const EXACT: Reach = Reach::Within(TOLERANCE);

    /// A tolerance for candidates that are checked later: at least `share` of the size.
    pub(super) fn at_least(self, share: f64) -> Reach {
        Reach::Within(share.max(self.slack(10.0).min(1.0)))
    }

    /// The largest residual that is allowed in a problem of this size.
    pub(super) fn slack(self, size: f64) -> f64 {
        match self {
            Reach::Within(share) => share * size,
            Reach::Closest => f64::INFINITY,
        }
    }
}

impl Default for Reach {
    fn default() -> Self {
        Reach::EXACT
    }
}

/// All values of one joint that solve a subproblem: angles in (-pi, pi] \[rad\], or displacements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Values {
    /// There is no solution.
    None,
    /// Exactly one value is a solution.
    One(f64),
    /// Two different values are solutions.
    Two(f64, f64),
    /// Every value is a solution.
    Free,
}

impl Values {
    /// The determined values; none when there are none or the joint is free.
    pub fn iter(self) -> impl Iterator<Item = f64> {
        let pair = match self {
            Values::None | Values::Free => [None, None],
            Values::One(first) => [Some(first), None],
            Values::Two(first, second) => [Some(first), Some(second)],
        };
        pair.into_iter().flatten()
    }

    /// The values with opposite signs.
    #[must_use]
    pub(super) fn negated(self) -> Values {
        match self {
            Values::One(q) => Values::One(-q),
            Values::Two(q, r) => Values::Two(-q, -r),
            none_or_free => none_or_free,
        }
    }

    /// The values as joint values of a solution; `None` for a free joint.
    pub(super) fn choices(self) -> SmallVec<[Option<f64>; 2]> {
        match self {
            Values::Free => SmallVec::from_slice(&[None]),
            values => values.iter().map(Some).collect(),
        }
    }
}

/// All solutions for `N` joints. `None` is a free joint: every value of it has a solution, with other values of the
/// other joints. They were computed with the free joint at zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answers<const N: usize> {
    list: SmallVec<[[Option<f64>; N]; 4]>,
}

impl<const N: usize> Answers<N> {
    pub(super) fn push(&mut self, answer: [Option<f64>; N]) {
        self.list.push(answer);
    }
}

impl<const N: usize> Deref for Answers<N> {
    type Target = [[Option<f64>; N]];

    fn deref(&self) -> &Self::Target {
        &self.list
    }
}

impl<const N: usize> FromIterator<[Option<f64>; N]> for Answers<N> {
    fn from_iter<I: IntoIterator<Item = [Option<f64>; N]>>(answers: I) -> Self {
        Answers { list: answers.into_iter().collect() }
    }
}

impl<'a, const N: usize> IntoIterator for &'a Answers<N> {
    type Item = &'a [Option<f64>; N];
    type IntoIter = std::slice::Iter<'a, [Option<f64>; N]>;

    fn into_iter(self) -> Self::IntoIter {
        self.list.iter()
    }
}
