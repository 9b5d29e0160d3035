//! Comprehensive Groebner systems: what becomes of a basis at every value of its parameters.
//!
//! [`cover`] cuts the parameter space into finitely many strata and gives a basis for each ([`Cover`], [`Stratum`]). [`check`]
//! proves that the strata are disjoint and leave nothing out; [`sample`] finds points on them. Source: Kapur, Sun and Wang,
//! ISSAC 2010 (the splitting); Montes and Wibmer, J. Symbolic Computation 45 (2010) (few segments).

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

/// Disjoint strata that together make the parameter space.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Cover<F: Field> {
    /// The unknowns, over the rational functions of the parameters; the bases are sorted by its order.
    pub ring: PolynomialRing<Fractions<F>>,
    /// The values of the parameters that were asked about, the relations of `ring` among the equations.
    pub space: Space<F::Element>,
    /// The strata, those with the fewest equations first.
    pub strata: Vec<Stratum<F>>,
}

/// The cover of the parameter space for the ideal of `generators`, whose coefficients are polynomials of the parameters.
///
/// Parameters that the coefficient field relates (see [`Fractions::with_square`]) keep their relations.
///
/// # Errors
/// [`crate::ErrorKind::BadValue`] for a coefficient with a denominator; [`crate::ErrorKind::Overflow`]; what `watch`
/// stops with.
pub fn cover<F: Field>(
    ring: &PolynomialRing<Fractions<F>>,
    generators: &[Polynomial<<Fractions<F> as Ring>::Element>],
    space: &Space<F::Element>,
    watch: &Watch,
) -> Result<Cover<F>> {
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
