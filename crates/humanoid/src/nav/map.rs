//! Occupancy grids of the floor, with speeds. Main type: [`Map`].

use std::ops::RangeInclusive;

use nalgebra::{Point2, Vector2};

use super::shape::Shape;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits::CELL_METRES;

/// The greatest number of cells of a map.
const MOST: usize = groebot_algebra::limits::MAP_CELLS;
/// The permitted speeds of a map.
const SPEEDS: RangeInclusive<f64> = 1e-3..=1e6;

/// The state of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Cell {
    /// No obstacle.
    Free,
    /// An obstacle.
    Occupied,
    /// Not observed: no path enters it.
    Unknown,
}

/// A grid of square cells on the floor. Cells are numbered by rows from the lower left corner, `x` along rows and `y`
/// across them. The corner has a pose in the world. Methods that change a map return another one.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    columns: usize,
    rows: usize,
    resolution: f64,
    corner: Point2<f64>,
    yaw: f64,
    cells: Vec<Cell>,
    /// F of RH0 (4-7) by cell; one everywhere where none is given.
    speeds: Option<Vec<f32>>,
}

impl Map {
    /// A free floor with the given numbers of columns and rows, and the side of a cell \[m\].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for no cells, more than 2^28, and a side that is not positive.
    pub fn new(columns: usize, rows: usize, resolution: f64) -> Result<Self> {
        let count = count_of(columns, rows, resolution)?;
        Map::of_cells(columns, rows, resolution, vec![Cell::Free; count])
    }

