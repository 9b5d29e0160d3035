//! Bases over Q modulo many primes, compared with known results and the engine over Q, with planted unlucky primes, and
//! their proofs.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use groebot_algebra::groebner::modular::{self, Modular, Status, prove};
use groebot_algebra::groebner::verify::{Claim, verify};
use groebot_algebra::groebner::{Options, basis};
use groebot_algebra::number::{BigInt, BigRational, Rationals, Ring, primes_below};
use groebot_algebra::poly::{Order, Polynomial, PolynomialRing};
use groebot_algebra::{ErrorKind, Watch};
use proptest::prelude::*;

use crate::corpus::groebner::{all, read_basis};
use crate::corpus::read_all;
use crate::poly::sparse::{Sparse, build, orders, sparse};

type Element = Polynomial<BigRational>;

fn modular(ring: &PolynomialRing<Rationals>, generators: &[Element]) -> Modular {
    modular::basis(ring, generators, &Options::default(), &Watch::none()).unwrap()
}

fn direct(ring: &PolynomialRing<Rationals>, generators: &[Element]) -> Vec<Element> {
    basis(ring, generators, &Options::default(), &Watch::none()).unwrap().polynomials
}

fn proved(found: &Modular, ring: &PolynomialRing<Rationals>, generators: &[Element]) -> bool {
    match prove(found, ring, generators, &Watch::none()) {
        Ok(status) => status == Status::Proved,
        Err(error) => {
            assert_eq!(error.kind(), ErrorKind::Certificate, "{error}");
            false
        }
    }
}

fn ring_of(names: &[&str], order: Order) -> PolynomialRing<Rationals> {
    PolynomialRing::new(Rationals, names, order).unwrap()
}

/// The generators in `texts`, with `P`, `Q` and `B` replaced by these numbers.
fn system(ring: &PolynomialRing<Rationals>, texts: &[&str], numbers: &[(&str, BigInt)]) -> Vec<Element> {
    let put =
        |text: &&str| numbers.iter().fold((*text).to_owned(), |text, (name, n)| text.replace(name, &n.to_string()));
    read_all(ring, &texts.iter().map(put).collect::<Vec<_>>())
}

/// The product of the first `count` primes below 2^31.
fn first_primes(count: usize) -> BigInt {
    primes_below(1 << 31).take(count).map(BigInt::from).product()
}

#[test]
fn the_known_bases_over_q_are_found_and_proved() {
    let cases: Vec<_> = all().into_iter().filter(|case| case.field == "Q").collect();
    assert!(cases.len() >= 45, "{}", cases.len());
    for case in &cases {
        let ring = case.ring(&Rationals);
        let generators = case.generators(&ring);
        let found = modular(&ring, &generators);
        assert_eq!(found.basis.ring, ring, "{}", case.file);
        assert!(found.basis.polynomials == read_basis(&ring, &case.basis), "{}: another basis", case.file);
        assert_eq!(found.status, Status::Probable);
        assert!(proved(&found, &ring, &generators), "{}", case.file);
    }
}

/// Whether the engine over Q finished in time for a comparison.
fn agrees(order: Order, generators: &[Sparse], numbers: &[BigInt]) -> bool {
    let ring = ring_of(&["x", "y", "z"], order);
    let scaled =
        |(f, n): (&Sparse, &BigInt)| ring.add(&ring.scale(&build(&ring, f), &n.clone().into()), &ring.variable(1));
    let plain = generators.iter().map(|f| build(&ring, f));
    let generators: Vec<_> = plain.chain(generators.iter().zip(numbers).map(scaled)).collect();
    let watch = Watch::none().with_time(Duration::from_millis(500));
    let Ok(expected) = basis(&ring, &generators, &Options::default(), &watch) else { return false };
    let found = modular(&ring, &generators);
    assert_eq!(found.basis, expected);
    assert!(proved(&found, &ring, &generators));
    true
}

