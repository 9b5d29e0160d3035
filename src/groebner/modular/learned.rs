//! What one prime teaches: the basis there, its shape, and how to compute it modulo other primes.

use super::super::{Basis, Options, Trace, basis, f4};
use super::system::System;
use crate::number::Zp;
use crate::poly::{Monomial, Polynomial, Width};
use crate::{Result, Watch};

/// How many primes a replay takes at once.
pub(super) const LANES: usize = 4;

/// The coefficients of all polynomials of a [`Shape`] modulo one prime.
pub(super) type Image = Vec<Vec<u32>>;

/// The monomials of the basis polynomials and, behind them, of their cofactors, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shape {
    pub supports: Vec<Vec<Monomial>>,
    /// The number of basis polynomials.
    pub elements: usize,
}

/// A basis modulo a prime.
pub(super) struct Seen {
    pub prime: u32,
    /// The width of the monomials' lanes.
    pub width: Width,
    pub shape: Shape,
    pub image: Image,
}

/// A basis modulo a prime and how it was computed.
pub(super) struct Learned {
    pub seen: Seen,
    way: Way,
}

/// How further images are made.
enum Way {
    /// By the trace of the first.
    Replay(Trace),
    /// Afresh, with cofactors: the choices of the engine depend on monomials alone.
    Afresh(Options),
}

impl System<'_> {
    /// The basis modulo `p`, and the way to it.
    pub(super) fn learn(&self, p: u32, options: &Options, watch: &Watch) -> Result<Learned> {
        if options.cofactors {
            return Ok(Learned { seen: self.look(p, options, watch)?, way: Way::Afresh(*options) });
        }
        let (ring, generators) = self.image(p)?;
        let (found, trace) = Trace::learn(&ring, &generators, watch)?;
        Ok(Learned { seen: Seen::new(p, &found), way: Way::Replay(trace) })
    }

    /// The basis modulo `p` alone.
    pub(super) fn look(&self, p: u32, options: &Options, watch: &Watch) -> Result<Seen> {
        let (ring, generators) = self.image(p)?;
        let found =
            if options.cofactors { basis(&ring, &generators, options, watch)? } else { f4(&ring, &generators, watch)? };
        Ok(Seen::new(p, &found))
    }
}

impl Learned {
    /// The images modulo further primes; `None` where the computation goes another way.
    pub(super) fn images(
        &self,
        system: &System<'_>,
        primes: [u32; LANES],
        watch: &Watch,
    ) -> Result<[Option<Image>; LANES]> {
        match &self.way {
            Way::Replay(trace) => trace.replay(primes, &system.lanes(primes), watch),
            Way::Afresh(options) => {
                let mut images = [const { None }; LANES];
                for (image, &p) in images.iter_mut().zip(&primes) {
                    let other = system.look(p, options, watch)?;
                    *image = (other.shape == self.seen.shape).then_some(other.image);
                }
                Ok(images)
            }
        }
    }
}

impl Seen {
    fn new(prime: u32, basis: &Basis<Zp>) -> Self {
        let all = || basis.polynomials.iter().chain(basis.cofactors.iter().flatten());
        let support = |f: &Polynomial<u64>| f.terms().iter().map(|term| term.monomial.clone()).collect();
        let coefficients = |f: &Polynomial<u64>| f.terms().iter().map(|term| term.coefficient as u32).collect();
        let shape = Shape { supports: all().map(support).collect(), elements: basis.polynomials.len() };
        Seen { prime, width: basis.ring.layout().width(), shape, image: all().map(coefficients).collect() }
    }
}
