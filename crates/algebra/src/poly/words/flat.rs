//! Sparse multivariate polynomials over a finite field: sorted packed exponents and a parallel vector of words.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::dense::Dense;
use super::field::WordField;

/// The position of each variable's exponent in a 128-bit key. Keys compare lexicographically, variable 0 first. The top
/// bit of each lane is zero, so divisibility is one subtraction.
#[derive(Clone, Debug)]
pub struct Packing {
    lanes: Vec<Lane>,
    guards: u128,
}

#[derive(Clone, Copy, Debug)]
struct Lane {
    shift: u32,
    mask: u128,
}

impl Packing {
    /// Lanes for exponents up to `bounds`, one for each variable; `None` when they need more than 128 bits.
    pub fn new(bounds: &[u32]) -> Option<Self> {
        let width = |bound: u32| if bound == 0 { 0 } else { 33 - bound.leading_zeros() };
        let mut shift = bounds.iter().map(|&bound| width(bound)).sum::<u32>();
        if shift > 128 {
            return None;
        }
        let (mut lanes, mut guards) = (Vec::with_capacity(bounds.len()), 0);
        for &bound in bounds {
            shift -= width(bound);
            let mask = if bound == 0 { 0 } else { (1u128 << (width(bound) - 1)) - 1 };
            guards |= if bound == 0 { 0 } else { 1u128 << (shift + width(bound) - 1) };
            lanes.push(Lane { shift: if bound == 0 { 0 } else { shift }, mask });
        }
        Some(Packing { lanes, guards })
    }

    /// Number of variables.
    pub fn variables(&self) -> usize {
        self.lanes.len()
    }

    /// The exponent of `variable` in `key`.
    pub fn exponent(&self, key: u128, variable: usize) -> u32 {
        let lane = self.lanes[variable];
        ((key >> lane.shift) & lane.mask) as u32
    }

    /// The key of `variable^exponent`.
    pub fn power(&self, variable: usize, exponent: u32) -> u128 {
        u128::from(exponent) << self.lanes[variable].shift
    }

    /// `key` with exponent 0 for `variable`.
    pub fn without(&self, key: u128, variable: usize) -> u128 {
        let lane = self.lanes[variable];
        key & !(lane.mask << lane.shift)
    }

    /// Whether the monomial `a` divides `b`.
    pub fn divides(&self, a: u128, b: u128) -> bool {
        ((b | self.guards) - a) & self.guards == self.guards
    }

    /// The largest possible exponents of a quotient of `f` by `g`; `None` when `g` has a larger degree.
    fn room(&self, f: &Flat, g: &Flat) -> Option<u128> {
        let mut room = 0;
        for v in 0..self.variables() {
            room |= self.power(v, f.degree_in(self, v).checked_sub(g.degree_in(self, v))?);
        }
        Some(room)
    }

    /// Evaluates the monomial of `key`. Variables without an entry in `tables` are omitted.
    pub fn value<K: WordField>(&self, field: &K, tables: &[Vec<u64>], key: u128) -> u64 {
        let known = tables.iter().enumerate().filter(|(_, table)| !table.is_empty());
        known.fold(1, |product, (v, table)| match self.exponent(key, v) {
            0 => product,
            exponent => field.mul(product, table[exponent as usize]),
        })
    }
}

/// The powers of `x` up to `x^top`.
pub fn powers<K: WordField>(field: &K, x: u64, top: u32) -> Vec<u64> {
    let next = |power: &u64| Some(field.mul(*power, x));
    std::iter::successors(Some(1), next).take(top as usize + 1).collect()
}

/// A polynomial: keys in descending order, and a parallel vector of nonzero values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Flat {
    pub keys: Vec<u128>,
    pub values: Vec<u64>,
}

impl Flat {
    /// The constant `c`.
    pub fn constant(c: u64) -> Self {
        if c == 0 { Flat::default() } else { Flat { keys: vec![0], values: vec![c] } }
    }

    /// Builds a polynomial from terms in any order. Like terms are collected.
    pub fn collect<K: WordField>(field: &K, mut terms: Vec<(u128, u64)>) -> Self {
        terms.sort_unstable_by_key(|term| Reverse(term.0));
        let mut result = Flat { keys: Vec::with_capacity(terms.len()), values: Vec::with_capacity(terms.len()) };
        for (key, value) in terms {
            result.push(field, key, value);
        }
        result.drop_zero();
        result
    }

    /// Adds a term. Its key is at most the last one.
    fn push<K: WordField>(&mut self, field: &K, key: u128, value: u64) {
        if self.keys.last() == Some(&key) {
            let last = self.values.last_mut().expect("as many values as keys");
            *last = field.add(*last, value);
        } else {
            self.drop_zero();
            self.keys.push(key);
            self.values.push(value);
        }
    }

    fn drop_zero(&mut self) {
        if self.values.last() == Some(&0) {
            self.keys.pop();
            self.values.pop();
        }
    }

