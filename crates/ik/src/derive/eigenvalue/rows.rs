//! The equations of a formulation as rows of coefficients modulo a prime ([`Rows`]), and the multiplication of a row by half an angle.
//!
//! The loop is `E1 E2 ... E6 = G` with any joint as the first one; the axes after the target are then moved to its other side. The line of the fourth axis is
//! invariant under `E4`. So `E1` maps `E2 E3 (line 4)` to `G E6^-1 E5^-1 (line 4)`, with two joints on each side of the hidden one. Each joint may be revolute
//! or prismatic.

use super::profile::{Frame, PRODUCTS, Products, Profile, STILL, TURNING};
use super::residue::Residue;
use super::screw::{Axis, Figure};
use crate::solver::eigenvalue::Formulation;

/// The number of products of the joints on the far side, without 1.
pub(super) const FAR: usize = PRODUCTS - 1;
/// The number of columns: products of the joints on the near side, including 1, then those on the far side.
const COLUMNS: usize = PRODUCTS + FAR;
/// The number of equations that contain the hidden angle.
pub(super) const MOVING: usize = 2 * TURNING;

/// The coefficients of the near products and of the far ones.
pub(super) type Row = [Residue; COLUMNS];

/// The equations: `still = 0` and `constant - x linear = 0` with `x sqrt n` the tangent of half the hidden angle.
pub(super) struct Rows {
    /// The rows without the hidden angle.
    pub still: [Row; STILL],
    /// The constant coefficients in `x`.
    pub constant: [Row; MOVING],
    /// The coefficients of `-x`.
    pub linear: [Row; MOVING],
}

impl Rows {
    /// The rows of a formulation. `figures` are the invariants of the axes, `moved` these after the target's motion, `back` after its inverse.
    pub fn of(formulation: Formulation, axes: &[Axis; 6], [figures, moved, back]: [&[Figure; 6]; 3]) -> Self {
        let place = |steps: usize, ahead: bool| {
            let joint = formulation.joint(steps);
            match (ahead, formulation.hidden + steps >= 6) {
                (true, true) => back[joint],
                (false, false) => moved[joint],
                _ => figures[joint],
            }
        };
        let axis = |steps: usize, ahead: bool| {
            let Figure { direction, point, .. } = place(steps, ahead);
            Axis { direction, point, ..axes[formulation.joint(steps)] }
        };
        let hidden = &axes[formulation.hidden];
        let frame = Frame::on(hidden);
        let near = frame.profile(&axis(1, true), &axis(2, true), &place(3, true));
        let far = frame.profile(&axis(5, false), &axis(4, false), &place(3, false));
        match (hidden.slides, axes[formulation.joint(3)].slides) {
            (false, _) => Rows::of_turn(&near, &far, hidden.square),
            (true, false) => Rows::of_slide(&near, &far, hidden.square, &UNMOVED, &SLIDING),
            (true, true) => Rows::of_slide(&near, &far, hidden.square, &UNMOVED_DIRECTED, &SLIDING_DIRECTED),
        }
    }

    /// The vectors perpendicular to the hidden axis `w` fulfil Rodrigues' equation `b - a = x w x (a + b)`.
    fn of_turn(near: &Profile, far: &Profile, square: Residue) -> Self {
        Rows {
            still: std::array::from_fn(|k| difference(&near[k], &far[k])),
            constant: std::array::from_fn(|k| difference(&near[STILL + k], &far[STILL + k])),
            linear: std::array::from_fn(|k| match k {
                0..TURNING => sum(&near[STILL + TURNING + k], &far[STILL + TURNING + k]),
                _ => sum(&near[STILL - TURNING + k], &far[STILL - TURNING + k]).map(|entry| -(entry * square)),
            }),
        }
    }

    /// A displacement of `2 x w` is `exp(2 x N)` with `N^3 = 0`, so `b - a = x N (a + b)` for all fourteen functions. Ten functions of directions are
    /// invariant. Four of these are among the moving rows: `r = 0` and `s = 0` are written as `s - x r = 0` and `-r - x s = 0`, which are equivalent for all
    /// `x` except `i` and `-i`.
    fn of_slide(
        near: &Profile,
        far: &Profile,
        square: Residue,
        unmoved: &[usize; STILL],
        sliding: &[(usize, usize, Factor); MOVING],
    ) -> Self {
        let image = |&(_, function, factor): &(usize, usize, Factor)| {
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
            constant: sliding.each_ref().map(|&(function, _, factor)| {
                let row = difference(&near[function], &far[function]);
                if factor == Factor::StillBack { row.map(|entry| -entry) } else { row }
            }),
            linear: sliding.each_ref().map(image),
        }
    }
}

/// The invariant functions of a prismatic joint: `l`, the component of `p x l` along the axis, the perpendicular components of `p`.
const UNMOVED: [usize; STILL] = [1, STILL + 1, STILL + TURNING + 1, 2, STILL, STILL + TURNING];

/// The factor by which the motion of a prismatic joint multiplies a function.
#[derive(Clone, Copy, PartialEq)]
enum Factor {
    One,
    Minus,
    MinusTwo,
    MinusSquare,
    TwoSquares,
    /// Both functions are invariant. For `StillBack`, the sign of the first one changes.
    Still,
    StillBack,
    /// The image is the constant `-w.w` from both sides, independent of the function.
    Constant,
}

/// The other functions, each with the function and the factor in its image under `-N`: `N p = w`, `N (p x l) = w x l`, `N ((p.p) l - 2 (p.l) p) = -2 w x (p x
/// l) - 2 (p.l) w`, `N (p.p) = 2 p.w`, `N (p.l) = l.w`.
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

/// Same as [`UNMOVED`], but for a prismatic fourth joint, with the functions `a`, `l`, `p x l`, `l x a`, `p.a` and `p.(l x a)`. Directions are invariant.
const UNMOVED_DIRECTED: [usize; STILL] = [0, 1, 2, 3, STILL, STILL + 1];

/// Same as [`SLIDING`], but for a prismatic fourth joint: `N (p x l) = w x l`, `N (p.a) = w.a`, `N (p.(l x a)) = w.(l x a)`. The first four are invariant.
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

/// `a + b` in the products of both sides.
fn sum(a: &Products, b: &Products) -> Row {
    difference(a, &b.map(|entry| -entry))
}

/// `a - b` in the products of both sides, which have the product 1 in common.
fn difference(a: &Products, b: &Products) -> Row {
    std::array::from_fn(|column| match column {
        0 => a[0] - b[0],
        1..PRODUCTS => a[column],
        _ => -b[column - FAR],
    })
}

/// The near joint by whose half angle or displacement the equations are multiplied.
pub(super) struct Doubled {
    /// Whether it is the second joint after the hidden one.
    pub second: bool,
    /// Whether it is prismatic.
    pub slides: bool,
    /// `n` of its axis.
    pub square: Residue,
}

impl Doubled {
    /// The near products of a row in the monomials `C^2, C S, S^2` of the joint's half angle, each with 1, c, s of the other joint. `1 = C^2 + n S^2`, `c = C^2
    /// - n S^2`, `s' = 2 C S`. For a prismatic joint, `1 = C^2`, `d' = C S`, `d'^2 = S^2`.
    pub fn monomials(&self, row: &Row) -> [[Residue; 3]; 3] {
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
