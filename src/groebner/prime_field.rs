//! The fastest way to a reduced basis over a prime field, in any order.

use super::{Basis, Options, basis, change_order, f4};
use crate::number::Zp;
use crate::poly::{Order, Polynomial, PolynomialRing};
use crate::{ErrorKind, Result, Watch};

/// The reduced Groebner basis of the ideal of `generators` modulo a prime, in the order of `ring`: by [`f4`] in the graded
/// reverse order, and from there by [`change_order`] when the ideal is zero-dimensional, else by [`f4`] in the order itself.
/// Primes beyond those of F4, and more variables than its keys hold, go to [`basis`].
///
/// # Errors
/// [`ErrorKind::Overflow`] when a degree does not fit; what `watch` stops with.
pub fn basis_modulo_prime(
    ring: &PolynomialRing<Zp>,
    generators: &[Polynomial<u64>],
    watch: &Watch,
) -> Result<Basis<Zp>> {
    let fast = if *ring.layout().order() == Order::GrevLex {
        f4(ring, generators, watch)
    } else {
        by_change_of_order(ring, generators, watch)
    };
    match fast {
        Err(error) if matches!(error.kind(), ErrorKind::BadValue | ErrorKind::Overflow) => {
            basis(ring, generators, &Options::default(), watch)
        }
        outcome => outcome,
    }
}

fn by_change_of_order(ring: &PolynomialRing<Zp>, generators: &[Polynomial<u64>], watch: &Watch) -> Result<Basis<Zp>> {
    let graded = PolynomialRing::new(*ring.field(), ring.variables(), Order::GrevLex)?;
    let images = generators.iter().map(|f| ring.transfer(f, &graded)).collect::<Result<Vec<_>>>()?;
    let by_degree = f4(&graded, &images, watch)?;
    match by_degree.require_zero_dimensional() {
        Ok(()) => change_order(&by_degree, ring, watch),
        Err(error) if error.kind() == ErrorKind::Inconsistent => {
            Ok(Basis { ring: ring.clone(), polynomials: vec![crate::number::Ring::one(ring)], cofactors: Vec::new() })
        }
        Err(_) => f4(ring, generators, watch),
    }
}
