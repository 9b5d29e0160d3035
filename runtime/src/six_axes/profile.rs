//! What is affine in the cosine and sine of every joint ([`Profile`]): the functions of Raghavan and Roth.
//!
//! Of a line with direction `l` through a point `p`, the fourteen functions `p`, `l`, `p x l`, `(p.p) l - 2 (p.l) p`, `p.p` and `p.l` span a space that
//! rigid motions map into itself. When the origin is on the axis of a turn, the part of the four vectors along it and the two scalars stay, six functions;
//! the part of the vectors across it turns. A joint that slides acts on them by polynomials of degree two in its way, 1, d^2, d in the place of 1, c, s.
//! What such a joint leaves alone is its direction `l`, a direction `a` across it, and lines along `l`: `a`, `l`, `p x l`, `l x a`, `p.a` and `p.(l x a)`
//! are fourteen functions of the same kind.

use core::array::from_fn;

use super::screw::{Axis, Figure};
use super::vector::{Vector, cross, dot, scale, sub};

/// Functions that the motion along the hidden axis leaves alone.
pub(super) const STILL: usize = 6;
/// Vectors among the functions.
pub(super) const TURNING: usize = 4;
/// All functions: of each vector the component along the hidden axis, the two scalars, the components along the two directions across.
pub(super) const FUNCTIONS: usize = 3 * TURNING + 2;
/// The products of one of 1, c, s of a first joint and one of 1, c, s of a second one: the second changes fastest.
pub(super) const PRODUCTS: usize = 9;

/// Coefficients of the products.
pub(super) type Products = [f64; PRODUCTS];
/// By function, its coefficients.
pub(super) type Profile = [Products; FUNCTIONS];

/// The frame on the axis whose angle or way is hidden.
pub(super) struct Frame<'a> {
    pub axis: Axis,
    /// Two directions across it.
    pub across: &'a [Vector; 2],
}

impl Frame<'_> {
    /// The functions of a figure that the axis `second` moves first and then the axis `first`.
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
