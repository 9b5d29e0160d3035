//! The floor with the distances that a walker needs. Main type: [`Floor`].

use nalgebra::Point2;

use super::body::around;
use super::pilot::Pilot;
use crate::gait::Polygon;
use crate::nav::{Map, Shape};
use crate::{Error, ErrorKind, Result};

/// A map and the distance of each cell from obstacles. Soles may touch obstacles; the body keeps a distance from them.
/// Unknown cells count as occupied.
#[derive(Clone, Debug)]
pub struct Floor {
    map: Map,
    clearances: Vec<f64>,
    apart: f64,
}

impl Floor {
    /// Makes the floor of a map, with the least distance of the body from obstacles \[m\].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a distance that is not finite or below zero.
    pub fn new(map: &Map, apart: f64) -> Result<Self> {
        if !(apart.is_finite() && apart >= 0.0) {
            let text = format!(
                "the least distance of the body from obstacles is {apart} m; give a finite number, not below zero (--apart)"
            );
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

    /// The least distance of the body from obstacles \[m\].
    pub(crate) fn apart(&self) -> f64 {
        self.apart
    }

    /// The map of positions for the centre of a disc of this radius \[m\] that keeps its distance from obstacles: the
    /// middles of the free cells.
    ///
    /// # Errors
    /// As [`Map::grown`].
    pub fn of_disc(&self, radius: f64) -> Result<Map> {
        self.map.keeping(&self.clearances, radius + self.apart)
    }

    /// The map of positions for the middle of a pilot's core, anywhere in a cell. No position in an occupied cell is
    /// feasible.
    ///
    /// # Errors
    /// As [`Map::grown`].
    pub(crate) fn of_core(&self, pilot: &Pilot) -> Result<Map> {
        self.of_disc((pilot.core() - self.map.half_diagonal()).max(0.0))
    }

    /// Whether all points within a radius of a place \[m\] surely keep their distance from obstacles. The test is
    /// conservative: there may be room where it returns false.
    pub(crate) fn is_far(&self, place: &Point2<f64>, radius: f64) -> bool {
        let own = self.map.in_map(place);
        let ends = [own.x, self.map.columns() as f64 - own.x, own.y, self.map.rows() as f64 - own.y];
        let border = ends.into_iter().fold(f64::INFINITY, f64::min) * self.map.resolution();
        // The distance from the cell's middle to the place.
        let off = self.map.half_diagonal();
        border > radius && self.map.cell_at(place).is_ok_and(|cell| self.clearances[cell] - off > radius + self.apart)
    }

    /// A point where a sole would overlap an obstacle.
    pub fn under_sole(&self, sole: &Polygon) -> Option<Point2<f64>> {
        self.under(sole.corners().to_vec())
    }

    /// A point where a body would come too near to an obstacle.
    pub fn beside_body(&self, outline: &Polygon) -> Option<Point2<f64>> {
        self.under(self.grown(outline).corners().to_vec())
    }

    /// An outline grown by the least distance.
    pub(super) fn grown(&self, outline: &Polygon) -> Polygon {
        Polygon::hull(&outline.corners().iter().flat_map(|corner| around(*corner, self.apart)).collect::<Vec<_>>())
    }

    /// A point of a polygon that is not free.
    pub(super) fn under(&self, corners: Vec<Point2<f64>>) -> Option<Point2<f64>> {
        self.map.obstacle_under(&Shape::Polygon(corners))
    }
}
