//! Shortest any-angle paths for a point, exact and proved. Main types: [`Shortest`], [`Distances`].
//!
//! Based on D. Harabor, A. Grastien, D. Oz and V. Aksakalli, Optimal Any-Angle Pathfinding in Practice (Journal of
//! Artificial Intelligence Research 56, 2016), and M. Cui, D. Harabor and A. Grastien, Compromise-free Pathfinding on a
//! Navigation Mesh (IJCAI 2017). Here the mesh is the runs of free cells of each row, read from bits, and visibility is
//! decided in integers.
//!
//! A path is in the closure of the free cells. It may touch obstacles, but does not pass between two that meet at a
//! corner. Unknown cells and the outside of the map are obstacles. The map's speeds are ignored.

mod aim;
mod corners;
mod distances;
mod flood;
mod plane;
mod rows;
mod search;
mod turns;
mod windows;

use nalgebra::{Point2, Vector2};

use self::aim::Aim;
use self::corners::Corners;
pub use self::distances::Distances;
use self::plane::Plane;
pub(super) use self::rows::Rows;
use self::search::{End, Search};
use self::windows::{Goal, NONE};
use super::field::Field;
use super::map::Map;
use super::path::{Enclosure, Path};
use crate::{Error, ErrorKind, Result, Watch};

/// A factor below one on a field's times after they are scaled to the length of a known path, because they may still be
/// too long.
const FIELD_FACTOR: f64 = 0.98;

/// A path with a lower bound.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Shortest {
    /// The path: it turns only at corners of obstacles, around them.
    pub path: Path,
    /// A lower bound for the length of all paths \[m\]. It equals the path's length where that is proved to be
    /// shortest.
    pub bound: f64,
}

impl Shortest {
    /// Whether the path is proved to be shortest.
    pub fn is_proved(&self) -> bool {
        self.bound >= self.path.length() * (1.0 - 1e-12)
    }
}

/// Hints and the effort limit for a search.
#[derive(Clone, Copy, Debug, Default)]
pub struct Guide<'a> {
    /// A field of the goal on the same map. With it a path is found early, which matters where the effort is bounded.
    /// The proof does not need it.
    pub field: Option<&'a Field>,
    /// The greatest number of steps of a proof once a path is known, each about 0.3 us; unlimited where none is given.
    pub effort: Option<usize>,
}

impl Map {
    /// Finds the shortest path from one place to another \[m\], or the cells that enclose one of them.
    ///
    /// # Errors
    /// As [`Map::free_cell_at`]; [`ErrorKind::BadValue`] for a field of another goal or another number of cells;
    /// [`Watch::check`].
    pub fn shortest_path<'w>(
        &self,
        start: &Point2<f64>,
        goal: &Point2<f64>,
        guide: &Guide,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<std::result::Result<Shortest, Enclosure>> {
        let watch = Watch::or_none(watch);
        let cells = [self.free_cell_at(start)?, self.free_cell_at(goal)?];
        let scale = guide.field.map(|field| scale(self, field, cells[1])).transpose()?;
        let rows = Rows::new(self);
        let floor = Floor { map: self, rows: &rows, plane: Plane::new(self), ends: [*start, *goal], cells };
        let is_reached = guide.field.is_some_and(|field| field.times()[cells[0]].is_finite());
        if !is_reached && let Some(enclosure) = enclosure(self, &rows, cells, watch)? {
            return Ok(Err(enclosure));
        }
        let aims = guide.field.zip(scale).filter(|_| is_reached);
        floor.shortest(aims.map(|(field, scale)| (field.times(), scale)), guide.effort, watch).map(Ok)
    }
}

/// The factor from a field's times to cells.
fn scale(map: &Map, field: &Field, goal: usize) -> Result<f64> {
    if field.times().len() != map.cells().len() || !field.goals().contains(&goal) {
        let text = "the field of the guide has another map or goal; give a field of this map and goal, or none";
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    Ok(1.0 / map.resolution())
}

/// The cells that enclose one of two cells, where they are not connected.
pub(super) fn enclosure(map: &Map, rows: &Rows, cells: [usize; 2], watch: &Watch) -> Result<Option<Enclosure>> {
    flood::enclosure(map, rows, cells.map(|cell| rows.place(cell)), watch)
}

/// A map, and the ends of a path on it.
struct Floor<'a> {
    map: &'a Map,
    rows: &'a Rows,
    plane: Plane,
    ends: [Point2<f64>; 2],
    cells: [usize; 2],
}

impl Floor<'_> {
    /// First finds a path by the times of a field, then searches for shorter ones with the straight line as heuristic.
    /// Where the effort does not suffice for that, it searches once more by the times.
    fn shortest(&self, times: Option<(&[f64], f64)>, effort: Option<usize>, watch: &Watch) -> Result<Shortest> {
        let mut best = None;
        if let Some((times, scale)) = times {
            self.improve(&mut best, Aim::Field(times, scale), Some(0), watch)?;
        }
        let known = best.as_ref().map(|(length, _)| *length);
        let end = self.improve(&mut best, Aim::Straight, effort, watch)?;
        if let (Some((times, scale)), Some(length), End::Open(_)) = (times, known, &end) {
            let estimate = times[self.cells[0]] * scale;
            let less = FIELD_FACTOR * (length / estimate).min(1.0);
            self.improve(&mut best, Aim::Field(times, scale * less), effort, watch)?;
        }
        let Some((length, path)) = best else { unreachable!("connected cells have a path") };
        let bound = match end {
            End::Closed => path.length(),
            End::Open(least) => least.min(length) / length * path.length() * (1.0 - 1e-12),
        };
        Ok(Shortest { path, bound })
    }

    /// Searches for a path that is shorter than `best`, which has its length in cells.
    fn improve(&self, best: &mut Option<(f64, Path)>, aim: Aim, effort: Option<usize>, watch: &Watch) -> Result<End> {
        let mut search = self.search(aim, None);
        search.best.0 = best.as_ref().map_or(f64::INFINITY, |(length, _)| *length).min(search.best.0);
        let end = search.run(effort, watch)?;
        if search.best.1 != NONE {
            *best = Some((search.best.0, self.path(&search)));
        }
        Ok(end)
    }

    /// A search whose start has been expanded.
    fn search<'a>(&'a self, aim: Aim<'a>, distances: Option<&'a Corners>) -> Search<'a> {
        let [start, end] = self.ends.map(|place| self.map.in_map(&place) + Vector2::repeat(1.0));
        let cell = self.rows.place(self.cells[1]);
        let goal = Goal { cell, spot: self.plane.spot(&end, cell), real: end };
        let mut search = Search::new(self.rows, self.plane, goal, aim);
        search.distances = distances;
        search.start(start, self.rows.place(self.cells[0]));
        search
    }

    /// The best path of a search, from its chain of roots.
    fn path(&self, search: &Search) -> Path {
        let mut points = vec![self.ends[1]];
        let mut root = search.best.1;
        while root != 0 {
            let own = &search.roots[root as usize];
            points.push(self.map.in_world(&(own.real - Vector2::repeat(1.0))));
            root = own.before;
        }
        points.push(self.ends[0]);
        points.reverse();
        Path { points }
    }
}