proptest! {
    #![proptest_config(crate::cases(40))]

    #[test]
    fn random_ideals_have_the_basis_of_the_engine(generators in prop::collection::vec(sparse(3, 3, 2), 1..4), order in 0usize..4) {
        prop_assume!(agrees(orders()[order].clone(), &generators, &[]));
    }

    #[test]
    fn long_coefficients_are_rebuilt(generators in prop::collection::vec(sparse(3, 2, 1), 1..3), order in 0usize..4, digits in prop::collection::vec(any::<u32>(), 1..40)) {
        let long: BigInt = BigInt::from(num_bigint::BigUint::new(digits)) + 1;
        prop_assume!(agrees(orders()[order].clone(), &generators, &[long.clone(), long + 1]));
    }

    #[test]
    fn cofactors_are_rebuilt_and_prove(generators in prop::collection::vec(sparse(3, 3, 1), 1..4), order in 0usize..4) {
        let ring = ring_of(&["x", "y", "z"], orders()[order].clone());
        let generators: Vec<_> = generators.iter().map(|f| ring.scale(&build(&ring, f), &BigRational::new(6.into(), 35.into()))).collect();
        let options = Options { cofactors: true, ..Options::default() };
        let found = modular::basis(&ring, &generators, &options, &Watch::none()).unwrap();
        prop_assert_eq!(found.status, Status::Proved);
        let claim = Claim { generators: &generators, basis: &found.basis.polynomials, cofactors: &found.basis.cofactors };
        verify(&ring, &claim, &Watch::none()).unwrap();
        prop_assert!(proved(&found, &ring, &generators));
    }
}

/// Coefficients, leading coefficients and denominators divisible by the first primes; systems that differ modulo the
/// first prime, the first two, or the first thirty.
#[test]
fn unlucky_primes_do_no_harm() {
    let systems: [&[&str]; 8] = [
        &["P*x^2 + y - 1", "x*y + P*y - 2"],
        &["P*x^3 + x*y + y^2", "x^2 - y/P + 3", "P*y - P"],
        &["x^2/P + y^2 - 1", "x - P*y"],
        &["x^2 + y^2 - 1", "x^2 + y^2 - 1 - P"],
        &["(1 + P)*x^2 + y^2 - 1", "x^2 + (1 - P)*y^2 - 1"],
        &["x^2*y - 1", "x*y^2 - 1 - P"],
        &["x^2 + x*y + y", "(x + (P + 1)*y)^2 - x*y - (1 + 2*P)*y^2 + y", "x^3 - y"],
        &["x*y - 1 - P", "x^2*y - x - x*P + P^2*y + P"],
    ];
    for (count, texts) in [1, 2, 3, 9, 30].into_iter().flat_map(|count| systems.map(|texts| (count, texts))) {
        for order in [Order::Lex, Order::GrevLex] {
            let ring = ring_of(&["x", "y"], order);
            let generators = system(&ring, texts, &[("P", first_primes(count))]);
            let found = modular(&ring, &generators);
            assert_eq!(found.basis.polynomials, direct(&ring, &generators), "{count} primes, {texts:?}");
            assert!(proved(&found, &ring, &generators), "{count} primes, {texts:?}");
        }
    }
}

#[test]
fn primes_with_another_result_are_counted() {
    let ring = ring_of(&["x", "y"], Order::GrevLex);
    let generators = system(&ring, &["x^2 + y^2 - 1", "x^2 + y^2 - 1 - P"], &[("P", first_primes(2))]);
    let found = modular(&ring, &generators);
    assert!(found.basis.is_unit_ideal());
    assert!(found.unlucky >= 1, "{found:?}");
    let lucky = modular(&ring, &system(&ring, &["x^2 + y^2 - 1", "x - y"], &[]));
    assert_eq!((lucky.unlucky, lucky.status), (0, Status::Probable));
    assert!(lucky.primes >= 2);
}

#[test]
fn the_zero_and_the_unit_ideal() {
    for order in orders() {
        let ring = ring_of(&["x", "y", "z"], order);
        for (texts, size) in
            [(vec!["0"], 0), (vec!["x", "0", "x - 1"], 1), (vec![], 0), (vec!["7/3"], 1), (vec!["0", "x*y"], 1)]
        {
            let generators = system(&ring, &texts, &[]);
            for cofactors in [false, true] {
                let options = Options { cofactors, ..Options::default() };
                let found = modular::basis(&ring, &generators, &options, &Watch::none()).unwrap();
                assert_eq!(found.basis.polynomials, direct(&ring, &generators), "{texts:?}");
                assert_eq!(found.basis.polynomials.len(), size, "{texts:?}");
                assert!(proved(&found, &ring, &generators), "{texts:?}");
            }
        }
    }
}

