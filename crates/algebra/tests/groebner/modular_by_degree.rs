//! Bases over Q modulo primes with a change of order, compared with Singular's results and the engine over Q, with
//! planted unlucky primes.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use groebot_algebra::groebner::modular::{self, Modular, Status, prove};
use groebot_algebra::groebner::{Options, basis};
use groebot_algebra::number::{BigInt, BigRational, Rationals, primes_below};
use groebot_algebra::poly::{Order, Polynomial, PolynomialRing};
use groebot_algebra::{ErrorKind, Watch};
use proptest::prelude::*;

use crate::corpus::read_all;
use crate::corpus::systems::{all, basis_hash};
use crate::poly::sparse::orders;

type Element = Polynomial<BigRational>;

fn modular(ring: &PolynomialRing<Rationals>, generators: &[Element]) -> Modular {
    modular::basis(ring, generators, &Options::default(), &Watch::none()).unwrap()
}

fn ring_of(names: &[&str], order: Order) -> PolynomialRing<Rationals> {
    PolynomialRing::new(Rationals, names, order).unwrap()
}

/// Systems of larger degree take seconds.
const DEGREE: usize = 100;

#[test]
fn the_lexicographic_facts_of_singular_are_found_over_q() {
    let mut checked = 0;
    for system in all() {
        let Some(answer) = system.answer("Q", &Order::Lex) else { continue };
        if answer.facts.dimension > 0 || answer.facts.degree > DEGREE {
            continue;
        }
        let ring = system.ring(Rationals, &Order::Lex);
        let found = modular(&ring, &system.generators(&ring)).basis;
        let degree = found.quotient_dimension();
        let expected = (answer.facts.size, answer.facts.hash, Some(answer.facts.degree));
        assert_eq!(
            (found.polynomials.len(), basis_hash(&found.ring, &found.polynomials), degree),
            expected,
            "{}",
            system.name
        );
        checked += 1;
    }
    assert!(checked >= 25, "{checked}");
}

/// Whether the engine over Q finished in time for a comparison.
fn agrees(ring: &PolynomialRing<Rationals>, texts: &[String]) -> bool {
    let generators = read_all(ring, texts);
    let watch = Watch::none().with_time(Duration::from_secs(1));
    let Ok(expected) = basis(ring, &generators, &Options::default(), &watch) else { return false };
    assert!(expected.require_zero_dimensional().is_ok());
    let found = modular(ring, &generators);
    assert_eq!(found.basis, expected);
    assert_eq!(prove(&found, ring, &generators, &Watch::none()).unwrap(), Status::Proved);
    true
}

proptest! {
    #![proptest_config(crate::cases(40))]

    #[test]
    fn multiple_points_have_the_basis_of_the_engine(n in prop::collection::vec(-3i64..4, 8), powers in prop::collection::vec(1u32..3, 4), names in 0usize..6, order in 0usize..4) {
        let names = [["x", "y", "z"], ["x", "z", "y"], ["y", "x", "z"], ["y", "z", "x"], ["z", "x", "y"], ["z", "y", "x"]][names];
        let texts = [
            format!("(x + ({})*y - {}/3)^{}*(x - ({}))", n[0], n[1], powers[0], n[2]),
            format!("(y - ({})*z*x + {}/2)^{}*(y + ({}))", n[3], n[4], powers[1], n[5]),
            format!("(z - ({}))^{}*(z + ({}))^{}", n[6], powers[2], n[7], powers[3]),
            format!("(x - ({}))*(y + ({}))^2*(z - ({}))", n[2], n[5], n[6]),
        ];
        let ring = ring_of(&names, orders()[order].clone());
        prop_assume!(modular(&ring, &read_all(&ring, &texts)).basis.require_zero_dimensional().is_ok());
        prop_assume!(agrees(&ring, &texts));
    }
}

/// Modulo P the last coordinate separates fewer points than over Q, while the graded leading monomials are unchanged:
/// `x` is a polynomial in `y` over Q only. No coefficient is divisible by P.
#[test]
fn primes_that_lose_the_shape_position_do_no_harm() {
    let systems: [&[&str]; 3] = [
        &["x - z", "z^2 - y - 2", "y^2 - (1 + P)*x + z - 3"],
        &["x - z", "z^3 - y*z - 1", "y^2 - (1 + 2*P)*x + z + 5*y"],
        &["x - z + 1", "(z - y)^2 - 3*y", "y^3 + (P - 1)*z + x"],
    ];
    for (count, texts) in [1, 3, 4, 5, 9, 30].into_iter().flat_map(|count| systems.map(|texts| (count, texts))) {
        let product: BigInt = primes_below(1 << 31).take(count).map(BigInt::from).product();
        let texts: Vec<String> = texts.iter().map(|text| text.replace('P', &product.to_string())).collect();
        for order in [Order::Lex, Order::elimination(2, 3)] {
            let ring = ring_of(&["x", "z", "y"], order.clone());
            assert!(agrees(&ring, &texts), "{count} primes, {texts:?}");
            let found = modular(&ring, &read_all(&ring, &texts));
            assert!(order != Order::Lex || found.unlucky >= count, "{} of {count}: {texts:?}", found.unlucky);
        }
    }
}

/// Graded leading monomials that differ modulo P while the lexicographic ones do not, and the reverse.
#[test]
fn primes_that_change_the_graded_shape_do_no_harm() {
    let systems: [&[&str]; 3] = [
        &["(1 + P)*x^2 - (1 - P)*y*x + x*y - x^2 + y", "y^3 - x - 2"],
        &["x - y^2 + 1", "y^3 - y + (1 + P)*x - x + 7"],
        &["x^2 - x", "y^2 - (2 + P)*y + 1 + P", "x*y - (1 + P)*x", "x*y - x - y + 1"],
    ];
    for (count, texts) in [1, 3, 5, 9, 30].into_iter().flat_map(|count| systems.map(|texts| (count, texts))) {
        let product: BigInt = primes_below(1 << 31).take(count).map(BigInt::from).product();
        let texts: Vec<String> = texts.iter().map(|text| text.replace('P', &product.to_string())).collect();
        for order in [Order::Lex, Order::elimination(1, 2)] {
            assert!(agrees(&ring_of(&["x", "y"], order), &texts), "{count} primes, {texts:?}");
        }
    }
}

/// The degree of the last polynomial exceeds the narrow lanes of the ring.
#[test]
fn lanes_are_widened() {
    use groebot_algebra::poly::Width;
    let ring = ring_of(&["x", "y"], Order::Lex).with_width(Width::Bits8);
    let generators = read_all(&ring, &["x^13 - y - 1".to_owned(), "y^13 - x + 2".to_owned()]);
    let found = modular(&ring, &generators).basis;
    assert_eq!((found.polynomials.len(), found.quotient_dimension()), (2, Some(169)));
    assert_eq!(found.ring.layout().width(), Width::Bits16);
}

#[test]
fn a_watch_stops_it() {
    let ring = ring_of(&["x", "y", "z"], Order::Lex);
    let texts = ["x^3 + y*z - 1", "y^3 - x*z + 2", "z^3 - 5*x*y"].map(str::to_owned);
    let generators = read_all(&ring, &texts);
    let found = modular(&ring, &generators);
    let stopped = Watch::none().with_cancel(Arc::new(AtomicBool::new(true)));
    let error = modular::basis(&ring, &generators, &Options::default(), &stopped).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Cancelled);
    assert_eq!(prove(&found, &ring, &generators, &stopped).unwrap_err().kind(), ErrorKind::Cancelled);
}
