//! Groebner bases over Q by many primes.
//!
//! The computation is learned modulo one prime and replayed modulo others (Traverso 1988); the coefficients are rebuilt by Chinese
//! remainders and rational reconstruction, and one more prime, learned afresh, confirms them (Arnold, "Modular algorithms for
//! computing Groebner bases", J. Symbolic Computation 35 (2003)). [`basis`] gives a [`Modular`], whose [`Status`] says
//! whether the result is only probable; [`prove`] settles that.

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

/// What is known of a basis that came from primes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// It agrees with a computation modulo a prime that it was not made from.
    Probable,
    /// It is the reduced basis: there is a proof over Q.
    Proved,
}

/// A reduced Groebner basis over Q, rebuilt from its images modulo primes.
#[derive(Clone, Debug, PartialEq)]
pub struct Modular {
    /// The basis, with cofactors when they were asked for.
    pub basis: Basis<Rationals>,
    /// How sure it is.
    pub status: Status,
    /// The number of primes that it was rebuilt from.
    pub primes: usize,
    /// The number of primes that were thrown away, because their computation went another way.
    pub unlucky: usize,
    /// The prime that confirmed it.
    pub confirmed_by: u32,
}

/// The reduced Groebner basis over Q of the ideal of `generators` in the order of `ring`, by many primes.
///
/// The result is [`Status::Probable`]: it agrees with the basis modulo a prime that it was not made from. That prime and the one
/// that the computation is learned from are scattered over those of 31 bits; until they agree, further ones are
/// learned from, each with one vote on what the monomials of the basis are. In other orders than the graded reverse one, the basis of a
/// zero-dimensional ideal comes from the graded one modulo each prime, by [`super::change_order`]. With [`Options::cofactors`] the cofactors are rebuilt in the
/// same way, [`verify`] proves the basis by them, and the result is [`Status::Proved`]; that is for small systems.
///
/// # Errors
/// Those of [`super::basis`] and [`super::f4()`]; [`Budget`](crate::ErrorKind::Budget) when no primes are left.
pub fn basis(
    ring: &PolynomialRing<Rationals>,
    generators: &[Polynomial<num_rational::BigRational>],
    options: &Options,
    watch: &Watch,
) -> Result<Modular> {
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

/// The same, proved: cofactors multiply out, generators and S-pairs reduce to zero.
fn proved_by_cofactors(
    found: Modular,
    generators: &[Polynomial<num_rational::BigRational>],
    watch: &Watch,
) -> Result<Modular> {
    let Basis { polynomials, cofactors, .. } = &found.basis;
    verify(&found.basis.ring, &Claim { generators, basis: polynomials, cofactors }, watch)?;
    Ok(Modular { status: Status::Proved, ..found })
}
