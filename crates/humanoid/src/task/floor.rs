//! The floor as a walker needs it. Main type: [`Floor`].

use nalgebra::Point2;

use super::body::around;
use super::pilot::Pilot;
use crate::gait::Polygon;
use crate::nav::{Map, Shape};
use crate::{Error, ErrorKind, Result};

/// A map and how far each of its places is from what stands there. Soles may touch obstacles; the body keeps away from them. Cells that have not been
/// seen are taken to be occupied.
#[derive(Clone, Debug)]
pub struct Floor {
    map: Map,
    clearances: Vec<f64>,
    apart: f64,
}

impl Floor {
    /// That of a map, with how far the body keeps away from obstacles \[m\].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another distance than a finite one that is not below zero.
    pub fn new(map: &Map, apart: f64) -> Result<Self> {
        if !(apart.is_finite() && apart >= 0.0) {
            let text =
                format!("the body keeps {apart} m away from obstacles; give a finite number, not below zero (--apart)");
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let map = map.clone().with_unknown_occupied();
        let clearances = map.clearances();
        Ok(Floor { map, clearances, apart })
    }

    /// The map.
    pub fn map(&self) -> &Map {
        &self.map
    }

    /// How far the body keeps away from obstacles \[m\].
    pub fn apart(&self) -> f64 {
        self.apart
    }

    /// Where a disc of this radius \[m\], which keeps away from obstacles, may have its middle: at the middles of cells that are free.
    ///
    /// # Errors
    /// As [`Map::grown`].
    pub fn of_disc(&self, radius: f64) -> Result<Map> {
        self.map.keeping(&self.clearances, radius + self.apart)
    }

    /// Where the middle of a pilot's core may be, at any place of a cell: what is not free here holds no pilot.
    ///
    /// # Errors
    /// As [`Map::grown`].
    pub fn of_core(&self, pilot: &Pilot) -> Result<Map> {
        self.of_disc((pilot.core() - self.map.half_diagonal()).max(0.0))
    }

    /// Whether all within a radius of a place \[m\] keeps away from obstacles, for sure: where this says no there may yet be room.
    pub fn is_far(&self, place: &Point2<f64>, radius: f64) -> bool {
        let own = self.map.in_map(place);
        let ends = [own.x, self.map.columns() as f64 - own.x, own.y, self.map.rows() as f64 - own.y];
        let border = ends.into_iter().fold(f64::INFINITY, f64::min) * self.map.resolution();
        // From the cell's middle to the place.
        let off = self.map.half_diagonal();
        border > radius && self.map.cell_at(place).is_ok_and(|cell| self.clearances[cell] - off > radius + self.apart)
    }

    /// A place where a sole would stand on an obstacle.
    pub fn under_sole(&self, sole: &Polygon) -> Option<Point2<f64>> {
        self.under(sole.corners().to_vec())
    }

    /// A place where a body would come too near to an obstacle.
    pub fn beside_body(&self, outline: &Polygon) -> Option<Point2<f64>> {
        self.under(self.grown(outline).corners().to_vec())
    }

    /// An outline and all that keeps away from it.
    pub(super) fn grown(&self, outline: &Polygon) -> Polygon {
        Polygon::hull(&outline.corners().iter().flat_map(|corner| around(*corner, self.apart)).collect::<Vec<_>>())
    }

    /// A place under a polygon that is not free.
    pub(super) fn under(&self, corners: Vec<Point2<f64>>) -> Option<Point2<f64>> {
        self.map.obstacle_under(&Shape::Polygon(corners))
    }
}
