//! The elements of a search for a shortest path: roots, windows and the goal. Main type: [`Window`].

use nalgebra::Point2;

use super::plane::Spot;

/// The number for no root.
pub(super) const NONE: u32 = u32::MAX;

/// A start or a corner, and the path to it.
pub(super) struct Root {
    pub spot: Spot,
    pub real: Point2<f64>,
    /// Its distance from the start, in cells.
    pub length: f64,
    pub before: u32,
    /// The direction in which a path of that length arrived that turned left there, and right.
    pub turns: [Option<Spot>; 2],
}

/// The root of a view, and the row that it enters upwards or downwards.
#[derive(Clone, Copy)]
pub(super) struct View {
    pub root: u32,
    pub row: u32,
    pub is_up: bool,
    /// The root's length at the time of the query.
    pub length: f64,
}

impl View {
    /// The height of the lattice line through which the row is entered.
    pub fn line(&self) -> usize {
        self.row as usize + usize::from(!self.is_up)
    }

    /// Positive where `other` has a greater x than the ray at the same height, negative for a lesser one; both begin at
    /// the root.
    #[inline]
    pub fn side(&self, ray: Spot, other: Spot) -> i128 {
        if self.is_up { -ray.cross(other) } else { ray.cross(other) }
    }
}

/// The rays that bound a view, from the root; `None` where only walls do.
pub(super) type Rays = [Option<Spot>; 2];

/// An interval of the line through which a view enters its row.
#[derive(Clone, Copy)]
pub(super) struct Window {
    pub view: View,
    /// The rays to its ends, the one of the lesser x first.
    pub rays: [Spot; 2],
    /// The opening that it is part of: cells from the first number to before the second are free on both sides of the
    /// line.
    pub opening: (u32, u32),
}

/// A goal: its cell and its position.
#[derive(Clone, Copy)]
pub(super) struct Goal {
    pub cell: (usize, usize),
    pub spot: Spot,
    pub real: Point2<f64>,
}
