//! Sums of products of residues below 2^31, reduced modulo the prime at the end.
//!
//! Four products fit a 64-bit word. Each such sum is split into two halves, which are accumulated separately: `hi *
//! 2^32 + lo`.

use crate::number::word::Prime;

/// The length of a padded row is a multiple of this.
pub(super) const LANES: usize = 32;

const LOW: u64 = 0xffff_ffff;

/// The least multiple of [`LANES`] that is at least `length`.
pub(super) fn padded(length: usize) -> usize {
    length.next_multiple_of(LANES)
}

/// The vector instruction set of this machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Level {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Level {
    /// Detects the instruction set.
    pub fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if std::arch::is_x86_feature_detected!("avx512f") {
                return Level::Avx512;
            }
            if std::arch::is_x86_feature_detected!("avx2") {
                return Level::Avx2;
            }
        }
        Level::Portable
    }
}

/// Compiles one body for each level and selects it at run time.
macro_rules! kernel {
    ($(#[$text:meta])* fn $name:ident($($arg:ident: $type:ty),*) $(-> $result:ty)? $body:block) => {
        $(#[$text])*
        pub(super) fn $name(level: Level, $($arg: $type),*) $(-> $result)? {
            #[inline(always)]
            fn portable($($arg: $type),*) $(-> $result)? $body
            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = "avx2")]
            fn avx2($($arg: $type),*) $(-> $result)? {
                portable($($arg),*)
            }
            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = "avx512f")]
            fn avx512($($arg: $type),*) $(-> $result)? {
                portable($($arg),*)
            }
            match level {
                Level::Portable => portable($($arg),*),
                // SAFETY: `Level::detect` found the instructions on this machine.
                #[cfg(target_arch = "x86_64")]
                #[allow(unsafe_code)]
                Level::Avx2 => unsafe { avx2($($arg),*) },
                // SAFETY: as above.
                #[cfg(target_arch = "x86_64")]
                #[allow(unsafe_code)]
                Level::Avx512 => unsafe { avx512($($arg),*) },
            }
        }
    };
}

kernel! {
    /// The halves `(lo, hi)` of the sum of `a[i] b[i]`; both have the same length, a multiple of [`LANES`].
    fn dot(a: &[u32], b: &[u32]) -> (u64, u64) {
        let quarter = a.len().min(b.len()) / 4;
        let range = |k: usize| k * quarter..(k + 1) * quarter;
        let (a, b) = ([0, 1, 2, 3].map(|k| &a[range(k)]), [0, 1, 2, 3].map(|k| &b[range(k)]));
        let (mut lo, mut hi) = (0, 0);
        for i in 0..quarter {
            let product = |k: usize| u64::from(a[k][i]) * u64::from(b[k][i]);
            let sum = product(0) + product(1) + product(2) + product(3);
            lo += sum & LOW;
            hi += sum >> 32;
        }
        (lo, hi)
    }
}

kernel! {
    /// Adds `factor * row` to the sums.
    fn add_one(lo: &mut [u64], hi: &mut [u64], factor: u32, row: &[u32]) {
        for ((lo, hi), entry) in lo.iter_mut().zip(hi).zip(row) {
            let product = u64::from(factor) * u64::from(*entry);
            *lo += product & LOW;
            *hi += product >> 32;
        }
    }
}

kernel! {
    /// Adds four multiples of rows of the same length to the sums.
    fn add_four(lo: &mut [u64], hi: &mut [u64], factors: [u32; 4], rows: [&[u32]; 4]) {
        let length = lo.len();
        let (hi, [a, b, c, d]) = (&mut hi[..length], rows.map(|row| &row[..length]));
        let [fa, fb, fc, fd] = factors.map(u64::from);
        for i in 0..length {
            let (x, y) = (fa * u64::from(a[i]), fb * u64::from(b[i]));
            let sum = x + y + fc * u64::from(c[i]) + fd * u64::from(d[i]);
            lo[i] += sum & LOW;
            hi[i] += sum >> 32;
        }
    }
}

/// Constants of Montgomery reduction (Mathematics of Computation 44, 1985) with R = 2^32.
#[derive(Clone, Copy, Debug)]
pub(super) struct Montgomery {
    p: u64,
    /// `-1/p mod R`.
    factor: u64,
    /// `R^2 mod p` and `R^3 mod p`.
    powers: [u64; 2],
}

impl Montgomery {
    /// The constants for an odd `p` below 2^31.
    fn new(p: u64) -> Self {
        let double = |inverse: u64| inverse.wrapping_mul(2u64.wrapping_sub(p.wrapping_mul(inverse)));
        let inverse = (0..5).fold(p, |inverse, _| double(inverse));
        let r = (1 << 32) % p;
        let square = r * r % p;
        Montgomery { p, factor: inverse.wrapping_neg() & LOW, powers: [square, square * r % p] }
    }

