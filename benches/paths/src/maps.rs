//! Maps of 1000 x 1000 cells: rooms with doors, and random occupied cells.

use groebot::nav::{Cell, Map};

const SIDE: usize = 1000;

/// Numbers in \[0, 1), by SplitMix64 (Steele, Lea and Flood 2014).
pub struct Numbers(pub u64);

impl Numbers {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }
}

/// Each cell is occupied with the probability `share`.
pub fn random(share: f64) -> Map {
    let mut numbers = Numbers(3);
    of(|_, _| numbers.next() < share)
}

/// Square rooms. Four of five walls between them have a door of three cells.
pub fn rooms(side: usize) -> Map {
    let mut numbers = Numbers(1);
    let mut doors = || (numbers.next() < 0.8).then(|| 1 + numbers.below(side - 4));
    let count = SIDE / side + 1;
    let walls: Vec<[Option<usize>; 2]> = (0..count * count).map(|_| [doors(), doors()]).collect();
    of(|x, y| {
        let [left, below] = walls[y / side * count + x / side];
        let is_door = |door: Option<usize>, at: usize| door.is_some_and(|door| (door..door + 3).contains(&(at % side)));
        (x % side == 0 && (x == 0 || !is_door(left, y))) || (y % side == 0 && (y == 0 || !is_door(below, x)))
    })
}

fn of(mut is_occupied: impl FnMut(usize, usize) -> bool) -> Map {
    let places = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
    let cells = places.map(|(x, y)| if is_occupied(x, y) { Cell::Occupied } else { Cell::Free }).collect();
    Map::of_cells(SIDE, SIDE, 1.0, cells).expect("a map")
}
