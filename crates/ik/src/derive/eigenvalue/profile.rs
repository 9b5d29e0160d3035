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

use super::residue::Residue;
use super::screw::{Axis, Figure};
use super::vector::{Vector, cross, dot, scale, sub};

/// Functions that the motion along the frame's axis leaves alone.
pub(super) const STILL: usize = 6;
/// Vectors among the functions.
pub(super) const TURNING: usize = 4;
/// All functions: of each vector the component along the frame's axis, the two scalars, the components along the two directions across.
const FUNCTIONS: usize = 3 * TURNING + 2;
/// The products of one of 1, c, s' of a first joint and one of 1, c, s' of a second one: the second changes fastest.
pub(super) const PRODUCTS: usize = 9;

/// Coefficients of the products.
pub(super) type Products = [Residue; PRODUCTS];
/// By function, its coefficients: along the axis, the scalars, along `e`, along `w x e`.
pub(super) type Profile = [Products; FUNCTIONS];

/// A frame on the axis whose angle or way is hidden.
pub(super) struct Frame {
    /// A point on the axis.
    origin: Vector,
    /// `w`, the axis; not zero, of any length.
    axis: Vector,
    /// `e`, perpendicular to `w`, and `w x e`.
    pub across: [Vector; 2],
}

impl Frame {
    /// A frame on `axis`.
    pub fn on(axis: &Axis) -> Self {
        let [x, y, z] = axis.direction;
        let zero = axis.units[0];
        // Of x, y, z one is not zero.
        let e = if x.value != 0 || y.value != 0 { [-y, x, zero] } else { [z, zero, zero] };
        Frame { origin: axis.point, axis: axis.direction, across: [e, cross(&axis.direction, &e)] }
    }

    /// The functions of `figure`, which the axis `second` moves first and then the axis `first`.
    pub fn profile(&self, first: &Axis, second: &Axis, figure: &Figure) -> Profile {
        let inner = second.samples().map(|by| figure.moved(second, by));
        let table = first.samples().map(|by| inner.map(|figure| self.functions(&figure.moved(first, by))));
        std::array::from_fn(|function| {
            let by_second = table.map(|values| second.coefficients(values.map(|values| values[function])));
            let by_first = [0, 1, 2].map(|k| first.coefficients(by_second.map(|values| values[k])));
            std::array::from_fn(|product| by_first[product % 3][product / 3])
        })
    }

    fn functions(&self, figure: &Figure) -> [Residue; FUNCTIONS] {
        let (p, l) = (sub(&figure.point, &self.origin), figure.direction);
        let (vectors, scalars) = if let Some(a) = figure.side {
            let b = cross(&l, &a);
            ([a, l, cross(&p, &l), b], [dot(&p, &a), dot(&p, &b)])
        } else {
            let (square, along) = (dot(&p, &p), dot(&p, &l));
            ([p, l, cross(&p, &l), sub(&scale(&l, square), &scale(&p, along + along))], [square, along])
        };
        let mut values = [scalars[0]; FUNCTIONS];
        values[TURNING + 1] = scalars[1];
        for (k, vector) in vectors.iter().enumerate() {
            values[k] = dot(&self.axis, vector);
            values[STILL + k] = dot(&self.across[0], vector);
            values[STILL + TURNING + k] = dot(&self.across[1], vector);
        }
        values
    }
}
