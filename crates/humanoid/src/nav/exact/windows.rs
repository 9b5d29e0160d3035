//! What a search for a shortest way sees: roots, windows and the goal. Main type: [`Window`].

use nalgebra::Point2;

use super::plane::Spot;

/// No root.
pub(super) const NONE: u32 = u32::MAX;

/// A start or a corner, and how one gets there.
pub(super) struct Root {
    pub spot: Spot,
    pub real: Point2<f64>,
    /// How far it is from the start, in cells.
    pub length: f64,
    pub before: u32,
    /// In which direction a way of that length came that turned to the left there, and to the right.
    pub turns: [Option<Spot>; 2],
}

/// From which root one goes up or down into which row.
#[derive(Clone, Copy)]
pub(super) struct View {
    pub root: u32,
    pub row: u32,
    pub is_up: bool,
    /// The root's length when it looked.
    pub length: f64,
}

impl View {
    /// The height of the lattice line by which the row is entered.
    pub fn line(&self) -> usize {
        self.row as usize + usize::from(!self.is_up)
    }

    /// Above nought where `other` has a greater x than the ray has beside it, below for a lesser one; both begin at the root.
    #[inline]
    pub fn side(&self, ray: Spot, other: Spot) -> i128 {
        if self.is_up { -ray.cross(other) } else { ray.cross(other) }
    }
}

/// Between which rays one looks, from the root; nothing where only walls are in the way.
pub(super) type Rays = [Option<Spot>; 2];

/// A stretch of the line by which a view enters its row.
#[derive(Clone, Copy)]
pub(super) struct Window {
    pub view: View,
    /// The rays to its ends, the one of the lesser x first.
    pub rays: [Spot; 2],
    /// The opening that it is part of: cells from one to below the other are free on both sides of the line.
    pub opening: (u32, u32),
}

/// A goal: its cell and where it is.
#[derive(Clone, Copy)]
pub(super) struct Goal {
    pub cell: (usize, usize),
    pub spot: Spot,
    pub real: Point2<f64>,
}
