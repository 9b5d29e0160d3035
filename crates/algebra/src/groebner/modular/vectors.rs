//! Vectors of rational numbers with a common denominator, reconstructed from their residues.
//!
//! A random combination of the entries, the witness, shows when there are enough primes, and gives the denominator.
//! Then each entry times the denominator is an integer, reconstructed without divisions.

use num_traits::Zero;

use crate::Result;
use crate::number::{BigInt, BigRational, Chinese, reconstruct, residue};

/// Number of bits by which a number must be smaller than the modulus to be accepted.
const SURPLUS: u32 = 32;

/// A vector of rational numbers: integers over one denominator.
#[derive(Clone, Debug)]
pub(super) struct Vector {
    pub numerators: Vec<BigInt>,
    /// The positive common denominator.
    pub denominator: BigInt,
}

/// The tables of Chinese remaindering for the first of some primes.
pub(super) struct Tables<'a> {
    primes: &'a [u32],
    full: Chinese,
    /// Tables for the numerators, which need fewer primes than fractions.
    short: Option<Chinese>,
}

/// A combination of the entries with fixed weights of 8 bits, as residues.
fn combination(residues: &[u32], p: u32) -> u32 {
    let weights = (1u64..).map(|k| (k.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 56) | 1);
    let sum: u64 = residues.iter().zip(weights).map(|(&c, weight)| u64::from(c) * weight).sum();
    (sum % u64::from(p)) as u32
}

impl<'a> Tables<'a> {
    pub(super) fn new(primes: &'a [u32]) -> Result<Self> {
        Ok(Tables { primes, full: Chinese::new(primes)?, short: None })
    }

    /// The product of the primes.
    pub(super) fn modulus(&self) -> &BigInt {
        self.full.modulus()
    }

    /// Whether `vector` has the residues `rows[l]` modulo `primes[l]`, for all primes.
    pub(super) fn agree(&self, vector: &Vector, rows: &[&[u32]]) -> bool {
        rows.iter().zip(self.primes).all(|(row, &p)| vector.modulo(p).is_some_and(|image| image == *row))
    }

    /// The witness: a combination of the entries whose residues modulo `primes[l]` are `rows[l]`; `None` when there are
    /// not enough primes.
    pub(super) fn witness(&self, rows: &[&[u32]]) -> Option<BigRational> {
        let residues: Vec<u32> = rows.iter().zip(self.primes).map(|(row, &p)| combination(row, p)).collect();
        reconstruct(&self.full.lift(&residues, self.full.factors()), self.full.modulus(), SURPLUS)
    }

    /// The vector whose residues modulo `primes[l]` are `rows[l]`, given its witness; `None` when there are not enough primes.
    pub(super) fn vector(&mut self, rows: &[&[u32]], witness: &BigRational) -> Result<Option<Vector>> {
        let mut denominator = witness.denom().clone();
        loop {
            self.choose(witness.numer().bits() + u64::from(SURPLUS) + 32)?;
            match self.numerators(rows, &denominator) {
                Attempt::Whole(numerators) => return Ok(Some(Vector { numerators, denominator })),
                Attempt::Lacks(factor) => denominator *= factor,
                Attempt::Fails => return Ok(None),
            }
        }
    }

    /// Selects as many primes for the short table as numbers of `bits` bits need.
    fn choose(&mut self, bits: u64) -> Result<()> {
        let count = (bits as usize / 30 + 1).next_multiple_of(4).min(self.primes.len());
        if self.short.as_ref().is_none_or(|short| short.primes().len() != count) {
            self.short = Some(Chinese::new(&self.primes[..count])?);
        }
        Ok(())
    }

    fn numerators(&self, rows: &[&[u32]], denominator: &BigInt) -> Attempt {
        let short = self.short.as_ref().unwrap_or(&self.full);
        let (short_factors, full_factors) = (short.factors_times(denominator), self.full.factors_times(denominator));
        let entries = rows.first().map_or(0, |row| row.len());
        let mut numerators = Vec::with_capacity(entries);
        let mut residues = vec![0; rows.len()];
        for entry in 0..entries {
            residues.iter_mut().zip(rows).for_each(|(residue, row)| *residue = row[entry]);
            if residues.iter().all(|&residue| residue == 0) {
                numerators.push(BigInt::zero());
                continue;
            }
            let mut n = short.lift(&residues, &short_factors);
            if !is_small(&n, short) {
                n = self.full.lift(&residues, &full_factors);
            }
            if !is_small(&n, &self.full) {
                let fraction = reconstruct(&n, self.full.modulus(), SURPLUS);
                return fraction.map_or(Attempt::Fails, |q| Attempt::Lacks(q.denom().clone()));
            }
            numerators.push(n);
        }
        Attempt::Whole(numerators)
    }
}

/// Result of the reconstruction of numerators for a denominator.
enum Attempt {
    Whole(Vec<BigInt>),
    /// The denominator must be multiplied by this factor.
    Lacks(BigInt),
    Fails,
}

fn is_small(n: &BigInt, chinese: &Chinese) -> bool {
    n.bits() + u64::from(SURPLUS) < chinese.modulus().bits()
}

impl Vector {
    /// The entries modulo a prime; `None` when it divides the denominator.
    pub(super) fn modulo(&self, p: u32) -> Option<Vec<u32>> {
        let modulus = u64::from(p);
        let inverse = u64::try_from(BigInt::from(residue(&self.denominator, p)).modinv(&BigInt::from(p))?).ok()?;
        let entry = |n: &BigInt| (u64::from(residue(n, p)) * inverse % modulus) as u32;
        Some(self.numerators.iter().map(entry).collect())
    }
}
