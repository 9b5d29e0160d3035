//! Greatest common divisors, square-free and coprime factors, square roots: known results and the definitions.

use groebot_algebra::number::{BigInt, BigRational, Field, Rationals, Ring, Zp};
use groebot_algebra::poly::{Fractions, Order, Polynomial, PolynomialRing};
use groebot_algebra::poly::{gcd, rational_root, refine_factors, square_free_factors, square_root};
use proptest::prelude::*;

use super::sparse::{Sparse, build, sparse};
use crate::corpus::{Check, over, poly, read};

type Ground = PolynomialRing<Rationals>;
type Poly = Polynomial<BigRational>;

fn ground() -> Ground {
    PolynomialRing::new(Rationals, &["x", "y", "z"], Order::GrevLex).unwrap()
}

struct KnownGcd<'a>(&'a poly::Pair);

impl Check for KnownGcd<'_> {
    fn run<F: Field>(&self, field: F) {
        let pair = self.0;
        for order in [Order::GrevLex, Order::Lex] {
            let ring = PolynomialRing::new(field.clone(), &pair.variables, order).unwrap();
            let [f, g, known] = [&pair.f, &pair.g, &pair.gcd].map(|text| read(&ring, text));
            assert_eq!(gcd(&ring, &f, &g), ring.monic(&known), "{}", pair.name);
            assert_eq!(gcd(&ring, &g, &f), ring.monic(&known), "{} in the opposite order", pair.name);
        }
    }
}

#[test]
fn known_gcds() {
    let pairs = poly::pairs();
    assert!(pairs.len() >= 40);
    for pair in &pairs {
        over(&pair.field, &pair.parameters, &KnownGcd(pair));
    }
}

fn product(ring: &Ground, factors: &[Poly]) -> Poly {
    factors.iter().fold(ring.one(), |product, f| ring.mul(&product, f))
}

pub fn pairwise_coprime<F: Field>(ring: &PolynomialRing<F>, factors: &[Polynomial<F::Element>]) -> bool {
    let coprime = |f, g| ring.is_one(&gcd(ring, f, g));
    factors.iter().enumerate().all(|(k, f)| factors[k + 1..].iter().all(|g| coprime(f, g)))
}

/// Divides `f` by the factors as often as possible. Returns the rest.
fn divide_out<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    factors: &[Polynomial<F::Element>],
) -> Polynomial<F::Element> {
    let mut rest = f.clone();
    for factor in factors {
        while let Some(quotient) = ring.exact_div(&rest, factor) {
            rest = quotient;
        }
    }
    rest
}

#[test]
fn known_factors() {
    let cases = poly::factorisations();
    for case in cases.iter().filter(|case| case.field == "Q") {
        let ring = PolynomialRing::new(Rationals, &case.variables, Order::GrevLex).unwrap();
        let f = read(&ring, &case.polynomial);
        let irreducible: Vec<_> =
            case.factors.iter().map(|factor| ring.monic(&read(&ring, &factor.polynomial))).collect();
        let multiplied = case.factors.iter().fold(read(&ring, &case.unit), |product, factor| {
            let base = read(&ring, &factor.polynomial);
            ring.mul(&product, &ring.pow(&base, factor.multiplicity as u32))
        });
        assert_eq!(multiplied, f, "{}: the corpus", case.name);
        let factors = square_free_factors(&ring, &f);
        assert_eq!(product(&ring, &factors), product(&ring, &irreducible), "{}: the radical", case.name);
        assert!(pairwise_coprime(&ring, &factors), "{}", case.name);
        assert!(factors.iter().all(|f| ring.as_constant(f).is_none()), "{}", case.name);
    }
}

pub fn gcd_laws<F: Field>(ring: &PolynomialRing<F>, parts: &[&Sparse; 3]) {
    let [f, g, h] = parts.map(|part| build(ring, part));
    let (fh, gh) = (ring.mul(&f, &h), ring.mul(&g, &h));
    let common = gcd(ring, &fh, &gh);
    if common.is_zero() {
        return assert!(fh.is_zero() && gh.is_zero());
    }
    assert_eq!(ring.monic(&common), common, "monic");
    let [left, right] = [&fh, &gh].map(|product| ring.exact_div(product, &common).expect("a gcd divides both"));
    assert!(ring.is_one(&gcd(ring, &left, &right)), "the cofactors are coprime");
    assert!(ring.exact_div(&common, &h).is_some(), "every common divisor divides it");
}

