//! Packed monomials: exponents in lanes of machine words, the total degree in the first lane.
//!
//! A [`Layout`] fixes the lane width and the lane of each variable; a [`Monomial`] is plain words. No exponent exceeds
//! the total degree, so overflow is checked in the degree lane alone. The top bit of every lane stays zero, so
//! divisibility is one subtraction per word.

use std::cmp::Ordering;

use smallvec::SmallVec;

use super::order::Order;

/// The product of powers `x1^a1 ... xn^an`, packed by some [`Layout`].
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Monomial {
    words: SmallVec<[u64; 3]>,
}

/// The width of a lane, which limits the total degree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Width {
    /// Total degrees up to 127.
    Bits8,
    /// Total degrees up to 32,767.
    Bits16,
    /// Total degrees up to 2,147,483,647.
    Bits32,
}

impl Width {
    /// Bits of a lane.
    pub(crate) fn bits(self) -> u32 {
        match self {
            Width::Bits8 => 8,
            Width::Bits16 => 16,
            Width::Bits32 => 32,
        }
    }

    /// The largest total degree.
    pub fn max_degree(self) -> u32 {
        (1 << (self.bits() - 1)) - 1
    }

    /// The next wider lane, if there is one.
    pub fn wider(self) -> Option<Width> {
        match self {
            Width::Bits8 => Some(Width::Bits16),
            Width::Bits16 => Some(Width::Bits32),
            Width::Bits32 => None,
        }
    }
}

/// The position of each variable's exponent in the words of a monomial, and the comparison of monomials.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    variables: usize,
    width: Width,
    order: Order,
}

impl Layout {
    /// Builds the layout of `variables` variables (greatest first) in `order`.
    ///
    /// # Panics
    /// When a block order does not cover exactly `variables` variables.
    pub fn new(variables: usize, width: Width, order: Order) -> Self {
        if let Order::Block(blocks) = &order {
            let covered: usize = blocks.iter().map(|block| block.size).sum();
            assert_eq!(covered, variables, "the blocks of an order cover all its variables");
        }
        Layout { variables, width, order }
    }

    /// Number of variables.
    pub(crate) fn variables(&self) -> usize {
        self.variables
    }

    /// Lane width.
    pub fn width(&self) -> Width {
        self.width
    }

    /// The monomial order.
    pub fn order(&self) -> &Order {
        &self.order
    }

    /// The binary logarithm of the number of lanes in a word, for positions by shifts.
    fn lanes_per_word_log2(&self) -> u32 {
        match self.width {
            Width::Bits8 => 3,
            Width::Bits16 => 2,
            Width::Bits32 => 1,
        }
    }

    fn lanes_per_word(&self) -> usize {
        1 << self.lanes_per_word_log2()
    }

    /// In graded reverse orders the lanes of the variables are reversed, so that words compare as numbers.
    fn lane(&self, variable: usize) -> usize {
        match self.order {
            Order::GrevLex => self.variables - variable,
            _ => variable + 1,
        }
    }

    fn place(&self, lane: usize) -> (usize, u32) {
        let last = self.lanes_per_word() - 1;
        let shift = (last - (lane & last)) as u32 * self.width.bits();
        (lane >> self.lanes_per_word_log2(), shift)
    }

    fn lane_mask(&self) -> u64 {
        u64::MAX >> (64 - self.width.bits())
    }

    fn guard_bits(&self) -> u64 {
        let lane = 1u64 << (self.width.bits() - 1);
        (0..self.lanes_per_word()).fold(0, |mask, k| mask | lane << (k as u32 * self.width.bits()))
    }

    fn degree_mask(&self) -> u64 {
        self.lane_mask() << (64 - self.width.bits())
    }

    /// The monomial 1.
    pub fn one(&self) -> Monomial {
        let words = (self.variables >> self.lanes_per_word_log2()) + 1;
        Monomial { words: SmallVec::from_elem(0, words) }
    }

    /// Packs `exponents`, one for each variable; `None` when the total degree does not fit.
    pub fn pack(&self, exponents: &[u32]) -> Option<Monomial> {
        debug_assert_eq!(exponents.len(), self.variables);
        let degree: u64 = exponents.iter().map(|&e| u64::from(e)).sum();
        if degree > u64::from(self.width.max_degree()) {
            return None;
        }
        let mut monomial = self.one();
        monomial.words[0] |= degree << (64 - self.width.bits());
        for (variable, &exponent) in exponents.iter().enumerate() {
            let (word, shift) = self.place(self.lane(variable));
            monomial.words[word] |= u64::from(exponent) << shift;
        }
        Some(monomial)
    }

