//! Restriction of polynomials in the parameters to a random line modulo a prime, which bounds their common factors.

use super::lift::defined_image;
use super::prime::Prime;
use super::{Poly, Ring};
use crate::number::{BigRational, Ring as _};
use crate::poly::{Monomial, Polynomial, Term};
use crate::random::SplitMix64;

type Ground = Polynomial<BigRational>;

/// The parameters on a line `offset + t direction` modulo a prime, for coprimality tests.
pub(super) struct Line {
    field: Prime,
    points: Vec<[u64; 2]>,
}

impl Line {
    pub fn new(ring: &Ring) -> Self {
        let field = Prime::new(2_147_483_647);
        let mut stream = SplitMix64::new(11);
        let parameters = ring.field().ring().variables();
        Line { field, points: parameters.iter().map(|_| [stream.unit(field.p), stream.unit(field.p)]).collect() }
    }

    /// Divides the element by its first coefficient.
    pub fn divide_by_first(&self, ring: &Ring, mut parts: Vec<(Monomial, Ground)>) -> Poly {
        let (field, ground) = (ring.field(), ring.field().ring());
        let lead = parts[0].1.leading().expect("a leading coefficient is not zero").coefficient.clone();
        if !ground.field().is_one(&lead) {
            let inverse = lead.recip();
            parts.iter_mut().for_each(|(_, c)| *c = ground.scale(c, &inverse));
        }
        let mut rest = parts.into_iter();
        let (monomial, divisor) = rest.next().expect("an element is not zero");
        let restricted = self.restrict(ring, &divisor);
        let degree = ground.degree(&divisor) as usize;
        let restricted = restricted.filter(|f| f.len() == degree + 1);
        let mut terms = vec![Term { coefficient: field.one(), monomial }];
        for (monomial, c) in rest {
            let is_coprime = ground.degree(&c) == 0
                || restricted.as_ref().is_some_and(|f| self.are_coprime(f, || self.restrict(ring, &c)));
            let coefficient = if is_coprime {
                field.coprime_fraction(c, divisor.clone())
            } else {
                field.fraction(&c, &divisor).expect("a leading coefficient is not zero")
            };
            terms.push(Term { coefficient, monomial });
        }
        ring.descending(terms)
    }

    /// A bound on the degree of a common divisor of all parts; `None` when the line gives no information. A divisor
    /// keeps its degree on the line if the first part does, and it divides all parts there.
    pub fn content_bound(&self, ring: &Ring, parts: &[(Monomial, Ground)]) -> Option<usize> {
        let degree = ring.field().ring().degree(&parts[0].1) as usize;
        let mut gcd = self.restrict(ring, &parts[0].1).filter(|f| f.len() == degree + 1)?;
        for (_, c) in &parts[1..] {
            if gcd.len() == 1 {
                break;
            }
            gcd = shared(self.field, gcd, self.restrict(ring, c)?);
        }
        Some(gcd.len() - 1)
    }

    /// Whether no factor divides both. A common factor would appear on the line if `a` keeps its degree there.
    fn are_coprime(&self, a: &[u64], b: impl FnOnce() -> Option<Vec<u64>>) -> bool {
        a.len() == 1 || b().is_some_and(|b| shared(self.field, a.to_vec(), b).len() == 1)
    }

    /// Restricts `f` to the line, as a polynomial in `t`; `None` when the prime divides a denominator.
    fn restrict(&self, ring: &Ring, f: &Ground) -> Option<Vec<u64>> {
        let ground = ring.field().ring();
        let length = ground.degree(f) as usize + 1;
        let (mut sum, mut product) = (vec![0; length], Vec::with_capacity(length));
        for term in f.terms() {
            product.clear();
            product.push(defined_image(self.field, &term.coefficient)?);
            for (variable, &factor) in self.points.iter().enumerate() {
                for _ in 0..ground.layout().exponent(&term.monomial, variable) {
                    self.multiply(&mut product, factor);
                }
            }
            sum.iter_mut().zip(&product).for_each(|(sum, &c)| *sum = self.field.add(*sum, c));
        }
        trim(&mut sum);
        Some(sum)
    }

    /// Multiplies `f` by `offset + t direction`.
    fn multiply(&self, f: &mut Vec<u64>, [offset, direction]: [u64; 2]) {
        f.push(0);
        for k in (0..f.len()).rev() {
            let lower = if k > 0 { f[k - 1] * direction } else { 0 };
            f[k] = self.field.reduce(f[k] * offset + lower);
        }
    }
}

/// A greatest common divisor of a nonzero `a` and `b`, by the Euclidean algorithm with multiplications instead of
/// inverses.
fn shared(field: Prime, mut a: Vec<u64>, mut b: Vec<u64>) -> Vec<u64> {
    while !b.is_empty() {
        if b.len() == 1 {
            return b;
        }
        while a.len() >= b.len() {
            let (shift, lead) = (a.len() - b.len(), b[b.len() - 1]);
            let top = field.neg(a.pop().expect("both have equal length"));
            for (k, c) in a.iter_mut().enumerate() {
                let other = if k >= shift { top * b[k - shift] } else { 0 };
                *c = field.reduce(*c * lead + other);
            }
            trim(&mut a);
        }
        (a, b) = (b, a);
    }
    a
}

fn trim(f: &mut Vec<u64>) {
    while f.last() == Some(&0) {
        f.pop();
    }
}
