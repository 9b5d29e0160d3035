//! String pulling of paths.

use nalgebra::{Point2, Vector2};

use super::map::Map;
use super::path::Path;
use super::traversal::time;
use crate::{Error, ErrorKind, Result, Watch};

/// Tolerance for lengths in cells and for their squares.
const NEAR: f64 = 1e-9;

impl Path {
    /// The taut path: no longer, on the same side of each obstacle, and with corners only at those of obstacles. It is
    /// the shortest in its homotopy class, not of all paths.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a path that crosses an obstacle, and one without points; [`Watch::check`].
    pub fn taut<'w>(&self, map: &Map, watch: impl Into<Option<&'w Watch>>) -> Result<Path> {
        let watch = Watch::or_none(watch);
        self.check_clear(map)?;
        let ends = self.points.first().zip(self.points.last());
        let Some((first, last)) = ends.filter(|_| self.points.len() > 2) else { return Ok(self.clone()) };
        let mut points: Vec<Point2<f64>> = self.points.iter().map(|point| map.in_map(point)).collect();
        while pull(map, &mut points) {
            watch.check()?;
        }
        let inner = points[1..points.len() - 1].iter().map(|point| map.in_world(point));
        Ok(Path { points: [*first].into_iter().chain(inner).chain([*last]).collect() })
    }

    /// Checks that the path has points and crosses no obstacle.
    pub(super) fn check_clear(&self, map: &Map) -> Result<()> {
        if self.points.is_empty() {
            return Err(Error::new(ErrorKind::BadValue, "a path without points; give at least one"));
        }
        for pair in self.points.windows(2) {
            if time(map, &[map.in_map(&pair[0]), map.in_map(&pair[1])]).is_none() {
                let text = format!(
                    "the path crosses an obstacle between ({}, {}) and ({}, {}); give one that is clear",
                    pair[0].x, pair[0].y, pair[1].x, pair[1].y
                );
                return Err(Error::new(ErrorKind::BadValue, text));
            }
        }
        Ok(())
    }
}

/// Replaces each point by the chain around the obstacles between its neighbours; returns whether one has changed.
fn pull(map: &Map, points: &mut Vec<Point2<f64>>) -> bool {
    let (mut place, mut has_moved) = (1, false);
    while place + 1 < points.len() {
        let [a, b, c] = [place - 1, place, place + 1].map(|at| points[at]);
        let chain = chain(map, a, b, c);
        let is_same = chain.len() == 1 && (chain[0] - b).norm() < NEAR;
        if !is_same {
            let count = chain.len();
            points.splice(place..=place, chain);
            has_moved = true;
            place += count;
        } else {
            place += 1;
        }
    }
    has_moved
}

fn cross(a: Point2<f64>, b: Point2<f64>, c: Point2<f64>) -> f64 {
    (b - a).perp(&(c - a))
}

/// The corners of the taut string from one point to another that passed around a third one: the hull of the obstacles
/// in their triangle (A. Andrew, Information Processing Letters 9, 1979).
fn chain(map: &Map, a: Point2<f64>, b: Point2<f64>, c: Point2<f64>) -> Vec<Point2<f64>> {
    let side = cross(a, c, b).signum();
    if cross(a, c, b).abs() < NEAR {
        return vec![];
    }
    let is_in = |p: &Point2<f64>| {
        let [one, other] = [side * cross(b, a, *p), side * cross(c, b, *p)];
        // Obstacles on the other side of the string do not hold it.
        side * cross(a, c, *p) > NEAR
            && one > -NEAR
            && other > -NEAR
            && (one.min(other) > NEAR || obstacles(map, *p).any(|cell| enters(cell, [a, b, c])))
    };
    let along = c - a;
    let mut corners: Vec<Point2<f64>> = around([a, b, c]).filter(is_in).collect();
    corners.retain(|p| obstacles(map, *p).next().is_some());
    corners.sort_by(|p, q| (p - a).dot(&along).total_cmp(&(q - a).dot(&along)));
    corners.push(c);
    let mut hull = vec![a];
    for corner in corners {
        while let [.., p, q] = hull[..] {
            // The hull bends away from the third point everywhere.
            if side * cross(p, q, corner) < -NEAR {
                break;
            }
            hull.pop();
        }
        hull.push(corner);
    }
    hull[1..hull.len() - 1].to_vec()
}

/// The lattice points in a triangle, row by row, and some just outside it.
fn around(corners: [Point2<f64>; 3]) -> impl Iterator<Item = Point2<f64>> {
    let [a, b, c] = corners;
    let range = |(low, high): (f64, f64)| (low - NEAR).ceil() as i64..=(high + NEAR).floor() as i64;
    let bounds = |values: &mut dyn Iterator<Item = f64>| {
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
    };
    let in_row = move |y: i64| {
        let y = y as f64;
        let sides = [(a, b), (b, c), (c, a)].map(|(p, q)| {
            // The point of a side at this height, or nearest to it; the whole side where it is horizontal.
            let share =
                if (q.y - p.y).abs() < NEAR { [0.0, 1.0] } else { [((y - p.y) / (q.y - p.y)).clamp(0.0, 1.0); 2] };
            share
                .map(|share| p + (q - p) * share)
                .map(|point| if (point.y - y).abs() < 2.0 * NEAR { point.x } else { f64::NAN })
        });
        range(bounds(&mut sides.into_iter().flatten().filter(|x| !x.is_nan())))
    };
    range(bounds(&mut [a.y, b.y, c.y].into_iter()))
        .flat_map(move |y| in_row(y).map(move |x| Point2::new(x as f64, y as f64)))
}

/// The cells around a lattice point that are not free, by their lower left corners.
fn obstacles(map: &Map, point: Point2<f64>) -> impl Iterator<Item = Point2<f64>> + '_ {
    let is_free = |cell: &Point2<f64>| {
        let is_on = cell.x >= 0.0 && cell.y >= 0.0 && cell.x < map.columns() as f64 && cell.y < map.rows() as f64;
        is_on && map.is_free(cell.y as usize * map.columns() + cell.x as usize)
    };
    let about = [(-1.0, -1.0), (0.0, -1.0), (-1.0, 0.0), (0.0, 0.0)];
    about.into_iter().map(move |(x, y)| point + Vector2::new(x, y)).filter(move |cell| !is_free(cell))
}

/// Whether the interiors of a cell and a triangle intersect: no side of either separates them.
fn enters(cell: Point2<f64>, triangle: [Point2<f64>; 3]) -> bool {
    let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| cell + Vector2::new(x, y));
    let [a, b, c] = triangle;
    let normals = [Vector2::x(), Vector2::y(), b - a, c - b, a - c];
    normals.iter().enumerate().all(|(place, normal)| {
        let axis = if place < 2 { *normal } else { Vector2::new(-normal.y, normal.x) };
        let range = |points: &[Point2<f64>]| {
            let along = points.iter().map(|point| point.coords.dot(&axis));
            (along.clone().fold(f64::INFINITY, f64::min), along.fold(f64::NEG_INFINITY, f64::max))
        };
        let (one, other) = (range(&square), range(&triangle));
        one.0 < other.1 - NEAR && other.0 < one.1 - NEAR
    })
}
