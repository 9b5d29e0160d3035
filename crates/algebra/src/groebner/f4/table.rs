//! Table of all monomials in a run, each once: open addressing from keys to indices.

use super::packing::{Key, hash};

/// A set of monomials with dense indices.
#[derive(Clone, Debug)]
pub(super) struct Table<const W: usize> {
    keys: Vec<Key<W>>,
    /// Index plus one; zero is a free slot. The length is a power of two, at least twice the number of keys.
    slots: Vec<u32>,
    shift: u32,
}

impl<const W: usize> Table<W> {
    pub fn new() -> Self {
        Table { keys: Vec::with_capacity(64), slots: vec![0; 1 << 8], shift: 64 - 8 }
    }

    pub fn len(&self) -> usize {
        self.keys.len()
    }

    /// The monomial with this index.
    pub fn key(&self, index: u32) -> &Key<W> {
        &self.keys[index as usize]
    }

    /// The index of `key`. A new key is added.
    #[inline]
    pub fn index(&mut self, key: Key<W>) -> u32 {
        let mask = self.slots.len() - 1;
        let mut slot = (hash(&key) >> self.shift) as usize;
        loop {
            match self.slots[slot & mask] {
                0 => return self.insert(slot & mask, key),
                taken if self.keys[taken as usize - 1] == key => return taken - 1,
                _ => slot += 1,
            }
        }
    }

    fn insert(&mut self, slot: usize, key: Key<W>) -> u32 {
        self.keys.push(key);
        self.slots[slot] = self.keys.len() as u32;
        if 2 * self.keys.len() > self.slots.len() {
            self.grow();
        }
        self.keys.len() as u32 - 1
    }

    fn grow(&mut self) {
        self.shift -= 1;
        let mask = 2 * self.slots.len() - 1;
        self.slots = vec![0; mask + 1];
        for (index, key) in self.keys.iter().enumerate() {
            let mut slot = (hash(key) >> self.shift) as usize;
            while self.slots[slot & mask] != 0 {
                slot += 1;
            }
            self.slots[slot & mask] = index as u32 + 1;
        }
    }

    /// Size of the table in bytes.
    pub fn bytes(&self) -> usize {
        self.keys.capacity() * W * 8 + self.slots.len() * 4
    }
}
