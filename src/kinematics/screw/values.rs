//! What the subproblems return: [`Values`] of one joint, [`Answers`] of several; and how far a target may be out of reach: [`Reach`].

use std::ops::Deref;

use smallvec::SmallVec;

/// How far out of reach, relative to the size of the problem, a target may be and still be reached exactly.
///
/// Lengths up to this share of the size also count as none where a joint becomes free.
pub const TOLERANCE: f64 = 1e-12;

/// How near to an end of its interval, relative to the size of the problem, a target has one answer instead of two.
pub const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// What to do with a target out of reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach {
    /// Out of reach by at most this, relative to the problem's size, counts as reached, at the nearest end.
    Within(f64),
    /// The values that come nearest, however far that is.
    Closest,
}

impl Reach {
    /// Out of reach by no more than rounding.
    pub const EXACT: Reach = Reach::Within(TOLERANCE);

    /// Whether a miss of `miss`, relative to the problem's size, counts as reached.
    pub(super) fn covers(self, miss: f64) -> bool {
        match self {
            Reach::Within(tolerance) => miss <= tolerance,
            Reach::Closest => miss.is_finite(),
        }
    }
}

impl Default for Reach {
    fn default() -> Self {
        Reach::EXACT
    }
}

/// All values of one joint that solve a subproblem: angles in (-pi, pi] \[rad\] or displacements \[m\].
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

    /// The same answers in another measure; `None` and `Free` stay.
    pub(super) fn map(self, f: impl Fn(f64) -> f64) -> Values {
        match self {
            Values::One(first) => Values::One(f(first)),
            Values::Two(first, second) => Values::Two(f(first), f(second)),
            same => same,
        }
    }
}

/// All answers for `N` joints, in the order of the joints: angles in (-pi, pi] \[rad\] or displacements \[m\].
///
/// An entry `None` is a free joint: every value of it has an answer, and the others were computed with it at 0. A slice of
/// answers by [`Deref`]; nothing is allocated for eight answers and less.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answers<const N: usize> {
    list: SmallVec<[[Option<f64>; N]; 8]>,
}

impl<const N: usize> Answers<N> {
    /// No answer.
    pub fn none() -> Self {
        Answers { list: SmallVec::new() }
    }

    /// Each answer made to another one, say for more joints or in another unit.
    pub(super) fn map<const M: usize>(&self, f: impl Fn(&[Option<f64>; N]) -> [Option<f64>; M]) -> Answers<M> {
        self.iter().map(f).collect()
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

impl<const N: usize> From<[Values; N]> for Answers<N> {
    /// Every combination of the joints' values; none when one of them has none.
    fn from(values: [Values; N]) -> Self {
        let mut answers = Answers { list: SmallVec::from_elem([None; N], 1) };
        for (joint, values) in values.into_iter().enumerate() {
            if values != Values::Free {
                let longer = |answer: [Option<f64>; N]| {
                    values
                        .iter()
                        .map(move |value| std::array::from_fn(|i| if i == joint { Some(value) } else { answer[i] }))
                };
                answers = answers.list.into_iter().flat_map(longer).collect();
            }
        }
        answers
    }
}
