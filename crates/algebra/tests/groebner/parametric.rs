//! Bases over rational functions: agreement of the methods, and specialisation to the bases at single points.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use groebot_algebra::groebner::parametric::{Method, Options, Parametric, basis};
use groebot_algebra::groebner::{self, Basis};
use groebot_algebra::number::{BigRational, Rationals, Ring, Zp};
use groebot_algebra::poly::{Fractions, Order, PolynomialRing};
use groebot_algebra::{ErrorKind, Watch};
use proptest::prelude::*;

use super::blocks::{self, Field, Mechanism, Poly};
use crate::corpus::groebner::{all, read_basis};
use crate::corpus::read;
use crate::poly::sparse::{Sparse, build, orders, quotient, sparse};

fn by(ring: &PolynomialRing<Field>, generators: &[Poly], method: Method) -> groebot_algebra::Result<Parametric> {
    basis(ring, generators, &Options { method: Some(method) }, &Watch::none().with_time(Duration::from_secs(20)))
}

fn agree(ring: &PolynomialRing<Field>, generators: &[Poly], methods: &[Method]) -> Basis<Field> {
    let found = |method: &Method| by(ring, generators, *method).unwrap_or_else(|error| panic!("{method:?}: {error}"));
    let bases: Vec<_> = methods.iter().map(found).collect();
    for other in &bases[1..] {
        assert!(
            other.basis.polynomials == bases[0].basis.polynomials,
            "{:?} and {:?} differ",
            bases[0].method,
            other.method
        );
        assert_eq!(other.exact, matches!(other.method, Method::Direct | Method::Variables));
    }
    bases.into_iter().next().expect("one method at least").basis
}

/// The image of the basis at a point modulo `p` equals the basis computed there.
fn assert_specialises(found: &Basis<Field>, generators: &[Poly], p: u64, seed: u64) {
    let count = found.ring.field().ring().variables().len() as u64;
    let point: Vec<u64> = (1..=count).map(|k| (seed * 7919 + k * k * 104_729 + k) % p).collect();
    assert_specialises_at(found, generators, p, &point);
}

fn assert_specialises_at(found: &Basis<Field>, generators: &[Poly], p: u64, point: &[u64]) {
    let zp = Zp::new(p).unwrap();
    let ring = &found.ring;
    let target = PolynomialRing::new(zp, ring.variables(), ring.layout().order().clone()).unwrap();
    let ground = ring.field().ring();
    let number = |q: &BigRational| {
        groebot_algebra::number::Field::from_rational(&zp, q).expect("no denominator is a multiple of p")
    };
    let image = |f: &Poly| {
        let value = |f: &_| ground.substitute(f, &zp, point, number);
        let coefficient = |c: &groebot_algebra::poly::Fraction<BigRational>| {
            Ok(zp.checked_div(&value(c.numerator()), &value(c.denominator())).expect("a lucky point"))
        };
        ring.map_into(f, &target, coefficient).unwrap()
    };
    let expected: Vec<_> = generators.iter().map(image).collect();
    let expected = groebner::basis(&target, &expected, &groebner::Options::default(), &Watch::none()).unwrap();
    let images: Vec<_> = found.polynomials.iter().map(image).collect();
    assert!(images == expected.polynomials, "another basis at {point:?} modulo {p}");
}

#[test]
fn the_methods_agree_on_small_blocks() {
    use Method::{Direct, Interpolation, Modular, Variables};
    let check = |block: Mechanism, methods: &[Method]| {
        let found = agree(&block.ring, &block.generators, methods);
        assert_eq!(found.quotient_dimension(), Some(block.solutions));
    };
    check(blocks::nao_leg(), &[Direct, Variables, Modular, Interpolation]);
    check(blocks::nao_arm(), &[Direct, Variables, Modular, Interpolation]);
    check(blocks::puma_position(), &[Variables, Modular, Interpolation]);
    check(blocks::puma_symbolic(), &[Modular, Interpolation]);
    check(blocks::planar_3r(), &[Variables, Modular]);
}

