//! Irreducible factors: Singular's results, the definition, and counts of irreducible polynomials.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use groebot_algebra::number::{Field, Rationals, Ring, Zp};
use groebot_algebra::poly::{Factorisation, Fractions, Order, Polynomial, PolynomialRing, Term, factor};
use groebot_algebra::{ErrorKind, Watch};
use proptest::prelude::*;

use super::factors::pairwise_coprime;
use super::sparse::{Sparse, build, sparse};
use crate::corpus::poly::Factor;
use crate::corpus::{Check, over, poly, read};

fn factored<F: Field>(ring: &PolynomialRing<F>, f: &Polynomial<F::Element>) -> Factorisation<F::Element> {
    factor(ring, f, &Watch::none()).expect("a nonzero polynomial over a prime field")
}

struct KnownFactors<'a>(&'a poly::Factored);

impl Check for KnownFactors<'_> {
    fn run<F: Field>(&self, field: F) {
        let case = self.0;
        for order in [Order::GrevLex, Order::Lex] {
            let ring = PolynomialRing::new(field.clone(), &case.variables, order).unwrap();
            let f = read(&ring, &case.polynomial);
            let found = factored(&ring, &f);
            assert_eq!(found.product(&ring), f, "{}", case.name);
            assert_eq!(found.factors.len(), case.factors.len(), "{}: the number of factors", case.name);
            for Factor { polynomial: text, multiplicity } in &case.factors {
                let known = (ring.monic(&read(&ring, text)), *multiplicity as u32);
                assert!(found.factors.contains(&known), "{}: {text}", case.name);
            }
        }
    }
}

#[test]
fn known_irreducible_factors() {
    let cases = poly::factorisations();
    assert!(cases.len() >= 80);
    for case in &cases {
        over(&case.field, &[], &KnownFactors(case));
    }
}

/// Checks that the product of the factors is `f`, that they are pairwise coprime, and that each is its own only factor.
fn laws<F: Field>(field: F, parts: &[(Sparse, u32)]) {
    let ring = PolynomialRing::new(field, &["x", "y", "z"], Order::GrevLex).unwrap();
    let powers = parts.iter().map(|(part, n)| ring.pow(&build(&ring, part), *n));
    let f = powers.fold(ring.one(), |product, power| ring.mul(&product, &power));
    if f.is_zero() {
        return;
    }
    let found = factored(&ring, &f);
    assert_eq!(found.product(&ring), f);
    let factors: Vec<_> = found.factors.iter().map(|(factor, _)| factor.clone()).collect();
    assert!(pairwise_coprime(&ring, &factors));
    for factor in &factors {
        assert_eq!(factored(&ring, factor).factors, [(factor.clone(), 1)]);
    }
    let expected = parts.iter().filter(|(part, _)| ring.as_constant(&build(&ring, part)).is_none());
    let total: u32 = found.factors.iter().map(|(_, n)| n).sum();
    assert!(total >= expected.map(|(_, n)| n).sum(), "each part is a product of some of the factors");
}

proptest! {
    #![proptest_config(crate::cases(24))]

    #[test]
    fn a_product_has_irreducible_factors(parts in prop::collection::vec((sparse(3, 4, 2), 1u32..3), 1..4)) {
        laws(Rationals, &parts);
        for p in [2, 7, 32003, 2147483647] {
            laws(Zp::new(p).unwrap(), &parts);
        }
    }
}

/// All monic polynomials of one degree over GF(p). The number of irreducible ones is given by Gauss's formula.
#[test]
fn as_many_are_irreducible_as_gauss_counted() {
    // (1/n) sum of mu(d) p^(n/d) over the divisors d of n.
    for (p, n, count) in [(2u64, 5u32, 6), (2, 8, 30), (3, 4, 18), (5, 3, 40), (7, 2, 21)] {
        let ring = PolynomialRing::new(Zp::new(p).unwrap(), &["x"], Order::Lex).unwrap();
        let digit = |number: u64, k: u32| if k == n { 1 } else { number / p.pow(k) % p };
        let polynomial = |number: u64| {
            let term = |k| Term { coefficient: digit(number, k), monomial: ring.layout().pack(&[k]).unwrap() };
            ring.collect((0..=n).map(term))
        };
        let irreducible = |f: &Polynomial<u64>| factored(&ring, f).factors == [(f.clone(), 1)];
        assert_eq!((0..p.pow(n)).filter(|&number| irreducible(&polynomial(number))).count(), count, "{p}^{n}");
    }
}

/// A polynomial of GF(2)[x, y] as bits: `x^i y^j` is bit `5 i + j`. The product without carries.
fn times(a: u64, b: u64) -> u64 {
    (0..15).filter(|k| b >> k & 1 == 1).fold(0, |product, k| product ^ (a << k))
}

