//! The equations as rows of coefficients ([`Rows`]).

use core::array::from_fn;

use super::profile::{PRODUCTS, Products, Profile, STILL, TURNING};

/// Products of the joints on the far side, without 1.
pub(super) const FAR: usize = PRODUCTS - 1;
/// Products of the joints on the near side, 1 among them, then those on the far side.
pub(super) const COLUMNS: usize = PRODUCTS + FAR;
/// Equations in which the hidden angle stands.
pub(super) const MOVING: usize = 2 * TURNING;

/// The coefficients of the near products and of the far ones.
pub(super) type Row = [f64; COLUMNS];

/// The equations: `still = 0` and `constant - x linear = 0` with `x` the tangent of half the hidden angle, or half the way.
pub(super) struct Rows {
    pub still: [Row; STILL],
    pub constant: [Row; MOVING],
    pub linear: [Row; MOVING],
}

/// The functions that a slide leaves alone: `l`, the component of `p x l` along the axis, those of `p` across it.
const UNMOVED: [usize; STILL] = [1, STILL + 1, STILL + TURNING + 1, 2, STILL, STILL + TURNING];
/// The other functions, and which multiple of which function `-N` makes of each, or the constant -2: `N p = w`, `N (p x l) = w x l`,
/// `N ((p.p) l - 2 (p.l) p) = -2 w x (p x l) - 2 (p.l) w`, `N (p.p) = 2 p.w`, `N (p.l) = l.w`.
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

/// The same of the functions `a`, `l`, `p x l`, `l x a`, `p.a` and `p.(l x a)`, for a fourth joint that slides: ten stay. Four of them stand among the
/// moving ones: `r = 0` and `s = 0` as `s - x r = 0` and `-r - x s = 0`, which say the same for all `x` but `i` and `-i`.
const UNMOVED_DIRECTED: [usize; STILL] = [0, 1, 2, 3, STILL, STILL + 1];
/// These four.
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
    /// What the hidden joint moves, and where it moves it to; whether that joint slides, and the fourth one behind it.
    #[inline(always)]
    pub fn new(near: &Profile, far: &Profile, [slides, is_directed]: [bool; 2]) -> Self {
        match (slides, is_directed) {
            (false, _) => Rows::of_turn(near, far),
            (true, false) => Rows::of_slide(near, far),
            (true, true) => Rows::of_slide_directed(near, far),
        }
    }

    /// The vectors across the hidden axis `w` fulfil Rodrigues' equation `b - a = x w x (a + b)`.
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

    /// A slide by `2 x w` is `exp(2 x N)` with `N^3 = 0`, so that `b - a = x N (a + b)` for all fourteen functions.
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

/// `a + b` in both sides' products.
#[inline(always)]
fn sum(a: &Products, b: &Products) -> Row {
    difference(a, &b.map(|entry| -entry))
}

/// `a - b` in both sides' products, whose 1 is the same.
#[inline(always)]
fn difference(a: &Products, b: &Products) -> Row {
    from_fn(|column| match column {
        0 => a[0] - b[0],
        1..PRODUCTS => a[column],
        _ => -b[column - FAR],
    })
}
