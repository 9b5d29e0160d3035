//! Relations as equations whose coefficients are polynomials in the numbers of the target ([`Symbolic`]).

use crate::Result;
use crate::derive::closure::{Arithmetic, Assignment, JointValue, Mechanism, Multilinear, Relation, Target, evaluate};
use groebot_algebra::number::{BigRational, Rationals, Ring};
use groebot_algebra::poly::{Order, Polynomial, PolynomialRing};

/// A polynomial in the numbers of the target.
pub(in crate::derive) type TargetPoly = Polynomial<BigRational>;

/// Polynomials in the numbers of the target.
pub(in crate::derive) struct Symbolic {
    pub ring: PolynomialRing<Rationals>,
}

impl Arithmetic for Symbolic {
    type Value = TargetPoly;

    fn rational(&mut self, number: &BigRational) -> TargetPoly {
        self.ring.constant(number.clone())
    }
    fn add(&mut self, a: &TargetPoly, b: &TargetPoly) -> TargetPoly {
        self.ring.add(a, b)
    }
    fn sub(&mut self, a: &TargetPoly, b: &TargetPoly) -> TargetPoly {
        self.ring.sub(a, b)
    }
    fn mul(&mut self, a: &TargetPoly, b: &TargetPoly) -> TargetPoly {
        self.ring.mul(a, b)
    }
    fn neg(&mut self, a: &TargetPoly) -> TargetPoly {
        self.ring.neg(a)
    }
    fn is_zero(&self, a: &TargetPoly) -> bool {
        a.is_zero()
    }
}

impl Symbolic {
    /// The ring of the target's numbers.
    pub fn new(mechanism: &Mechanism) -> Result<Self> {
        Ok(Symbolic { ring: PolynomialRing::new(Rationals, &mechanism.parameters(), Order::GrevLex)? })
    }

    /// `relation` as a polynomial in the unknowns of all joints.
    pub fn polynomial(&mut self, mechanism: &Mechanism, relation: &Relation) -> Result<Multilinear<TargetPoly>> {
        let parameters: Vec<TargetPoly> = (0..self.ring.variables().len()).map(|v| self.ring.variable(v)).collect();
        let target = Target::new(mechanism, &parameters, self)?;
        let joints = vec![JointValue::Unknown; mechanism.joints().len()];
        evaluate(mechanism, relation, &Assignment { joints, target }, self)
    }
}
