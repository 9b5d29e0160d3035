//! Polynomials over Q with exponents of at most one, for points that joints move.

use std::collections::BTreeMap;

use num_traits::{One, Zero};

use groebot_algebra::number::BigRational;
use groebot_robot::kinematics::ExactVector;

/// A polynomial by its sets of unknowns: bit `v` of a key is set for unknown `v`.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Form(BTreeMap<u32, BigRational>);

/// Three coordinates.
pub(super) type Forms = [Form; 3];

impl Form {
    pub fn constant(value: BigRational) -> Self {
        Form::default().plus(&Form(BTreeMap::from([(0, value)])))
    }

    pub fn unknown(index: usize) -> Self {
        Form(BTreeMap::from([(1 << index, BigRational::one())]))
    }

    /// The terms, by the sets of their unknowns.
    pub fn terms(&self) -> impl Iterator<Item = (u32, &BigRational)> {
        self.0.iter().map(|(&set, coefficient)| (set, coefficient))
    }

    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The value of a polynomial without unknowns.
    pub fn value(&self) -> BigRational {
        debug_assert!(self.0.keys().all(|&set| set == 0));
        self.0.get(&0).cloned().unwrap_or_default()
    }

    pub fn plus(&self, other: &Form) -> Form {
        self.with_multiple(other, &BigRational::one())
    }

    pub fn minus(&self, other: &Form) -> Form {
        self.with_multiple(other, &-BigRational::one())
    }

    /// `self + factor * other`.
    pub fn with_multiple(&self, other: &Form, factor: &BigRational) -> Form {
        let mut sum = self.clone();
        if factor.is_zero() {
            return sum;
        }
        for (&set, coefficient) in &other.0 {
            *sum.0.entry(set).or_default() += coefficient * factor;
        }
        sum.0.retain(|_, coefficient| !coefficient.is_zero());
        sum
    }

    /// The product with a polynomial in other unknowns.
    pub fn times(&self, other: &Form) -> Form {
        let mut product = Form::default();
        for (&set, coefficient) in &other.0 {
            debug_assert!(self.0.keys().all(|own| own & set == 0), "an unknown occurs in both factors");
            let shifted = self.0.iter().map(|(own, c)| (own | set, c.clone())).collect();
            product = product.with_multiple(&Form(shifted), coefficient);
        }
        product
    }
}

/// `a . x` for a constant vector `a`.
pub(super) fn dot(a: &ExactVector, x: &Forms) -> Form {
    a.iter().zip(x).fold(Form::default(), |sum, (a, x)| sum.with_multiple(x, a))
}

/// `a x b` for a constant vector `a`.
pub(super) fn cross(a: &ExactVector, x: &Forms) -> Forms {
    [[1, 2], [2, 0], [0, 1]].map(|[i, j]| Form::default().with_multiple(&x[j], &a[i]).with_multiple(&x[i], &-&a[j]))
}

/// `x + factor * y`.
pub(super) fn sum(x: &Forms, factor: &Form, y: &Forms) -> Forms {
    [0, 1, 2].map(|i| x[i].plus(&y[i].times(factor)))
}

pub(super) fn constant(vector: &ExactVector) -> Forms {
    vector.each_ref().map(|entry| Form::constant(entry.clone()))
}
