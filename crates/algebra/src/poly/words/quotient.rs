//! Exact division of integer polynomials: computed modulo primes, proved by a bound on the coefficients.

use super::field::Prime;
use super::flat::Packing;
use super::images::{Images, primes};
use super::integral::Integral;

impl Integral {
    /// `self / divisor`, if it is a polynomial over the integers and `divisor` is primitive.
    ///
    /// The quotient is computed modulo primes. It is proved when the moduli exceed every coefficient of both sides of
    /// `self = quotient * divisor`, since a congruence of numbers below the modulus is an equality.
    pub fn quotient(&self, packing: &Packing, divisor: &Integral) -> Option<Integral> {
        let mut images = Images::default();
        let terms = (divisor.keys.len() as u64).ilog2() as u64 + 1;
        for p in primes() {
            let field = Prime::new(p);
            let small = divisor.image(&field);
            if small.keys.first() != divisor.keys.first() {
                continue;
            }
            images.add(&field, self.image(&field).exact_div(&field, packing, &small)?);
            let quotient = images.symmetric();
            let needed = self.bits().max(quotient.bits() + divisor.bits() + terms);
            if needed + 2 <= images.bits() {
                return Some(quotient);
            }
        }
        None
    }
}