proptest! {
    #![proptest_config(crate::cases(64))]

    #[test]
    fn a_gcd_divides_and_leaves_coprime_cofactors(f in sparse(3, 3, 2), g in sparse(3, 3, 2), h in sparse(3, 3, 2)) {
        gcd_laws(&ground(), &[&f, &g, &h]);
        for p in [2, 3, 32003] {
            let ring = PolynomialRing::new(Zp::new(p).unwrap(), &["x", "y", "z"], Order::Lex).unwrap();
            gcd_laws(&ring, &[&f, &g, &h]);
        }
        let field = Fractions::new(Rationals, &["z"]).unwrap();
        let ring = PolynomialRing::new(field, &["x", "y", "w"], Order::GrevLex).unwrap();
        gcd_laws(&ring, &[&f, &g, &h]);
    }

    #[test]
    fn square_free_factors_have_the_zeros_of_the_product(parts in prop::collection::vec((sparse(3, 2, 1), 1u32..4), 1..4)) {
        let ring = ground();
        let powers = parts.iter().map(|(f, n)| ring.pow(&build(&ring, f), *n));
        let f = powers.fold(ring.one(), |product, power| ring.mul(&product, &power));
        let factors = square_free_factors(&ring, &f);
        prop_assert!(pairwise_coprime(&ring, &factors));
        for factor in &factors {
            let repeated = (0..3).fold(factor.clone(), |common, v| gcd(&ring, &common, &ring.derivative(factor, v)));
            prop_assert!(ring.is_one(&repeated), "square-free");
            prop_assert!(ring.exact_div(&f, factor).is_some(), "no new zeros");
        }
        let radical = product(&ring, &factors);
        let mut rest = f;
        while !rest.is_zero() && ring.as_constant(&rest).is_none() {
            let common = gcd(&ring, &rest, &radical);
            prop_assert!(!ring.is_one(&common), "no lost zeros");
            rest = ring.exact_div(&rest, &common).unwrap();
        }
    }

    #[test]
    fn refined_factors_give_all_inputs(parts in prop::collection::vec(sparse(3, 2, 1), 4)) {
        let ring = ground();
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| build(&ring, &parts[k]));
        let times = |f: &Poly, g: &Poly| ring.mul(f, g);
        let inputs = [times(&a, &b), times(&b, &c), times(&times(&a, &a), &d), times(&c, &d)];
        let basis = refine_factors(&ring, &inputs);
        prop_assert!(pairwise_coprime(&ring, &basis));
        prop_assert!(basis.iter().all(|f| ring.as_constant(f).is_none() && ring.monic(f) == *f));
        for f in inputs.iter().filter(|f| !f.is_zero()) {
            prop_assert!(ring.as_constant(&divide_out(&ring, f, &basis)).is_some());
        }
    }

    #[test]
    fn a_square_has_its_root(f in sparse(3, 4, 3), g in sparse(3, 2, 2)) {
        for order in super::sparse::orders() {
            let ring = PolynomialRing::new(Rationals, &["x", "y", "z"], order).unwrap();
            let (f, g) = (build(&ring, &f), build(&ring, &g));
            let square = ring.mul(&f, &f);
            let root = square_root(&ring, &square).expect("a square has a root");
            prop_assert!(root == f || root == ring.neg(&f));
            let other = ring.add(&square, &g);
            if let Some(root) = square_root(&ring, &other) {
                prop_assert_eq!(ring.mul(&root, &root), other);
            }
        }
    }
}

#[test]
fn what_has_no_rational_root_is_refused() {
    let ring = ground();
    for text in ["2", "-1", "x", "x^2 + 1", "x^2 + x*y + y^2", "2*x^2", "x^2*y", "x^4 + 2*x^2 + 2", "-x^2"] {
        assert_eq!(square_root(&ring, &read(&ring, text)), None, "{text}");
    }
    let q = |n: i64, d: i64| BigRational::new(BigInt::from(n), BigInt::from(d));
    assert_eq!(rational_root(&q(9, 4)), Some(q(3, 2)));
    assert_eq!(rational_root(&q(0, 1)), Some(q(0, 1)));
    assert!([q(2, 1), q(1, 2), q(-4, 1), q(4, 3)].iter().all(|q| rational_root(q).is_none()));
}

#[test]
fn nothing_and_constants_have_no_factors() {
    let ring = ground();
    assert!(
        square_free_factors(&ring, &ring.zero()).is_empty() && square_free_factors(&ring, &read(&ring, "7")).is_empty()
    );
    assert!(refine_factors(&ring, &[ring.zero(), ring.one()]).is_empty());
    assert!(gcd(&ring, &ring.zero(), &ring.zero()).is_zero());
    assert_eq!(gcd(&ring, &read(&ring, "2*x"), &ring.zero()), ring.variable(0));
}
