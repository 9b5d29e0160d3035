//! What the subproblems answer: all values of one joint, or of several, and when a target counts as reached.
//!
//! Tolerances are relative to the *size* of a subproblem, the largest distance between its points (1 for directions), though at
//! least [`GRAIN`] of the distance of the moved points from the origin, where their coordinates round:
//! * a target out of reach by at most the [`Reach`] counts as reached, at the nearest end;
//! * a joint is *free* when moving it changes what is asked for by at most [`TOLERANCE`] of the size;
//! * two values are one where the target is within [`ROUNDING`] of the size of an end of its interval.
//!
//! Near an end the target hardly depends on the joint: known to a share e of the size, it leaves an angle uncertain by about
//! sqrt(e). What the answer reaches is accurate throughout.

use std::ops::Deref;

use nalgebra::Point3;
use smallvec::SmallVec;

/// How far out of reach, relative to the size of the problem, a target may be and still be reached.
pub const TOLERANCE: f64 = 1e-12;

/// How near to an end of its interval, relative to the size of the problem, a target has one value instead of two.
pub const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The smallest size of a problem, relative to its points' distance from the origin: its [`TOLERANCE`] is then the coordinates'
/// [`ROUNDING`].
pub const GRAIN: f64 = ROUNDING / TOLERANCE;

/// The size that the rounding of these points' coordinates leaves to a problem, and no less than their distance.
pub(super) fn size_of_way(p: &Point3<f64>, k: &Point3<f64>) -> f64 {
    let grain = GRAIN * p.coords.norm().max(k.coords.norm());
    let way = (k - p).norm();
    if way.is_nan() { way } else { way.max(grain) }
}

/// What to do with a target out of reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach {
    /// Out of reach by at most this, relative to the size of the problem, counts as reached.
    Within(f64),
    /// However far: the values that come nearest, in the sense of least squares.
    Closest,
}

impl Reach {
    /// Within [`TOLERANCE`].
    pub const EXACT: Reach = Reach::Within(TOLERANCE);

    /// A reach for candidates that are checked later: at least `share` of the size.
    pub(super) fn at_least(self, share: f64) -> Reach {
        Reach::Within(share.max(self.slack(10.0).min(1.0)))
    }

    /// The largest miss that is allowed in a problem of this size.
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
    /// No value does it.
    None,
    /// Exactly one value does it.
    One(f64),
    /// Two different values do it.
    Two(f64, f64),
    /// Every value does it.
    Free,
}

impl Values {
    /// The determined values: none when there are none or when every value does it.
    pub fn iter(self) -> impl Iterator<Item = f64> {
        let pair = match self {
            Values::None | Values::Free => [None, None],
            Values::One(first) => [Some(first), None],
            Values::Two(first, second) => [Some(first), Some(second)],
        };
        pair.into_iter().flatten()
    }

    /// The same with every value's sign changed.
    #[must_use]
    pub(super) fn negated(self) -> Values {
        match self {
            Values::One(q) => Values::One(-q),
            Values::Two(q, r) => Values::Two(-q, -r),
            none_or_free => none_or_free,
        }
    }

    /// The values as joint values of an answer; `None` for a free joint.
    pub(super) fn choices(self) -> SmallVec<[Option<f64>; 2]> {
        match self {
            Values::Free => SmallVec::from_slice(&[None]),
            values => values.iter().map(Some).collect(),
        }
    }
}

/// All answers for `N` joints. In an answer `None` is a free joint: every value of it is an answer, the other joints
/// changing along with it; they were computed with it at zero.
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
