//! What one prime teaches: the basis there, and how to compute it modulo other primes.

use super::super::prime_field::by_degree_first;
use super::super::{Options, Trace, basis, f4};
use super::by_degree::ByDegree;
use super::seen::{Image, Seen};
use super::system::System;
use crate::number::{BigRational, Rationals};
use crate::poly::{Order, Polynomial, PolynomialRing};
use crate::{Result, Watch};

/// How many primes a replay takes at once.
pub(super) const LANES: usize = 4;

/// A basis modulo a prime and how it was computed.
pub(super) struct Learned {
    pub seen: Seen,
    way: Way,
}

/// How further images are made.
enum Way {
    /// By the trace of the first.
    Replay(Trace),
    /// By the trace of the first graded basis, and a change of order.
    Reorder(ByDegree),
    /// Afresh, with cofactors: the choices of the engine depend on monomials alone.
    Afresh,
}

/// The generators of a basis, and how to compute it.
pub(super) struct Input {
    pub system: System,
    /// The generators by degree, where the basis may be reached from the graded one.
    graded: Option<System>,
    options: Options,
}

impl Input {
    /// # Errors
    /// [`Overflow`](crate::ErrorKind::Overflow) when a degree does not fit.
    pub(super) fn new(
        ring: &PolynomialRing<Rationals>,
        generators: &[Polynomial<BigRational>],
        options: &Options,
    ) -> Result<Self> {
        let in_order = options.cofactors || *ring.layout().order() == Order::GrevLex;
        let graded = if in_order { None } else { Some(System::graded(ring, generators)?) };
        Ok(Input { system: System::new(ring, generators), graded, options: *options })
    }

    /// The basis modulo `p`, and the way to it.
    pub(super) fn learn(&self, p: u32, watch: &Watch) -> Result<Learned> {
        if self.options.cofactors {
            return Ok(Learned { seen: self.look(p, watch)?, way: Way::Afresh });
        }
        let (ring, generators) = self.system.image(p)?;
        if let Some(graded) = &self.graded
            && let Some((found, way)) = ByDegree::learn(graded, &ring, watch)?
        {
            return Ok(Learned { seen: Seen::new(p, &found), way: Way::Reorder(way) });
        }
        let (found, trace) = Trace::learn(&ring, &generators, watch)?;
        Ok(Learned { seen: Seen::new(p, &found), way: Way::Replay(trace) })
    }

    /// The basis modulo `p` alone.
    pub(super) fn look(&self, p: u32, watch: &Watch) -> Result<Seen> {
        let (ring, generators) = self.system.image(p)?;
        let found = match (&self.graded, self.options.cofactors) {
            (_, true) => basis(&ring, &generators, &self.options, watch)?,
            (Some(_), _) => by_degree_first(&ring, &generators, watch)?,
            (None, _) => f4(&ring, &generators, watch)?,
        };
        Ok(Seen::new(p, &found))
    }
}

impl Learned {
    /// The images modulo further primes; `None` where the computation goes another way.
    pub(super) fn images(&self, input: &Input, primes: [u32; LANES], watch: &Watch) -> Result<[Option<Image>; LANES]> {
        match (&self.way, &input.graded) {
            (Way::Replay(trace), _) => trace.replay(primes, &input.system.lanes(primes), watch),
            (Way::Reorder(way), Some(graded)) => {
                let lanes = way.replay(graded, &input.system.ring, primes, watch)?;
                Ok(lanes.map(|found| found.and_then(|found| self.seen.shape.image(&found))))
            }
            _ => {
                let mut images = [const { None }; LANES];
                for (image, &p) in images.iter_mut().zip(&primes) {
                    let other = input.look(p, watch)?;
                    *image = (other.shape == self.seen.shape).then_some(other.image);
                }
                Ok(images)
            }
        }
    }
}
