//! The equations as rows of coefficients, over any [`Scalar`] ([`Rows`]), and how a row is multiplied by half an angle.

use super::formulation::Equations;
use super::profile::{PRODUCTS, STILL, TURNING};
use super::scalar::Scalar;

/// Products of the joints on the far side, without 1.
pub const FAR: usize = PRODUCTS - 1;
/// Products of the joints on the near side, 1 among them, then those on the far side.
pub const COLUMNS: usize = PRODUCTS + FAR;
/// Equations in which the hidden angle stands.
pub const MOVING: usize = 2 * TURNING;

/// The coefficients of the near products and of the far ones.
pub type Row<T> = [T; COLUMNS];

/// The equations: `still = 0` and `constant - x linear = 0` with `x sqrt n` the tangent of half the hidden angle.
#[derive(Clone, Copy, Debug)]
pub struct Rows<T> {
    /// Free of the hidden angle.
    pub still: [Row<T>; STILL],
    /// Without `x`.
    pub constant: [Row<T>; MOVING],
    /// What `x` is multiplied by.
    pub linear: [Row<T>; MOVING],
}

impl<T: Scalar> Rows<T> {
    /// What is moved, less where it is moved to.
    pub fn new(equations: &Equations<T>) -> Self {
        if equations.slides { Rows::of_slide(equations) } else { Rows::of_turn(equations) }
    }

    /// The vectors across the hidden axis `w` fulfil Rodrigues' equation `b - a = x w x (a + b)`.
    fn of_turn(equations: &Equations<T>) -> Self {
        let (near, far) = (&equations.turned.functions, &equations.reached.functions);
        let square = equations.square;
        Rows {
            still: std::array::from_fn(|k| difference(&near[k], &far[k])),
            constant: std::array::from_fn(|k| difference(&near[STILL + k], &far[STILL + k])),
            linear: std::array::from_fn(|k| match k {
                0..TURNING => sum(&near[STILL + TURNING + k], &far[STILL + TURNING + k]),
                _ => sum(&near[STILL - TURNING + k], &far[STILL - TURNING + k]).map(|entry| -(entry * square)),
            }),
        }
    }

    /// A slide by `2 x w` is `exp(2 x N)` with `N^3 = 0`, so that `b - a = x N (a + b)` for all fourteen functions. Of directions it leaves
    /// ten alone. Four of them stand among the moving ones: `r = 0` and `s = 0` as `s - x r = 0` and `-r - x s = 0`, which say the same for
    /// all `x` but `i` and `-i`.
    fn of_slide(equations: &Equations<T>) -> Self {
        let (near, far) = (&equations.turned.functions, &equations.reached.functions);
        let square = equations.square;
        let (unmoved, sliding) =
            if equations.is_directed { (&UNMOVED_DIRECTED, &SLIDING_DIRECTED) } else { (&UNMOVED, &SLIDING) };
        let image = |k: usize| {
            let (_, function, factor) = sliding[k];
            let row = sum(&near[function], &far[function]);
            match factor {
                Factor::One => row,
                Factor::Minus => row.map(|entry| -entry),
                Factor::MinusTwo => row.map(|entry| -(entry + entry)),
                Factor::MinusSquare => row.map(|entry| -(entry * square)),
                Factor::TwoSquares => row.map(|entry| (entry + entry) * square),
                Factor::Still | Factor::StillBack => difference(&near[function], &far[function]),
                Factor::Constant => std::array::from_fn(|column| match column {
                    0 => -(square + square),
                    _ => square + -square,
                }),
            }
        };
        Rows {
            still: unmoved.map(|k| difference(&near[k], &far[k])),
            constant: std::array::from_fn(|k| match sliding[k] {
                (function, _, Factor::StillBack) => difference(&near[function], &far[function]).map(|entry| -entry),
                (function, ..) => difference(&near[function], &far[function]),
            }),
            linear: std::array::from_fn(image),
        }
    }
}

/// The functions that a slide leaves alone: `l`, the component of `p x l` along the axis, those of `p` across it.
const UNMOVED: [usize; STILL] = [1, STILL + 1, STILL + TURNING + 1, 2, STILL, STILL + TURNING];

