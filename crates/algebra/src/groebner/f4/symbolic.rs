//! Symbolic preprocessing: the multiples of elements in a round's matrix, and their columns.

use std::cmp::Reverse;

use super::packing::{Key, product, quotient};
use super::running::{Pair, Running, overflow};
use super::table::Table;
use crate::{Result, Watch};

/// A row: a multiple of an element. Its entries are in the element's order of terms.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    pub element: u32,
    /// Position of its columns among the entries of the shape.
    pub from: usize,
    pub to: usize,
}

/// The shape of a round's matrix. The first `upper.len()` columns are the leading columns of the reducers, in the order
/// of the rows. In both parts, columns descend in the monomial order.
#[derive(Clone, Debug, Default)]
pub(super) struct Shape {
    pub columns: usize,
    pub upper: Vec<Row>,
    pub lower: Vec<Row>,
    pub entries: Vec<u32>,
}

impl Shape {
    /// The columns of a row's terms.
    #[inline(always)]
    pub fn columns_of(&self, row: &Row) -> &[u32] {
        &self.entries[row.from..row.to]
    }

    /// Size of the shape in bytes.
    pub fn bytes(&self) -> usize {
        4 * self.entries.capacity() + size_of::<Row>() * (self.upper.capacity() + self.lower.capacity())
    }
}

/// The monomials of a shape's columns.
pub(super) type Columns<const W: usize> = Vec<Key<W>>;

const UNSEEN: u32 = u32::MAX;
/// Initial capacity of a matrix' lists of monomials.
const CAPACITY: usize = 64;

/// Role of a monomial in the growing matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    /// No reducer has been searched yet.
    Open,
    /// This upper row reduces it.
    Upper(u32),
    /// There is no reducer for it.
    Free,
}

/// The growing matrix.
pub(super) struct Builder<'a, const W: usize> {
    running: &'a Running<W>,
    table: &'a mut Table<W>,
    /// Indices of the monomials in the matrix.
    monomials: Vec<u32>,
    /// The position in `monomials` for each index of the table.
    place: Vec<u32>,
    roles: Vec<Role>,
    upper: Vec<Row>,
    lower: Vec<Row>,
    entries: Vec<u32>,
    /// Upper bound of a reducer's sugar.
    bound: u32,
}

impl<'a, const W: usize> Builder<'a, W> {
    pub fn new(running: &'a Running<W>, table: &'a mut Table<W>, bound: u32) -> Self {
        let mut place = Vec::with_capacity(table.len() + CAPACITY);
        place.resize(table.len(), UNSEEN);
        Builder {
            running,
            table,
            monomials: Vec::with_capacity(CAPACITY),
            place,
            roles: Vec::with_capacity(CAPACITY),
            upper: Vec::with_capacity(CAPACITY / 4),
            lower: Vec::with_capacity(CAPACITY / 4),
            entries: Vec::with_capacity(4 * CAPACITY),
            bound,
        }
    }

    /// The position of a monomial. A new monomial is added.
    #[inline]
    fn place_of(&mut self, key: Key<W>) -> u32 {
        let index = self.table.index(key) as usize;
        if index >= self.place.len() {
            self.place.resize(index + 1, UNSEEN);
        }
        if self.place[index] == UNSEEN {
            self.place[index] = self.monomials.len() as u32;
            self.monomials.push(index as u32);
            self.roles.push(Role::Open);
        }
        self.place[index]
    }

    /// The row `multiplier * element` without its first `skip` terms.
    fn row(&mut self, element: u32, multiplier: &Key<W>, skip: usize) -> Result<Row> {
        let running = self.running;
        let keys = &running.elements[element as usize][skip..];
        let from = self.entries.len();
        self.entries.reserve(keys.len());
        let mut over = false;
        for key in keys {
            let key = product(key, multiplier);
            over |= running.packing.overflows(&key);
            let place = self.place_of(key);
            self.entries.push(place);
        }
        if over { Err(overflow()) } else { Ok(Row { element, from, to: self.entries.len() }) }
    }

    /// Adds the rows of the selected pairs. For each least common multiple, the first row is the reducer and the others
    /// are to be reduced.
    pub fn take_pairs(&mut self, selected: &[Pair<W>]) -> Result<()> {
        for group in selected.chunk_by(|a, b| a.lcm == b.lcm) {
            let lcm = group[0].lcm;
            let mut elements: Vec<u32> = group.iter().flat_map(|pair| [pair.left, pair.right]).collect();
            elements.sort_unstable();
            elements.dedup();
            let place = self.place_of(lcm) as usize;
            for element in elements {
                let row = self.row(element, &self.running.multiplier(element, &lcm), 0)?;
                if self.roles[place] == Role::Open {
                    self.roles[place] = Role::Upper(self.upper.len() as u32);
                    self.upper.push(row);
                } else {
                    self.lower.push(row);
                }
            }
        }
        Ok(())
    }

    /// Adds the elements themselves, without their first `skip` terms, as rows to be reduced.
    pub fn take_elements(&mut self, elements: &[u32], skip: usize) -> Result<()> {
        for &element in elements {
            let row = self.row(element, &[0; W], skip)?;
            self.lower.push(row);
        }
        Ok(())
    }

    /// Searches a reducer for each monomial, including those of the reducers.
    pub fn close(&mut self, watch: &Watch) -> Result<()> {
        let mut next = 0;
        while next < self.monomials.len() {
            if next % 256 == 0 {
                watch.check()?;
            }
            if self.roles[next] == Role::Open {
                let key = *self.table.key(self.monomials[next]);
                self.roles[next] = match self.running.divisor(&key, self.bound) {
                    None => Role::Free,
                    Some(element) => {
                        let multiplier = quotient(&key, &self.running.elements[element as usize][0]);
                        let row = self.row(element, &multiplier, 0)?;
                        self.upper.push(row);
                        Role::Upper(self.upper.len() as u32 - 1)
                    }
                };
            }
            next += 1;
        }
        Ok(())
    }

    /// Sorts the columns: those with a reducer first, each part descending.
    pub fn finish(self) -> (Shape, Columns<W>) {
        let packing = &self.running.packing;
        let (mut order, mut free): (Vec<_>, Vec<_>) = (0..self.monomials.len() as u32)
            .map(|place| (packing.rank(self.table.key(self.monomials[place as usize])), place))
            .partition(|&(_, place)| self.roles[place as usize] != Role::Free);
        order.sort_unstable_by_key(|(rank, _)| Reverse(*rank));
        free.sort_unstable_by_key(|(rank, _)| Reverse(*rank));
        order.append(&mut free);
        let mut column = vec![0; order.len()];
        let mut upper_order = Vec::with_capacity(self.upper.len());
        for (index, &(_, place)) in order.iter().enumerate() {
            column[place as usize] = index as u32;
            if let Role::Upper(row) = self.roles[place as usize] {
                upper_order.push(row);
            }
        }
        let mut entries = self.entries;
        entries.iter_mut().for_each(|place| *place = column[*place as usize]);
        let upper = upper_order.into_iter().map(|row: u32| self.upper[row as usize]).collect();
        let keys: Columns<W> =
            order.iter().map(|&(_, place)| *self.table.key(self.monomials[place as usize])).collect();
        (Shape { columns: keys.len(), upper, lower: self.lower, entries }, keys)
    }
}
