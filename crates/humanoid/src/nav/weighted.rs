//! Quickest paths with different speeds. Main type: [`Quickest`].
//!
//! The descent path of a fast marching field is pulled taut and gets points where speeds change. The points move until
//! no move makes the path quicker; then Snell's law holds there (J. Mitchell and C. Papadimitriou, The Weighted Region
//! Problem, Journal of the ACM 38, 1991).

use nalgebra::{Point2, Vector2};

use super::exact::Guide;
use super::field::{Field, Method};
use super::map::Map;
use super::path::{Enclosure, Path};
use super::traversal::{pieces, time};
use crate::{Error, ErrorKind, Result, Watch};

/// The greatest number of rounds, and of sweeps over all points in each round.
const ROUNDS: usize = 12;
const SWEEPS: usize = 60;
/// The least step of a point, in cells.
const LEAST_STEP: f64 = 1e-5;
/// The greatest number of moves that a point tries in a sweep.
const TRIES: usize = 48;
/// The least relative gain for another sweep, and for another round.
const GAINS: [f64; 2] = [1e-9, 1e-6];

/// A path, its time, and a lower bound.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Quickest {
    /// The path: no small move of its points makes it quicker.
    pub path: Path,
    /// Its time, as [`Path::time`] \[s\].
    pub time: f64,
    /// A lower bound for the time of all paths \[s\].
    pub bound: f64,
}

impl Map {
    /// Finds a quick path from one place to another with the map's speeds \[m\], or the cells that enclose one of them.
    /// It starts from a fast marching field of the goal where one is given.
    ///
    /// The bound shows whether the path is the quickest one. It is the greatest of three times. The first is that of
    /// the shortest path at the greatest speed. The others are those on maps whose columns, or rows, have their
    /// greatest speed everywhere.
    ///
    /// # Errors
    /// As [`Map::free_cell_at`]; [`ErrorKind::BadValue`] for a field of another goal; [`Watch::check`].
    pub fn quickest_path<'w>(
        &self,
        start: &Point2<f64>,
        goal: &Point2<f64>,
        field: Option<&Field>,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<std::result::Result<Quickest, Enclosure>> {
        let watch = Watch::or_none(watch);
        let (from, to) = (self.free_cell_at(start)?, self.free_cell_at(goal)?);
        let shortest = match self.shortest_path(start, goal, &Guide::default(), watch)? {
            Ok(shortest) => shortest,
            Err(enclosure) => return Ok(Err(enclosure)),
        };
        let own =
            if field.is_none() { Some(Field::new(self, &[*goal], Method::FastMarching(1), watch)?) } else { None };
        let Some(field) = field.or(own.as_ref()).filter(|field| field.goals() == [to]) else {
            return Err(Error::new(
                ErrorKind::BadValue,
                "the field has another goal; give a field of this goal, or none",
            ));
        };
        field.check_of(self)?;
        let places = |path: &Path| path.points.iter().map(|point| self.in_map(point)).collect::<Vec<_>>();
        let mut course = Course { map: self, points: places(&shortest.path) };
        let mut best = course.settle(watch)?;
        let ends = [self.in_map(start), self.in_map(goal)];
        if let Some(down) = descent(self, field, from, ends)? {
            let mut other = Course { map: self, points: down };
            let time = other.settle(watch)?;
            if time < best {
                (course, best) = (other, time);
            }
        }
        let mut path = Path { points: course.points.iter().map(|point| self.in_world(point)).collect() };
        let last = path.points.len() - 1;
        (path.points[0], path.points[last]) = (*start, *goal);
        let time = best * self.resolution();
        Ok(Ok(Quickest { bound: bound(self, ends, shortest.bound).min(time), time, path }))
    }
}

/// The descent path of a field from one end to the other; `None` where the field does not reach it.
fn descent(map: &Map, field: &Field, from: usize, ends: [Point2<f64>; 2]) -> Result<Option<Vec<Point2<f64>>>> {
    let Ok(down) = field.descend(map, &map.centre(from))? else { return Ok(None) };
    let mut points = vec![ends[0]];
    points.extend(down.points.iter().map(|point| map.in_map(point)));
    points.push(ends[1]);
    Ok(Some(points))
}

/// The state of the optimisation of a path; points are in cells.
struct Course<'a> {
    map: &'a Map,
    points: Vec<Point2<f64>>,
}

