//! Finite fields of `p^k` elements by tables of logarithms, for primes with too few points.

use super::field::WordField;
use crate::random::SplitMix64;

/// Maximum size of a field with tables.
const LIMIT: u64 = 1 << 20;

/// GF(p^k). An element is the number whose digits to the base `p` are its coefficients.
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
        let mut random = SplitMix64::new(size);
        loop {
            let modulus = 1 + random.below(size - 1);
            if let Some(powers) = powers_of_x(p, size, modulus) {
                let mut logarithms = vec![0; size as usize];
                powers.iter().enumerate().for_each(|(n, &power)| logarithms[power as usize] = n as u32);
                return Some(Extension { p, powers, logarithms });
            }
        }
    }
}

/// All powers of `x` as numbers, where `x^k` is the element `top`, if they are all `size - 1` nonzero elements. Then
/// `x^k - top` is a primitive polynomial.
fn powers_of_x(p: u64, size: u64, top: u64) -> Option<Vec<u32>> {
    let multiples: Vec<u64> =
        std::iter::successors(Some(0), |&n| Some(add_digits(p, n, top))).take(p as usize).collect();
    let place = size / p;
    let (mut powers, mut power) = (Vec::with_capacity(size as usize - 1), 1);
    for n in 0..size - 1 {
        if power == 0 || (n > 0 && power == 1) {
            return None;
        }
        powers.push(power as u32);
        power = add_digits(p, power % place * p, multiples[(power / place) as usize]);
    }
    (power == 1).then_some(powers)
}

/// The sum, digit by digit to the base `p`.
fn add_digits(p: u64, mut a: u64, mut b: u64) -> u64 {
    if p == 2 {
        return a ^ b;
    }
    let (mut sum, mut place) = (0, 1);
    while a > 0 || b > 0 {
        sum += (a % p + b % p) % p * place;
        (a, b, place) = (a / p, b / p, place * p);
    }
    sum
}

impl WordField for Extension {
    fn size(&self) -> u64 {
        self.logarithms.len() as u64
    }
    fn characteristic(&self) -> u64 {
        self.p
    }
    fn add(&self, a: u64, b: u64) -> u64 {
        add_digits(self.p, a, b)
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
