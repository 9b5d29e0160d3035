//! Pseudorandom joint vectors.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use groebot_runtime::redundant::{Limits, MOST_JOINTS, Q};

/// Random numbers (xorshift, G. Marsaglia 2003).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Random(88_172_645_463_325_252 ^ seed)
    }

    /// In `[0, 1)`.
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The range of a joint's random values: its limits, or one turn.
fn range([low, high]: [f64; 2]) -> [f64; 2] {
    if high - low >= TAU - 1e-9 { [-PI, PI] } else { [low, high] }
}

/// Uniform within limits. Entries from the number of joints on are 0.
pub fn random(limits: &Limits, count: usize, random: &mut Random) -> Q {
    let mut q = [0.0; MOST_JOINTS];
    for i in 0..count {
        let [low, high] = range(limits[i]);
        q[i] = low + random.unit() * (high - low);
    }
    q
}

/// Multiples of 15 degrees within limits.
pub fn round(limits: &Limits, count: usize, random: &mut Random) -> Q {
    let step = 15.0_f64.to_radians();
    let mut q = [0.0; MOST_JOINTS];
    for i in 0..count {
        let [low, high] = range(limits[i]).map(|limit| limit / step);
        let (low, high) = ((low - 1e-12).ceil(), (high + 1e-12).floor());
        q[i] = step * (low + (random.unit() * (high - low + 1.0)).floor());
    }
    q
}

/// Anywhere in a whole turn.
pub fn anywhere(count: usize, random: &mut Random) -> Q {
    let mut q = [0.0; MOST_JOINTS];
    q[..count].iter_mut().for_each(|value| *value = PI - TAU * random.unit());
    q
}

/// The vectors of a CSV file, one a row, without a header.
pub fn read(file: &Path) -> Vec<Q> {
    let text = std::fs::read_to_string(file).expect("a file of joint vectors");
    let row = |line: &str| {
        let mut q = [0.0; MOST_JOINTS];
        line.split(',').zip(&mut q).for_each(|(word, value)| *value = word.trim().parse().expect("a number"));
        q
    };
    text.lines().map(row).collect()
}
