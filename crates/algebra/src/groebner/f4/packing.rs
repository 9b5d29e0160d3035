//! Monomials as fixed arrays of words. Multiplication adds lanes, and comparison in any order compares numbers.
//!
//! A lane holds an exponent or the degree of a block of variables, greatest significance first. Orders that compare an
//! exponent in reverse (graded reverse) flip its lane before the comparison: one exclusive or per word.

use std::cmp::Ordering;

use crate::poly::Order;

/// A packed monomial of `W` words.
pub(super) type Key<const W: usize> = [u64; W];

/// Odd multipliers: the hash of a product is the sum of the hashes.
const MIX: [u64; 8] = [
    0x9e37_79b9_7f4a_7c15,
    0xc2b2_ae3d_27d4_eb4f,
    0x1656_67b1_9e37_79f9,
    0xff51_afd7_ed55_8ccd,
    0xc4ce_b9fe_1a85_ec53,
    0xd6e8_feb8_6659_fd93,
    0xa076_1d64_78bd_642f,
    0xe703_7ed1_a0b4_28db,
];

/// A lane: the exponent of one variable, or the degree in a range of them.
#[derive(Clone, Debug)]
enum Lane {
    Exponent { variable: usize, flipped: bool },
    Degree { from: usize, to: usize },
}

/// Positions of the lanes, and the comparison of keys.
#[derive(Clone, Debug)]
pub(super) struct Packing<const W: usize> {
    bits: u32,
    flip: Key<W>,
    guard: Key<W>,
    exponents: Vec<(usize, u32)>,
    degrees: Vec<(usize, u32, usize, usize)>,
    degree_lanes: Key<W>,
    total: (usize, u32),
}

/// The number of words for `variables` variables in `order` with lanes of `bits` bits.
pub(super) fn words(order: &Order, variables: usize, bits: u32) -> usize {
    lanes(order, variables).len().div_ceil((64 / bits) as usize)
}

fn lanes(order: &Order, variables: usize) -> Vec<Lane> {
    let mut lanes = Vec::new();
    let mut block = |from: usize, to: usize, graded: bool| {
        if graded {
            lanes.push(Lane::Degree { from, to });
            lanes.extend((from..to).rev().map(|variable| Lane::Exponent { variable, flipped: true }));
        } else {
            lanes.extend((from..to).map(|variable| Lane::Exponent { variable, flipped: false }));
        }
    };
    match order {
        Order::Lex => block(0, variables, false),
        Order::GrevLex => block(0, variables, true),
        Order::Block(blocks) => {
            let mut from = 0;
            for part in blocks {
                block(from, from + part.size, part.graded);
                from += part.size;
            }
        }
    }
    let is_total = |lane: &Lane| matches!(lane, Lane::Degree { from: 0, to } if *to == variables);
    if !lanes.iter().any(is_total) {
        lanes.push(Lane::Degree { from: 0, to: variables });
    }
    lanes
}

impl<const W: usize> Packing<W> {
    /// Builds the packing of `variables` variables, greatest first, in `order`. It takes at most `W` words.
    pub fn new(order: &Order, variables: usize, bits: u32) -> Self {
        let per_word = (64 / bits) as usize;
        let mask = u64::MAX >> (64 - bits);
        let mut packing = Packing {
            bits,
            flip: [0; W],
            guard: [0; W],
            exponents: vec![(0, 0); variables],
            degrees: Vec::new(),
            degree_lanes: [0; W],
            total: (0, 0),
        };
        for (index, lane) in lanes(order, variables).into_iter().enumerate() {
            let (word, shift) = (index / per_word, (per_word - 1 - index % per_word) as u32 * bits);
            packing.guard[word] |= 1 << (shift + bits - 1);
            match lane {
                Lane::Exponent { variable, flipped } => {
                    packing.exponents[variable] = (word, shift);
                    packing.flip[word] |= if flipped { mask << shift } else { 0 };
                }
                Lane::Degree { from, to } => {
                    packing.degrees.push((word, shift, from, to));
                    packing.degree_lanes[word] |= mask << shift;
                    if (from, to) == (0, variables) {
                        packing.total = (word, shift);
                    }
                }
            }
        }
        packing
    }

