//! Shortest ways for a point, exact and proved. Main types: [`Shortest`], [`Search`].
//!
//! After D. Harabor, A. Grastien, D. Oz and V. Aksakalli, Optimal Any-Angle Pathfinding in Practice (Journal of Artificial Intelligence Research 56, 2016), and M. Cui, D. Harabor and
//! A. Grastien, Compromise-free Pathfinding on a Navigation Mesh (IJCAI 2017): here the mesh is the runs of free cells of each row, read off bits, and who sees whom is decided in whole
//! numbers.
//!
//! A way is in the closure of the cells that are free: it may touch obstacles, but does not slip through where two of them meet at a corner. Unknown cells and what is off the map are
//! obstacles. The map's speeds do not matter.

mod aim;
mod flood;
mod plane;
mod rows;
mod search;
mod turns;

use nalgebra::{Point2, Vector2};

use self::aim::Aim;
use self::plane::Plane;
use self::rows::Rows;
use self::search::{End, Goal, NONE, Search};
use super::field::Field;
use super::map::Map;
use super::way::{Enclosure, Way};
use crate::{Error, ErrorKind, Result, Watch};

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
    /// A field of the goal on the same map: it shows where a short way is before one is proved to be shortest.
    pub field: Option<&'a Field>,
    /// How many steps a proof may take once a way is known, each about 0.1 us; as many as it takes where none is told.
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
        let floor = Floor { map: self, rows: Rows::new(self), plane: Plane::new(self), ends: [*start, *goal], cells };
        let is_reached = guide.field.is_some_and(|field| field.times()[cells[0]].is_finite());
        if !is_reached && let Some(enclosure) = floor.enclosure(watch)? {
            return Ok(Err(enclosure));
        }
        let guided = match (guide.field, scale) {
            (Some(field), Some(scale)) if is_reached => floor.guided(field, scale, watch)?,
            _ => None,
        };
        Ok(Ok(floor.proved(guided, guide.effort, watch)?))
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

/// A map between whose places one goes.
struct Floor<'a> {
    map: &'a Map,
    rows: Rows,
    plane: Plane,
    ends: [Point2<f64>; 2],
    cells: [usize; 2],
}

impl Floor<'_> {
    fn enclosure(&self, watch: &Watch) -> Result<Option<Enclosure>> {
        flood::enclosure(self.map, &self.rows, self.cells.map(|cell| self.rows.place(cell)), watch)
    }

    /// A way that a field leads to. It is as good as the field: the search ends where times, which are too long by what the start's is, leave no shorter one.
    fn guided(&self, field: &Field, scale: f64, watch: &Watch) -> Result<Option<(f64, Way)>> {
        let told = field.times()[self.cells[0]] * scale;
        let slack = |best: f64| best + (told - best).clamp(0.0, 0.01 * best) + 0.5;
        let mut search = self.search(Aim::Field(field.times(), scale));
        search.run(slack, None, watch)?;
        Ok(search.best.0.is_finite().then(|| (search.best.0, self.way(&search))))
    }

    /// The shortest way, as far as the effort allows to prove it.
    fn proved(&self, guided: Option<(f64, Way)>, effort: Option<usize>, watch: &Watch) -> Result<Shortest> {
        let mut search = self.search(Aim::Straight);
        let mut known = None;
        if let Some((length, way)) = guided {
            known = Some(way);
            search.best.0 = search.best.0.min(length);
        }
        let end = search.run(|best| best * (1.0 - 1e-13), effort, watch)?;
        let way = match known {
            Some(way) if search.best.1 == NONE => way,
            _ => self.way(&search),
        };
        let bound = match end {
            End::Closed => way.length(),
            End::Open(least) => (least * self.map.resolution() * (1.0 - 1e-12)).min(way.length()),
        };
        Ok(Shortest { way, bound })
    }

    /// A search that has looked about from the start.
    fn search<'a>(&'a self, aim: Aim<'a>) -> Search<'a> {
        let [start, end] = self.ends.map(|place| self.map.in_map(&place) + Vector2::repeat(1.0));
        let cell = self.rows.place(self.cells[1]);
        let goal = Goal { cell, spot: self.plane.spot(&end, cell), real: end };
        let mut search = Search::new(&self.rows, self.plane, goal, aim);
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
