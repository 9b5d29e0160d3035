//! The equations as rows of coefficients ([`Rows`]).

use core::array::from_fn;

use super::profile::{PRODUCTS, Products, Profile, STILL, TURNING};

/// Products of the joints on the far side, without 1.
pub(super) const FAR: usize = PRODUCTS - 1;
/// Number of columns: products of the joints on the near side, with 1, then those on the far side.
pub(super) const COLUMNS: usize = PRODUCTS + FAR;
/// Number of equations that contain the hidden angle.
pub(super) const MOVING: usize = 2 * TURNING;

/// Coefficients of the near products, then of the far ones.
pub(super) type Row = [f64; COLUMNS];

/// The equations: `still = 0` and `constant - x linear = 0`, where `x` is the tangent of half the hidden angle, or half the displacement.
pub(super) struct Rows {
    pub still: [Row; STILL],
    pub constant: [Row; MOVING],
    pub linear: [Row; MOVING],
}

/// The functions invariant under a translation: `l`, the component of `p x l` along the axis, those of `p` orthogonal to it.
const UNMOVED: [usize; STILL] = [1, STILL + 1, STILL + TURNING + 1, 2, STILL, STILL + TURNING];
/// The other functions, and which multiple of which function `-N` maps each to, or the constant -2: `N p = w`, `N (p x l) = w x l`, `N ((p.p) l - 2 (p.l) p) =
/// -2 w x (p x l) - 2 (p.l) w`, `N (p.p) = 2 p.w`, `N (p.l) = l.w`.
const SLIDING: [(usize, usize, f64); MOVING] = [
    (0, 0, 0.0),
    (STILL + 2, STILL + TURNING + 1, 1.0),
    (STILL + TURNING + 2, STILL + 1, -1.0),
    (3, TURNING + 1, 2.0),
    (STILL + 3, STILL + TURNING + 2, -2.0),
    (STILL + TURNING + 3, STILL + 2, 2.0),
    (TURNING, 0, -2.0),
    (TURNING + 1, 1, -1.0),
];

/// Invariant functions among `a`, `l`, `p x l`, `l x a`, `p.a` and `p.(l x a)`, for a prismatic fourth joint: ten in all. Four of them are among the moving
/// equations: `r = 0` and `s = 0` become `s - x r = 0` and `-r - x s = 0`, which are equivalent for all `x` except `i` and `-i`.
const UNMOVED_DIRECTED: [usize; STILL] = [0, 1, 2, 3, STILL, STILL + 1];
/// These four functions.
const PAIRED: [(usize, usize, f64); 4] = [
    (STILL + TURNING, STILL + 3, 1.0),
    (STILL + 3, STILL + TURNING, -1.0),
    (STILL + TURNING + 3, STILL + TURNING + 1, 1.0),
    (STILL + TURNING + 1, STILL + TURNING + 3, -1.0),
];
/// `N (p x l) = w x l`, `N (p.a) = w.a`, `N (p.(l x a)) = w.(l x a)`.
const SLIDING_DIRECTED: [(usize, usize, f64); 4] = [
    (STILL + 2, STILL + TURNING + 1, 1.0),
    (STILL + TURNING + 2, STILL + 1, -1.0),
    (TURNING, 0, -1.0),
    (TURNING + 1, 3, -1.0),
];

impl Rows {
    /// The equations from the functions that the hidden joint moves and those of their images. The flags say whether the hidden joint and the fourth one after
    /// it are prismatic.
    #[inline(always)]
    pub fn new(near: &Profile, far: &Profile, [slides, is_directed]: [bool; 2]) -> Self {
        match (slides, is_directed) {
            (false, _) => Rows::of_turn(near, far),
            (true, false) => Rows::of_slide(near, far),
            (true, true) => Rows::of_slide_directed(near, far),
        }
    }

    /// Equations of a revolute hidden joint: the vectors orthogonal to its axis `w` fulfil Rodrigues' equation `b - a = x w x (a + b)`.
    #[inline(always)]
    fn of_turn(near: &Profile, far: &Profile) -> Self {
        let less = |k: usize| difference(&near[k], &far[k]);
        let more = |k: usize| sum(&near[k], &far[k]);
        Rows {
            still: from_fn(less),
            constant: from_fn(|k| less(STILL + k)),
            linear: from_fn(|k| {
                if k < TURNING { more(STILL + TURNING + k) } else { times(more(STILL - TURNING + k), -1.0) }
            }),
        }
    }

    /// Equations of a prismatic hidden joint: a translation by `2 x w` is `exp(2 x N)` with `N^3 = 0`, so that `b - a = x N (a + b)` for all fourteen
    /// functions.
    fn of_slide(near: &Profile, far: &Profile) -> Self {
        let constant = from_fn(|column| if column == 0 { -2.0 } else { 0.0 });
        Rows {
            still: UNMOVED.map(|k| difference(&near[k], &far[k])),
            constant: SLIDING.map(|(k, _, _)| difference(&near[k], &far[k])),
            linear: SLIDING.map(
                |(_, image, factor)| {
                    if factor == 0.0 { constant } else { times(sum(&near[image], &far[image]), factor) }
                },
            ),
        }
    }

    fn of_slide_directed(near: &Profile, far: &Profile) -> Self {
        let less = |k: usize| difference(&near[k], &far[k]);
        let sliding = |k: usize| SLIDING_DIRECTED[k - PAIRED.len()];
        let image = |(_, image, factor): (usize, usize, f64)| times(sum(&near[image], &far[image]), factor);
        Rows {
            still: UNMOVED_DIRECTED.map(less),
            constant: from_fn(|k| PAIRED.get(k).map_or_else(|| less(sliding(k).0), |pair| times(less(pair.0), pair.2))),
            linear: from_fn(|k| PAIRED.get(k).map_or_else(|| image(sliding(k)), |pair| less(pair.1))),
        }
    }
}

#[inline(always)]
fn times(row: Row, factor: f64) -> Row {
    row.map(|entry| factor * entry)
}

/// `a + b` in the products of both sides.
#[inline(always)]
fn sum(a: &Products, b: &Products) -> Row {
    difference(a, &b.map(|entry| -entry))
}

/// `a - b` in the products of both sides, which share the constant 1.
#[inline(always)]
fn difference(a: &Products, b: &Products) -> Row {
    from_fn(|column| match column {
        0 => a[0] - b[0],
        1..PRODUCTS => a[column],
        _ => -b[column - FAR],
    })
}
