//! Functions of Raghavan and Roth, affine in the cosine and sine of every joint ([`Profile`]).
//!
//! For a line with direction `l` through a point `p`, the fourteen functions `p`, `l`, `p x l`, `(p.p) l - 2 (p.l) p`, `p.p` and `p.l` span a space that rigid
//! motions map into itself. With the origin on the axis of a rotation, six functions are invariant: the components of the four vectors along the axis, and the
//! two scalars. The orthogonal components of the vectors rotate. A prismatic joint acts on them by polynomials of degree two in its displacement: 1, d^2, d
//! take the place of 1, c, s. Such a joint leaves invariant its direction `l`, a direction `a` orthogonal to it, and lines along `l`. Then `a`, `l`, `p x l`,
//! `l x a`, `p.a` and `p.(l x a)` are fourteen functions with equal properties.

use core::array::from_fn;

use super::screw::{Axis, Figure};
use super::vector::{Vector, cross, dot, scale, sub};

/// Number of functions that the motion along the hidden axis leaves invariant.
pub(super) const STILL: usize = 6;
/// Number of vectors among the functions.
pub(super) const TURNING: usize = 4;
/// All functions: of each vector the component along the hidden axis, then the two scalars, then the components along the two orthogonal directions.
pub(super) const FUNCTIONS: usize = 3 * TURNING + 2;
/// The products of one of 1, c, s of a first joint and one of 1, c, s of a second one; the second index changes fastest.
pub(super) const PRODUCTS: usize = 9;

/// Coefficients of the products.
pub(super) type Products = [f64; PRODUCTS];
/// By function, its coefficients.
pub(super) type Profile = [Products; FUNCTIONS];

/// The frame on the axis whose angle or displacement is hidden.
pub(super) struct Frame<'a> {
    pub axis: Axis,
    /// Two directions orthogonal to it.
    pub across: &'a [Vector; 2],
}

impl Frame<'_> {
    /// The functions of a figure moved first by the axis `second`, then by the axis `first`.
    pub fn profile(&self, first: &Axis, second: &Axis, figure: &Figure) -> Profile {
        let inner = second.samples().map(|by| figure.moved(second, by));
        let table = first.samples().map(|by| inner.map(|figure| self.functions(&figure.moved(first, by))));
        from_fn(|function| {
            let by_second = table.map(|values| second.coefficients(values.map(|values| values[function])));
            let by_first = [0, 1, 2].map(|k| first.coefficients(by_second.map(|values| values[k])));
            from_fn(|product| by_first[product % 3][product / 3])
        })
    }

    #[inline(always)]
    fn functions(&self, figure: &Figure) -> [f64; FUNCTIONS] {
        let (p, l) = (sub(&figure.point, &self.axis.point), figure.direction);
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
            values[k] = dot(&self.axis.direction, vector);
            values[STILL + k] = dot(&self.across[0], vector);
            values[STILL + TURNING + k] = dot(&self.across[1], vector);
        }
        values
    }
}
