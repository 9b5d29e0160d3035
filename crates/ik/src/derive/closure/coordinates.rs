//! Vectors of polynomials in the unknown joints, for evaluations.

use super::arithmetic::{Arithmetic, Multilinear};
use super::evaluate::{Evaluation, Vector};
use groebot_algebra::number::BigRational;
use groebot_robot::kinematics::ExactVector;

impl<A: Arithmetic> Evaluation<'_, A> {
    pub fn number(&mut self, number: &BigRational) -> Multilinear<A::Value> {
        let value = self.arithmetic.rational(number);
        Multilinear::constant(value, self.arithmetic)
    }

    pub fn numbers(&mut self, vector: &ExactVector) -> Vector<A::Value> {
        vector.each_ref().map(|entry| self.number(entry))
    }

    pub fn values(&mut self, vector: &[A::Value; 3]) -> Vector<A::Value> {
        vector.each_ref().map(|entry| Multilinear::constant(entry.clone(), self.arithmetic))
    }

    pub fn times_value(&mut self, entry: &Multilinear<A::Value>, value: &A::Value) -> Multilinear<A::Value> {
        entry.mul(&Multilinear::constant(value.clone(), self.arithmetic), self.arithmetic)
    }

    pub fn plus(&mut self, a: &Vector<A::Value>, b: &Vector<A::Value>) -> Vector<A::Value> {
        std::array::from_fn(|k| a[k].add(&b[k], self.arithmetic))
    }

    pub fn minus(&mut self, a: &Vector<A::Value>, b: &Vector<A::Value>) -> Vector<A::Value> {
        std::array::from_fn(|k| a[k].sub(&b[k], self.arithmetic))
    }

    pub fn dot(&mut self, a: &Vector<A::Value>, b: &Vector<A::Value>) -> Multilinear<A::Value> {
        let products = std::array::from_fn(|k| a[k].mul(&b[k], self.arithmetic));
        self.sum(products)
    }

    pub fn cross(&mut self, a: &Vector<A::Value>, b: &Vector<A::Value>) -> Vector<A::Value> {
        std::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let (first, second) = (a[i].mul(&b[j], self.arithmetic), a[j].mul(&b[i], self.arithmetic));
            first.sub(&second, self.arithmetic)
        })
    }

    pub fn dot_number(&mut self, a: &ExactVector, b: &Vector<A::Value>) -> Multilinear<A::Value> {
        let products = std::array::from_fn(|k| b[k].scale(&a[k], self.arithmetic));
        self.sum(products)
    }

    pub fn dot_values(&mut self, a: &[A::Value; 3], b: &Vector<A::Value>) -> Multilinear<A::Value> {
        let products = std::array::from_fn(|k| self.times_value(&b[k], &a[k]));
        self.sum(products)
    }

    pub fn sum(&mut self, [x, y, z]: Vector<A::Value>) -> Multilinear<A::Value> {
        x.add(&y, self.arithmetic).add(&z, self.arithmetic)
    }
}
