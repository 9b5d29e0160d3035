//! Navigation: maps as they are read, distances beside brute force, fields beside what they solve.

mod fields;
mod maps;

use groebot::nav::{Cell, Map};

/// Cells that are occupied with this likelihood, by SplitMix64 (Steele, Lea and Flood 2014).
fn random_map(columns: usize, rows: usize, share: f64, seed: u64) -> Map {
    let mut state = seed;
    let mut number = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    };
    let cells = (0..columns * rows).map(|_| if number() < share { Cell::Occupied } else { Cell::Free }).collect();
    Map::of_cells(columns, rows, 0.05, cells).unwrap()
}
