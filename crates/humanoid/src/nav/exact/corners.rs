//! Distances of corners from a goal. Main type: [`Corners`].

use nalgebra::Point2;

/// A corner as found by the search.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub place: Point2<f64>,
    /// Its distance from the goal, in cells.
    pub length: f64,
    /// One plus the number of the next corner on the path to the goal; zero where the goal is visible.
    pub next: u32,
}

/// The corners from which a path leads to a goal.
#[derive(Clone, Debug)]
pub(super) struct Corners {
    /// By lattice point, one plus the number of its corner; zero where it is no corner or no path leads to it.
    pub numbers: Vec<u32>,
    pub corners: Vec<Corner>,
}

impl Corners {
    /// The number of a corner plus one, and its distance.
    pub fn corner(&self, point: usize) -> Option<(u32, f64)> {
        let number = self.numbers[point];
        Some((number, self.corners.get(number.checked_sub(1)? as usize)?.length))
    }
}