#[test]
fn interpolated_blocks_specialise() {
    for block in [blocks::puma_position(), blocks::puma_symbolic(), blocks::generic_3r_position()] {
        let found = by(&block.ring, &block.generators, Method::Interpolation).unwrap().basis;
        assert_eq!(found.quotient_dimension(), Some(block.solutions));
        for (p, seed) in [(2_147_483_647, 5), (1_000_003, 6), (2_305_843_009_213_693_951, 7)] {
            assert_specialises(&found, &block.generators, p, seed);
        }
    }
}

#[test]
#[ignore = "four seconds"]
fn the_generic_arm_with_eight_parameters_specialises() {
    let block = blocks::generic_3r_symbolic();
    let watch = Watch::none().with_time(Duration::from_secs(60));
    let found = basis(&block.ring, &block.generators, &Options::default(), &watch).unwrap().basis;
    assert_eq!(found.quotient_dimension(), Some(block.solutions));
    for seed in 1..4 {
        assert_specialises(&found, &block.generators, 2_305_843_009_213_693_951, seed);
    }
}

#[test]
fn known_parametric_bases_are_found() {
    let cases =
        all().into_iter().filter(|case| case.field.starts_with("Q(")).filter(|case| !case.parameters.is_empty());
    let mut count = 0;
    for case in cases {
        let ring = case.ring(&Fractions::new(Rationals, &case.parameters).unwrap());
        for method in [Method::Interpolation, Method::Modular] {
            let found = by(&ring, &case.generators(&ring), method).unwrap();
            assert!(found.basis.polynomials == read_basis(&ring, &case.basis), "{}: another basis", case.file);
        }
        count += 1;
    }
    assert!(count >= 8, "{count} cases");
}

/// The engine's first primes as numerators, denominators and sums of coefficients.
#[test]
fn coefficients_may_be_the_primes_that_are_tried_first() {
    let field = Fractions::new(Rationals, &["a"]).unwrap();
    let ring = PolynomialRing::new(field, &["x", "y"], Order::Lex).unwrap();
    let methods = [Method::Direct, Method::Variables, Method::Modular, Method::Interpolation];
    let primes = [2_147_483_647u64, 2_147_483_629, 2_147_483_587, 2_147_483_579, 2_147_483_563, 2_013_265_921];
    let find = |texts: &[String]| {
        let generators: Vec<Poly> = texts.iter().map(|text| read(&ring, text)).collect();
        agree(&ring, &generators, &methods).polynomials
    };
    let found = find(&["1/2147483647*x^2 - 1/2147483629".to_owned(), "a*y - 2147483647*x".to_owned()]);
    let (first, second) = ("y^2 - 2147483647^3/2147483629/a^2", "x - a*y/2147483647");
    assert_eq!(found, [read(&ring, first), read(&ring, second)]);
    for p in primes {
        let found = find(&[format!("{p}*a*x - y"), format!("y^2/{p} - a")]);
        assert_eq!(found, [read(&ring, &format!("y^2 - {p}*a")), read(&ring, &format!("x - 1/{p}/a*y"))]);
        assert_eq!(find(&["a*x + y".to_owned(), format!("a*x + {}*y", p + 1)]), [read(&ring, "y"), read(&ring, "x")]);
    }
    let all = primes.iter().map(u64::to_string).collect::<Vec<_>>().join("*");
    assert_eq!(find(&[format!("{all}*x - a")]), [read(&ring, &format!("x - a/({all})"))]);
}

