//! Rational functions over Q from residues modulo primes: Chinese remaindering and rational reconstruction.

use std::ops::{Add, Mul};

use num_bigint::Sign;
use num_traits::ToPrimitive;

use super::learn::{Learned, learn};
use super::pattern::{Functions, Pattern, factors_modulo};
use super::prime::{Prime, SmoothPrime};
use crate::number::{BigInt, BigRational, Rationals, Zp};
use crate::poly::{Fraction, Fractions, Monomial, Polynomial, PolynomialRing, Term};
use crate::random::SplitMix64;
use crate::{Error, ErrorKind, Result, Watch};

type Ground = PolynomialRing<Rationals>;

/// Reconstructs the functions as elements of `field`, which has their parameters.
///
/// # Errors
/// Those of [`learn`]; [`ErrorKind::Unsupported`] when too many primes are unlucky; [`ErrorKind::Overflow`].
pub(super) fn interpolate(
    functions: &impl Functions,
    field: &Fractions<Rationals>,
    watch: &Watch,
) -> Result<Vec<Fraction<BigRational>>> {
    if functions.count() == 0 {
        return Ok(Vec::new());
    }
    let learned = learn(functions, watch)?;
    let Learned { patterns, .. } = &learned;
    let supports: Vec<Support> = patterns.iter().map(|p| Support::new(field.ring(), p)).collect::<Result<_>>()?;
    let mut residues = Residues::default();
    residues.push(learned.field, &normalised(learned.field, &supports, &learned.factors));
    let mut stream = SplitMix64::new(7);
    let mut primes = Primes::new();
    loop {
        watch.check()?;
        if residues.is_worth_a_trial()
            && let Some(values) = residues.rationals()
            && holds(functions, patterns, &supports, &values, &mut primes, &mut stream, watch)?
        {
            return Ok(supports.iter().zip(split(&supports, values)).map(|(s, v)| s.fraction(field, v)).collect());
        }
        let (modulus, factors) = next_factors(functions, patterns, &mut primes, &mut stream, watch)?;
        residues.push(modulus, &normalised(modulus, &supports, &factors));
    }
}

/// The factors modulo the next lucky prime.
fn next_factors(
    functions: &impl Functions,
    patterns: &[Pattern],
    primes: &mut Primes,
    stream: &mut SplitMix64,
    watch: &Watch,
) -> Result<(Prime, Vec<Vec<Vec<u64>>>)> {
    for _ in 0..10 {
        let field = primes.next_that(|field| functions.admit(field));
        if let Some(factors) = factors_modulo(functions, patterns, field, stream, watch)? {
            return Ok((field, factors));
        }
    }
    let text = "ten consecutive primes do not fit the supports of the first prime; compute over the field of fractions instead";
    Err(Error::new(ErrorKind::Unsupported, text))
}

/// Whether the rational functions have the correct values at a random point modulo another prime.
fn holds(
    functions: &impl Functions,
    patterns: &[Pattern],
    supports: &[Support],
    values: &[BigRational],
    primes: &mut Primes,
    stream: &mut SplitMix64,
    watch: &Watch,
) -> Result<bool> {
    let field = primes.next_that(|field| functions.admit(field));
    let point: Vec<u64> = (0..functions.parameters()).map(|_| stream.unit(field.p)).collect();
    let found = functions.values(field, std::slice::from_ref(&point), watch)?;
    let Some(expected) = found.into_iter().next().flatten() else { return Ok(false) };
    let mut rest = values.iter();
    let mut right = true;
    for ((pattern, support), &expected) in patterns.iter().zip(supports).zip(&expected) {
        let images = rest.by_ref().take(support.monomials.len()).map(|q| image(field, q));
        let mut images = images.collect::<Vec<_>>().into_iter();
        let factors: Vec<Vec<u64>> =
            pattern.slots.iter().map(|slot| images.by_ref().take(slot.exponents.len()).collect()).collect();
        let (numerator, denominator) = pattern.value(field, &factors, &point);
        right &= denominator != 0 && numerator == field.mul(denominator, expected);
    }
    Ok(right)
}

/// A rational number modulo a prime that does not divide its denominator; else 0.
pub(super) fn image(field: Prime, q: &BigRational) -> u64 {
    defined_image(field, q).unwrap_or(0)
}

/// A rational number modulo a prime; `None` when the prime divides its denominator.
pub(super) fn defined_image(field: Prime, q: &BigRational) -> Option<u64> {
    let integer = |n: &BigInt| {
        let magnitude = match n.magnitude().to_u64() {
            Some(small) => field.reduce(small),
            None => (n.magnitude() % field.p).to_u64().expect("a residue of a word"),
        };
        if n.sign() == Sign::Minus { field.neg(magnitude) } else { magnitude }
    };
    let numerator = integer(q.numer());
    if q.is_integer() {
        return Some(numerator);
    }
    match integer(q.denom()) {
        0 => None,
        denominator => Some(field.mul(numerator, field.inverse(denominator))),
    }
}

