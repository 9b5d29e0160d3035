//! The thesis' modified fast marching, RH0 4.3, for equal costs: breadth-first search over four neighbours, with 64
//! cells per machine word.

use super::map::{Cell, Map};
use crate::{Result, Watch};

const LEFT: u64 = 0x0101_0101_0101_0101;
const RIGHT: u64 = LEFT << 7;
const LOWEST: u64 = 0xff;
const HIGHEST: u64 = LOWEST << 56;

/// Eight rows of eight cells, the lowest row in the lowest bits.
#[derive(Clone, Copy, Default)]
struct Tile {
    /// Free cells that have not been reached.
    open: u64,
    /// Cells that the next wave reaches.
    next: u64,
}

/// The cells of a wave in one tile.
#[derive(Clone, Copy, Default)]
struct Crest {
    tile: u32,
    cells: u64,
}

/// A map in tiles with a border of tiles.
struct Tiles {
    stride: usize,
    tiles: Vec<Tile>,
    /// By tile and cell, the number of the wave that reached it, from one; zero where none did.
    waves: Vec<[u32; 64]>,
}

/// T of RH0 (4-17) by cell, for equal costs.
pub(super) fn arrivals(map: &Map, goals: &[usize], cost: f64, watch: &Watch) -> Result<Vec<f64>> {
    let mut tiles = Tiles::new(map);
    let (mut wave, mut next) = (tiles.begin(map, goals), Vec::new());
    let (mut length, mut count) = (wave.len(), 0u32);
    while length > 0 {
        if count.is_multiple_of(256) {
            watch.check()?;
        }
        count += 1;
        length = tiles.spread(&mut wave[..length], &mut next, count);
        std::mem::swap(&mut wave, &mut next);
    }
    Ok(tiles.times(map, cost))
}

impl Tiles {
    fn new(map: &Map) -> Self {
        let stride = map.columns().div_ceil(8) + 2;
        let mut tiles = vec![Tile::default(); stride * (map.rows().div_ceil(8) + 2)];
        for (row, cells) in map.cells().chunks_exact(map.columns()).enumerate() {
            let own = &mut tiles[(row / 8 + 1) * stride + 1..];
            for (tile, cells) in own.iter_mut().zip(cells.chunks(8)) {
                let bits = cells.iter().rev().fold(0, |bits, cell| bits << 1 | u64::from(*cell == Cell::Free));
                tile.open |= bits << (row % 8 * 8);
            }
        }
        let waves = vec![[0; 64]; tiles.len()];
        Tiles { stride, tiles, waves }
    }

    /// The first wave.
    fn begin(&mut self, map: &Map, goals: &[usize]) -> Vec<Crest> {
        let mut wave = Vec::new();
        for goal in goals {
            let (column, row) = (goal % map.columns(), goal / map.columns());
            let tile = (row / 8 + 1) * self.stride + column / 8 + 1;
            if self.tiles[tile].next == 0 {
                wave.push(Crest { tile: tile as u32, cells: 0 });
            }
            self.put(tile, 1 << (row % 8 * 8 + column % 8));
        }
        wave
    }

    /// Marks open cells of a tile for the next wave; returns whether they are the first ones in the tile.
    #[inline]
    fn put(&mut self, tile: usize, cells: u64) -> bool {
        let own = &mut self.tiles[tile];
        let (cells, is_first) = (cells & own.open, own.next == 0);
        own.next |= cells;
        own.open &= !cells;
        is_first & (cells != 0)
    }

    /// Marks the cells of a wave and writes the next wave; returns its length. The loop has only two branches, none on
    /// the sides by which the wave leaves a tile.
    fn spread(&mut self, wave: &mut [Crest], next: &mut Vec<Crest>, count: u32) -> usize {
        if next.len() < 5 * wave.len() {
            next.resize(8 * wave.len(), Crest::default());
        }
        wave.iter_mut().for_each(|crest| crest.cells = std::mem::take(&mut self.tiles[crest.tile as usize].next));
        let (mut length, stride) = (0, self.stride);
        for &Crest { tile, cells } in &*wave {
            let tile = tile as usize;
            mark(&mut self.waves[tile], cells, count);
            let mut put = |tile: usize, cells: u64| {
                next[length].tile = tile as u32;
                length += usize::from(self.put(tile, cells));
            };
            put(tile, cells << 8 | cells >> 8 | (cells & !RIGHT) << 1 | (cells & !LEFT) >> 1);
            if cells & (LEFT | RIGHT) != 0 {
                put(tile - 1, (cells & LEFT) << 7);
                put(tile + 1, (cells & RIGHT) >> 7);
            }
            if cells & (LOWEST | HIGHEST) != 0 {
                put(tile - stride, cells << 56);
                put(tile + stride, cells >> 56);
            }
        }
        length
    }

    fn times(&self, map: &Map, cost: f64) -> Vec<f64> {
        let time = |wave: &u32| if *wave == 0 { f64::INFINITY } else { f64::from(*wave - 1) * cost };
        let (columns, mut times) = (map.columns(), vec![0.0; map.cells().len()]);
        for (row, times) in times.chunks_exact_mut(columns).enumerate() {
            let tiles = &self.waves[(row / 8 + 1) * self.stride + 1..];
            for (times, waves) in times.chunks_mut(8).zip(tiles) {
                let waves = &waves[row % 8 * 8..][..8];
                times.iter_mut().zip(waves).for_each(|(own, wave)| *own = time(wave));
            }
        }
        times
    }
}

#[inline]
fn mark(waves: &mut [u32; 64], mut cells: u64, count: u32) {
    while cells != 0 {
        waves[cells.trailing_zeros() as usize] = count;
        cells &= cells - 1;
    }
}