impl Course<'_> {
    /// Optimises until nothing more is gained; returns the time.
    fn settle(&mut self, watch: &Watch) -> Result<f64> {
        let mut best = f64::INFINITY;
        for _ in 0..ROUNDS {
            self.pull();
            self.divide();
            self.relax(watch)?;
            self.pull();
            let found = self.time(&self.points);
            let gain = best - found;
            best = found.min(best);
            if gain <= GAINS[1] * best {
                break;
            }
        }
        Ok(best)
    }

    fn time(&self, points: &[Point2<f64>]) -> f64 {
        time(self.map, points).unwrap_or(f64::INFINITY)
    }

    /// Removes points without which the path is as quick.
    fn pull(&mut self) {
        loop {
            let before = self.points.len();
            let mut place = 1;
            while place + 1 < self.points.len() {
                let [a, b, c] = [place - 1, place, place + 1].map(|at| self.points[at]);
                if self.time(&[a, c]) <= self.time(&[a, b, c]) + 1e-12 {
                    self.points.remove(place);
                }
                place += 1;
            }
            if self.points.len() == before {
                return;
            }
        }
    }

    /// Inserts a point wherever the speed changes.
    fn divide(&mut self) {
        let mut points = vec![self.points[0]];
        for pair in self.points.windows(2) {
            let pieces = pieces(self.map, pair[0], pair[1]).unwrap_or_default();
            let changes = pieces.windows(2).filter(|pair| pair[0].slowness != pair[1].slowness);
            points.extend(changes.map(|pair| on_line(pair[0].end)));
            points.push(pair[1]);
        }
        self.points = points;
    }

    /// Moves points one after the other until none moves.
    fn relax(&mut self, watch: &Watch) -> Result<()> {
        // The first step of a point is as long as its last move.
        let mut steps = vec![1.0_f64; self.points.len()];
        for _ in 0..SWEEPS {
            watch.check()?;
            let before = self.time(&self.points);
            for (place, step) in steps.iter_mut().enumerate().take(self.points.len() - 1).skip(1) {
                *step = self.relax_point(place, step.max(16.0 * LEAST_STEP));
            }
            if before - self.time(&self.points) <= GAINS[0] * before {
                break;
            }
        }
        Ok(())
    }

    /// Optimises one point by the pattern search of R. Hooke and T. Jeeves (Journal of the ACM 8, 1961); returns the
    /// length of its move.
    fn relax_point(&mut self, place: usize, mut step: f64) -> f64 {
        let [before, first, after] = [place - 1, place, place + 1].map(|at| self.points[at]);
        let mut own = first;
        let mut best = self.time(&[before, own, after]);
        for _ in 0..TRIES {
            if step < LEAST_STEP {
                break;
            }
            let tries = moves(own, step).map(|point| (self.time(&[before, point, after]), point));
            let (time, point) = tries.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((best, own));
            if time < best - 1e-13 * best {
                (best, own) = (time, point);
                step *= 2.0;
            } else {
                step *= 0.5;
            }
        }
        self.points[place] = own;
        (own - first).norm()
    }
}

/// Candidate moves of a point: along the axes and diagonals, and onto lattice lines and points, where speeds and
/// obstacles change.
fn moves(point: Point2<f64>, step: f64) -> [Point2<f64>; 11] {
    let go = |x: f64, y: f64| point + Vector2::new(x, y) * step;
    let (x, y) = (point.x.round(), point.y.round());
    [
        go(1.0, 0.0),
        go(-1.0, 0.0),
        go(0.0, 1.0),
        go(0.0, -1.0),
        go(1.0, 1.0),
        go(1.0, -1.0),
        go(-1.0, 1.0),
        go(-1.0, -1.0),
        Point2::new(x, point.y),
        Point2::new(point.x, y),
        Point2::new(x, y),
    ]
}

/// The projection onto the nearest lattice line.
fn on_line(point: Point2<f64>) -> Point2<f64> {
    let (x, y) = (point.x.round(), point.y.round());
    if (point.x - x).abs() < (point.y - y).abs() { Point2::new(x, point.y) } else { Point2::new(point.x, y) }
}

/// The lower bound for the time \[s\].
fn bound(map: &Map, ends: [Point2<f64>; 2], shortest: f64) -> f64 {
    let (columns, rows) = (map.columns(), map.rows());
    let slowness = |cell: usize| map.speeds().map_or(1.0, |speeds| 1.0 / f64::from(speeds[cell]));
    let (mut along_x, mut along_y) = (vec![f64::INFINITY; columns], vec![f64::INFINITY; rows]);
    for cell in (0..columns * rows).filter(|cell| map.is_free(*cell)) {
        let (x, y, own) = (cell % columns, cell / columns, slowness(cell));
        (along_x[x], along_y[y]) = (along_x[x].min(own), along_y[y].min(own));
    }
    let least = along_x.iter().copied().fold(f64::INFINITY, f64::min);
    let [a, b] = ends;
    let across = layered(&along_x, [a.x, b.x], (a.y - b.y).abs(), least);
    let up = layered(&along_y, [a.y, b.y], (a.x - b.x).abs(), least);
    (across.max(up) * map.resolution()).max(shortest * least) * (1.0 - 1e-9)
}

/// A lower bound for the time through layers, each with its least slowness s by cell. With Snell's constant c, take the
/// function with the gradient `sqrt(s^2 - c^2)` across the layers and c along them. Its slope nowhere exceeds s, so its
/// rise is a bound. The best c is taken.
fn layered(slowness: &[f64], [from, to]: [f64; 2], along: f64, most: f64) -> f64 {
    let rise = |c: f64| {
        let (low, high) = (from.min(to), from.max(to));
        let layers = slowness.iter().enumerate().map(|(layer, slowness)| {
            let depth = (high.min(layer as f64 + 1.0) - low.max(layer as f64)).max(0.0);
            if depth > 0.0 { depth * (slowness * slowness - c * c).max(0.0).sqrt() } else { 0.0 }
        });
        layers.sum::<f64>() + c * along
    };
    // It is concave in c.
    let (mut low, mut high) = (0.0, most);
    for _ in 0..100 {
        let third = (high - low) / 3.0;
        if rise(low + third) < rise(high - third) { low += third } else { high -= third }
    }
    rise(low).max(rise(high))
}