    /// A map of the given cells, by rows from the lowest one.
    ///
    /// # Errors
    /// As [`Map::new`], and when the number of cells is wrong.
    pub fn of_cells(columns: usize, rows: usize, resolution: f64, cells: Vec<Cell>) -> Result<Self> {
        let count = count_of(columns, rows, resolution)?;
        if count != cells.len() {
            let text = format!("{} cells are given; {columns} x {rows} are {count}", cells.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        Ok(Map { columns, rows, resolution, corner: Point2::origin(), yaw: 0.0, cells, speeds: None })
    }

    /// Sets the position of the lower left corner in the world \[m\], and the anticlockwise rotation of the rows
    /// \[rad\].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a number that is not finite.
    pub fn placed(mut self, corner: Point2<f64>, yaw: f64) -> Result<Self> {
        if !corner.iter().chain([&yaw]).all(|x| x.is_finite()) {
            let text = format!("origin [{}, {}, {yaw}]: give finite numbers", corner.x, corner.y);
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        (self.corner, self.yaw) = (corner, yaw);
        Ok(self)
    }

    /// Sets the speed inside a shape, RH0 (4-7); elsewhere it stays one or as it was set before. Where shapes overlap,
    /// the later one counts.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a speed that is not from 0.001 to a million; obstacles are added by [`Map::with`].
    /// Those of [`Shape::check`].
    pub fn with_speed(mut self, shape: &Shape, speed: f64) -> Result<Self> {
        shape.check()?;
        if !SPEEDS.contains(&speed) {
            let text = format!(
                "a speed of {speed}: give a positive number from {} to {}; add an obstacle where the robot must not go",
                SPEEDS.start(),
                SPEEDS.end()
            );
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let inside: Vec<usize> = (0..self.cells.len()).filter(|cell| shape.holds(&self.centre(*cell))).collect();
        let speeds = self.speeds.get_or_insert_with(|| vec![1.0; self.cells.len()]);
        inside.into_iter().for_each(|cell| speeds[cell] = speed as f32);
        Ok(self)
    }

    /// Adds obstacles: each cell that one of them touches is occupied. To move an obstacle, add it to the map without
    /// it.
    ///
    /// # Errors
    /// As [`Shape::check`].
    pub fn with(&self, obstacles: &[Shape]) -> Result<Self> {
        let mut map = self.clone();
        for shape in obstacles {
            shape.check()?;
            for cell in self.touched(&self.placed_in_map(shape), |_| true) {
                map.cells[cell] = Cell::Occupied;
            }
        }
        Ok(map)
    }

    /// A point where a shape touches a cell that is not free, if there is one: the middle of that cell, or a corner of
    /// the shape's bounds outside the map.
    pub fn obstacle_under(&self, shape: &Shape) -> Option<Point2<f64>> {
        let placed = self.placed_in_map(shape);
        let (low, high) = placed.bounds();
        let beyond = [low, high].into_iter().find(|corner| !self.is_on(corner));
        beyond
            .map(|corner| self.in_world(&corner))
            .or_else(|| self.touched(&placed, |cell| !self.is_free(cell)).next().map(|cell| self.centre(cell)))
    }

    /// A shape of the world in the coordinates of the map, in cells.
    fn placed_in_map(&self, shape: &Shape) -> Shape {
        shape.moved(&|point| self.in_map(point), 1.0 / self.resolution)
    }

    /// The cells that a shape touches, of those for which `wanted` is true. The shape is given in cells.
    fn touched<'a, W: Fn(usize) -> bool>(
        &self,
        placed: &'a Shape,
        wanted: W,
    ) -> impl Iterator<Item = usize> + use<'a, W> {
        let (low, high) = placed.bounds();
        let range = |low: f64, high: f64, most: usize| {
            (low.floor().max(0.0) as usize).min(most)..(high.floor() + 1.0).clamp(0.0, most as f64) as usize
        };
        let (rows, columns) = (range(low.y, high.y, self.rows), range(low.x, high.x, self.columns));
        let width = self.columns;
        let all = rows.flat_map(move |row| columns.clone().map(move |column| (row, column)));
        let touches = |(row, column): &(usize, usize)| placed.touches(&Point2::new(*column as f64, *row as f64));
        let cell = move |(row, column): &(usize, usize)| row * width + column;
        all.filter(move |at| wanted(cell(at))).filter(touches).map(move |at| cell(&at))
    }

    /// The map with its unknown cells free.
    #[must_use]
    pub fn with_unknown_free(mut self) -> Self {
        self.cells.iter_mut().filter(|cell| **cell == Cell::Unknown).for_each(|cell| *cell = Cell::Free);
        self
    }

    /// The map with its unknown cells occupied.
    #[must_use]
    pub fn with_unknown_occupied(mut self) -> Self {
        self.cells.iter_mut().filter(|cell| **cell == Cell::Unknown).for_each(|cell| *cell = Cell::Occupied);
        self
    }

    /// The map in which only the free cells with `kept` stay free.
    pub(crate) fn keeping_where(mut self, mut kept: impl FnMut(usize) -> bool) -> Self {
        for cell in 0..self.cells.len() {
            if self.is_free(cell) && !kept(cell) {
                self.cells[cell] = Cell::Occupied;
            }
        }
        self
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The side of a cell \[m\].
    pub fn resolution(&self) -> f64 {
        self.resolution
    }

    /// The distance from the middle of a cell to its corners \[m\].
    pub fn half_diagonal(&self) -> f64 {
        self.resolution * std::f64::consts::FRAC_1_SQRT_2
    }

    /// The anticlockwise rotation of the rows \[rad\].
    pub fn yaw(&self) -> f64 {
        self.yaw
    }

    /// The cells, by rows from the lowest one.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// F by cell, where speeds are given.
    pub fn speeds(&self) -> Option<&[f32]> {
        self.speeds.as_deref()
    }

    /// Whether a cell is free.
    pub fn is_free(&self, cell: usize) -> bool {
        self.cells[cell] == Cell::Free
    }

    pub(super) fn cells_mut(&mut self) -> &mut [Cell] {
        &mut self.cells
    }

    /// The middle of a cell in the world \[m\].
    pub fn centre(&self, cell: usize) -> Point2<f64> {
        let (column, row) = (cell % self.columns, cell / self.columns);
        self.in_world(&Point2::new(column as f64 + 0.5, row as f64 + 0.5))
    }

    /// The cell that contains a point of the world.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a point outside the map.
    pub fn cell_at(&self, place: &Point2<f64>) -> Result<usize> {
        let own = self.in_map(place);
        if !self.is_on(&own) {
            let [low, high] = [Point2::origin(), Point2::new(self.columns as f64, self.rows as f64)]
                .map(|corner| self.in_world(&corner));
            let text = format!(
                "({}, {}) is not on the map, whose corners are ({}, {}) and ({}, {})",
                place.x, place.y, low.x, low.y, high.x, high.y
            );
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let whole = |value: f64, most: usize| (value.floor() as usize).min(most - 1);
        Ok(whole(own.y, self.rows) * self.columns + whole(own.x, self.columns))
    }

    /// Whether a point, given in cells, is on the map.
    fn is_on(&self, own: &Point2<f64>) -> bool {
        own.x >= 0.0 && own.y >= 0.0 && own.x <= self.columns as f64 && own.y <= self.rows as f64
    }

    /// The free cell that contains a point.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a point outside the map or in a cell that is not free; the message has the nearest
    /// free place.
    pub fn free_cell_at(&self, place: &Point2<f64>) -> Result<usize> {
        let cell = self.cell_at(place)?;
        if self.is_free(cell) {
            return Ok(cell);
        }
        let free = (0..self.cells.len()).filter(|cell| self.is_free(*cell)).map(|cell| self.centre(cell));
        let nearest = free.min_by(|a, b| (a - place).norm_squared().total_cmp(&(b - place).norm_squared()));
        let kind = if self.cells[cell] == Cell::Unknown { "unknown" } else { "occupied" };
        let hint = nearest.map_or_else(
            || "no place is free".to_owned(),
            |free| format!("the nearest free place is ({:.3}, {:.3})", free.x, free.y),
        );
        Err(Error::new(ErrorKind::BadValue, format!("({}, {}) is {kind}; {hint}", place.x, place.y)))
    }

    /// Transforms a point of the world to the map's coordinates, in cells from the lower left corner.
    pub fn in_map(&self, place: &Point2<f64>) -> Point2<f64> {
        let (sine, cosine) = self.yaw.sin_cos();
        let away = (place - self.corner) / self.resolution;
        Point2::new(cosine * away.x + sine * away.y, cosine * away.y - sine * away.x)
    }

    /// Transforms a point from the map's coordinates, in cells, to the world.
    pub fn in_world(&self, place: &Point2<f64>) -> Point2<f64> {
        let (sine, cosine) = self.yaw.sin_cos();
        let turned = Vector2::new(cosine * place.x - sine * place.y, sine * place.x + cosine * place.y);
        self.corner + turned * self.resolution
    }
}

/// The number of cells for the given columns and rows.
fn count_of(columns: usize, rows: usize, resolution: f64) -> Result<usize> {
    let bad = |text: String| Err(Error::new(ErrorKind::BadValue, text));
    let [least, greatest] = CELL_METRES;
    if !(least..=greatest).contains(&resolution) {
        return bad(format!("a resolution of {resolution:?} m: give the side of a cell, {least:e} to {greatest:e} m"));
    }
    match columns.checked_mul(rows).filter(|count| (1..=MOST).contains(count)) {
        Some(count) => Ok(count),
        None => bad(format!("a map of {columns} x {rows} cells: give between one and {MOST}")),
    }
}
