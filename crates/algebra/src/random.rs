//! A deterministic pseudorandom number generator. Main type: [`SplitMix64`].

/// SplitMix64 (G. L. Steele, D. Lea and C. H. Flood, OOPSLA 2014). The numbers depend on the seed only, on every
/// computer. They are not for cryptography.
#[derive(Clone, Debug)]
pub struct SplitMix64(u64);

impl SplitMix64 {
    /// A generator with this seed.
    pub fn new(seed: u64) -> Self {
        SplitMix64(seed)
    }

    /// A number of 64 bits.
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number from 0 to `limit - 1`.
    ///
    /// # Panics
    /// When `limit` is zero.
    pub fn below(&mut self, limit: u64) -> u64 {
        self.word() % limit
    }

    /// A number from 1 to `p - 1`: a nonzero residue modulo a prime.
    ///
    /// # Panics
    /// When `p` is less than two.
    pub fn unit(&mut self, p: u64) -> u64 {
        1 + self.below(p - 1)
    }

    /// A number in \[0, 1), a multiple of 2^-53.
    pub fn share(&mut self) -> f64 {
        (self.word() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number in (low, high].
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        high - (high - low) * self.share()
    }
}
