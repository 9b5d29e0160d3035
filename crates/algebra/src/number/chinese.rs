//! Chinese remainder theorem: integers from their residues modulo many word-size primes.
//!
//! [`Chinese`] stores all that depends on the primes alone (Knuth, TAOCP 2, section 4.3.2). The integer is the sum of
//! `c_p * (M / p)`, with one word `c_p` for each prime, minus a multiple of `M`. The fractions `c_p / p` determine this
//! multiple. One integer costs one multiplication by a word for each two primes, and no inversion.

use num_bigint::Sign;

use super::limbs::{add_product, signed, sub_product};
use super::{BigInt, Field, Ring, Zp};
use crate::{Error, ErrorKind, Result};

/// Precomputed tables for Chinese remaindering modulo a list of distinct primes below 2^31.
#[derive(Clone, Debug)]
pub struct Chinese {
    primes: Vec<u32>,
    modulus: BigInt,
    /// `M` in limbs.
    limbs: Vec<u64>,
    /// The inverse of `M / p` modulo `p` for each prime.
    inverses: Vec<u32>,
    /// `M / (p q)` for pairs of primes, each as long as `M`; `M / p` for a last single prime.
    cofactors: Vec<u64>,
}

impl Chinese {
    /// Builds the tables for `primes`. The cost is quadratic in the number of primes.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when a modulus is not a prime below 2^31, or is listed twice.
    pub fn new(primes: &[u32]) -> Result<Self> {
        primes.iter().try_for_each(|&p| check_prime(p))?;
        let modulus: BigInt = primes.iter().map(|&p| BigInt::from(p)).product();
        let length = modulus.iter_u64_digits().count();
        let padded = |n: &BigInt| {
            let mut limbs: Vec<u64> = n.iter_u64_digits().collect();
            limbs.resize(length, 0);
            limbs
        };
        let cofactor = |pair: &[u32]| padded(&(&modulus / pair.iter().map(|&p| u64::from(p)).product::<u64>()));
        let cofactors = primes.chunks(2).flat_map(cofactor).collect();
        let inverses = primes.iter().map(|&p| inverse_of_cofactor(&modulus, p)).collect::<Result<_>>()?;
        Ok(Chinese { primes: primes.to_vec(), limbs: padded(&modulus), modulus, inverses, cofactors })
    }

    /// The primes.
    pub fn primes(&self) -> &[u32] {
        &self.primes
    }

    /// The product `M` of the primes; one for an empty list.
    pub fn modulus(&self) -> &BigInt {
        &self.modulus
    }

    /// The factors with which [`Chinese::lift`] returns the integer itself.
    pub fn factors(&self) -> &[u32] {
        &self.inverses
    }

    /// The factors with which [`Chinese::lift`] returns `multiplier` times the integer.
    pub fn factors_times(&self, multiplier: &BigInt) -> Vec<u32> {
        let product = |(&p, &inverse): (&u32, &u32)| {
            let residue = super::residue(multiplier, p);
            (u64::from(residue) * u64::from(inverse) % u64::from(p)) as u32
        };
        self.primes.iter().zip(&self.inverses).map(product).collect()
    }

    /// The integer between `-M/2` and `M/2` whose residue modulo `primes[k]` is `residues[k]` times the multiplier of
    /// `factors`.
    ///
    /// # Panics
    /// When there are fewer residues or factors than primes.
    pub fn lift(&self, residues: &[u32], factors: &[u32]) -> BigInt {
        let length = self.limbs.len();
        let mut sum = vec![0u64; length + 2];
        let mut fraction = 1u64 << 31;
        let mut digit = |k: usize| {
            let p = u64::from(self.primes[k]);
            let digit = u64::from(residues[k]) * u64::from(factors[k]) % p;
            fraction += (digit << 32) / p;
            digit
        };
        for (pair, cofactor) in self.cofactors.chunks_exact(length.max(1)).enumerate() {
            let first = digit(2 * pair);
            let factor = match self.primes.get(2 * pair + 1) {
                Some(&q) => first * u64::from(q) + digit(2 * pair + 1) * u64::from(self.primes[2 * pair]),
                None => first,
            };
            add_product(&mut sum, cofactor, factor);
        }
        sub_product(&mut sum, &self.limbs, fraction >> 32);
        self.centred(signed(&sum))
    }

    /// The fractions were truncated, so the sum may be wrong by one `M`.
    fn centred(&self, n: BigInt) -> BigInt {
        if n.bits() + 1 < self.modulus.bits() {
            return n;
        }
        let twice: BigInt = &n << 1;
        match twice.sign() {
            Sign::Plus if twice > self.modulus => n - &self.modulus,
            Sign::Minus if -twice > self.modulus => n + &self.modulus,
            _ => n,
        }
    }
}

fn refused(p: u32, why: &str) -> Error {
    Error::new(ErrorKind::BadValue, format!("modulus {p} {why}; give distinct primes below 2^31"))
}

fn check_prime(p: u32) -> Result<()> {
    match Zp::new(u64::from(p)) {
        Ok(_) if p < 1 << 31 => Ok(()),
        Ok(_) => Err(refused(p, "is too large")),
        Err(_) => Err(refused(p, "is not a prime")),
    }
}

/// The inverse of `M / p` modulo the prime `p`.
fn inverse_of_cofactor(modulus: &BigInt, p: u32) -> Result<u32> {
    let field = Zp::new(u64::from(p))?;
    let inverse = field.inverse(&field.from_integer(&(modulus / p)));
    Ok(inverse.ok_or_else(|| refused(p, "is listed twice"))? as u32)
}
