//! The free cells of a map, one bit per cell. Main type: [`Rows`].
//!
//! Lattice points and cells are numbered from the lower left corner of a border of obstacles one cell wide, so that
//! each cell has neighbours. Cell (x, y) has the corners (x, y) and (x + 1, y + 1).

use crate::nav::map::{Cell, Map};

const WORD: usize = 64;

/// Rows of bits, set where a cell is free.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::nav) struct Rows {
    words: Vec<u64>,
    /// The number of words per row.
    width: usize,
    columns: usize,
}

impl Rows {
    /// The rows of a map.
    pub fn new(map: &Map) -> Self {
        let mut rows = Rows::none(map);
        for (own, cells) in rows.words.chunks_exact_mut(rows.width).skip(1).zip(map.cells().chunks_exact(map.columns()))
        {
            // The first bit belongs to the border.
            let mut carry = 0;
            for (place, cells) in cells.chunks(WORD).enumerate() {
                let bits = packed(cells);
                own[place] = bits << 1 | carry;
                carry = bits >> (WORD - 1);
            }
            if carry > 0 {
                own[cells.len() / WORD] |= carry;
            }
        }
        rows
    }

    /// The rows of a map without free cells.
    pub fn none(map: &Map) -> Self {
        let width = (map.columns() + 2).div_ceil(WORD);
        Rows { words: vec![0; width * (map.rows() + 2)], width, columns: map.columns() }
    }

    /// The cell of the map at a place.
    pub fn cell(&self, x: usize, y: usize) -> usize {
        (y - 1) * self.columns + x - 1
    }

    /// The place of a cell of the map.
    pub fn place(&self, cell: usize) -> (usize, usize) {
        (cell % self.columns + 1, cell / self.columns + 1)
    }

    /// The number of lattice points.
    pub fn points(&self) -> usize {
        self.words.len() * WORD
    }

    /// The number of a lattice point.
    pub fn point(&self, x: usize, y: usize) -> usize {
        y * self.width * WORD + x
    }

    #[inline]
    pub fn has(&self, x: usize, y: usize) -> bool {
        self.words[y * self.width + x / WORD] >> (x % WORD) & 1 == 1
    }

    /// Sets the bits from `from` to before `to`.
    pub fn set(&mut self, y: usize, from: usize, to: usize) {
        for place in from / WORD..to.div_ceil(WORD) {
            let (low, high) = (from.max(place * WORD) % WORD, to.min((place + 1) * WORD) - place * WORD);
            self.words[y * self.width + place] |= (u64::MAX >> (WORD - high)) & (u64::MAX << low);
        }
    }

    /// The first cell at `x` or right of it whose state is `is_free`; the width of all words where there is none.
    #[inline]
    pub fn next(&self, x: usize, y: usize, is_free: bool) -> usize {
        let row = &self.words[y * self.width..][..self.width];
        let flip = if is_free { 0 } else { u64::MAX };
        let mut mask = u64::MAX << (x % WORD);
        for (place, word) in row.iter().enumerate().skip(x / WORD) {
            let found = (word ^ flip) & mask;
            if found != 0 {
                return place * WORD + found.trailing_zeros() as usize;
            }
            mask = u64::MAX;
        }
        self.width * WORD
    }

    /// The place right of the last cell left of `x` whose state is `is_free`; zero where there is none.
    #[inline]
    pub fn after_last(&self, x: usize, y: usize, is_free: bool) -> usize {
        let row = &self.words[y * self.width..][..self.width];
        let flip = if is_free { 0 } else { u64::MAX };
        let mut mask = (1 << (x % WORD)) - 1;
        for place in (0..=x / WORD).rev() {
            let found = (row.get(place).copied().unwrap_or(0) ^ flip) & mask;
            if found != 0 {
                return place * WORD + WORD - found.leading_zeros() as usize;
            }
            mask = u64::MAX;
        }
        0
    }

    /// The run of free cells that contains a free cell: its first and its last lattice point.
    #[inline]
    pub fn run(&self, x: usize, y: usize) -> (usize, usize) {
        (self.after_last(x, y, false), self.next(x, y, false))
    }

    /// The last lattice point, from a start in a direction along the row, up to which the cells have equal states.
    pub fn alike(&self, x: usize, y: usize, is_right: bool) -> usize {
        let other = !self.has(x, y);
        if is_right { self.next(x, y, other) } else { self.after_last(x, y, other) }
    }

    /// The cells of the map whose bits are set, in order.
    pub fn cells(&self) -> Vec<usize> {
        let mut cells = Vec::new();
        for y in 1..self.words.len() / self.width - 1 {
            let mut x = self.next(0, y, true);
            while x <= self.columns {
                let end = self.next(x, y, false);
                cells.extend((x..end).map(|x| self.cell(x, y)));
                x = self.next(end, y, true);
            }
        }
        cells
    }
}

/// Up to 64 cells as bits.
fn packed(cells: &[Cell]) -> u64 {
    let (eights, rest) = cells.as_chunks::<8>();
    let mut bits = 0;
    for (place, eight) in eights.iter().enumerate() {
        let bytes = u64::from_le_bytes(eight.map(|cell| u8::from(cell == Cell::Free)));
        // The product gathers the lowest bit of each byte in the highest byte.
        bits |= (bytes.wrapping_mul(0x0102_0408_1020_4080) >> 56) << (8 * place);
    }
    for (place, cell) in rest.iter().enumerate() {
        bits |= u64::from(*cell == Cell::Free) << (8 * eights.len() + place);
    }
    bits
}
