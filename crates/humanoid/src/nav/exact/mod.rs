//! Shortest ways for a point, exact and proved. Main types: [`Shortest`], [`Distances`].
//!
//! After D. Harabor, A. Grastien, D. Oz and V. Aksakalli, Optimal Any-Angle Pathfinding in Practice (Journal of Artificial Intelligence Research 56, 2016), and M. Cui, D. Harabor and
//! A. Grastien, Compromise-free Pathfinding on a Navigation Mesh (IJCAI 2017): here the mesh is the runs of free cells of each row, read off bits, and who sees whom is decided in whole
//! numbers.
//!
//! A way is in the closure of the cells that are free: it may touch obstacles, but does not slip through where two of them meet at a corner. Unknown cells and what is off the map are
//! obstacles. The map's speeds do not matter.

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
use super::way::{Enclosure, Way};
use crate::{Error, ErrorKind, Result, Watch};

/// By how much a field's times, made as long as a way is, may still be too long.
const CAUTION: f64 = 0.98;

/// A way, and what is proved of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Shortest {
    /// The way: it turns at corners of obstacles only, about them.
    pub way: Way,
    /// No way is shorter than this \[m\]: the way's length where it is proved to be shortest.
    pub bound: f64,
}

impl Shortest {
    /// Whether no way is shorter.
    pub fn is_proved(&self) -> bool {
        self.bound >= self.way.length() * (1.0 - 1e-12)
    }
}

/// What helps the search for a shortest way, and how long it lasts.
#[derive(Clone, Copy, Debug, Default)]
pub struct Guide<'a> {
    /// A field of the goal on the same map: along it a way is known soon, which matters where the effort is bounded. What proves a way does not need it.
    pub field: Option<&'a Field>,
    /// How many steps a proof may take once a way is known, each about 0.3 us; as many as it takes where none is told.
    pub effort: Option<usize>,
}

impl Map {
    /// The shortest way from one place to another one \[m\], or the cells that enclose one of them.
    ///
    /// # Errors
    /// As [`Map::free_cell_at`]; [`ErrorKind::BadValue`] for a field of another goal or another count of cells; [`Watch::check`].
    pub fn shortest_way(
        &self,
        start: &Point2<f64>,
        goal: &Point2<f64>,
        guide: &Guide,
        watch: &Watch,
    ) -> Result<std::result::Result<Shortest, Enclosure>> {
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

/// By how much to multiply a field's times to have cells.
fn scale(map: &Map, field: &Field, goal: usize) -> Result<f64> {
    if field.times().len() != map.cells().len() || !field.goals().contains(&goal) {
        let text = "the field that guides is not one of this map and goal; give one of both, or none";
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    Ok(1.0 / map.resolution())
}

/// The cells that enclose one of two cells against the other, where they are not connected.
pub(super) fn enclosure(map: &Map, rows: &Rows, cells: [usize; 2], watch: &Watch) -> Result<Option<Enclosure>> {
    flood::enclosure(map, rows, cells.map(|cell| rows.place(cell)), watch)
}

/// A map between whose places one goes.
struct Floor<'a> {
    map: &'a Map,
    rows: &'a Rows,
    plane: Plane,
    ends: [Point2<f64>; 2],
    cells: [usize; 2],
}

impl Floor<'_> {
    /// First a way that the times of a field lead to, then what the straight line to the goal leaves of shorter ones; where the effort does not last for that, once more by the times.
    fn shortest(&self, times: Option<(&[f64], f64)>, effort: Option<usize>, watch: &Watch) -> Result<Shortest> {
        let mut best = None;
        if let Some((times, scale)) = times {
            self.improve(&mut best, Aim::Field(times, scale), Some(0), watch)?;
        }
        let known = best.as_ref().map(|(length, _)| *length);
        let end = self.improve(&mut best, Aim::Straight, effort, watch)?;
        if let (Some((times, scale)), Some(length), End::Open(_)) = (times, known, &end) {
            let told = times[self.cells[0]] * scale;
            let less = CAUTION * (length / told).min(1.0);
            self.improve(&mut best, Aim::Field(times, scale * less), effort, watch)?;
        }
        let Some((length, way)) = best else { unreachable!("cells that are connected have a way") };
        let bound = match end {
            End::Closed => way.length(),
            End::Open(least) => least.min(length) / length * way.length() * (1.0 - 1e-12),
        };
        Ok(Shortest { way, bound })
    }

    /// Looks for a way that is shorter than the best one, which is told with its length in cells.
    fn improve(&self, best: &mut Option<(f64, Way)>, aim: Aim, effort: Option<usize>, watch: &Watch) -> Result<End> {
        let mut search = self.search(aim, None);
        search.best.0 = best.as_ref().map_or(f64::INFINITY, |(length, _)| *length).min(search.best.0);
        let end = search.run(effort, watch)?;
        if search.best.1 != NONE {
            *best = Some((search.best.0, self.way(&search)));
        }
        Ok(end)
    }

    /// A search that has looked about from the start.
    fn search<'a>(&'a self, aim: Aim<'a>, distances: Option<&'a Corners>) -> Search<'a> {
        let [start, end] = self.ends.map(|place| self.map.in_map(&place) + Vector2::repeat(1.0));
        let cell = self.rows.place(self.cells[1]);
        let goal = Goal { cell, spot: self.plane.spot(&end, cell), real: end };
        let mut search = Search::new(self.rows, self.plane, goal, aim);
        search.distances = distances;
        search.start(start, self.rows.place(self.cells[0]));
        search
    }

    /// The best way of a search, whose roots follow one another.
    fn way(&self, search: &Search) -> Way {
        let mut points = vec![self.ends[1]];
        let mut root = search.best.1;
        while root != 0 {
            let own = &search.roots[root as usize];
            points.push(self.map.in_world(&(own.real - Vector2::repeat(1.0))));
            root = own.before;
        }
        points.push(self.ends[0]);
        points.reverse();
        Way { points }
    }
}