/// The monomials of one function, in the order of the factors of its pattern.
struct Support {
    /// Whether the monomial belongs to the numerator, and the monomial.
    monomials: Vec<(bool, Monomial)>,
    /// The greatest monomial of the denominator: its coefficient becomes one.
    lead: usize,
}

impl Support {
    /// Multiplies numerator and denominator by the least monomial that leaves no negative exponent.
    fn new(ring: &Ground, pattern: &Pattern) -> Result<Self> {
        let all: Vec<(bool, &Vec<i32>)> =
            pattern.slots.iter().flat_map(|slot| slot.exponents.iter().map(|e| (slot.place.top, e))).collect();
        let least = |v: usize| all.iter().map(|(_, e)| e[v]).min().unwrap_or(0);
        let least: Vec<i32> = (0..ring.variables().len()).map(least).collect();
        let monomial = |e: &[i32]| {
            let exponents: Vec<u32> = e.iter().zip(&least).map(|(&e, &low)| (e - low) as u32).collect();
            ring.monomial(&exponents)
        };
        let monomials: Vec<(bool, Monomial)> =
            all.iter().map(|(top, e)| Ok((*top, monomial(e)?))).collect::<Result<_>>()?;
        let bottom = (0..monomials.len()).filter(|&i| !monomials[i].0);
        let lead = bottom.max_by(|&i, &j| ring.layout().compare(&monomials[i].1, &monomials[j].1)).unwrap_or(0);
        Ok(Support { monomials, lead })
    }

    /// The fraction with these coefficients.
    fn fraction(&self, field: &Fractions<Rationals>, values: Vec<BigRational>) -> Fraction<BigRational> {
        let ring = field.ring();
        let mut parts: [Vec<Term<BigRational>>; 2] = Default::default();
        for ((top, monomial), coefficient) in self.monomials.iter().zip(values) {
            parts[usize::from(*top)].push(Term { coefficient, monomial: monomial.clone() });
        }
        let [bottom, top]: [Polynomial<BigRational>; 2] = parts.map(|terms| ring.collect(terms));
        field.coprime_fraction(top, bottom)
    }
}

/// All factors in one row. The leading coefficient of each denominator is one.
fn normalised(field: Prime, supports: &[Support], factors: &[Vec<Vec<u64>>]) -> Vec<u64> {
    let mut row = Vec::new();
    for (support, factors) in supports.iter().zip(factors) {
        let flat: Vec<u64> = factors.iter().flatten().copied().collect();
        let inverse = field.inverse(flat[support.lead]);
        row.extend(flat.iter().map(|&c| field.mul(c, inverse)));
    }
    row
}

/// The values, split by function.
fn split(supports: &[Support], values: Vec<BigRational>) -> Vec<Vec<BigRational>> {
    let mut rest = values.into_iter();
    supports.iter().map(|support| rest.by_ref().take(support.monomials.len()).collect()).collect()
}

/// A row of numbers by their residues, in mixed radix. Digit `k` is the coefficient of the product of the first `k`
/// primes.
#[derive(Default)]
pub(super) struct Residues {
    primes: Vec<Prime>,
    digits: Vec<Vec<u64>>,
}

impl Residues {
    /// Adds the residues modulo one more prime (Garner, 1959).
    pub fn push(&mut self, field: Prime, residues: &[u64]) {
        self.digits.resize(residues.len(), Vec::new());
        let product = self.primes.iter().fold(1, |product, prime| field.mul(product, prime.p % field.p));
        let inverse = field.inverse(product);
        for (digits, &residue) in self.digits.iter_mut().zip(residues) {
            let known = digits.iter().zip(&self.primes).rev();
            let value = known.fold(0, |value, (&digit, prime)| field.reduce(value * (prime.p % field.p) + digit));
            digits.push(field.mul(field.sub(residue, value), inverse));
        }
        self.primes.push(field);
    }

    /// Whether an attempt is due. Attempts become rarer as the numbers grow.
    pub fn is_worth_a_trial(&self) -> bool {
        let count = self.primes.len();
        count <= 4 || count.is_multiple_of(count / 4)
    }

    /// The number of primes so far.
    pub fn count(&self) -> usize {
        self.primes.len()
    }

    /// All numbers as rationals that have the residues `seen` modulo another prime, each from as few primes as
    /// possible; `None` when one is not determined yet.
    pub fn rationals_like(&self, field: Prime, seen: &[u64]) -> Option<Vec<BigRational>> {
        if self.primes.len() > 4 {
            let values = self.rationals()?;
            let agrees = values.iter().zip(seen).all(|(value, &seen)| image(field, value) == seen);
            return agrees.then_some(values);
        }
        let bounds: Vec<(u128, u128)> = (1..=self.primes.len())
            .map(|count| self.primes[..count].iter().map(|prime| u128::from(prime.p)).product())
            .map(|modulus: u128| (modulus, (modulus / 2).isqrt()))
            .collect();
        let number = |(digits, &seen): (&Vec<u64>, &u64)| {
            bounds.iter().enumerate().find_map(|(last, &(modulus, bound))| {
                let (n, d) = short_fraction(self.value(&digits[..=last]), modulus, bound)?;
                let later = (last + 1..digits.len()).map(|k| (self.primes[k], self.residue(&digits[..=k])));
                let agrees = later.chain([(field, seen)]).all(|(field, residue)| is_residue(field, residue, n, d));
                agrees.then(|| BigRational::new_raw(n.into(), d.into()))
            })
        };
        self.digits.iter().zip(seen).map(number).collect()
    }

