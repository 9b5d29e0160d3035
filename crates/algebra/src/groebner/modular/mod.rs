//! Groebner bases over Q by computations modulo many primes.
//!
//! The computation is learned modulo one prime and replayed modulo others (Traverso 1988); the coefficients are
//! reconstructed by Chinese remaindering and rational reconstruction. A separate computation modulo one more prime
//! confirms them (Arnold, "Modular algorithms for computing Groebner bases", J. Symbolic Computation 35 (2003)).
//! [`basis`] returns a [`Modular`] whose [`Status`] shows whether the result is proved or only probable. [`prove`]
//! proves it.

mod arnold;
mod by_degree;
mod candidate;
mod divisors;
mod learned;
mod matrix;
mod seen;
mod system;
mod terms;
mod vanish;
mod vectors;

pub use arnold::prove;

use super::verify::{Claim, verify};
use super::{Basis, Options};
use crate::number::Rationals;
use crate::poly::{Polynomial, PolynomialRing};
use crate::{Result, Watch};
use candidate::{Ballot, Lift};
use learned::Input;
use system::no_primes;

/// Certainty of a basis that was computed modulo primes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// It agrees with a computation modulo a prime that was not used for it.
    Probable,
    /// There is a proof over Q that it is the reduced basis.
    Proved,
}

/// A reduced Groebner basis over Q, reconstructed from its images modulo primes.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Modular {
    /// The basis, with cofactors on request.
    pub basis: Basis<Rationals>,
    /// Whether the basis is probable or proved.
    pub status: Status,
    /// The number of primes that were used.
    pub primes: usize,
    /// The number of primes that were discarded because their computation differed.
    pub unlucky: usize,
    /// The prime that confirmed it.
    pub confirmed_by: u32,
}

/// Computes the reduced Groebner basis over Q of the ideal of `generators` in the order of `ring`, modulo many primes.
///
/// The result is [`Status::Probable`]: it agrees with the basis modulo a prime that was not used. This prime and the
/// one of the learned computation are chosen from the 31-bit primes by a hash of the coefficients. Until they agree,
/// further primes are learned, each with one vote on the monomials of the basis. For orders other than grevlex, the
/// basis of a zero-dimensional ideal is converted from the grevlex one modulo each prime, by [`super::change_order`].
/// With [`Options::cofactors`] the cofactors are reconstructed too, [`verify`] proves the basis with them, and the
/// result is [`Status::Proved`]. This is suitable for small systems.
///
/// # Errors
/// Those of [`super::basis`] and [`super::f4()`]; [`Budget`](crate::ErrorKind::Budget) when no primes are left.
pub fn basis<'w>(
    ring: &PolynomialRing<Rationals>,
    generators: &[Polynomial<num_rational::BigRational>],
    options: &Options,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Modular> {
    let watch = Watch::or_none(watch);
    let input = Input::new(ring, generators, options)?;
    let system = &input.system;
    let mut primes = system.primes();
    let mut ballot = Ballot::default();
    let mut lifted: Option<Lift> = None;
    for round in 0.. {
        let p = system.scattered_prime(round)?;
        if let Some(lift) = lifted
            && lift.agrees_with(&input.look(p, watch)?)
        {
            let (primes, confirmed_by) = (lift.primes(), p);
            let basis = lift.into_basis(system, watch)?;
            let found = Modular { basis, status: Status::Probable, primes, unlucky: ballot.unlucky(), confirmed_by };
            return if options.cofactors { proved_by_cofactors(found, generators, watch) } else { Ok(found) };
        }
        lifted = ballot.enter(input.learn(p, watch)?).lift(&input, &mut primes, watch)?;
    }
    Err(no_primes())
}

/// Same as [`basis`], but proved: cofactors multiply out, generators and S-pairs reduce to zero.
fn proved_by_cofactors(
    found: Modular,
    generators: &[Polynomial<num_rational::BigRational>],
    watch: &Watch,
) -> Result<Modular> {
    let Basis { polynomials, cofactors, .. } = &found.basis;
    verify(&found.basis.ring, &Claim { generators, basis: polynomials, cofactors }, watch)?;
    Ok(Modular { status: Status::Proved, ..found })
}