    /// The terms, greatest first.
    pub fn terms(&self) -> impl Iterator<Item = (u128, u64)> + '_ {
        self.keys.iter().copied().zip(self.values.iter().copied())
    }

    /// Whether this is zero.
    pub fn is_zero(&self) -> bool {
        self.keys.is_empty()
    }

    /// Whether this is a constant, zero included.
    pub fn is_constant(&self) -> bool {
        self.keys.first().is_none_or(|&key| key == 0)
    }

    /// The degree in each variable.
    pub fn degrees(&self, packing: &Packing) -> Vec<u32> {
        (0..packing.variables()).map(|v| self.degree_in(packing, v)).collect()
    }

    /// The degree in one variable; 0 for zero.
    pub fn degree_in(&self, packing: &Packing, variable: usize) -> u32 {
        self.keys.iter().map(|&key| packing.exponent(key, variable)).max().unwrap_or(0)
    }

    /// `f` divided by its leading value.
    pub fn monic<K: WordField>(&self, field: &K) -> Self {
        match self.values.first().and_then(|&lead| field.inverse(lead)) {
            Some(inverse) if inverse != 1 => self.scale(field, inverse),
            _ => self.clone(),
        }
    }

    /// `c f` for a nonzero `c`.
    pub fn scale<K: WordField>(&self, field: &K, c: u64) -> Self {
        Flat { keys: self.keys.clone(), values: self.values.iter().map(|&value| field.mul(value, c)).collect() }
    }

    /// `f g`.
    pub fn mul<K: WordField>(&self, field: &K, other: &Flat) -> Self {
        let mut terms = Vec::with_capacity(self.keys.len() * other.keys.len());
        for (a, x) in self.terms() {
            terms.extend(other.terms().map(|(b, y)| (a + b, field.mul(x, y))));
        }
        Flat::collect(field, terms)
    }

    /// The coefficients as a polynomial in one variable: `result[k]` is the coefficient of the `k`-th power.
    pub fn coefficients_in(&self, packing: &Packing, variable: usize) -> Vec<Flat> {
        let mut parts = vec![Flat::default(); self.degree_in(packing, variable) as usize + 1];
        for (key, value) in self.terms() {
            let part = &mut parts[packing.exponent(key, variable) as usize];
            part.keys.push(packing.without(key, variable));
            part.values.push(value);
        }
        parts
    }

    /// The leading coefficient as a polynomial in one variable.
    pub fn leading_in(&self, packing: &Packing, variable: usize) -> Flat {
        self.coefficients_in(packing, variable).pop().unwrap_or_default()
    }

    /// Substitutes the element `x` for one variable.
    pub fn evaluate<K: WordField>(&self, field: &K, packing: &Packing, variable: usize, x: u64) -> Self {
        let table = powers(field, x, self.degree_in(packing, variable));
        let image = |(key, value)| {
            let power = table[packing.exponent(key, variable) as usize];
            (packing.without(key, variable), field.mul(value, power))
        };
        Flat::collect(field, self.terms().map(image).collect())
    }

    /// The dense form of a polynomial in `variable` alone.
    pub fn dense(&self, packing: &Packing, variable: usize) -> Dense {
        let mut result = vec![0; if self.is_zero() { 0 } else { self.degree_in(packing, variable) as usize + 1 }];
        self.terms().for_each(|(key, value)| result[packing.exponent(key, variable) as usize] = value);
        result
    }

    /// The polynomial in `variable` with these coefficients.
    pub fn from_dense(packing: &Packing, variable: usize, f: &[u64]) -> Self {
        let terms = f.iter().enumerate().rev().filter(|(_, value)| **value != 0);
        let (keys, values) = terms.map(|(n, &value)| (packing.power(variable, n as u32), value)).unzip();
        Flat { keys, values }
    }

    /// `f / g` if `g` divides `f`, with a heap of the products of quotient and divisor (Monagan and Pearce 2011).
    pub fn exact_div<K: WordField>(&self, field: &K, packing: &Packing, divisor: &Flat) -> Option<Self> {
        let (&lead, inverse) = (divisor.keys.first()?, field.inverse(*divisor.values.first()?)?);
        let room = packing.room(self, divisor)?;
        let mut quotient = Flat::default();
        let mut heap: BinaryHeap<(u128, usize, usize)> = BinaryHeap::new();
        let mut open = self.terms().peekable();
        while let Some(key) = open.peek().map(|term| term.0).into_iter().chain(heap.peek().map(|top| top.0)).max() {
            let mut value = open.next_if(|term| term.0 == key).map_or(0, |term| term.1);
            while let Some(&(_, q, d)) = heap.peek().filter(|top| top.0 == key) {
                value = field.sub(value, field.mul(quotient.values[q], divisor.values[d]));
                heap.pop();
                if let Some(next) = divisor.keys.get(d + 1) {
                    heap.push((quotient.keys[q] + next, q, d + 1));
                }
            }
            if value == 0 {
                continue;
            }
            if !packing.divides(lead, key) || !packing.divides(key - lead, room) {
                return None;
            }
            quotient.keys.push(key - lead);
            quotient.values.push(field.mul(value, inverse));
            if let Some(next) = divisor.keys.get(1) {
                heap.push((key - lead + next, quotient.keys.len() - 1, 1));
            }
        }
        Some(quotient)
    }
}