/// What a slide multiplies a function by.
#[derive(Clone, Copy)]
enum Factor {
    One,
    Minus,
    MinusTwo,
    MinusSquare,
    TwoSquares,
    /// Both functions stay; of `StillBack` the first one's sign changes.
    Still,
    StillBack,
    /// Whatever the function is, the image is the constant `-w.w`, from both sides.
    Constant,
}

/// The other functions, and which multiple of which function `-N` makes of each: `N p = w`, `N (p x l) = w x l`,
/// `N ((p.p) l - 2 (p.l) p) = -2 w x (p x l) - 2 (p.l) w`, `N (p.p) = 2 p.w`, `N (p.l) = l.w`.
const SLIDING: [(usize, usize, Factor); MOVING] = [
    (0, 0, Factor::Constant),
    (STILL + 2, STILL + TURNING + 1, Factor::One),
    (STILL + TURNING + 2, STILL + 1, Factor::MinusSquare),
    (3, TURNING + 1, Factor::TwoSquares),
    (STILL + 3, STILL + TURNING + 2, Factor::MinusTwo),
    (STILL + TURNING + 3, STILL + 2, Factor::TwoSquares),
    (TURNING, 0, Factor::MinusTwo),
    (TURNING + 1, 1, Factor::Minus),
];

/// The same of the functions `a`, `l`, `p x l`, `l x a`, `p.a` and `p.(l x a)`, for a fourth joint that slides: directions stay.
const UNMOVED_DIRECTED: [usize; STILL] = [0, 1, 2, 3, STILL, STILL + 1];

/// `N (p x l) = w x l`, `N (p.a) = w.a`, `N (p.(l x a)) = w.(l x a)`; the first four
/// stay.
const SLIDING_DIRECTED: [(usize, usize, Factor); MOVING] = [
    (STILL + TURNING, STILL + 3, Factor::Still),
    (STILL + 3, STILL + TURNING, Factor::StillBack),
    (STILL + TURNING + 3, STILL + TURNING + 1, Factor::Still),
    (STILL + TURNING + 1, STILL + TURNING + 3, Factor::StillBack),
    (STILL + 2, STILL + TURNING + 1, Factor::One),
    (STILL + TURNING + 2, STILL + 1, Factor::MinusSquare),
    (TURNING, 0, Factor::Minus),
    (TURNING + 1, 3, Factor::Minus),
];

/// `a + b` in both sides' products.
fn sum<T: Scalar>(a: &[T; PRODUCTS], b: &[T; PRODUCTS]) -> Row<T> {
    difference(a, &b.map(|entry| -entry))
}

/// `a - b` in both sides' products, whose 1 is the same.
fn difference<T: Scalar>(a: &[T; PRODUCTS], b: &[T; PRODUCTS]) -> Row<T> {
    std::array::from_fn(|column| match column {
        0 => a[0] - b[0],
        1..PRODUCTS => a[column],
        _ => -b[column - FAR],
    })
}

/// The near joint whose half angle or way the equations are multiplied by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Doubled<T> {
    /// Whether it is the second one.
    pub second: bool,
    /// Whether it slides.
    pub slides: bool,
    /// `n` of its axis.
    pub square: T,
}

impl<T: Scalar> Doubled<T> {
    /// The near products of a row in the monomials `C^2, C S, S^2` of half the angle of the joint, each with 1, c, s of the other one:
    /// `1 = C^2 + n S^2`, `c = C^2 - n S^2`, `s' = 2 C S`; for a joint that slides, `1 = C^2`, `d' = C S`, `d'^2 = S^2`.
    pub fn monomials(&self, row: &Row<T>) -> [[T; 3]; 3] {
        let (step, other) = if self.second { (1, 3) } else { (3, 1) };
        let mut table = [[row[0]; 3]; 3];
        for k in 0..3 {
            let [one, even, odd] = [0, 1, 2].map(|index| row[k * other + index * step]);
            (table[0][k], table[1][k], table[2][k]) =
                if self.slides { (one, odd, even) } else { (one + even, odd + odd, (one - even) * self.square) };
        }
        table
    }
}