    /// `t / R mod p` for `t < R p`.
    #[inline(always)]
    fn divide(self, t: u64) -> u64 {
        let multiple = ((t & LOW) * self.factor) & LOW;
        let quotient = (t + multiple * self.p) >> 32;
        quotient.min(quotient.wrapping_sub(self.p))
    }
}

kernel! {
    /// The residues of `hi * 2^32 + lo`, both below `2^32 p`.
    fn reduce_all(lo: &[u64], hi: &[u64], montgomery: Montgomery, residues: &mut [u32]) {
        let [square, cube] = montgomery.powers;
        for ((&lo, &hi), residue) in lo.iter().zip(hi).zip(residues) {
            let sum = montgomery.divide(lo) * square + montgomery.divide(hi) * cube;
            *residue = montgomery.divide(sum) as u32;
        }
    }
}

/// Arithmetic modulo a prime below 2^31 with delayed reduction of sums of products.
#[derive(Clone, Copy, Debug)]
pub(super) struct Modulus {
    prime: Prime,
    montgomery: Montgomery,
    pub level: Level,
}

impl Modulus {
    /// Exclusive upper bound of the modulus.
    pub const LIMIT: u64 = 1 << 31;

    /// Builds the modulus; `None` when `p` is too large.
    pub fn new(p: u64) -> Option<Self> {
        (p < Self::LIMIT).then(|| Modulus {
            prime: Prime::new(p as u32),
            montgomery: Montgomery::new(p),
            level: Level::detect(),
        })
    }

    /// The residue of `hi * 2^32 + lo` for `lo < 2^63`.
    pub fn reduce(self, lo: u64, hi: u64) -> u32 {
        self.prime.reduce((self.prime.reduce(hi) << 32) + self.prime.reduce(lo)) as u32
    }

    /// The residue of a word.
    pub fn residue(self, word: u64) -> u32 {
        self.prime.reduce(word) as u32
    }

    pub fn neg(self, a: u32) -> u32 {
        self.prime.neg(u64::from(a)) as u32
    }

    pub fn mul(self, a: u32, b: u32) -> u32 {
        self.residue(u64::from(a) * u64::from(b))
    }

    /// `a + b c`.
    pub fn add_mul(self, a: u32, b: u32, c: u32) -> u32 {
        self.residue(u64::from(a) + u64::from(b) * u64::from(c))
    }

    /// The inverse of a residue that is not zero.
    pub fn inverse(self, a: u32) -> u32 {
        self.prime.inverse(u64::from(a)) as u32
    }

    /// The sum of `a[i] b[i]` over padded rows.
    pub fn dot(self, a: &[u32], b: &[u32]) -> u32 {
        let (lo, hi) = dot(self.level, a, b);
        self.reduce(lo, hi)
    }
}

/// A vector of sums of products.
#[derive(Clone, Debug)]
pub(super) struct Sums {
    modulus: Modulus,
    pub lo: Vec<u64>,
    pub hi: Vec<u64>,
}

impl Sums {
    pub fn new(modulus: Modulus, length: usize) -> Self {
        Sums { modulus, lo: vec![0; length], hi: vec![0; length] }
    }

    /// Sets the sums to the residues `row`.
    pub fn set(&mut self, row: &[u32]) {
        self.hi.fill(0);
        self.lo.iter_mut().zip(row).for_each(|(lo, &entry)| *lo = u64::from(entry));
    }

    /// Adds `factor * row` from position `at` on.
    pub fn add_at(&mut self, at: usize, factor: u32, row: &[u32]) {
        add_one(self.modulus.level, &mut self.lo[at..], &mut self.hi[at..], factor, row);
    }

    /// Adds the multiples of rows, four at a time.
    pub fn add<'a>(&mut self, mut terms: impl Iterator<Item = (u32, &'a [u32])>) {
        let mut term = || terms.next().unwrap_or((0, &[]));
        loop {
            let four = [term(), term(), term(), term()];
            if four[3].1.is_empty() {
                let rest = four.into_iter().filter(|(_, row)| !row.is_empty());
                return rest.for_each(|(factor, row)| self.add_at(0, factor, row));
            }
            add_four(self.modulus.level, &mut self.lo, &mut self.hi, four.map(|f| f.0), four.map(|f| f.1));
        }
    }

    /// The residue at one position.
    pub fn get(&self, at: usize) -> u32 {
        self.modulus.reduce(self.lo[at], self.hi[at])
    }

    pub fn clear(&mut self, range: std::ops::Range<usize>) {
        self.lo[range.clone()].fill(0);
        self.hi[range].fill(0);
    }

    /// All residues.
    pub fn residues(&self) -> Vec<u32> {
        if self.modulus.prime.p == 2 {
            return self.lo.iter().map(|lo| (lo & 1) as u32).collect();
        }
        let mut residues = vec![0; self.lo.len()];
        reduce_all(self.modulus.level, &self.lo, &self.hi, self.modulus.montgomery, &mut residues);
        residues
    }
}
