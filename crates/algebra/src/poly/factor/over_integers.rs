//! Factors of a square-free polynomial over the integers, in one or several variables.
//!
//! All variables but the main one are replaced by small integers. The integer factors of this image are lifted modulo
//! word-size primes, and the coefficients are reconstructed. Exact division proves the product. A factor is irreducible
//! because no proper subset of its image's factors lifts.

use num_traits::{One, Pow, Zero};

use super::integers::{self, Integers};
use super::lift::{Lifting, Variables};
use crate::number::BigInt;
use crate::poly::words::dense::{self, Dense};
use crate::poly::words::{Images, Integral, Packing, Prime, primes, residue};
use crate::random::SplitMix64;
use crate::{Result, Watch};

/// Number of points from which the one whose image has the fewest factors is chosen.
const POINTS: usize = 3;

/// The polynomial to factor and its variables.
struct Task<'a> {
    f: &'a Integral,
    packing: &'a Packing,
    main: usize,
    others: Vec<usize>,
    watch: &'a Watch,
}

/// A point and the factors of the image there.
struct Anchor {
    point: Vec<i64>,
    factors: Vec<Integers>,
}

/// The primitive irreducible factors of a square-free `f` that is primitive in `main`.
pub fn split_over_integers(packing: &Packing, f: &Integral, main: usize, watch: &Watch) -> Result<Vec<Integral>> {
    let occurs = |v: usize| f.keys.iter().any(|&key| packing.exponent(key, v) > 0);
    let others = (0..packing.variables()).filter(|&v| v != main && occurs(v)).collect();
    let task = Task { f, packing, main, others, watch };
    if task.others.is_empty() {
        let factors = integers::factors(&task.image_at(&[]), watch)?;
        return Ok(factors.into_iter().map(|factor| from_line(packing, main, factor)).collect());
    }
    let mut random = SplitMix64::new(3);
    for range in 4.. {
        let anchor = task.choose_anchor(range, &mut random)?;
        if anchor.factors.len() == 1 {
            return Ok(vec![f.clone()]);
        }
        if let Some(factors) = task.split_at(&anchor, &mut random)? {
            return Ok(factors);
        }
    }
    unreachable!("the range of points has no end")
}

impl Task<'_> {
    /// Substitutes integers for the other variables. The result is dense in the main variable.
    fn image_at(&self, point: &[i64]) -> Integers {
        let mut line = Integers::new();
        for (&key, value) in self.f.keys.iter().zip(&self.f.values) {
            let place = self.packing.exponent(key, self.main) as usize;
            if line.len() <= place {
                line.resize(place + 1, BigInt::zero());
            }
            let placed = self.others.iter().zip(point);
            let powers = placed.map(|(&v, &x)| BigInt::from(x).pow(self.packing.exponent(key, v)));
            line[place] += powers.fold(value.clone(), |product, power| product * power);
        }
        line
    }

    /// Chooses a point with coordinates up to about `range` where `f` keeps its degree and stays square-free.
    fn choose_anchor(&self, range: u64, random: &mut SplitMix64) -> Result<Anchor> {
        let field = Prime::new(primes().next().expect("there are primes below 2^61"));
        let (mut best, mut found, mut tries): (Option<Anchor>, _, _) = (None, 0, 0);
        loop {
            self.watch.check()?;
            tries += 1;
            let spread = range + tries / 8;
            let mut coordinate = || random.below(2 * spread + 1) as i64 - spread as i64;
            let point: Vec<i64> = self.others.iter().map(|_| coordinate()).collect();
            let line = self.image_at(&point);
            let image = residues(&line, &field);
            let repeated = dense::gcd(&field, &image, &dense::derivative(&field, &image));
            if image.last() == Some(&0) || repeated.len() != 1 {
                continue;
            }
            let factors = integers::factors(&primitive(line), self.watch)?;
            if best.as_ref().is_none_or(|best| factors.len() < best.factors.len()) {
                best = Some(Anchor { point, factors });
            }
            found += 1;
            if let Some(best) = best.take_if(|best| found == POINTS || best.factors.len() == 1) {
                return Ok(best);
            }
        }
    }

    /// The factors lifted from one point; `None` when it is unlucky.
    fn split_at(&self, anchor: &Anchor, random: &mut SplitMix64) -> Result<Option<Vec<Integral>>> {
        let mut parts: Option<Vec<Vec<usize>>> = None;
        let mut images: Vec<Images> = Vec::new();
        for p in primes() {
            let field = Prime::new(p);
            let point = anchor.point.iter().map(|&x| residue(&BigInt::from(x), &field)).collect();
            let image = self.f.image(&field);
            let variables = Variables { main: self.main, others: &self.others, anchor: point };
            let lifting = Lifting::new(&field, self.packing, &image, variables);
            let Some(lifting) = lifting else { continue };
            let lines: Vec<Dense> = anchor.factors.iter().map(|line| residues(line, &field)).collect();
            if parts.is_none() {
                parts = lifting.partition(&lines, self.watch)?;
            }
            let Some(parts) = &parts else { continue };
            if parts.len() == 1 {
                return Ok(Some(vec![self.f.clone()]));
            }
            let times = |product: Dense, &i: &usize| dense::mul(&field, &product, &lines[i]);
            let starts: Vec<Dense> = parts.iter().map(|part| part.iter().fold(vec![1], times)).collect();
            let Some(factors) = lifting.factors(&starts, random, self.watch)? else { return Ok(None) };
            images.resize_with(factors.len(), Images::default);
            images.iter_mut().zip(factors).for_each(|(images, factor)| images.add(&field, factor));
            if let Some(factors) = proved(self.f, self.packing, &images) {
                return Ok(Some(factors));
            }
            if images[0].bits() > self.enough_bits() {
                return Ok(None);
            }
        }
        Ok(None)
    }

    /// An upper bound of the bits of numerator and denominator of a factor's coefficient (Gelfond's bound, doubled).
    fn enough_bits(&self) -> u64 {
        let degrees = (0..self.packing.variables())
            .map(|v| self.f.keys.iter().map(|&key| u64::from(self.packing.exponent(key, v))).max().unwrap_or(0));
        4 * (self.f.bits() + degrees.sum::<u64>()) + 64 * self.f.keys.len().ilog2() as u64 + 64
    }
}

fn residues(line: &Integers, field: &Prime) -> Dense {
    line.iter().map(|c| residue(c, field)).collect()
}

fn from_line(packing: &Packing, main: usize, line: Integers) -> Integral {
    let terms = line.into_iter().enumerate().rev().filter(|(_, value)| !value.is_zero());
    let (keys, values) = terms.map(|(n, value)| (packing.power(main, n as u32), value)).unzip();
    Integral { keys, values }.primitive().0
}

fn primitive(line: Integers) -> Integers {
    let keys = (0..line.len() as u128).rev().collect();
    let (part, _) = Integral { keys, values: line.into_iter().rev().collect() }.primitive();
    part.values.into_iter().rev().collect()
}

/// Reconstructs the factors from their images, if their product is `f`.
fn proved(f: &Integral, packing: &Packing, images: &[Images]) -> Option<Vec<Integral>> {
    let factors = images.iter().map(Images::rational).collect::<Option<Vec<_>>>()?;
    let rest = factors.iter().try_fold(f.clone(), |rest, factor| rest.quotient(packing, factor))?;
    (rest.is_constant() && rest.values.iter().all(One::is_one)).then_some(factors)
}
