//! The generators with integer coefficients, and their images modulo primes.

use std::collections::HashMap;

use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::super::prime_field::graded;
use crate::number::{BigInt, BigRational, Rationals, Zp, primes_below, residue};
use crate::poly::{Monomial, Polynomial, PolynomialRing, Term};
use crate::random::SplitMix64;
use crate::{Error, ErrorKind, Result};

/// The nonzero generators, as primitive polynomials over the integers.
pub(super) struct System {
    pub ring: PolynomialRing<Rationals>,
    pub generators: Vec<Integral>,
    /// The number of generators, including zeros.
    pub given: usize,
}

/// A polynomial with integer coefficients and its position in a list.
pub(super) struct Integral {
    /// The index of the polynomial of which it is a multiple.
    pub index: usize,
    /// The factor by which that polynomial was multiplied.
    pub factor: BigRational,
    /// Greatest first.
    pub terms: Vec<(Monomial, BigInt)>,
}

impl Integral {
    /// The primitive multiple of a nonzero polynomial.
    pub(super) fn new(index: usize, f: &Polynomial<BigRational>) -> Self {
        let denominator = f.terms().iter().fold(BigInt::one(), |lcm, term| lcm.lcm(term.coefficient.denom()));
        let whole = |term: &Term<BigRational>| term.coefficient.numer() * (&denominator / term.coefficient.denom());
        let mut terms: Vec<_> = f.terms().iter().map(|term| (term.monomial.clone(), whole(term))).collect();
        let content = terms.iter().fold(BigInt::zero(), |gcd, (_, c)| if gcd.is_one() { gcd } else { gcd.gcd(c) });
        terms.iter_mut().for_each(|(_, c)| *c /= &content);
        Integral { index, factor: BigRational::new(denominator, content), terms }
    }

    /// The leading monomial.
    pub(super) fn lead(&self) -> &Monomial {
        &self.terms[0].0
    }

    /// The leading coefficient.
    pub(super) fn leading_coefficient(&self) -> &BigInt {
        &self.terms[0].1
    }

    /// The total degree.
    pub(super) fn degree(&self, ring: &PolynomialRing<Rationals>) -> u32 {
        self.terms.iter().map(|(monomial, _)| ring.layout().degree(monomial)).max().unwrap_or(0)
    }

    /// The greatest magnitude of a coefficient.
    pub(super) fn height(&self) -> BigInt {
        self.terms.iter().map(|(_, c)| c.abs()).max().unwrap_or_default()
    }

    /// The image modulo a prime.
    pub(super) fn image(&self, ring: &PolynomialRing<Zp>) -> Polynomial<u64> {
        let p = ring.field().modulus() as u32;
        let term = |(monomial, c): &(Monomial, BigInt)| Term {
            coefficient: u64::from(residue(c, p)),
            monomial: monomial.clone(),
        };
        ring.collect(self.terms.iter().map(term))
    }
}

impl System {
    pub(super) fn new(ring: &PolynomialRing<Rationals>, generators: &[Polynomial<BigRational>]) -> Self {
        let nonzero = generators.iter().enumerate().filter(|(_, f)| !f.is_zero());
        let integral = nonzero.map(|(index, f)| Integral::new(index, f)).collect();
        System { ring: ring.clone(), generators: integral, given: generators.len() }
    }

    /// The generators in graded reverse order.
    ///
    /// # Errors
    /// [`ErrorKind::Overflow`] when a degree does not fit.
    pub(super) fn graded(ring: &PolynomialRing<Rationals>, generators: &[Polynomial<BigRational>]) -> Result<Self> {
        let graded = graded(ring)?;
        let generators = generators.iter().map(|f| ring.transfer(f, &graded)).collect::<Result<Vec<_>>>()?;
        Ok(System::new(&graded, &generators))
    }

    /// The primes below 2^31 that divide no coefficient, in descending order.
    pub(super) fn primes(&self) -> impl Iterator<Item = u32> {
        primes_below(1 << 31).map(|p| p as u32).filter(|&p| self.is_good(p))
    }

    /// A good prime above 2^30, chosen by a hash of all coefficients and `round`. So no particular prime is likely to
    /// be unlucky for many systems.
    ///
    /// # Errors
    /// [`ErrorKind::Budget`] when there is none.
    pub(super) fn scattered_prime(&self, round: u64) -> Result<u32> {
        let digits = self.generators.iter().flat_map(|f| &f.terms).flat_map(|(_, c)| c.iter_u64_digits());
        let seed = digits.fold(scatter(round), |seed, digit| scatter(seed ^ digit));
        let mut primes = primes_below((1 << 30) + seed % (1 << 30)).map(|p| p as u32);
        primes.find(|&p| self.is_good(p)).ok_or_else(no_primes)
    }

    /// Whether `p` divides no coefficient.
    pub(super) fn is_good(&self, p: u32) -> bool {
        p > 0 && self.generators.iter().flat_map(|f| &f.terms).all(|(_, c)| residue(c, p) != 0)
    }

    /// The ring and the generators modulo a prime.
    pub(super) fn image(&self, p: u32) -> Result<(PolynomialRing<Zp>, Vec<Polynomial<u64>>)> {
        let ring = modulo(&self.ring, p)?;
        let images = self.generators.iter().map(|f| f.image(&ring)).collect();
        Ok((ring, images))
    }

    /// The coefficients of the generators in `N` lanes, one for each prime.
    pub(super) fn lanes<const N: usize>(&self, primes: [u32; N]) -> Vec<Vec<[u32; N]>> {
        let lanes = |(_, c): &(Monomial, BigInt)| primes.map(|p| residue(c, p));
        self.generators.iter().map(|f| f.terms.iter().map(lanes).collect()).collect()
    }
}

/// The sum of products of a polynomial, an integer and a monomial. It may be zero.
pub(super) fn combination(
    ring: &PolynomialRing<Rationals>,
    parts: &[(&Integral, BigInt, Monomial)],
) -> Result<Integral> {
    let layout = ring.layout();
    let mut sums: HashMap<Monomial, BigInt> = HashMap::new();
    for (f, factor, shift) in parts {
        for (monomial, c) in &f.terms {
            let limit = || Error::new(ErrorKind::Overflow, "an S-pair's degree exceeds the limit of the ring");
            let product = layout.checked_mul(monomial, shift).ok_or_else(limit)?;
            *sums.entry(product).or_default() += c * factor;
        }
    }
    let mut terms: Vec<_> = sums.into_iter().filter(|(_, c)| !c.is_zero()).collect();
    terms.sort_by(|(a, _), (b, _)| layout.compare(b, a));
    Ok(Integral { index: 0, factor: BigRational::one(), terms })
}

/// Same ring, but modulo a prime.
pub(super) fn modulo(ring: &PolynomialRing<Rationals>, p: u32) -> Result<PolynomialRing<Zp>> {
    let layout = ring.layout();
    let image = PolynomialRing::new(Zp::new(u64::from(p))?, ring.variables(), layout.order().clone())?;
    Ok(image.with_width(layout.width()))
}

/// A hash: all bits of the result depend on all bits of `n`.
fn scatter(n: u64) -> u64 {
    SplitMix64::new(n).word()
}

/// The error when no primes are left.
pub(super) fn no_primes() -> Error {
    Error::new(ErrorKind::Budget, "there are no more primes below 2^31 to compute modulo")
}

/// Builds the error for a claim that fails.
pub(super) fn refuse(text: impl Into<String>) -> Error {
    Error::new(ErrorKind::Certificate, text)
}
