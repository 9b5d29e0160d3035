//! Comprehensive Groebner systems: the Groebner basis for every value of the parameters.
//!
//! [`cover`] divides the parameter space into finitely many strata with a basis for each ([`Cover`], [`Stratum`]).
//! [`check`] proves that the strata are disjoint and complete; [`sample`] finds points on them. Source: Kapur, Sun and
//! Wang, ISSAC 2010 (the splitting); Montes and Wibmer, J. Symbolic Computation 45 (2010) (few segments).

mod check;
mod emptiness;
mod flat;
mod ideals;
mod merge;
mod proof;
mod pseudo;
mod real;
mod region;
mod sample;
mod signs;
mod space;
mod split;
mod stratum;
mod tidy;
mod words;

pub use check::{Checked, check};
pub use real::rational_roots;
pub use region::Region;
pub use sample::{Candidates, sample};
pub use signs::forced_zeros;
pub use space::Space;
pub use stratum::{Element, Kind, RealPoints, Stratum};

use crate::number::{Field, Ring};
use crate::poly::{Fractions, Polynomial, PolynomialRing};
use crate::{Result, Watch};
use flat::Flat;
use ideals::Ideals;

/// Disjoint strata whose union is the parameter space.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Cover<F: Field> {
    /// The ring of the unknowns over the rational functions of the parameters. The bases are sorted by its order.
    pub ring: PolynomialRing<Fractions<F>>,
    /// The set of parameter values that is covered. Its equations include the relations of `ring`.
    pub space: Space<F::Element>,
    /// The strata, sorted by the number of equations.
    pub strata: Vec<Stratum<F>>,
}

/// Computes the cover of the parameter space for the ideal of `generators`. Their coefficients are polynomials of the
/// parameters.
///
/// Relations between parameters (see [`Fractions::with_square`]) are kept.
///
/// # Errors
/// [`crate::ErrorKind::BadValue`] for a coefficient with a denominator; [`crate::ErrorKind::Overflow`]; the error with
/// which `watch` stops the work.
pub fn cover<'w, F: Field>(
    ring: &PolynomialRing<Fractions<F>>,
    generators: &[Polynomial<<Fractions<F> as Ring>::Element>],
    space: &Space<F::Element>,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Cover<F>> {
    let watch = Watch::or_none(watch);
    let ideals = Ideals::new(ring.field().ring(), watch)?;
    let flat = Flat::new(ring, generators)?;
    let space = space.related(ring.field());
    let pieces = match space.region(&ideals)? {
        Some(region) => split::pieces(&ideals, &flat, region)?,
        None => Vec::new(),
    };
    let strata = merge::merged(&ideals, &flat, &pieces, &space.forbidden())?;
    Ok(Cover { ring: ring.clone(), space, strata })
}
