//! Fast computation of reduced bases over a prime field, in any order.

use super::{Basis, Options, basis, change_order, f4};
use crate::number::{Field, Ring, Zp};
use crate::poly::{Order, Polynomial, PolynomialRing};
use crate::{ErrorKind, Result, Watch};

/// Computes the reduced Groebner basis of the ideal of `generators` modulo a prime, in the order of `ring`. A
/// zero-dimensional ideal is computed by [`f4()`] in graded reverse order and converted by [`change_order`]. Other
/// ideals are computed by [`f4()`] in the order itself. Larger primes or more variables than F4 supports are passed to
/// [`basis`].
///
/// # Errors
/// [`ErrorKind::Overflow`] when a degree does not fit; the error with which `watch` stops the work.
pub fn basis_modulo_prime<'w>(
    ring: &PolynomialRing<Zp>,
    generators: &[Polynomial<u64>],
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Basis<Zp>> {
    let watch = Watch::or_none(watch);
    let fast = if *ring.layout().order() == Order::GrevLex {
        f4(ring, generators, watch)
    } else {
        by_degree_first(ring, generators, watch)
    };
    match fast {
        Err(error) if matches!(error.kind(), ErrorKind::BadValue | ErrorKind::Overflow) => {
            basis(ring, generators, &Options::default(), watch)
        }
        outcome => outcome,
    }
}

/// The reduced basis in the order of `ring`, converted from the graded one where that is faster.
///
/// # Errors
/// Those of [`f4()`] and [`change_order`].
pub(super) fn by_degree_first(
    ring: &PolynomialRing<Zp>,
    generators: &[Polynomial<u64>],
    watch: &Watch,
) -> Result<Basis<Zp>> {
    let graded = graded(ring)?;
    let images = generators.iter().map(|f| ring.transfer(f, &graded)).collect::<Result<Vec<_>>>()?;
    match reordered(&f4(&graded, &images, watch)?, ring, watch)? {
        Some(found) => Ok(found),
        None => f4(ring, generators, watch),
    }
}

/// Same ring, but in graded reverse order.
pub(super) fn graded<F: Field>(ring: &PolynomialRing<F>) -> Result<PolynomialRing<F>> {
    let plain = PolynomialRing::new(ring.field().clone(), ring.variables(), Order::GrevLex)?;
    Ok(plain.with_width(ring.layout().width()))
}

/// The reduced basis in the order of `target` from the graded one, in lanes as wide as needed; `None` when the ideal is
/// positive-dimensional.
///
/// # Errors
/// Those of [`change_order`].
pub(super) fn reordered(graded: &Basis<Zp>, target: &PolynomialRing<Zp>, watch: &Watch) -> Result<Option<Basis<Zp>>> {
    match graded.require_zero_dimensional() {
        Ok(()) => in_some_width(graded, target, watch).map(Some),
        Err(error) if error.kind() == ErrorKind::Inconsistent => {
            Ok(Some(Basis { ring: target.clone(), polynomials: vec![target.one()], cofactors: Vec::new() }))
        }
        Err(_) => Ok(None),
    }
}

fn in_some_width(graded: &Basis<Zp>, target: &PolynomialRing<Zp>, watch: &Watch) -> Result<Basis<Zp>> {
    match (change_order(graded, target, watch), target.layout().width().wider()) {
        (Err(error), Some(wider)) if error.kind() == ErrorKind::Overflow => {
            let width = wider.max(graded.ring.layout().width());
            in_some_width(&graded.clone().with_width(width)?, &target.with_width(wider), watch)
        }
        (outcome, _) => outcome,
    }
}
