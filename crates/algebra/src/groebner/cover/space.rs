//! The part of the parameter space that a cover is requested for.

use super::ideals::{Ideal, Ideals};
use super::region::Region;
use crate::Result;
use crate::number::{Field, Ring};
use crate::poly::{Fractions, Polynomial};

/// The parameter values where all `equations` hold and no polynomial of `nonzero` vanishes.
#[derive(Clone, Debug, PartialEq)]
pub struct Space<E> {
    /// Polynomials of the parameters that are zero.
    pub equations: Vec<Polynomial<E>>,
    /// Polynomials of the parameters that are not zero, for example lengths.
    pub nonzero: Vec<Polynomial<E>>,
}

impl<E: Clone> Space<E> {
    /// The whole parameter space.
    pub fn all() -> Self {
        Space { equations: Vec::new(), nonzero: Vec::new() }
    }

    /// Adds the relations between the parameters of `field` to the equations.
    pub(super) fn related<F: Field<Element = E>>(&self, field: &Fractions<F>) -> Self {
        let ring = field.ring();
        let mut space = self.clone();
        for v in (0..ring.variables().len()).filter(|&v| field.is_algebraic(v)) {
            let square = ring.pow(&ring.variable(v), 2);
            space.equations.push(ring.sub(&square, &field.reduce(&square)));
        }
        space
    }

    /// The space as a region; `None` when it is empty.
    pub(super) fn region<F: Field<Element = E>>(&self, ideals: &Ideals<'_, F>) -> Result<Option<Region<E>>> {
        ideals.region(ideals.ideal(&self.equations)?, &self.forbidden())
    }

    /// The excluded zero sets.
    pub(super) fn forbidden(&self) -> Vec<Ideal<E>> {
        self.nonzero.iter().map(|f| vec![f.clone()]).collect()
    }
}
