//! Functions that are affine in the cosine and sine of every joint ([`Profile`]), after Raghavan and Roth.
//!
//! Let a line have the direction `l` and a point `p`. The fourteen functions `p`, `l`, `p x l`, `(p.p) l - 2 (p.l) p`, `p.p` and `p.l` span a space that rigid
//! motions map to itself. A rotation about an axis acts on it by a matrix that is affine in the cosine and sine of the angle (M. Raghavan and B. Roth, J.
//! Mechanical Design 115 (1993) 502-508).
//!
//! Let the origin be on that axis. Six functions are then invariant: the components of the four vectors along the axis, and the two scalars. The perpendicular
//! components of the vectors rotate.
//!
//! A prismatic joint acts on them by polynomials of degree two in its displacement d: 1, d^2, d in place of 1, c, s. Its invariants are its direction `l`, a
//! direction `a` perpendicular to it, and lines along `l`. The vectors `a`, `l`, `p x l`, `l x a` and the scalars `p.a`, `p.(l x a)` are fourteen functions
//! with the same properties.

use super::residue::Residue;
use super::screw::{Axis, Figure};
use super::vector::{Vector, cross, dot, scale, sub};

/// The number of functions that are invariant under the motion along the frame's axis.
pub(super) const STILL: usize = 6;
/// The number of vectors among the functions.
pub(super) const TURNING: usize = 4;
/// The number of functions. They are ordered: of each vector the component along the frame's axis, the two scalars, the components along the two perpendicular
/// directions.
const FUNCTIONS: usize = 3 * TURNING + 2;
/// The number of products of one of 1, c, s' of a first joint and one of 1, c, s' of a second one. The factor of the second joint changes fastest.
pub(super) const PRODUCTS: usize = 9;

/// The coefficients of the products.
pub(super) type Products = [Residue; PRODUCTS];
/// The coefficients of each function: components along the axis, scalars, components along `e`, components along `w x e`.
pub(super) type Profile = [Products; FUNCTIONS];

/// A frame on the axis of the hidden joint.
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
        // At least one of x, y, z is not zero.
        let e = if x.value != 0 || y.value != 0 { [-y, x, zero] } else { [z, zero, zero] };
        Frame { origin: axis.point, axis: axis.direction, across: [e, cross(&axis.direction, &e)] }
    }

    /// The functions of `figure`, which is moved first by the axis `second` and then by the axis `first`.
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
