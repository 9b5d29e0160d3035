//! Finite fields of `p^k` elements by tables of logarithms, for primes too small to give enough points.

use super::dense;
use super::field::{Prime, Random, WordField};

/// The largest field that gets tables.
const LIMIT: u64 = 1 << 20;

/// GF(p^k): an element is the number whose digits to the base `p` are its coefficients.
#[derive(Clone, Debug)]
pub struct Extension {
    p: u64,
    powers: Vec<u32>,
    logarithms: Vec<u32>,
}

impl Extension {
    /// The field of `p^k` elements; `None` above `2^20` elements.
    pub fn new(p: u64, k: u32) -> Option<Self> {
        let size = p.checked_pow(k).filter(|&size| size <= LIMIT)?;
        let base = Prime::new(p);
        let mut random = Random::new(size);
        loop {
            let mut modulus: Vec<u64> = (0..k).map(|_| random.below(p)).collect();
            modulus.push(1);
            if let Some(powers) = powers_of_x(&base, &modulus, size) {
                let mut logarithms = vec![0; size as usize];
                powers.iter().enumerate().for_each(|(n, &power)| logarithms[power as usize] = n as u32);
                return Some(Extension { p, powers, logarithms });
            }
        }
    }
}

/// All powers of `x` modulo `modulus` as numbers, if they are all `size - 1` nonzero elements: then `modulus` is a
/// primitive polynomial.
fn powers_of_x(base: &Prime, modulus: &[u64], size: u64) -> Option<Vec<u32>> {
    let mut powers = Vec::with_capacity(size as usize - 1);
    let mut power = dense::rem(base, &[1], modulus);
    for n in 0..size - 1 {
        let number = power.iter().rev().fold(0, |number, &digit| number * base.modulus() + digit);
        if number == 0 || (n > 0 && number == 1) {
            return None;
        }
        powers.push(number as u32);
        power.insert(0, 0);
        power = dense::rem(base, &power, modulus);
    }
    (power == [1]).then_some(powers)
}

impl WordField for Extension {
    fn size(&self) -> u64 {
        self.logarithms.len() as u64
    }
    fn characteristic(&self) -> u64 {
        self.p
    }
    fn add(&self, a: u64, b: u64) -> u64 {
        if self.p == 2 {
            return a ^ b;
        }
        let (mut a, mut b, mut sum, mut place) = (a, b, 0, 1);
        while a > 0 || b > 0 {
            sum += (a % self.p + b % self.p) % self.p * place;
            (a, b, place) = (a / self.p, b / self.p, place * self.p);
        }
        sum
    }
    fn neg(&self, a: u64) -> u64 {
        let (mut a, mut result, mut place) = (a, 0, 1);
        while a > 0 {
            result += (self.p - a % self.p) % self.p * place;
            (a, place) = (a / self.p, place * self.p);
        }
        result
    }
    fn mul(&self, a: u64, b: u64) -> u64 {
        if a == 0 || b == 0 {
            return 0;
        }
        let sum = self.logarithms[a as usize] as usize + self.logarithms[b as usize] as usize;
        u64::from(self.powers[if sum >= self.powers.len() { sum - self.powers.len() } else { sum }])
    }
    fn inverse(&self, a: u64) -> Option<u64> {
        let logarithm = *self.logarithms.get(a as usize)? as usize;
        (a != 0).then(|| u64::from(self.powers[(self.powers.len() - logarithm) % self.powers.len()]))
    }
}