    /// All numbers as small rationals; `None` when one is not determined yet.
    fn rationals(&self) -> Option<Vec<BigRational>> {
        if self.primes.len() <= 4 {
            let modulus: u128 = self.primes.iter().map(|prime| u128::from(prime.p)).product();
            let bound = (modulus / 2).isqrt();
            return self.digits.iter().map(|digits| short_rational(self.value(digits), modulus, bound)).collect();
        }
        let modulus: BigInt = self.primes.iter().map(|prime| BigInt::from(prime.p)).product();
        let bound = (&modulus >> 1usize).sqrt();
        self.digits.iter().map(|digits| rational(self.value(digits), &modulus, &bound)).collect()
    }

    /// The number with these digits modulo the prime of the last one.
    fn residue(&self, digits: &[u64]) -> u64 {
        let field = self.primes[digits.len() - 1];
        let pairs = digits.iter().zip(&self.primes).rev();
        pairs.fold(0, |value, (&digit, prime)| field.reduce(value * (prime.p % field.p) + digit))
    }

    /// The number with these digits.
    fn value<N: From<u64> + Mul<Output = N> + Add<Output = N>>(&self, digits: &[u64]) -> N {
        let pairs = digits.iter().zip(&self.primes).rev();
        pairs.fold(N::from(0), |value, (&digit, prime)| value * N::from(prime.p) + N::from(digit))
    }
}

/// The rational number with numerator and denominator up to `bound` that is `value` modulo `modulus` (P. Wang, SYMSAC 1981).
fn rational(value: BigInt, modulus: &BigInt, bound: &BigInt) -> Option<BigRational> {
    let (mut a, mut b) = (modulus.clone(), value);
    let (mut s, mut t) = (BigInt::ZERO, BigInt::from(1));
    while b > *bound {
        let quotient = &a / &b;
        (a, b) = (b.clone(), a - &quotient * b);
        (s, t) = (t.clone(), s - quotient * t);
    }
    (t.magnitude() <= bound.magnitude() && t.sign() != Sign::NoSign).then(|| BigRational::new(b, t))
}

/// Same as [`rational`], but in machine words.
fn short_rational(value: u128, modulus: u128, bound: u128) -> Option<BigRational> {
    short_fraction(value, modulus, bound).map(|(n, d)| BigRational::new(n.into(), d.into()))
}

/// Numerator and denominator of [`rational`] for a modulus below 2^124.
fn short_fraction(value: u128, modulus: u128, bound: u128) -> Option<(i64, i64)> {
    let (mut a, mut b, mut s, mut t) = (modulus, value, 0i64, 1i64);
    while b > bound {
        let quotient = if a >> 64 == 0 { u128::from(a as u64 / b as u64) } else { a / b };
        (a, b) = (b, a - quotient * b);
        (s, t) = (t, s - quotient as i64 * t);
    }
    (t != 0 && u128::from(t.unsigned_abs()) <= bound).then(|| (b as i64 * t.signum(), t.abs()))
}

/// Whether `n / d` is in lowest terms as far as the prime can show, and has this `residue`.
fn is_residue(field: Prime, residue: u64, n: i64, d: i64) -> bool {
    let small = |n: i64| n.rem_euclid(field.p as i64) as u64;
    small(d) != 0 && field.mul(small(d), residue) == small(n)
}

/// The primes below 2^31 in descending order, without those of [`SmoothPrime`].
pub(super) struct Primes {
    count: usize,
    last: u32,
}

impl Primes {
    /// The first primes, so that small problems need no primality test.
    const FIRST: [u32; 16] = [
        2147483629, 2147483587, 2147483579, 2147483563, 2147483549, 2147483543, 2147483497, 2147483489, 2147483477,
        2147483423, 2147483399, 2147483353, 2147483323, 2147483269, 2147483249, 2147483237,
    ];

    pub fn new() -> Self {
        Primes { count: 0, last: 0 }
    }

    pub fn next_prime(&mut self) -> Prime {
        let listed = Self::FIRST.get(self.count);
        let is_next =
            |&n: &u32| Zp::new(u64::from(n)).is_ok() && !SmoothPrime::all().iter().any(|s| s.field.p == u64::from(n));
        self.last = listed.copied().unwrap_or_else(|| (0..self.last).rev().find(is_next).unwrap_or(3));
        self.count += 1;
        Prime::new(self.last)
    }
    /// The next prime that `admit` accepts. It rejects finitely many.
    pub fn next_that(&mut self, admit: impl Fn(Prime) -> bool) -> Prime {
        loop {
            let field = self.next_prime();
            if admit(field) {
                return field;
            }
        }
    }
}