#[test]
fn orientation_given_by_related_parameters() {
    let block = blocks::planar_3r();
    let found = by(&block.ring, &block.generators, Method::Variables).unwrap().basis;
    assert_eq!(found.quotient_dimension(), Some(block.solutions));
    // The wrist (x - c, y - s) determines the second angle: 2*3*2*c2 = |wrist|^2 - 3^2 - 2^2.
    let cosine = read(&block.ring, "12*c2 - (x - c)^2 - (y - s)^2 + 13");
    assert!(found.contains(&cosine).unwrap());
    let (p, fifth) = (1_000_003, 600_002);
    assert_eq!(5 * fifth % p, 1, "(3/5, 4/5) is a direction");
    for (x, y) in [(17, 29), (401, 7), (123_456, 654_321)] {
        assert_specialises_at(&found, &block.generators, p, &[x, y, 3 * fifth % p, 4 * fifth % p]);
    }
    let refused = by(&block.ring, &block.generators, Method::Interpolation).unwrap_err();
    assert_eq!(refused.kind(), ErrorKind::Unsupported);
}

/// The field of a unit vector (a, b, r) and a constant h with 2 h^2 = 1.
fn unit_vector() -> Field {
    let field = Fractions::new(Rationals, &["a", "b", "r", "h"]).unwrap();
    let ring = field.ring().clone();
    let square = |text: &str| read(&ring, text);
    field.with_square(2, &square("1 - a^2 - b^2")).unwrap().with_square(3, &square("1/2")).unwrap()
}

#[test]
fn relations_between_parameters_hold_in_the_basis() {
    let ring = PolynomialRing::new(unit_vector(), &["x", "y", "z"], Order::GrevLex).unwrap();
    let texts = ["a*x + b*y + r*z - 1", "h*x - h*y - 1", "r*x - a*z + h"];
    let generators: Vec<Poly> = texts.iter().map(|text| read(&ring, text)).collect();
    let found = agree(&ring, &generators, &[Method::Direct, Method::Variables, Method::Modular]);
    assert_eq!(found.quotient_dimension(), Some(1));
    let unit = [read(&ring, "a^2*x + b^2*x + r^2*x - 1")];
    let found = agree(&ring, &unit, &[Method::Direct, Method::Variables, Method::Modular]);
    assert_eq!(found.polynomials, [read(&ring, "x - 1")], "r.r = 1");
    let chosen = basis(&ring, &unit, &Options::default(), &Watch::none()).unwrap();
    assert!(chosen.method == Method::Modular && chosen.basis.polynomials == found.polynomials);
    let both = ["x*r - x", "x - 1"].map(|text| read(&ring, text));
    let found = agree(&ring, &both, &[Method::Direct, Method::Variables, Method::Modular]);
    assert_eq!(found.polynomials, [ring.one()], "a polynomial of the parameters that no relation makes zero");
}

#[test]
fn degenerate_input_is_answered() {
    let field = Fractions::new(Rationals, &["p"]).unwrap();
    let ring = PolynomialRing::new(field, &["x", "y"], Order::Lex).unwrap();
    let find = |texts: &[&str]| {
        let generators: Vec<Poly> = texts.iter().map(|text| read(&ring, text)).collect();
        agree(&ring, &generators, &[Method::Direct, Method::Variables, Method::Modular, Method::Interpolation])
            .polynomials
    };
    assert!(find(&[]).is_empty());
    assert!(find(&["0"]).is_empty());
    assert_eq!(find(&["p*x - 1", "x"]), [ring.one()]);
    assert_eq!(find(&["x - 1", "p*x - p^2"]), [ring.one()]);
    assert_eq!(find(&["x^2/p - 1/(p + 1)", "x^2/p - 1/(p + 1)"]), [read(&ring, "x^2 - p/(p + 1)")]);
    let constants = PolynomialRing::new(Fractions::new(Rationals, &[""; 0]).unwrap(), &["x"], Order::Lex).unwrap();
    let f = [read(&constants, "2*x - 1")];
    assert_eq!(by(&constants, &f, Method::Interpolation).unwrap_err().kind(), ErrorKind::Unsupported);
    assert_eq!(basis(&constants, &f, &Options::default(), &Watch::none()).unwrap().basis.polynomials.len(), 1);
}

