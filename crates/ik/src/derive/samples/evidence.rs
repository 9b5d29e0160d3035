//! The number of complex solutions of a random reachable target, and the number of values of each joint, by a Groebner basis modulo a prime.

use super::random_sample::{RandomSample, lucky_field};
use super::sampled_relations::set;
use crate::derive::closure::{Arithmetic, Factor, Factors, Mechanism, Modular, Polynomials, Relation};
use crate::derive::planner::Evidence;
use crate::{Result, Watch};
use groebot_algebra::groebner::{Basis, WordQuotient, basis_modulo_prime};
use groebot_algebra::number::{Ring, Zp, primes_below};
use groebot_algebra::poly::{Order, Polynomial, PolynomialRing, Term};
use groebot_algebra::random::SplitMix64;

/// The number of primes, each with a separate target.
const PRIMES: usize = 3;

/// The evidence for three primes; `None` if there are infinitely many solutions.
///
/// # Errors
/// The error of `watch` if it stops the count.
pub fn gather(mechanism: &Mechanism, relations: &[Relation], watch: &Watch) -> Result<Option<Vec<Evidence>>> {
    let mut found = Vec::new();
    for (p, mut arithmetic) in lucky_primes(mechanism)?.into_iter().take(PRIMES) {
        watch.report("targets modulo primes", found.len(), PRIMES - found.len());
        let seed = p ^ found.len() as u64;
        match examine(mechanism, relations, &mut arithmetic, seed, watch)? {
            Some(evidence) => found.push(evidence),
            None => return Ok(None),
        }
    }
    Ok(Some(found))
}

/// The first primes below 2^31 that divide no denominator of the mechanism's constants.
pub fn lucky_primes(mechanism: &Mechanism) -> Result<Vec<(u64, Modular)>> {
    let mut lucky = Vec::new();
    for p in primes_below(1 << 31) {
        lucky.extend(lucky_field(mechanism, p)?.map(|arithmetic| (p, arithmetic)));
        if lucky.len() == PRIMES {
            break;
        }
    }
    Ok(lucky)
}

/// The evidence of one random target; `None` if it has infinitely many solutions.
fn examine(
    mechanism: &Mechanism,
    relations: &[Relation],
    arithmetic: &mut Modular,
    seed: u64,
    watch: &Watch,
) -> Result<Option<Evidence>> {
    let mut random = SplitMix64::new(seed);
    let unknown = mechanism.unknown();
    let space = Space::new(mechanism, &unknown, arithmetic.field())?;
    let basis = basis(mechanism, relations, arithmetic, &space, &mut random, watch)?;
    let Some(dimension) = basis.quotient_dimension() else { return Ok(None) };
    let mut degrees = vec![1; mechanism.joints().len()];
    for (&joint, degree) in unknown.iter().zip(space.degrees(&basis, &unknown, &mut random, watch)?) {
        degrees[joint] = degree;
    }
    Ok(Some(Evidence { prime: arithmetic.field().modulus() as u32, seed, dimension, degrees }))
}

/// Whether a random reachable target has finitely many solutions.
///
/// # Errors
/// As [`gather`].
pub fn is_finite(mechanism: &Mechanism, relations: &[Relation], watch: &Watch) -> Result<bool> {
    let Some((p, mut arithmetic)) = lucky_primes(mechanism)?.into_iter().next() else { return Ok(false) };
    let space = Space::new(mechanism, &mechanism.unknown(), arithmetic.field())?;
    let basis = basis(mechanism, relations, &mut arithmetic, &space, &mut SplitMix64::new(p), watch)?;
    Ok(basis.quotient_dimension().is_some())
}

/// The Groebner basis of all equations at a random reachable target.
fn basis(
    mechanism: &Mechanism,
    relations: &[Relation],
    arithmetic: &mut Modular,
    space: &Space,
    random: &mut SplitMix64,
    watch: &Watch,
) -> Result<Basis<Zp>> {
    let sample = RandomSample::draw(mechanism, arithmetic, random)?;
    let mask = set(&mechanism.unknown());
    let squares: Vec<u64> = mechanism.joints().iter().map(|joint| arithmetic.rational(&joint.square)).collect();
    let mut generators = space.circles(&squares)?;
    generators.extend(space.couplings(mechanism));
    let of_loop = relations.iter().filter(|relation| relation.followed().is_none());
    for relation in of_loop.filter(|relation| is_split(relation, mask)) {
        watch.check()?;
        let value = sample.evaluate(mechanism, relation, mask, arithmetic)?;
        generators.push(space.polynomial(value.terms().map(|(product, &coefficient)| (product, coefficient)))?);
    }
    basis_modulo_prime(&space.ring, &generators, watch)
}

