//! Exact distances of a goal from all corners. Main type: [`Distances`].
//!
//! The windows of the search for one path are expanded from the goal in the order of their distance (J. Mitchell, D.
//! Mount and C. Papadimitriou, The Discrete Geodesic Problem, SIAM Journal on Computing 16, 1987).

use nalgebra::{Point2, Vector2};

use super::aim::Aim;
use super::corners::{Corner, Corners};
use super::search::Search;
use super::windows::{Goal, NONE, Root};
use super::{Floor, Plane, Rows, Shortest, enclosure};
use crate::nav::map::Map;
use crate::nav::path::{Enclosure, Path};
use crate::{Error, ErrorKind, Result, Watch};

/// The distance of each corner of an obstacle from a goal. With it, one visibility query finds the shortest path from
/// any place.
#[derive(Clone, Debug)]
pub struct Distances {
    goal: Point2<f64>,
    cell: usize,
    rows: Rows,
    corners: Corners,
}

impl Distances {
    /// Computes the distances of a goal \[m\].
    ///
    /// # Errors
    /// As [`Map::free_cell_at`]; [`Watch::check`].
    pub fn new<'w>(map: &Map, goal: &Point2<f64>, watch: impl Into<Option<&'w Watch>>) -> Result<Self> {
        let watch = Watch::or_none(watch);
        let cell = map.free_cell_at(goal)?;
        let (rows, plane) = (Rows::new(map), Plane::new(map));
        let start = map.in_map(goal) + Vector2::repeat(1.0);
        // A dummy goal: no run contains a cell of the border.
        let nowhere = Goal { cell: (0, 0), spot: plane.lattice(0, 0), real: Point2::origin() };
        let mut search = Search::new(&rows, plane, nowhere, Aim::Nearest);
        search.start(start, rows.place(cell));
        search.run(None, watch)?;
        let corner = |root: &Root| Corner { place: root.real, length: root.length, next: root.before };
        let corners = search.roots[1..].iter().map(corner).collect();
        let corners = Corners { corners, numbers: search.into_numbers() };
        Ok(Distances { goal: *goal, cell, rows, corners })
    }

    /// The goal \[m\].
    pub fn goal(&self) -> &Point2<f64> {
        &self.goal
    }

    /// The shortest path from a place to the goal, proved; or the cells that enclose one of them.
    ///
    /// # Errors
    /// As [`Map::free_cell_at`]; [`ErrorKind::BadValue`] for a map with other free cells; [`Watch::check`].
    pub fn path<'w>(
        &self,
        map: &Map,
        start: &Point2<f64>,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<std::result::Result<Shortest, Enclosure>> {
        let watch = Watch::or_none(watch);
        let cells = [map.free_cell_at(start)?, self.cell];
        if self.rows != Rows::new(map) {
            let text = "the distances belong to a map with other free cells; give that map";
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let floor = Floor { map, rows: &self.rows, plane: Plane::new(map), ends: [*start, self.goal], cells };
        let mut search = floor.search(Aim::Straight, Some(&self.corners));
        search.run(None, watch)?;
        if search.best.1 == NONE {
            let enclosure = enclosure(map, &self.rows, cells, watch)?;
            return Ok(Err(enclosure.unwrap_or_else(|| unreachable!("connected cells have a path"))));
        }
        let mut points = vec![*start];
        let mut next = search.via;
        while let Some(corner) = next.checked_sub(1).and_then(|number| self.corners.corners.get(number as usize)) {
            points.push(map.in_world(&(corner.place - Vector2::repeat(1.0))));
            next = corner.next;
        }
        points.push(self.goal);
        let path = Path { points };
        Ok(Ok(Shortest { bound: path.length(), path }))
    }
}
