//! Candidates for the shape of the basis, the images for each, and the lift of one candidate to Q.

use super::super::Basis;
use super::learned::{Input, LANES, Learned};
use super::seen::{Image, Seen, Shape};
use super::system::{System, no_primes};
use super::vectors::{Tables, Vector};
use crate::number::{BigRational, Rationals, Ring};
use crate::poly::{Polynomial, PolynomialRing, Term, Width};
use crate::{Result, Watch};

/// The number of primes grows by one part in this many before the next attempt to lift.
const PATIENCE: usize = 16;

/// Votes on the shape. Every prime with a full computation has one vote.
#[derive(Default)]
pub(super) struct Ballot {
    candidates: Vec<Candidate>,
}

/// One shape with its images.
pub(super) struct Candidate {
    learned: Learned,
    votes: usize,
    unlucky: usize,
    primes: Vec<u32>,
    images: Vec<Image>,
    /// One witness for each polynomial, as far as computed.
    witnesses: Vec<BigRational>,
}

/// The coefficients over Q of all polynomials of a candidate.
pub(super) struct Lift {
    vectors: Vec<Vector>,
    shape: Shape,
    width: Width,
    primes: usize,
}

impl Ballot {
    /// Counts a vote. It replaces an earlier computation of the same shape. Returns the candidate with the most votes,
    /// the latest among equals.
    pub(super) fn enter(&mut self, learned: Learned) -> &mut Candidate {
        match self.candidates.iter_mut().find(|candidate| candidate.learned.seen.shape == learned.seen.shape) {
            Some(candidate) => {
                candidate.votes += 1;
                candidate.take(learned.seen.prime, learned.seen.image.clone());
                candidate.learned = learned;
            }
            None => self.candidates.push(Candidate::new(learned)),
        }
        self.candidates.iter_mut().max_by_key(|candidate| candidate.votes).expect("there is one at least")
    }

    /// The number of primes that differed from their candidate, or belong to a rejected candidate.
    pub(super) fn unlucky(&self) -> usize {
        let last = self.candidates.iter().max_by_key(|candidate| candidate.votes);
        let kept = last.map_or(0, |candidate| candidate.primes.len());
        self.candidates.iter().map(|candidate| candidate.primes.len() + candidate.unlucky).sum::<usize>() - kept
    }
}

impl Candidate {
    fn new(learned: Learned) -> Self {
        let (primes, images) = (vec![learned.seen.prime], vec![learned.seen.image.clone()]);
        Candidate { learned, votes: 1, unlucky: 0, primes, images, witnesses: Vec::new() }
    }

    fn take(&mut self, prime: u32, image: Image) {
        if !self.primes.contains(&prime) {
            self.primes.push(prime);
            self.images.push(image);
        }
    }

    /// Computes images until the coefficients over Q are determined; `None` when a whole batch of primes differs.
    pub(super) fn lift(
        &mut self,
        input: &Input,
        primes: &mut impl Iterator<Item = u32>,
        watch: &Watch,
    ) -> Result<Option<Lift>> {
        loop {
            if let Some(vectors) = self.vectors(watch)? {
                let Seen { shape, width, .. } = &self.learned.seen;
                return Ok(Some(Lift { vectors, shape: shape.clone(), width: *width, primes: self.primes.len() }));
            }
            let enough = self.primes.len() + (self.primes.len() / PATIENCE).max(1);
            while self.primes.len() < enough {
                if self.gather(input, primes, watch)? == 0 {
                    return Ok(None);
                }
            }
        }
    }

    /// Computes the images modulo the next primes. Returns their number.
    fn gather(&mut self, input: &Input, primes: &mut impl Iterator<Item = u32>, watch: &Watch) -> Result<usize> {
        watch.check()?;
        watch.report("primes", self.primes.len(), self.learned.seen.shape.supports.len() - self.witnesses.len());
        let mut batch = [0; LANES];
        for p in &mut batch {
            *p = primes.next().ok_or_else(no_primes)?;
        }
        let before = self.primes.len();
        for (p, image) in batch.into_iter().zip(self.learned.images(input, batch, watch)?) {
            match image {
                Some(image) => self.take(p, image),
                None => self.unlucky += 1,
            }
        }
        Ok(self.primes.len() - before)
    }

    /// All coefficients over Q, as soon as each polynomial has a witness.
    fn vectors(&mut self, watch: &Watch) -> Result<Option<Vec<Vector>>> {
        let count = self.learned.seen.shape.supports.len();
        let mut tables = Tables::new(&self.primes)?;
        while self.witnesses.len() < count {
            match tables.witness(&rows(&self.images, self.witnesses.len())) {
                Some(witness) => self.witnesses.push(witness),
                None => return Ok(None),
            }
        }
        let mut vectors = Vec::with_capacity(count);
        for (index, witness) in self.witnesses.iter().enumerate() {
            watch.check()?;
            match tables.vector(&rows(&self.images, index), witness)? {
                Some(vector) => vectors.push(vector),
                None => {
                    self.witnesses.truncate(index);
                    return Ok(None);
                }
            }
        }
        Ok(Some(vectors))
    }
}

/// The coefficients of polynomial `index` modulo each prime.
fn rows(images: &[Image], index: usize) -> Vec<&[u32]> {
    images.iter().map(|image| &image[index][..]).collect()
}

impl Lift {
    /// The number of primes that were used.
    pub(super) fn primes(&self) -> usize {
        self.primes
    }

    /// Whether this basis agrees with `seen` modulo its prime.
    pub(super) fn agrees_with(&self, seen: &Seen) -> bool {
        let same = |(vector, image): (&Vector, &Vec<u32>)| vector.modulo(seen.prime).as_ref() == Some(image);
        self.shape == seen.shape && self.vectors.iter().zip(&seen.image).all(same)
    }

    /// The basis over Q.
    pub(super) fn into_basis(self, system: &System, watch: &Watch) -> Result<Basis<Rationals>> {
        let ring = system.ring.with_width(self.width);
        let mut polynomials = Vec::with_capacity(self.vectors.len());
        for (vector, support) in self.vectors.iter().zip(&self.shape.supports) {
            watch.check()?;
            let terms = vector.entries().into_iter().zip(support);
            polynomials.push(ring.collect(terms.map(|(coefficient, m)| Term { coefficient, monomial: m.clone() })));
        }
        let cofactors = polynomials.split_off(self.shape.elements);
        let columns = system.generators.len();
        let rows = if columns == 0 {
            Vec::new()
        } else {
            cofactors.chunks(columns).map(|row| widen(&ring, system, row)).collect()
        };
        Ok(Basis { ring, polynomials, cofactors: rows })
    }
}

/// The cofactors of the given generators, from those of their integer multiples.
fn widen(
    ring: &PolynomialRing<Rationals>,
    system: &System,
    row: &[Polynomial<BigRational>],
) -> Vec<Polynomial<BigRational>> {
    let mut wide = vec![ring.zero(); system.given];
    for (generator, cofactor) in system.generators.iter().zip(row) {
        wide[generator.index] = ring.scale(cofactor, &generator.factor);
    }
    wide
}
