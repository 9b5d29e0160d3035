//! Pseudorandom floors.

use groebot::nav::{Cell, Map, Shape};
use nalgebra::Point2;

/// SplitMix64 (Steele, Lea and Flood 2014).
pub struct Random(pub u64);

impl Random {
    /// A number between 0 and 1.
    pub fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// An integer below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        (self.number() * count as f64) as usize
    }
}

/// Kinds of floors.
#[derive(Clone, Copy, PartialEq)]
pub enum Floor {
    /// Eight by eight rooms with doors.
    Rooms,
    /// Discs that cover about a quarter.
    Obstacles,
    /// One cell in five, at random.
    Cells,
    /// Corridors of one cell between walls of one cell.
    Maze,
}

pub const FLOORS: [(&str, Floor); 4] =
    [("rooms", Floor::Rooms), ("obstacles", Floor::Obstacles), ("cells", Floor::Cells), ("maze", Floor::Maze)];

/// A square map with `side` cells per side, 0.05 m each.
pub fn map(floor: Floor, side: usize) -> Map {
    let mut random = Random(side as u64);
    let cells = match floor {
        Floor::Rooms => rooms(side, &mut random),
        Floor::Cells => {
            let one = |_| if random.number() < 0.2 { Cell::Occupied } else { Cell::Free };
            (0..side * side).map(one).collect()
        }
        Floor::Maze => maze(side, &mut random),
        Floor::Obstacles => vec![Cell::Free; side * side],
    };
    let map = Map::of_cells(side, side, 0.05, cells).unwrap();
    if floor == Floor::Obstacles { map.with(&discs(side, 150, 0.025, &mut random)).unwrap() } else { map }
}

/// Same map, but with forty discs with speeds between 0.3 and 3.
pub fn with_speeds(map: Map) -> Map {
    let mut random = Random(7);
    let discs = discs(map.columns(), 40, 0.1, &mut random);
    discs.iter().fold(map, |map, disc| map.with_speed(disc, 0.3 * 10f64.powf(random.number())).unwrap())
}

/// The free cell that is nearest to the middle.
pub fn goal(map: &Map) -> usize {
    let middle = map.columns() / 2 * map.columns() + map.columns() / 2;
    (0..map.cells().len()).filter(|cell| map.is_free(*cell)).min_by_key(|cell| cell.abs_diff(middle)).unwrap()
}

fn discs(side: usize, count: usize, radius: f64, random: &mut Random) -> Vec<Shape> {
    let reach = 0.05 * side as f64;
    let mut disc = || Shape::Circle {
        centre: Point2::new(reach * random.number(), reach * random.number()),
        radius: reach * radius * (0.5 + random.number()),
    };
    (0..count).map(|_| disc()).collect()
}

fn rooms(side: usize, random: &mut Random) -> Vec<Cell> {
    let (room, mut cells) = (side / 8, vec![Cell::Free; side * side]);
    for wall in (room..side).step_by(room) {
        for along in 0..side {
            cells[wall * side + along] = Cell::Occupied;
            cells[along * side + wall] = Cell::Occupied;
        }
    }
    let width = (side / 60).max(2);
    for wall in (room..side).step_by(room) {
        for first in (0..side - room + 1).step_by(room) {
            let doors = [(); 2].map(|()| first + 1 + random.below(room - width - 1));
            for step in 0..width {
                cells[wall * side + doors[0] + step] = Cell::Free;
                cells[(doors[1] + step) * side + wall] = Cell::Free;
            }
        }
    }
    cells
}

/// A maze by depth-first search.
fn maze(side: usize, random: &mut Random) -> Vec<Cell> {
    let mut cells = vec![Cell::Occupied; side * side];
    let nodes = side.div_ceil(2);
    let place = |(x, y): (usize, usize)| 2 * y * side + 2 * x;
    let mut stack = vec![(0usize, 0usize)];
    cells[0] = Cell::Free;
    while let Some((x, y)) = stack.last().copied() {
        let near = [(x.wrapping_sub(1), y), (x + 1, y), (x, y.wrapping_sub(1)), (x, y + 1)];
        let closed = |node: &(usize, usize)| node.0 < nodes && node.1 < nodes && cells[place(*node)] != Cell::Free;
        let closed: Vec<(usize, usize)> = near.into_iter().filter(closed).collect();
        if closed.is_empty() {
            stack.pop();
            continue;
        }
        let next = closed[random.below(closed.len())];
        cells[(place((x, y)) + place(next)) / 2] = Cell::Free;
        cells[place(next)] = Cell::Free;
        stack.push(next);
    }
    cells
}
