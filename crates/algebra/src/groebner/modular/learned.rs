//! Result for one prime: the basis, and the method to compute it modulo other primes.

use super::super::prime_field::by_degree_first;
use super::super::{Options, Trace, basis, f4};
use super::by_degree::ByDegree;
use super::seen::{Image, Seen};
use super::system::System;
use crate::number::{BigRational, Rationals};
use crate::poly::{Order, Polynomial, PolynomialRing};
use crate::{Result, Watch};

/// Number of primes of one replay.
pub(super) const LANES: usize = 4;

/// A basis modulo a prime and how it was computed.
pub(super) struct Learned {
    pub seen: Seen,
    method: ImageMethod,
}

/// Method for further images.
enum ImageMethod {
    /// Replay of the first prime's trace.
    Replay(Trace),
    /// Replay of the first graded basis' trace, and a change of order.
    Reorder(ByDegree),
    /// A full computation with cofactors. The choices of the engine depend on monomials alone.
    Afresh,
}

/// The generators of a basis, and options of the computation.
pub(super) struct Input {
    pub system: System,
    /// The generators in a degree order, if the basis may be computed from the graded one.
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

    /// The basis modulo `p`, with the method for further primes.
    pub(super) fn learn(&self, p: u32, watch: &Watch) -> Result<Learned> {
        if self.options.cofactors {
            return Ok(Learned { seen: self.look(p, watch)?, method: ImageMethod::Afresh });
        }
        let (ring, generators) = self.system.image(p)?;
        if let Some(graded) = &self.graded
            && let Some((found, computation)) = ByDegree::learn(graded, &ring, watch)?
        {
            return Ok(Learned { seen: Seen::new(p, &found), method: ImageMethod::Reorder(computation) });
        }
        let (found, trace) = Trace::learn(&ring, &generators, watch)?;
        Ok(Learned { seen: Seen::new(p, &found), method: ImageMethod::Replay(trace) })
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
    /// The images modulo further primes; `None` where the computation differs.
    pub(super) fn images(&self, input: &Input, primes: [u32; LANES], watch: &Watch) -> Result<[Option<Image>; LANES]> {
        match (&self.method, &input.graded) {
            (ImageMethod::Replay(trace), _) => trace.replay(primes, &input.system.lanes(primes), watch),
            (ImageMethod::Reorder(computation), Some(graded)) => {
                let lanes = computation.replay(graded, &input.system.ring, primes, watch)?;
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
