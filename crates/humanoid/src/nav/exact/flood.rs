//! Connectivity of two cells, by a bidirectional flood fill over runs of free cells.

use super::rows::Rows;
use crate::nav::map::Map;
use crate::nav::path::Enclosure;
use crate::{Result, Watch};

/// The runs that are connected to one place.
struct Flood {
    seen: Rows,
    waiting: Vec<(usize, usize, usize)>,
    next: usize,
}

impl Flood {
    fn new(map: &Map, rows: &Rows, (x, y): (usize, usize)) -> Self {
        let mut flood = Flood { seen: Rows::none(map), waiting: vec![], next: 0 };
        flood.add(rows, x, y);
        flood
    }

    fn add(&mut self, rows: &Rows, x: usize, y: usize) {
        let (from, to) = rows.run(x, y);
        self.seen.set(y, from, to);
        self.waiting.push((y, from, to));
    }

    /// Expands one run; returns whether the other flood is met.
    fn step(&mut self, rows: &Rows, other: &Flood) -> bool {
        let (row, from, to) = self.waiting[self.next];
        self.next += 1;
        for beside in [row - 1, row + 1] {
            let mut x = rows.next(from, beside, true);
            while x < to {
                if other.seen.has(x, beside) {
                    return true;
                }
                if !self.seen.has(x, beside) {
                    self.add(rows, x, beside);
                }
                x = rows.next(rows.next(x, beside, false), beside, true);
            }
        }
        false
    }
}

/// The cells that enclose one of two cells, where they are not connected.
pub(super) fn enclosure(map: &Map, rows: &Rows, ends: [(usize, usize); 2], watch: &Watch) -> Result<Option<Enclosure>> {
    let mut floods = ends.map(|end| Flood::new(map, rows, end));
    if floods[0].seen.has(ends[1].0, ends[1].1) {
        return Ok(None);
    }
    for count in 1usize.. {
        let [one, other] = &mut floods;
        if one.step(rows, other) {
            return Ok(None);
        }
        if one.next == one.waiting.len() {
            return Ok(Some(Enclosure { cells: one.seen.cells() }));
        }
        floods.swap(0, 1);
        if count.is_multiple_of(4096) {
            watch.check()?;
        }
    }
    unreachable!("a flood ends")
}