/// Among the polynomials of degrees at most 2 in `x` and in `y` over GF(2), exactly the products are reducible.
#[test]
fn all_small_polynomials_in_two_variables_over_gf2() {
    let ring = PolynomialRing::new(Zp::new(2).unwrap(), &["x", "y"], Order::GrevLex).unwrap();
    let bit = |k: u32| 5 * (k / 3) + k % 3;
    let small: Vec<u64> = (2..512u64).map(|n| (0..9).map(|k| (n >> k & 1) << bit(k)).sum()).collect();
    let products: std::collections::HashSet<u64> =
        small.iter().flat_map(|&a| small.iter().map(move |&b| times(a, b))).collect();
    for &bits in &small {
        let places = (0..15u32).filter(|k| bits >> k & 1 == 1);
        let term = |k| Term { coefficient: 1, monomial: ring.layout().pack(&[k / 5, k % 5]).unwrap() };
        let f = ring.collect(places.map(term));
        let count: u32 = factored(&ring, &f).factors.iter().map(|(_, n)| n).sum();
        assert_eq!(count > 1, products.contains(&bits), "{}", ring.format(&f, groebot_algebra::number::Style::Text));
    }
}

#[test]
fn constants_have_a_unit_only_and_the_order_is_fixed() {
    let ring = PolynomialRing::new(Rationals, &["x", "y"], Order::GrevLex).unwrap();
    let seven = read(&ring, "7/3");
    let found = factored(&ring, &seven);
    assert!(found.factors.is_empty() && found.product(&ring) == seven);
    let found = factored(&ring, &read(&ring, "-2*(y + 1)^2*x*(x^2 + y)*(x - 1)"));
    let texts: Vec<String> =
        found.factors.iter().map(|(f, _)| ring.format(f, groebot_algebra::number::Style::Text)).collect();
    assert_eq!(texts, ["x", "x - 1", "x^2 + y", "y + 1"], "by multiplicity, degree, terms, text");
}

#[test]
fn what_cannot_be_factored_is_refused() {
    let ring = PolynomialRing::new(Rationals, &["x", "y"], Order::GrevLex).unwrap();
    let kind = |result: groebot_algebra::Result<Factorisation<_>>| result.unwrap_err().kind();
    assert_eq!(kind(factor(&ring, &ring.zero(), &Watch::none())), ErrorKind::BadValue);
    let stop = Watch::none().with_cancel(Arc::new(AtomicBool::new(true)));
    assert_eq!(kind(factor(&ring, &read(&ring, "x^2 - y^2"), &stop)), ErrorKind::Cancelled);
    let field = Fractions::new(Rationals, &["a"]).unwrap();
    let ring = PolynomialRing::new(field, &["x"], Order::Lex).unwrap();
    let refused = factor(&ring, &read(&ring, "x^2 - a^2"), &Watch::none());
    assert_eq!(refused.unwrap_err().kind(), ErrorKind::Unsupported);
}

/// Irreducible polynomials that split whenever one certain variable is replaced by a number: all elements of these
/// fields are cubes, in GF(2) and its extensions of odd degree, in GF(5), and in GF(32003). Singular 4.4: `factorize`
/// finds one factor each.
#[test]
fn irreducible_although_every_image_splits() {
    for (p, text) in [
        (2, "x^6*y^2 + z^3"),
        (5, "x^3*y + z^3"),
        (32003, "x^6*y + z^3"),
        (5, "3*x^12*y^3*z^3 + 3*x^11*z^6 + 2*x^8 + x*y + 2"),
        (32003, "3*x^13*y^3 + 2*z^18 + 3*x^5*y"),
    ] {
        let ring = PolynomialRing::new(Zp::new(p).unwrap(), &["x", "y", "z"], Order::GrevLex).unwrap();
        let f = ring.monic(&read(&ring, text));
        assert_eq!(factored(&ring, &f).factors, [(f, 1)], "{text} modulo {p}");
    }
}

/// The degrees are above those of the extensions of GF(5) with tables. Singular 4.4: `factorize` finds these factors.
#[test]
fn degrees_above_those_of_the_extensions() {
    let ring = PolynomialRing::new(Zp::new(5).unwrap(), &["x", "y", "z"], Order::GrevLex).unwrap();
    let known = ["x", "3*z + 4", "3*x^12*y^3*z^3 + 3*x^11*z^6 + 2*x^8 + x*y + 2", "z", "2*y*z^14 + 3*y^7 + z^5 + 4*y"];
    let known = known.map(|text| ring.monic(&read(&ring, text)));
    let found = factored(&ring, &known.iter().fold(ring.one(), |product, f| ring.mul(&product, f)));
    assert_eq!(found.factors.len(), known.len());
    assert!(known.iter().all(|f| found.factors.contains(&(f.clone(), 1))));
}
