//! Navigation: readers of maps, distances compared with brute force, fields and paths checked against their equations.

mod exact;
mod fields;
mod maps;
mod octile;
mod rooms;
mod smooth;
mod thesis;
mod update;
mod weighted;

use groebot_humanoid::nav::{Cell, Map};

/// SplitMix64 (Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    /// A random number in [0, 1).
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A random integer below `count`.
    fn below(&mut self, count: usize) -> usize {
        (self.number() * count as f64) as usize
    }
}

/// A map whose cells are occupied with this probability.
fn random_map(columns: usize, rows: usize, share: f64, seed: u64) -> Map {
    let mut random = Random(seed);
    let mut cell = || if random.number() < share { Cell::Occupied } else { Cell::Free };
    let cells = (0..columns * rows).map(|_| cell()).collect();
    Map::of_cells(columns, rows, 0.05, cells).unwrap()
}