/// Whether each side of the relation has at most half of the unknown joints (rounded up). Such relations are small, and they generate all equations.
fn is_split(relation: &Relation, unknown: u32) -> bool {
    let most = (unknown.count_ones() as usize).div_ceil(2);
    [&relation.left, &relation.right].iter().all(|word| {
        let joints = word.0.iter().filter_map(|letter| letter.joint());
        joints.filter(|joint| unknown >> joint & 1 == 1).count() <= most
    })
}

/// The polynomials in the unknowns of some joints, modulo a prime.
pub struct Space {
    pub ring: PolynomialRing<Zp>,
    factors: Vec<Factor>,
}

impl Space {
    /// The ring in the unknowns of `joints`, in this order.
    pub fn new(mechanism: &Mechanism, joints: &[usize], field: Zp) -> Result<Self> {
        let unknowns = |&joint: &usize| match mechanism.joints()[joint].is_revolute() {
            true => vec![Factor::Cosine(joint), Factor::Sine(joint)],
            false => vec![Factor::Length(joint)],
        };
        let factors: Vec<Factor> = joints.iter().flat_map(unknowns).collect();
        let names: Vec<String> = (0..factors.len()).map(|index| format!("x{index}")).collect();
        Ok(Space { ring: PolynomialRing::new(field, &names, Order::GrevLex)?, factors })
    }

    fn place(&self, factor: Factor) -> Option<usize> {
        self.factors.iter().position(|own| *own == factor)
    }

    /// The circle c^2 + n s'^2 - 1 of each revolute joint. `squares` contains n of every joint of the chain.
    pub fn circles(&self, squares: &[u64]) -> Result<Vec<Polynomial<u64>>> {
        let ring = &self.ring;
        let mut circles = Vec::new();
        for (place, factor) in self.factors.iter().enumerate() {
            let Factor::Cosine(joint) = factor else { continue };
            let square = |place: usize| ring.checked_mul(&ring.variable(place), &ring.variable(place));
            let sum = ring.add(&square(place)?, &ring.scale(&square(place + 1)?, &squares[*joint]));
            circles.push(ring.sub(&sum, &ring.one()));
        }
        Ok(circles)
    }

    /// The law of each joint that follows another one of these: its unknowns minus their values by the law.
    pub fn couplings(&self, mechanism: &Mechanism) -> Vec<Polynomial<u64>> {
        let mut arithmetic = Polynomials(&self.ring);
        let places = |joint: usize| (0..self.factors.len()).filter(move |&place| self.factors[place].joint() == joint);
        let mut couplings = Vec::new();
        for (follower, coupling) in mechanism.followers() {
            let [own, leader]: [Vec<Polynomial<u64>>; 2] =
                [follower, coupling.leader].map(|joint| places(joint).map(|place| self.ring.variable(place)).collect());
            if !own.is_empty() && !leader.is_empty() {
                let law = coupling.follow(&leader, &mut arithmetic);
                couplings.extend(own.iter().zip(&law).map(|(own, law)| self.ring.sub(own, law)));
            }
        }
        couplings
    }

    /// The polynomial of products with their coefficients. Factors of other joints must not occur.
    pub fn polynomial<'a>(&self, value: impl Iterator<Item = (&'a Factors, u64)>) -> Result<Polynomial<u64>> {
        let mut terms = Vec::new();
        for (product, coefficient) in value {
            let mut exponents = vec![0; self.factors.len()];
            for &factor in product.list() {
                let (own, power) = match factor {
                    Factor::LengthSquared(joint) => (Factor::Length(joint), 2),
                    other => (other, 1),
                };
                self.place(own).into_iter().for_each(|place| exponents[place] = power);
            }
            terms.push(Term { coefficient, monomial: self.ring.monomial(&exponents)? });
        }
        Ok(self.ring.collect(terms))
    }

    /// The number of values of each joint: the degree of the minimal polynomial of a random linear form of its unknowns.
    pub fn degrees(
        &self,
        basis: &Basis<Zp>,
        joints: &[usize],
        random: &mut SplitMix64,
        watch: &Watch,
    ) -> Result<Vec<usize>> {
        let quotient = WordQuotient::new(basis, watch)?;
        let mut degrees = Vec::new();
        for &joint in joints {
            let own = (0..self.factors.len()).filter(|&place| self.factors[place].joint() == joint);
            let form = own.fold(self.ring.zero(), |form, place| {
                let factor = random.unit(self.ring.field().modulus());
                self.ring.add(&form, &self.ring.scale(&self.ring.variable(place), &factor))
            });
            degrees.push(quotient.minimal_polynomial(&form, watch)?.degree().unwrap_or(0));
        }
        Ok(degrees)
    }
}