#[test]
fn work_ends_when_the_watch_stops_it() {
    let block = blocks::generic_3r_symbolic();
    let start = std::time::Instant::now();
    let watch = Watch::none().with_time(Duration::from_millis(300));
    let error = basis(&block.ring, &block.generators, &Options::default(), &watch).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Budget);
    assert!(start.elapsed() < Duration::from_secs(3), "it took {:?}", start.elapsed());
    let cancelled = Watch::none().with_cancel(Arc::new(AtomicBool::new(true)));
    let error = basis(&block.ring, &block.generators, &Options::default(), &cancelled).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Cancelled);
}

/// A linear system `x_i = f_i(p)`: its basis shows how single rational functions are interpolated.
fn assert_interpolates(functions: &[(Sparse, Sparse)]) {
    let field = Fractions::new(Rationals, &["p", "q", "r"]).unwrap();
    let names = ["x", "y", "z"];
    let ring = PolynomialRing::new(field.clone(), &names[..functions.len()], Order::GrevLex).unwrap();
    let line = |(k, (top, bottom)): (usize, &(Sparse, Sparse))| {
        let value = quotient(&field, top, bottom);
        ring.sub(&ring.variable(k), &ring.constant(value))
    };
    let generators: Vec<Poly> = functions.iter().enumerate().map(line).collect();
    let found = by(&ring, &generators, Method::Interpolation).unwrap().basis;
    let expected: Vec<Poly> = generators.into_iter().rev().collect();
    assert!(found.polynomials == expected, "{}", ring.format(&expected[0], groebot_algebra::number::Style::Text));
}

#[test]
fn functions_without_a_corner_on_the_axes_are_interpolated() {
    let term = |c: i64, exponents: [u32; 3]| (c, exponents.to_vec());
    let circles = vec![term(3, [2, 0, 0]), term(5, [0, 2, 0]), term(-7, [0, 0, 2])];
    let mixed = vec![term(1, [1, 1, 0]), term(2, [0, 1, 1]), term(3, [1, 0, 1])];
    assert_interpolates(&[
        (circles.clone(), mixed.clone()),
        (mixed, circles.clone()),
        (vec![term(1, [0, 0, 0])], circles),
    ]);
}

proptest! {
    #![proptest_config(crate::cases(24))]

    #[test]
    fn random_functions_are_interpolated(functions in prop::collection::vec((sparse(3, 5, 4), sparse(3, 4, 3)), 1..4)) {
        assert_interpolates(&functions);
    }

    #[test]
    fn the_methods_agree_on_random_ideals(
        generators in prop::collection::vec(prop::collection::vec((sparse(2, 2, 1), 0u32..3, 0u32..2), 1..4), 1..4),
        order in 0usize..2,
    ) {
        let field = Fractions::new(Rationals, &["p", "q"]).unwrap();
        let ring = PolynomialRing::new(field.clone(), &["x", "y"], orders()[order].clone()).unwrap();
        let one = |terms: &Vec<(Sparse, u32, u32)>| {
            let term = |(c, x, y): &(Sparse, u32, u32)| {
                let monomial = ring.monomial(&[*x, *y]).unwrap();
                ring.term(field.embed(&build(field.ring(), c)), monomial)
            };
            terms.iter().map(term).fold(ring.zero(), |sum, term| ring.add(&sum, &term))
        };
        let generators: Vec<Poly> = generators.iter().map(one).collect();
        let brief = Watch::none().with_time(Duration::from_secs(1));
        let direct = groebner::basis(&ring, &generators, &groebner::Options::default(), &brief);
        prop_assume!(direct.is_ok());
        let found = agree(&ring, &generators, &[Method::Interpolation, Method::Variables, Method::Modular]);
        prop_assert!(found.polynomials == direct.unwrap().polynomials);
        prop_assert!(found.polynomials.iter().all(|f| ring.is_well_formed(f)));
    }
}