/// A correct result with its elements replaced.
fn forged(honest: &Modular, polynomials: Vec<Element>) -> Modular {
    let mut forged = honest.clone();
    forged.basis.polynomials = polynomials;
    forged
}

/// Bases of other ideals, larger and smaller, and sets that are not bases.
#[test]
fn forged_bases_are_not_proved() {
    let forgeries: [(&[&str], &[&[&str]]); 5] = [
        (&["x^2", "y"], &[&["y", "x"], &["x^2"], &["y"], &["1"], &[], &["y", "x^2", "x^3"]]),
        (&["x^2 - 1", "x*y - x"], &[&["y - 1", "x - 1"], &["y - 1", "x^2"], &["1"], &["x^2 - 1"]]),
        (&["x*y - 1", "y^2 - x"], &[&["y^2 - x", "x*y - 1"], &["y - 1", "x - 1"], &["1"], &["y^3 - 1"]]),
        (&["x^2*y - 1", "x*y^2 - x"], &[&["x^2*y - 1", "x*y^2 - x"], &["2*y - 2", "x^2 - 1"], &["y + 1", "x^2 + 1"]]),
        (
            &["x + y", "x - y - 1"],
            &[&["y - 1/2", "x + 1/2"], &["x + 1/2"], &["x + 1/2", "y + 1/2"], &["y + 1/2", "x + y"]],
        ),
    ];
    for order in [Order::Lex, Order::GrevLex, Order::elimination(1, 2)] {
        let ring = ring_of(&["x", "y"], order);
        for (texts, wrong) in forgeries {
            let generators = system(&ring, texts, &[]);
            let honest = modular(&ring, &generators);
            assert!(proved(&honest, &ring, &generators), "{texts:?}");
            for texts in wrong {
                let claim = forged(&honest, system(&ring, texts, &[]));
                assert!(claim.basis == honest.basis || !proved(&claim, &ring, &generators), "{texts:?}");
            }
        }
    }
}

/// Every coefficient of a basis affects its proof.
#[test]
fn a_changed_coefficient_is_not_proved() {
    let homogeneous: &[&str] = &["x^2 + 2*x*y - z^2", "x*y - 3*y*z", "y^2 - x*z"];
    for texts in [homogeneous, &["x^2 + 2*x*y - 1", "x*y - 3*z", "y^2 - x*z + 2"]] {
        for order in [Order::Lex, Order::GrevLex] {
            let ring = ring_of(&["x", "y", "z"], order);
            let generators = system(&ring, texts, &[]);
            let honest = modular(&ring, &generators);
            assert!(proved(&honest, &ring, &generators));
            for (index, f) in honest.basis.polynomials.iter().enumerate() {
                for term in &f.terms()[1..] {
                    let mut polynomials = honest.basis.polynomials.clone();
                    let change = ring.term(BigRational::new(first_primes(1), 5.into()), term.monomial.clone());
                    polynomials[index] = ring.add(f, &change);
                    assert!(!proved(&forged(&honest, polynomials), &ring, &generators), "{texts:?}: element {index}");
                }
            }
        }
    }
}

#[test]
fn a_watch_stops_it() {
    let ring = ring_of(&["x", "y", "z"], Order::GrevLex);
    let generators = system(&ring, &["x^3 + y*z - 1", "y^3 - x*z + 2", "z^3 - 5*x*y"], &[]);
    let found = modular(&ring, &generators);
    let stopped = Watch::none().with_cancel(Arc::new(AtomicBool::new(true)));
    let error = modular::basis(&ring, &generators, &Options::default(), &stopped).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Cancelled);
    assert_eq!(prove(&found, &ring, &generators, &stopped).unwrap_err().kind(), ErrorKind::Cancelled);
    let late = Watch::none().with_time(Duration::ZERO);
    assert_eq!(modular::basis(&ring, &generators, &Options::default(), &late).unwrap_err().kind(), ErrorKind::Budget);
}
