//! What is affine in the cosine and sine of every joint ([`Profile`]): the functions of Raghavan and Roth.
//!
//! Of a line with direction `l` through a point `p`, the fourteen functions `p`, `l`, `p x l`, `(p.p) l - 2 (p.l) p`, `p.p` and `p.l`
//! span a space that rigid motions map into itself, and a turn about an axis acts on it by a matrix that is affine in the cosine and
//! sine of the angle (M. Raghavan and B. Roth, J. Mechanical Design 115 (1993) 502-508). When the origin is on that axis, the part of
//! the four vectors along it and the two scalars stay, six functions; the part of the vectors across it turns.

use super::scalar::{Scalar, Vector, cross, dot, scale, sub};
use super::screw::{Axis, Line};

/// Functions that the turn about the frame's axis leaves alone.
pub const STILL: usize = 6;
/// Vectors whose parts across the frame's axis turn with it.
pub const TURNING: usize = 4;
/// The products of one of 1, c, s' of a first joint and one of 1, c, s' of a second one: the second changes fastest.
pub const PRODUCTS: usize = 9;

/// A frame on the axis whose angle is hidden.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame<T> {
    /// A point on the axis.
    pub origin: Vector<T>,
    /// `w`, the axis; not zero, of any length.
    pub axis: Vector<T>,
    /// `e`, perpendicular to `w`, and `w x e`.
    pub across: [Vector<T>; 2],
}

/// The coefficients of the functions of a line that two joints turn, in the nine products of their cosines and sines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profile<T> {
    /// Of the components along the axis, and the two scalars.
    pub still: [[T; PRODUCTS]; STILL],
    /// Of the components along the two directions across.
    pub turning: [[[T; PRODUCTS]; TURNING]; 2],
}

/// The values of the functions, in the order still, along `e`, along `w x e`.
type Values<T> = [T; STILL + 2 * TURNING];

impl<T: Scalar> Profile<T> {
    /// The functions of `line`, which the axis `second` turns first and then the axis `first`.
    pub fn new(frame: &Frame<T>, first: &Axis<T>, second: &Axis<T>, line: &Line<T>) -> Self {
        let inner = second.samples().map(|turn| line.turned(second, turn));
        let table = first.samples().map(|turn| inner.map(|line| frame.functions(&line.turned(first, turn))));
        let row = |function: usize| {
            let samples = table.map(|values| values.map(|values| values[function]));
            let by_second = samples.map(|values| second.coefficients(values));
            let by_first = [0, 1, 2].map(|k| first.coefficients(by_second.map(|values| values[k])));
            std::array::from_fn(|product| by_first[product % 3][product / 3])
        };
        Profile {
            still: std::array::from_fn(row),
            turning: [0, 1].map(|side| std::array::from_fn(|k| row(STILL + side * TURNING + k))),
        }
    }
}

impl<T: Scalar> Frame<T> {
    fn functions(&self, line: &Line<T>) -> Values<T> {
        let (p, l) = (sub(&line.point, &self.origin), line.direction);
        let (square, along) = (dot(&p, &p), dot(&p, &l));
        let vectors = [p, l, cross(&p, &l), sub(&scale(&l, square), &scale(&p, along + along))];
        let [w, e, f] = [self.axis, self.across[0], self.across[1]];
        let mut values = [square; STILL + 2 * TURNING];
        values[TURNING + 1] = along;
        for (k, vector) in vectors.iter().enumerate() {
            values[k] = dot(&w, vector);
            values[STILL + k] = dot(&e, vector);
            values[STILL + TURNING + k] = dot(&f, vector);
        }
        values
    }
}
