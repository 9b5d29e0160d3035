//! What is affine in the cosine and sine of every joint ([`Profile`]): the functions of Raghavan and Roth.
//!
//! Of a line with direction `l` through a point `p`, the fourteen functions `p`, `l`, `p x l`, `(p.p) l - 2 (p.l) p`, `p.p` and `p.l`
//! span a space that rigid motions map into itself, and a turn about an axis acts on it by a matrix that is affine in the cosine and
//! sine of the angle (M. Raghavan and B. Roth, J. Mechanical Design 115 (1993) 502-508). When the origin is on that axis, the part of
//! the four vectors along it and the two scalars stay, six functions; the part of the vectors across it turns.
//!
//! A joint that slides acts on them by polynomials of degree two in its way, 1, d^2, d in the place of 1, c, s. What such a joint leaves
//! alone is its direction `l`, a direction `a` across it, and lines along `l`: the vectors `a`, `l`, `p x l`, `l x a` and the scalars
//! `p.a`, `p.(l x a)` are fourteen functions of the same kind.

use super::scalar::{Scalar, Vector, cross, dot, scale, sub};
use super::screw::{Axis, Figure};

/// Functions that the motion along the frame's axis leaves alone.
pub const STILL: usize = 6;
/// Vectors among the functions.
pub const TURNING: usize = 4;
/// All functions: of each vector the component along the frame's axis, the two scalars, the components along the two directions across.
pub const FUNCTIONS: usize = 3 * TURNING + 2;
/// The products of one of 1, c, s' of a first joint and one of 1, c, s' of a second one: the second changes fastest.
pub const PRODUCTS: usize = 9;

/// A frame on the axis whose angle or way is hidden.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame<T> {
    /// A point on the axis.
    pub origin: Vector<T>,
    /// `w`, the axis; not zero, of any length.
    pub axis: Vector<T>,
    /// `e`, perpendicular to `w`, and `w x e`.
    pub across: [Vector<T>; 2],
}

/// The coefficients of the functions of a figure that two joints move, in the nine products of their coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profile<T> {
    /// By function: along the axis, the scalars, along `e`, along `w x e`.
    pub functions: [[T; PRODUCTS]; FUNCTIONS],
}

impl<T: Scalar> Profile<T> {
    /// The functions of `figure`, which the axis `second` moves first and then the axis `first`.
    pub fn new(frame: &Frame<T>, first: &Axis<T>, second: &Axis<T>, figure: &Figure<T>) -> Self {
        let inner = second.samples().map(|by| figure.moved(second, by));
        let table = first.samples().map(|by| inner.map(|figure| frame.functions(&figure.moved(first, by))));
        let row = |function: usize| {
            let samples = table.map(|values| values.map(|values| values[function]));
            let by_second = samples.map(|values| second.coefficients(values));
            let by_first = [0, 1, 2].map(|k| first.coefficients(by_second.map(|values| values[k])));
            std::array::from_fn(|product| by_first[product % 3][product / 3])
        };
        Profile { functions: std::array::from_fn(row) }
    }
}

impl<T: Scalar> Frame<T> {
    fn functions(&self, figure: &Figure<T>) -> [T; FUNCTIONS] {
        let (p, l) = (sub(&figure.line.point, &self.origin), figure.line.direction);
        let (vectors, scalars) = if let Some(a) = figure.side {
            let b = cross(&l, &a);
            ([a, l, cross(&p, &l), b], [dot(&p, &a), dot(&p, &b)])
        } else {
            let (square, along) = (dot(&p, &p), dot(&p, &l));
            ([p, l, cross(&p, &l), sub(&scale(&l, square), &scale(&p, along + along))], [square, along])
        };
        let [w, e, f] = [self.axis, self.across[0], self.across[1]];
        let mut values = [scalars[0]; FUNCTIONS];
        values[TURNING + 1] = scalars[1];
        for (k, vector) in vectors.iter().enumerate() {
            values[k] = dot(&w, vector);
            values[STILL + k] = dot(&e, vector);
            values[STILL + TURNING + k] = dot(&f, vector);
        }
        values
    }
}
