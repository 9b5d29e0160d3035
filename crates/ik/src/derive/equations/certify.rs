//! Proofs of bases. The engine finds cofactors, and [`groebot_algebra::groebner::verify`] checks them before use.

use crate::derive::equations::setting::{Coefficients, Poly, Setting, Unknowns};
use crate::{Result, Watch};
use groebot_algebra::groebner::verify::{Claim, Proof, verify};
use groebot_algebra::groebner::{Basis, divide};
use groebot_algebra::number::Ring;
use groebot_algebra::poly::Order;

/// A reduced Groebner basis of a setting's equations, with verified cofactors as proof.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Certified {
    /// The unknowns, greatest first.
    pub order: Vec<String>,
    /// Whether the order is graded reverse lexicographic, otherwise lexicographic.
    pub graded: bool,
    /// The basis, monic, smallest leading monomial first.
    pub basis: Vec<Poly>,
    /// `basis[i] = sum over j of cofactors[i][j] * equation j`.
    pub cofactors: Vec<Vec<Poly>>,
    /// The proved statement.
    pub proof: Proof,
}

impl Certified {
    /// The ring of the basis in `setting`.
    ///
    /// # Errors
    /// If the setting's field cannot be built.
    pub fn ring(&self, setting: &Setting) -> Result<Unknowns> {
        setting.ring(&self.order, if self.graded { Order::GrevLex } else { Order::Lex })
    }

    /// Verifies the claim that this is the basis of `setting`'s equations.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Certificate`] with the first false part.
    pub(crate) fn verify(&self, setting: &Setting) -> Result<Proof> {
        let ring = self.ring(setting)?;
        let generators = setting.generators(&ring)?;
        verify(
            &ring,
            &Claim { generators: &generators, basis: &self.basis, cofactors: &self.cofactors },
            &Watch::none(),
        )
    }
}

/// The basis `target` with proof. It is a basis of the same ideal as `graded`, whose cofactors by `generators` are known.
pub(in crate::derive) fn certified(
    graded: &Basis<Coefficients>,
    target: &Basis<Coefficients>,
    generators: &[Poly],
    watch: &Watch,
) -> Result<Certified> {
    let ring = &target.ring;
    let cofactors = target.polynomials.iter().map(|g| express(graded, target, g, generators.len()));
    let cofactors: Vec<Vec<Poly>> = cofactors.collect::<Result<_>>()?;
    let generators: Vec<Poly> = generators.iter().map(|f| graded.ring.transfer(f, ring)).collect::<Result<_>>()?;
    let proof =
        verify(ring, &Claim { generators: &generators, basis: &target.polynomials, cofactors: &cofactors }, watch)?;
    Ok(Certified {
        order: ring.variables().to_vec(),
        graded: *ring.layout().order() == Order::GrevLex,
        basis: target.polynomials.clone(),
        cofactors,
        proof,
    })
}

/// The cofactors of `g`: its quotients by the graded basis, times that basis' cofactors.
fn express(
    graded: &Basis<Coefficients>,
    target: &Basis<Coefficients>,
    g: &Poly,
    generators: usize,
) -> Result<Vec<Poly>> {
    let division = divide(&graded.ring, &target.ring.transfer(g, &graded.ring)?, &graded.polynomials)?;
    let mut cofactors = vec![graded.ring.zero(); generators];
    for (quotient, row) in division.quotients.iter().zip(&graded.cofactors).filter(|(q, _)| !q.is_zero()) {
        for (sum, cofactor) in cofactors.iter_mut().zip(row) {
            *sum = graded.ring.add(sum, &graded.ring.checked_mul(quotient, cofactor)?);
        }
    }
    cofactors.iter().map(|f| graded.ring.transfer(f, &target.ring)).collect()
}