    /// The exponent of `variable` in `m`.
    pub fn exponent(&self, m: &Monomial, variable: usize) -> u32 {
        let (word, shift) = self.place(self.lane(variable));
        ((m.words[word] >> shift) & self.lane_mask()) as u32
    }

    /// All exponents of `m`.
    pub fn exponents(&self, m: &Monomial) -> Vec<u32> {
        (0..self.variables).map(|variable| self.exponent(m, variable)).collect()
    }

    /// Whether `m` can belong to this layout. This detects most monomials of another lane width or number of variables.
    pub fn is_packed(&self, m: &Monomial) -> bool {
        m.words.len() == self.one().words.len() && self.pack(&self.exponents(m)).is_some_and(|packed| packed == *m)
    }

    /// The total degree of `m`.
    pub fn degree(&self, m: &Monomial) -> u32 {
        (m.words[0] >> (64 - self.width.bits())) as u32
    }

    /// `a b`, or `None` when the degree does not fit.
    pub fn checked_mul(&self, a: &Monomial, b: &Monomial) -> Option<Monomial> {
        let degree = u64::from(self.degree(a)) + u64::from(self.degree(b));
        (degree <= u64::from(self.width.max_degree())).then(|| zip(a, b, |x, y| x + y))
    }

    /// Whether `a` divides `b`.
    pub fn divides(&self, a: &Monomial, b: &Monomial) -> bool {
        let guard = self.guard_bits();
        a.words.iter().zip(&b.words).all(|(x, y)| ((y | guard) - x) & guard == guard)
    }

    /// `b / a`, or `None` when `a` does not divide `b`.
    pub fn checked_div(&self, b: &Monomial, a: &Monomial) -> Option<Monomial> {
        self.divides(a, b).then(|| zip(b, a, |x, y| x - y))
    }

    /// The least common multiple, or `None` when its degree does not fit.
    pub fn lcm(&self, a: &Monomial, b: &Monomial) -> Option<Monomial> {
        self.merge(a, b, u32::max)
    }

    /// The greatest common divisor.
    pub fn gcd(&self, a: &Monomial, b: &Monomial) -> Monomial {
        self.merge(a, b, u32::min).expect("a divisor has no larger degree")
    }

    fn merge(&self, a: &Monomial, b: &Monomial, pick: fn(u32, u32) -> u32) -> Option<Monomial> {
        let exponents: SmallVec<[u32; 16]> =
            (0..self.variables).map(|v| pick(self.exponent(a, v), self.exponent(b, v))).collect();
        self.pack(&exponents)
    }

    /// Whether `a` and `b` share no variable.
    pub fn coprime(&self, a: &Monomial, b: &Monomial) -> bool {
        (0..self.variables).all(|v| self.exponent(a, v) == 0 || self.exponent(b, v) == 0)
    }

    /// The variable and exponent when `m` is a power of one variable; `None` for 1.
    pub fn pure_power(&self, m: &Monomial) -> Option<(usize, u32)> {
        let degree = self.degree(m);
        (0..self.variables).find(|&v| degree > 0 && self.exponent(m, v) == degree).map(|v| (v, degree))
    }

    /// Compares in the monomial order.
    pub fn compare(&self, a: &Monomial, b: &Monomial) -> Ordering {
        match &self.order {
            Order::Lex => self.compare_lanes(a, b),
            Order::GrevLex => {
                let degrees = self.degree(a).cmp(&self.degree(b));
                degrees.then_with(|| self.compare_lanes(b, a))
            }
            Order::Block(blocks) => super::order::compare_blocks(blocks, &self.exponents(a), &self.exponents(b)),
        }
    }

    /// Compares the words as numbers, without the degree lane.
    fn compare_lanes(&self, a: &Monomial, b: &Monomial) -> Ordering {
        let mask = !self.degree_mask();
        let first = (a.words[0] & mask).cmp(&(b.words[0] & mask));
        first.then_with(|| a.words[1..].cmp(&b.words[1..]))
    }
}

fn zip(a: &Monomial, b: &Monomial, f: impl Fn(u64, u64) -> u64) -> Monomial {
    Monomial { words: a.words.iter().zip(&b.words).map(|(&x, &y)| f(x, y)).collect() }
}
