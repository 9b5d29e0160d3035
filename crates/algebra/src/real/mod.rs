//! All real solutions of a zero-dimensional polynomial system, isolated exactly: [`solve`] gives one [`RealSolution`]
//! each.
//!
//! The rational univariate representation describes the solutions by the roots of one polynomial (Rouillier 1999).
//! These roots are isolated by Descartes' rule of signs, refined, and mapped back to boxes.

mod solution;

use std::sync::Arc;

pub use self::solution::{Enclosure, RealSolution};
use crate::groebner::{self, Basis, modular, univariate_representation};
use crate::number::{BigRational, Rationals};
use crate::poly::{Order, Polynomial, PolynomialRing};
use crate::roots::isolate_square_free;
use crate::{ErrorKind, Result, Watch};

/// Options of [`solve`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Every coordinate is enclosed in an interval of width at most `2^-precision`.
    pub precision: u64,
}

impl Default for Options {
    /// 64 bits.
    fn default() -> Self {
        Options { precision: 64 }
    }
}

/// Computes all real solutions of the system `generators = 0`. The generators are polynomials of `ring`, in any order.
///
/// The boxes are disjoint, and each holds exactly one real solution. They are sorted by the value of the separating
/// linear form.
///
/// # Errors
/// [`crate::ErrorKind::Inconsistent`] when there is no solution at all, complex ones included;
/// [`crate::ErrorKind::PositiveDimensional`] when there are infinitely many; [`crate::ErrorKind::Overflow`]; the error
/// with which `watch` stops the work.
pub fn solve<'w>(
    ring: &PolynomialRing<Rationals>,
    generators: &[Polynomial<BigRational>],
    options: &Options,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Vec<RealSolution>> {
    let watch = Watch::or_none(watch);
    let graded = PolynomialRing::new(Rationals, ring.variables(), Order::GrevLex)?;
    let graded = graded.with_width(ring.layout().width());
    let generators: Vec<_> = generators.iter().map(|f| ring.transfer(f, &graded)).collect::<Result<_>>()?;
    let basis = proved_basis(&graded, &generators, watch)?;
    let generators: Vec<_> = generators.iter().map(|f| graded.transfer(f, &basis.ring)).collect::<Result<_>>()?;
    solve_basis(&basis, &generators, options, watch)
}

/// The proved reduced basis: by a modular computation with proof, or by the engine over Q where the modular one is not
/// applicable.
fn proved_basis(
    ring: &PolynomialRing<Rationals>,
    generators: &[Polynomial<BigRational>],
    watch: &Watch,
) -> Result<Basis<Rationals>> {
    let options = groebner::Options::default();
    let by_primes = modular::basis(ring, generators, &options, watch);
    let proved = by_primes.and_then(|found| modular::prove(&found, ring, generators, watch).map(|_| found.basis));
    match proved {
        Err(error) if error.kind() != ErrorKind::Cancelled => {
            watch.check()?;
            groebner::basis(ring, generators, &options, watch)
        }
        outcome => outcome,
    }
}

/// Same as [`solve`], but with the reduced Groebner basis of the ideal of `generators` as input. The generators are in
/// the basis' ring.
///
/// # Errors
/// Those of [`univariate_representation()`].
pub fn solve_basis<'w>(
    basis: &Basis<Rationals>,
    generators: &[Polynomial<BigRational>],
    options: &Options,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Vec<RealSolution>> {
    let watch = Watch::or_none(watch);
    let representation = Arc::new(univariate_representation(basis, generators, watch)?);
    let roots = isolate_square_free(&representation.polynomial.coefficients, watch)?;
    let mut solutions = Vec::with_capacity(roots.len());
    for (done, root) in roots.iter().enumerate() {
        watch.report("real solutions", done, roots.len() - done);
        solutions.push(RealSolution::new(representation.clone(), root.clone(), options.precision, watch)?);
    }
    separate(&mut solutions, watch)?;
    Ok(solutions)
}

/// Refines the solutions until no two boxes intersect.
fn separate(solutions: &mut [RealSolution], watch: &Watch) -> Result<()> {
    for i in 1..solutions.len() {
        for j in 0..i {
            while solutions[i].meets(&solutions[j]) {
                for k in [i, j] {
                    solutions[k] = solutions[k].refine(2 * solutions[k].precision(), watch)?;
                }
            }
        }
    }
    Ok(())
}
