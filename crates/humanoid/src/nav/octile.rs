//! Shortest paths on the grid of cell middles with eight neighbours (A*, octile distance).
//!
//! P. Hart, N. Nilsson and B. Raphael, A Formal Basis for the Heuristic Determination of Minimum Cost Paths (IEEE
//! Transactions on Systems Science and Cybernetics 4, 1968). The moves are those of N. Sturtevant, Benchmarks for
//! Grid-Based Pathfinding (IEEE Transactions on Computational Intelligence and AI in Games 4, 2012).

use std::f64::consts::SQRT_2;

use nalgebra::Point2;

use super::exact::{Rows, enclosure};
use super::map::Map;
use super::path::{Enclosure, Path};
use crate::{Result, Watch};

/// Offsets to the eight neighbours.
const STEPS: [(isize, isize); 8] = [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1)];

impl Map {
    /// Finds a shortest path on the grid of cell middles, with moves to eight neighbours. A diagonal move needs free
    /// cells on both sides. Returns the corners of the path, or the cells that enclose one of the ends. The map's
    /// speeds are ignored.
    ///
    /// # Errors
    /// As [`Map::free_cell_at`]; [`Watch::check`].
    pub fn octile_path<'w>(
        &self,
        start: &Point2<f64>,
        goal: &Point2<f64>,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<std::result::Result<Path, Enclosure>> {
        let watch = Watch::or_none(watch);
        let cells = [self.free_cell_at(start)?, self.free_cell_at(goal)?];
        let rows = Rows::new(self);
        if let Some(enclosure) = enclosure(self, &rows, cells, watch)? {
            return Ok(Err(enclosure));
        }
        let mut search = Search::new(self, &rows, cells);
        search.run(watch)?;
        Ok(Ok(search.path(self)))
    }
}

/// A* with levels instead of a heap. Within a level, cells are expanded in any order, and again when their length has
/// decreased.
struct Search<'a> {
    rows: &'a Rows,
    columns: usize,
    start: usize,
    goal: usize,
    /// By cell, one plus its length; zero where it has none yet.
    lengths: Vec<f64>,
    /// By cell, the move that reached it.
    steps: Vec<u8>,
    /// Cells by the integer part of the excess of their path over the least length, with the lengths that they had.
    levels: Vec<Vec<(u32, f64)>>,
    level: usize,
    least: f64,
}

impl<'a> Search<'a> {
    fn new(map: &Map, rows: &'a Rows, [start, goal]: [usize; 2]) -> Self {
        let count = map.cells().len();
        let (lengths, steps) = (vec![0.0; count], vec![0; count]);
        let columns = map.columns();
        let mut search = Search { rows, columns, start, goal, lengths, steps, levels: vec![], level: 0, least: 0.0 };
        search.least = search.at_least(start);
        search.reach(start, 1.0, 0);
        search
    }

    /// The octile distance to the goal.
    fn at_least(&self, cell: usize) -> f64 {
        // There are fewer than 2^28 cells.
        let (cell, goal, columns) = (cell as u32, self.goal as u32, self.columns as u32);
        let away = |a: u32, b: u32| f64::from(a.abs_diff(b));
        let across = away(cell % columns, goal % columns);
        let up = away(cell / columns, goal / columns);
        across.max(up) + (SQRT_2 - 1.0) * across.min(up)
    }

    fn reach(&mut self, cell: usize, length: f64, step: u8) {
        (self.lengths[cell], self.steps[cell]) = (length, step);
        // Rounding may give a value below the current level.
        let level = ((length - 1.0 + self.at_least(cell) - self.least) as usize).max(self.level);
        if level >= self.levels.len() {
            self.levels.resize_with(level + 1, Vec::new);
        }
        self.levels[level].push((cell as u32, length));
    }

    /// Expands level by level until a level ends with the goal reached. All paths on later levels are longer.
    fn run(&mut self, watch: &Watch) -> Result<()> {
        let mut count = 0usize;
        while self.lengths[self.goal] == 0.0 || self.level_of_goal() >= self.level {
            while let Some((cell, length)) = self.levels[self.level].pop() {
                count += 1;
                if count.is_multiple_of(4096) {
                    watch.check()?;
                }
                if length == self.lengths[cell as usize] {
                    self.expand(cell as usize, length);
                }
            }
            self.level += 1;
        }
        Ok(())
    }

    fn level_of_goal(&self) -> usize {
        (self.lengths[self.goal] - 1.0 - self.least) as usize
    }

    fn expand(&mut self, cell: usize, length: f64) {
        let (x, y) = self.rows.place(cell);
        let beside =
            [self.rows.has(x + 1, y), self.rows.has(x, y + 1), self.rows.has(x - 1, y), self.rows.has(x, y - 1)];
        for (step, (across, up)) in STEPS.iter().enumerate() {
            let is_allowed = match beside.get(step) {
                Some(is_free) => *is_free,
                None => {
                    let corner = (x.wrapping_add_signed(*across), y.wrapping_add_signed(*up));
                    beside[step - 4] && beside[(step - 3) % 4] && self.rows.has(corner.0, corner.1)
                }
            };
            if is_allowed {
                let next = cell.wrapping_add_signed(up * self.columns as isize + across);
                let new = length + if step < 4 { 1.0 } else { SQRT_2 };
                let old = self.lengths[next];
                if old == 0.0 || new < old - 1e-9 {
                    self.reach(next, new, step as u8);
                }
            }
        }
    }

    /// Follows the moves back from the goal; a corner is where the move changes.
    fn path(&self, map: &Map) -> Path {
        let (mut cell, mut last) = (self.goal, None);
        let mut points = vec![];
        while cell != self.start {
            let step = self.steps[cell];
            if last != Some(step) {
                points.push(map.centre(cell));
            }
            last = Some(step);
            let (across, up) = STEPS[step as usize];
            cell = cell.wrapping_add_signed(-(up * self.columns as isize + across));
        }
        points.push(map.centre(self.start));
        points.reverse();
        Path { points }
    }
}
