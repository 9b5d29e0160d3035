//! Points in integer coordinates, so that orientations are decided exactly. Main types: [`Spot`], [`Plane`].

use nalgebra::Point2;

use crate::nav::map::Map;

/// A point or a vector in fractions of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::nav) struct Spot {
    pub x: i64,
    pub y: i64,
}

impl Spot {
    pub fn from(self, other: Spot) -> Spot {
        Spot { x: self.x - other.x, y: self.y - other.y }
    }

    /// The cross product: positive where `other` is left of this vector, zero where both are parallel.
    #[inline]
    pub fn cross(self, other: Spot) -> i128 {
        i128::from(self.x) * i128::from(other.y) - i128::from(self.y) * i128::from(other.x)
    }
}

/// The scale of integer coordinates. A cell has a power of two of parts: as many as its map's size leaves of 60 bits,
/// at most 2^50.
#[derive(Clone, Copy, Debug)]
pub(in crate::nav) struct Plane {
    shift: u32,
}

impl Plane {
    pub fn new(map: &Map) -> Self {
        let most = map.columns().max(map.rows()) + 2;
        Plane { shift: (60 - (usize::BITS - most.leading_zeros())).min(50) }
    }

    /// A lattice point.
    #[inline]
    pub fn lattice(self, x: usize, y: usize) -> Spot {
        Spot { x: (x as i64) << self.shift, y: (y as i64) << self.shift }
    }

    /// The integer coordinates of a point of a cell, given in cells. A point on the upper side of its cell is moved one
    /// part below it.
    pub fn spot(self, point: &Point2<f64>, (x, y): (usize, usize)) -> Spot {
        let whole = |x: f64| (x * (1u64 << self.shift) as f64).round() as i64;
        let (low, high) = (self.lattice(x, y), self.lattice(x + 1, y + 1));
        Spot { x: whole(point.x).clamp(low.x, high.x), y: whole(point.y).clamp(low.y, high.y - 1) }
    }

    /// The lattice point at the lower left of a point.
    pub fn floor(self, spot: Spot) -> (usize, usize) {
        ((spot.x >> self.shift) as usize, (spot.y >> self.shift) as usize)
    }
}
