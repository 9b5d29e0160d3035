//! How far corners are from a goal. Main type: [`Corners`].

use nalgebra::Point2;

/// A corner as the search found it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub place: Point2<f64>,
    /// To the goal, in cells.
    pub length: f64,
    /// The next corner on the way there, one more than its number; nought where the goal is seen.
    pub next: u32,
}

/// The corners from which a way leads to a goal.
#[derive(Clone, Debug)]
pub(super) struct Corners {
    /// By lattice point the number of its corner and one more, nought where it is none or no way leads to it.
    pub numbers: Vec<u32>,
    pub corners: Vec<Corner>,
}

impl Corners {
    /// The number of a corner, one more than its place, and how far it is.
    pub fn corner(&self, point: usize) -> Option<(u32, f64)> {
        let number = self.numbers[point];
        Some((number, self.corners.get(number.checked_sub(1)? as usize)?.length))
    }
}
