//! Feasible stances of a walker on a floor. Main type: [`Stances`].

use std::f64::consts::TAU;

use nalgebra::Point2;

use super::floor::Floor;
use super::pilot::Pilot;
use crate::gait::{Footprint, Polygon, Side};
use crate::nav::{Map, Shape};
use crate::{Result, Watch};

/// The number of headings at which a stance is tried.
pub(super) const HEADINGS: usize = 16;

/// A walker on a floor, with the areas that it covers including its distance from obstacles.
pub(super) struct Stances<'a> {
    pub(super) pilot: &'a Pilot,
    pub(super) floor: &'a Floor,
    /// The area during steps on the spot, and during its greatest steps, in the frame of the middle of the feet.
    outlines: [Polygon; 2],
    /// By heading, the cells that body and soles cover side by side about the middle of a cell, as columns and rows
    /// relative to it.
    covered: [Vec<[i64; 2]>; HEADINGS],
}

impl<'a> Stances<'a> {
    /// # Errors
    /// As [`Map::new`].
    pub(super) fn new(pilot: &'a Pilot, floor: &'a Floor) -> Result<Self> {
        let outlines = pilot.outlines().map(|outline| floor.grown(outline));
        let mut stances = Stances { pilot, floor, outlines, covered: Default::default() };
        stances.covered = stances.cells()?;
        Ok(stances)
    }

    /// The covered cells by heading.
    fn cells(&self) -> Result<[Vec<[i64; 2]>; HEADINGS]> {
        let map = self.floor.map();
        let reach =
            self.outlines[0].corners().iter().map(|corner| corner.coords.norm()).fold(self.pilot.radius(), f64::max);
        let half = (reach / map.resolution()).ceil() as i64 + 1;
        let side = (2 * half + 1) as usize;
        let around = Map::new(side, side, map.resolution())?.placed(Point2::origin(), map.yaw())?;
        let at = around.centre(around.cells().len() / 2);
        let mut all: [Vec<[i64; 2]>; HEADINGS] = Default::default();
        for (heading, covered) in all.iter_mut().enumerate() {
            let middle = Footprint { x: at.x, y: at.y, yaw: yaw(heading) };
            let feet = middle.feet(self.pilot.half_width());
            let sole = |side: Side| feet[side as usize].carry_all(self.sole(side));
            let parts = [middle.carry_all(self.outlines[0].corners()), sole(Side::Left), sole(Side::Right)];
            let with = around.with(&parts.map(Shape::Polygon))?;
            let taken = (0..with.cells().len()).filter(|cell| !with.is_free(*cell)).map(|cell| cell as i64);
            covered.extend(taken.map(|cell| [cell % side as i64 - half, cell / side as i64 - half]));
        }
        Ok(all)
    }

    /// Whether there is room for a foot at its landing pose, and for the body between both feet; for a stride, the area
    /// of the greatest steps counts.
    pub(super) fn fits(&self, feet: &[Footprint; 2], landed: Side, strides: bool) -> bool {
        self.is_on_floor(feet, landed) && self.has_room(&feet[0].middle(&feet[1]), strides)
    }

    /// Whether there is room with the feet side by side about the middle of a cell, at a heading.
    pub(super) fn stands(&self, cell: usize, heading: usize) -> bool {
        let map = self.floor.map();
        let (columns, rows) = (map.columns() as i64, map.rows() as i64);
        let (column, row) = (cell as i64 % columns, cell as i64 / columns);
        self.covered[heading].iter().all(|[right, up]| {
            let (column, row) = (column + right, row + up);
            (0..columns).contains(&column) && (0..rows).contains(&row) && map.is_free((row * columns + column) as usize)
        })
    }

    /// Whether there is room for the body.
    pub(super) fn has_room(&self, middle: &Footprint, strides: bool) -> bool {
        let outline = &self.outlines[usize::from(strides)];
        self.floor.is_far(&middle.point(), self.pilot.radius())
            || self.floor.under(middle.carry_all(outline.corners())).is_none()
    }

    /// Whether a sole is on free cells.
    fn is_on_floor(&self, feet: &[Footprint; 2], side: Side) -> bool {
        self.floor.under(feet[side as usize].carry_all(self.sole(side))).is_none()
    }

    fn sole(&self, side: Side) -> &[Point2<f64>] {
        &self.pilot.walker().biped.feet[side as usize].corners
    }

    /// The map of positions for the middle of the feet side by side, at the middles of cells, at one heading at least.
    /// It is narrower than the map of the core, and no proof.
    ///
    /// # Errors
    /// As [`Map::grown`]; [`Watch::check`].
    pub(super) fn places(&self, watch: &Watch) -> Result<Map> {
        // A heading that fits in a cell usually fits in the next one.
        let (mut last, mut looked, mut ended) = (0, 0u32, Ok(()));
        let map = self.floor.of_core(self.pilot)?.keeping_where(|cell| {
            looked += 1;
            if looked.is_multiple_of(1024) && ended.is_ok() {
                ended = watch.check();
            }
            let mut turns = (0..HEADINGS).map(|turn| (last + turn) % HEADINGS);
            let found = turns.find(|heading| ended.is_ok() && self.stands(cell, *heading));
            last = found.unwrap_or(last);
            found.is_some()
        });
        ended.map(|()| map)
    }
}

/// A heading \[rad\].
pub(super) fn yaw(heading: usize) -> f64 {
    TAU * heading as f64 / HEADINGS as f64
}