    /// The key of an exponent vector; `None` when a degree does not fit.
    pub fn key(&self, exponents: &[u32]) -> Option<Key<W>> {
        let total: u64 = exponents.iter().map(|&e| u64::from(e)).sum();
        if total >= 1 << (self.bits - 1) {
            return None;
        }
        let mut key = [0; W];
        for (&exponent, &(word, shift)) in exponents.iter().zip(&self.exponents) {
            key[word] |= u64::from(exponent) << shift;
        }
        Some(self.with_degrees(key))
    }

    /// Fills the degree lanes from the exponents.
    fn with_degrees(&self, mut key: Key<W>) -> Key<W> {
        for &(word, shift, from, to) in &self.degrees {
            let degree: u64 = (from..to).map(|variable| u64::from(self.exponent(&key, variable))).sum();
            key[word] |= degree << shift;
        }
        key
    }

    /// The exponent of one variable.
    pub fn exponent(&self, key: &Key<W>, variable: usize) -> u32 {
        self.lane(key, self.exponents[variable])
    }

    /// Writes all exponents.
    pub fn unpack(&self, key: &Key<W>, exponents: &mut [u32]) {
        for (variable, exponent) in exponents.iter_mut().enumerate() {
            *exponent = self.exponent(key, variable);
        }
    }

    fn lane(&self, key: &Key<W>, (word, shift): (usize, u32)) -> u32 {
        ((key[word] >> shift) & (u64::MAX >> (64 - self.bits))) as u32
    }

    /// The total degree.
    pub fn degree(&self, key: &Key<W>) -> u32 {
        self.lane(key, self.total)
    }

    /// The key in the form that is compared: word by word, as numbers.
    pub fn rank(&self, key: &Key<W>) -> Key<W> {
        std::array::from_fn(|word| key[word] ^ self.flip[word])
    }

    /// Compares in the monomial order.
    pub fn compare(&self, a: &Key<W>, b: &Key<W>) -> Ordering {
        self.rank(a).cmp(&self.rank(b))
    }

    /// Whether `a` divides `b`.
    #[inline]
    pub fn divides(&self, a: &Key<W>, b: &Key<W>) -> bool {
        (0..W).all(|word| ((b[word] | self.guard[word]) - a[word]) & self.guard[word] == self.guard[word])
    }

    /// Whether a product overflows its lanes.
    pub fn overflows(&self, key: &Key<W>) -> bool {
        (0..W).any(|word| key[word] & self.guard[word] != 0)
    }

    /// The least common multiple; `None` when its degree does not fit.
    pub fn lcm(&self, a: &Key<W>, b: &Key<W>) -> Option<Key<W>> {
        let mut key = [0; W];
        for word in 0..W {
            let (x, y) = (a[word] & !self.degree_lanes[word], b[word] & !self.degree_lanes[word]);
            let greater = ((x | self.guard[word]) - y) & self.guard[word];
            let mask = greater | (greater - (greater >> (self.bits - 1)));
            key[word] = (x & mask) | (y & !mask);
        }
        let key = self.with_degrees(key);
        (!self.overflows(&key)).then_some(key)
    }

    /// Whether `a` and `b` share no variable, given their least common multiple.
    pub fn coprime(&self, a: &Key<W>, b: &Key<W>, lcm: &Key<W>) -> bool {
        product(a, b) == *lcm
    }
}

/// `a b`. The caller checks for overflow.
#[inline]
pub(super) fn product<const W: usize>(a: &Key<W>, b: &Key<W>) -> Key<W> {
    std::array::from_fn(|word| a[word].wrapping_add(b[word]))
}

/// `a / b` for a divisor `b`.
pub(super) fn quotient<const W: usize>(a: &Key<W>, b: &Key<W>) -> Key<W> {
    std::array::from_fn(|word| a[word] - b[word])
}

/// A linear hash.
#[inline]
pub(super) fn hash<const W: usize>(key: &Key<W>) -> u64 {
    (0..W).fold(0, |sum: u64, word| sum.wrapping_add(key[word].wrapping_mul(MIX[word])))
}
