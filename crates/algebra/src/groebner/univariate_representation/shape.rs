//! The shape of a representation modulo every lucky prime, and the layout of its coefficients in one vector.

use num_bigint::BigInt;

use super::modular::Modular;
use super::{UnivariateRepresentation, integral, univariate};

/// The degrees in a representation: equal for all lucky primes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shape {
    pub(super) degree: usize,
    minimal: usize,
    classes: Vec<(usize, usize)>,
    variables: usize,
}

impl Shape {
    pub(super) fn of(modular: &Modular) -> Self {
        let classes = modular.classes.iter().map(|(multiplicity, factor)| (*multiplicity, factor.len() - 1)).collect();
        Shape {
            degree: modular.polynomial.len() - 1,
            minimal: modular.minimal,
            classes,
            variables: modular.numerators.len(),
        }
    }

    /// Whether the primes before `modular` were unlucky. Degrees can only drop modulo a prime.
    pub(super) fn is_unlucky(&self, modular: &Modular) -> bool {
        let other = Shape::of(modular);
        (self.degree, self.minimal) < (other.degree, other.minimal)
    }

    pub(super) fn length(&self) -> usize {
        self.degree * (1 + self.variables) + self.classes.iter().map(|(_, degree)| degree).sum::<usize>()
    }

    /// All coefficients except the leading ones of monic polynomials.
    pub(super) fn flatten(&self, modular: &Modular) -> Vec<u32> {
        let mut residues = modular.polynomial[..self.degree].to_vec();
        for (index, numerator) in modular.numerators.iter().enumerate() {
            residues.extend(numerator);
            residues.resize(self.degree * (index + 2), 0);
        }
        residues.extend(modular.classes.iter().flat_map(|(_, factor)| &factor[..factor.len() - 1]));
        residues
    }

    /// The inverse of [`Shape::flatten`] over Q: builds the representation from numerators followed by their common
    /// denominator.
    pub(super) fn assemble(&self, variables: &[String], form: &[i64], values: &[BigInt]) -> UnivariateRepresentation {
        let (denominator, values) = values.split_last().expect("the denominator is last");
        let (represented, mut rest) = values.split_at(self.degree * (1 + self.variables));
        let mut parts = represented.chunks(self.degree).map(<[BigInt]>::to_vec);
        let monic = |low: &[BigInt]| low.iter().chain([denominator]).cloned().collect::<Vec<_>>();
        let polynomial = univariate(monic(&parts.next().unwrap_or_default()));
        let mut multiplicities = Vec::new();
        for &(multiplicity, degree) in &self.classes {
            let (low, after) = rest.split_at(degree);
            multiplicities.push((multiplicity, univariate(integral::primitive(&monic(low)))));
            rest = after;
        }
        if multiplicities.is_empty() {
            multiplicities.push((1, univariate(integral::primitive(&polynomial.coefficients))));
        }
        let numerators = parts.map(univariate).collect();
        let (variables, form) = (variables.to_vec(), form.to_vec());
        UnivariateRepresentation { variables, form, polynomial, numerators, multiplicities }
    }
}
