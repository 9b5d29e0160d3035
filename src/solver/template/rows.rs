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
    /// What is turned, less what it is turned into; for the vectors across the hidden axis `w` by Rodrigues' equation
    /// `b - a = x w x (a + b)`.
    pub fn new(equations: &Equations<T>) -> Self {
        let (near, far) = (&equations.turned, &equations.reached);
        let ([near_e, near_f], [far_e, far_f]) = (&near.turning, &far.turning);
        let square = equations.square;
        let negated = |row: Row<T>| row.map(|entry| -(entry * square));
        Rows {
            still: std::array::from_fn(|k| difference(&near.still[k], &far.still[k])),
            constant: std::array::from_fn(|k| match k {
                0..TURNING => difference(&near_e[k], &far_e[k]),
                _ => difference(&near_f[k - TURNING], &far_f[k - TURNING]),
            }),
            linear: std::array::from_fn(|k| match k {
                0..TURNING => difference(&near_f[k], &far_f[k].map(|entry| -entry)),
                _ => negated(difference(&near_e[k - TURNING], &far_e[k - TURNING].map(|entry| -entry))),
            }),
        }
    }
}

/// `a - b` in both sides' products, whose 1 is the same.
fn difference<T: Scalar>(a: &[T; PRODUCTS], b: &[T; PRODUCTS]) -> Row<T> {
    std::array::from_fn(|column| match column {
        0 => a[0] - b[0],
        1..PRODUCTS => a[column],
        _ => -b[column - FAR],
    })
}

/// The near products of a row in the monomials `C^2, C S, S^2` of half the angle of one near joint, each with 1, c, s of the other one;
/// `n` of the doubled axis is `square`: `1 = C^2 + n S^2`, `c = C^2 - n S^2`, `s' = 2 C S`.
pub fn halved<T: Scalar>(row: &Row<T>, second: bool, square: T) -> [[T; 3]; 3] {
    let (step, other) = if second { (1, 3) } else { (3, 1) };
    let mut table = [[row[0]; 3]; 3];
    for k in 0..3 {
        let [one, cosine, sine] = [0, 1, 2].map(|index| row[k * other + index * step]);
        (table[0][k], table[1][k], table[2][k]) = (one + cosine, sine + sine, (one - cosine) * square);
    }
    table
}
