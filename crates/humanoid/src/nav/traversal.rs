//! Line traversal: the cells that a straight line crosses. Main type: [`Piece`].
//!
//! J. Amanatides and A. Woo, A Fast Voxel Traversal Algorithm for Ray Tracing (Eurographics 1987). Here lines on
//! lattice lines and through lattice points are separate cases.

use nalgebra::{Point2, Vector2};

use super::map::Map;
use super::path::Path;

/// The distance within which a line is on a lattice line or point, in cells.
const NEAR: f64 = 1e-9;

/// A part of a straight line in one cell, or on the border between two cells.
pub(super) struct Piece {
    /// Its length, in cells.
    pub length: f64,
    /// Its end, in cells.
    pub end: Point2<f64>,
    /// The free cells that it is in.
    cells: [Option<(usize, usize)>; 2],
    /// The time per cell side, relative to the time at speed one.
    pub slowness: f64,
}

impl Path {
    /// The time of the path with the map's speeds, \[s\], or \[m\] where the map has none. `None` where the path
    /// crosses an obstacle, or passes between two that meet at a corner. On the border between two speeds the faster
    /// one counts.
    pub fn time(&self, map: &Map) -> Option<f64> {
        let points: Vec<Point2<f64>> = self.points.iter().map(|point| map.in_map(point)).collect();
        Some(time(map, &points)? * map.resolution())
    }
}

/// The time of a path over points that are given in cells; `None` where it is not clear.
pub(super) fn time(map: &Map, points: &[Point2<f64>]) -> Option<f64> {
    let mut sum = 0.0;
    let mut last: Option<Piece> = None;
    for pair in points.windows(2) {
        for piece in pieces(map, pair[0], pair[1])? {
            if !last.as_ref().is_none_or(|last| last.leads_to(&piece, map)) {
                return None;
            }
            sum += piece.length * piece.slowness;
            last = Some(piece);
        }
    }
    Some(sum)
}

impl Piece {
    /// Whether a cell and one of the next piece's cells are connected over sides.
    fn leads_to(&self, next: &Piece, map: &Map) -> bool {
        let is_connected = |(x, y): (usize, usize), (to_x, to_y): (usize, usize)| {
            let is_diagonal = x != to_x && y != to_y;
            !is_diagonal || is_free(map, x, to_y) || is_free(map, to_x, y)
        };
        self.cells.iter().flatten().any(|from| next.cells.iter().flatten().any(|to| is_connected(*from, *to)))
    }
}

fn is_free(map: &Map, x: usize, y: usize) -> bool {
    x < map.columns() && y < map.rows() && map.is_free(y * map.columns() + x)
}

/// The pieces from one point to another, in order; `None` where one of them is in no free cell.
pub(super) fn pieces(map: &Map, a: Point2<f64>, b: Point2<f64>) -> Option<Vec<Piece>> {
    let offset = b - a;
    let length = offset.norm();
    if length < NEAR {
        return Some(vec![]);
    }
    let mut stops = crossings(a.x, offset.x, length);
    stops.extend(crossings(a.y, offset.y, length));
    stops.push(1.0);
    stops.sort_by(f64::total_cmp);
    let mut from = 0.0;
    let mut all = Vec::with_capacity(stops.len());
    for stop in stops {
        // Shorter pieces only touch a corner.
        if (stop - from) * length >= NEAR {
            all.push(piece(map, a + offset * from, a + offset * stop)?);
            from = stop;
        }
    }
    Some(all)
}

/// The fractions of the line at which a coordinate is an integer.
fn crossings(from: f64, along: f64, length: f64) -> Vec<f64> {
    if along.abs() < NEAR * length.min(1.0) {
        return vec![];
    }
    let (low, high) = (from.min(from + along), from.max(from + along));
    (low.ceil() as i64..=high.floor() as i64)
        .map(|line| (line as f64 - from) / along)
        .filter(|t| *t > 0.0 && *t < 1.0)
        .collect()
}

fn piece(map: &Map, a: Point2<f64>, b: Point2<f64>) -> Option<Piece> {
    let middle = nalgebra::center(&a, &b);
    let on_line =
        [0, 1].map(|axis| (b[axis] - a[axis]).abs() < NEAR && (middle[axis] - middle[axis].round()).abs() < NEAR);
    let beside = match on_line {
        [true, _] => [Vector2::new(-0.5, 0.0), Vector2::new(0.5, 0.0)],
        [_, true] => [Vector2::new(0.0, -0.5), Vector2::new(0.0, 0.5)],
        _ => [Vector2::zeros(); 2],
    };
    let cells = beside.map(|away| {
        let (x, y) = ((middle.x + away.x).floor(), (middle.y + away.y).floor());
        (x >= 0.0 && y >= 0.0).then_some((x as usize, y as usize)).filter(|(x, y)| is_free(map, *x, *y))
    });
    let speed = |(x, y): &(usize, usize)| map.speeds().map_or(1.0, |speeds| f64::from(speeds[y * map.columns() + x]));
    let fastest = cells.iter().flatten().map(speed).reduce(f64::max)?;
    Some(Piece { length: (b - a).norm(), end: b, cells, slowness: 1.0 / fastest })
}
