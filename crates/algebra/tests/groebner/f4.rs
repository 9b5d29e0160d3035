//! F4 modulo primes compared with Buchberger's algorithm and the known bases of Singular, and its replays.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use groebot_algebra::groebner::buchberger::is_groebner_basis;
use groebot_algebra::groebner::{Basis, Options, Settings, Trace, basis, f4, f4_with, normal_form};
use groebot_algebra::number::{Ring, Zp};
use groebot_algebra::poly::{Block, Order, Polynomial, PolynomialRing};
use groebot_algebra::{ErrorKind, Watch};
use proptest::prelude::*;

use crate::corpus;
use crate::corpus::groebner::{all, read_basis};
use crate::poly::sparse::{Sparse, build, orders, sparse};

/// Small primes, for which random combinations are not used; then 16, 30 and 31 bits, the largest last.
const PRIMES: [u64; 9] = [2, 3, 5, 7, 101, 32003, 65521, 1073741827, 2147483647];

fn ring(p: u64, variables: &[&str], order: Order) -> PolynomialRing<Zp> {
    PolynomialRing::new(Zp::new(p).unwrap(), variables, order).unwrap()
}

fn read(ring: &PolynomialRing<Zp>, texts: &[&str]) -> Vec<Polynomial<u64>> {
    texts.iter().map(|text| corpus::read(ring, text)).collect()
}

fn by_buchberger(ring: &PolynomialRing<Zp>, generators: &[Polynomial<u64>]) -> Option<Basis<Zp>> {
    basis(ring, generators, &Options::default(), &Watch::none().with_time(Duration::from_secs(1))).ok()
}

/// The coefficients of the generators, equal in all lanes.
fn lanes<const N: usize>(generators: &[Polynomial<u64>]) -> Vec<Vec<[u32; N]>> {
    generators.iter().map(|f| f.terms().iter().map(|t| [u32::try_from(t.coefficient).unwrap(); N]).collect()).collect()
}

fn coefficients(basis: &Basis<Zp>) -> Vec<Vec<u32>> {
    let row = |f: &Polynomial<u64>| f.terms().iter().map(|t| u32::try_from(t.coefficient).unwrap()).collect();
    basis.polynomials.iter().map(row).collect()
}

/// Checks that all settings of F4 give the basis of Buchberger's algorithm; `false` when that took too long.
fn agree(p: u64, order: Order, generators: &[Sparse]) -> bool {
    let ring = ring(p, &["x", "y", "z"], order);
    let generators: Vec<_> = generators.iter().map(|f| build(&ring, f)).collect();
    let Some(expected) = by_buchberger(&ring, &generators) else { return false };
    assert_eq!(f4(&ring, &generators, &Watch::none()).unwrap().polynomials, expected.polynomials);
    for (combinations, vectors) in [(true, false), (false, true), (false, false)] {
        let found = f4_with(&ring, &generators, Settings { combinations, vectors }, &Watch::none()).unwrap();
        assert_eq!(found.polynomials, expected.polynomials, "combinations {combinations}, vectors {vectors}");
    }
    let (learned, trace) = Trace::learn(&ring, &generators, &Watch::none()).unwrap();
    assert_eq!(learned.polynomials, expected.polynomials);
    let replayed = trace.replay::<2>([p as u32; 2], &lanes(&generators), &Watch::none()).unwrap();
    assert_eq!(replayed, [Some(coefficients(&expected)), Some(coefficients(&expected))]);
    true
}

proptest! {
    #![proptest_config(crate::cases(300))]

    #[test]
    fn equals_buchberger(
        generators in prop::collection::vec(sparse(3, 3, 2), 1..5),
        order in 0usize..4,
        prime in 0..PRIMES.len(),
    ) {
        prop_assume!(agree(PRIMES[prime], orders()[order].clone(), &generators));
    }
}

/// In this order, `x^2` appears after `x^2 - x*y*z^2`, whose sugar is too large to reduce it. One of them must stay in the basis.
#[test]
fn elements_with_equal_leading_monomials_do_not_remove_each_other() {
    for p in PRIMES {
        let ring = ring(p, &["x", "y", "z"], Order::elimination(2, 3));
        let found = f4(&ring, &read(&ring, &["x+y^2", "x^2-x*y*z^2", "x*y"]), &Watch::none()).unwrap();
        assert_eq!(found.polynomials, read(&ring, &["y^2+x", "x*y", "x^2"]), "modulo {p}");
    }
}

#[test]
fn known_bases() {
    let mut seen = 0;
    for case in all().into_iter().filter(|case| case.parameters.is_empty()) {
        let Some(p) = case.field.strip_prefix("GF(").and_then(|rest| rest.strip_suffix(')')) else { continue };
        let ring = case.ring(&Zp::new(p.parse().unwrap()).unwrap());
        let found = f4(&ring, &case.generators(&ring), &Watch::none()).unwrap();
        assert_eq!(found.polynomials, read_basis(&ring, &case.basis), "{}", case.file);
        seen += 1;
    }
    assert!(seen >= 15, "{seen} cases");
}

/// A basis over Q modulo a prime that divides no denominator and no leading coefficient of the computation is the basis
/// modulo the prime. A random prime of 31 bits satisfies this with high probability.
#[test]
fn known_bases_over_the_rationals_modulo_a_prime() {
    let mut seen = 0;
    for case in all().into_iter().filter(|case| case.field == "Q") {
        let ring = case.ring(&Zp::new(1_879_048_201).unwrap());
        let found = f4(&ring, &case.generators(&ring), &Watch::none()).unwrap();
        assert_eq!(found.polynomials, read_basis(&ring, &case.basis), "{}", case.file);
        seen += 1;
    }
    assert!(seen >= 50, "{seen} cases");
}

const KATSURA_4: [&str; 5] = [
    "x0+2*x1+2*x2+2*x3+2*x4-1",
    "x0^2+2*x1^2+2*x2^2+2*x3^2+2*x4^2-x0",
    "2*x0*x1+2*x1*x2+2*x2*x3+2*x3*x4-x1",
    "x1^2+2*x0*x2+2*x1*x3+2*x2*x4-x2",
    "2*x1*x2+2*x0*x3+2*x1*x4-x3",
];
const KATSURA_NAMES: [&str; 5] = ["x0", "x1", "x2", "x3", "x4"];

#[test]
fn replays_modulo_other_primes() {
    let primes = [2147483629, 1073741827, 32003, 65521];
    for order in [Order::GrevLex, Order::Lex, Order::elimination(2, 5)] {
        let learned_in = ring(2147483647, &KATSURA_NAMES, order.clone());
        let (_, trace) = Trace::learn(&learned_in, &read(&learned_in, &KATSURA_4), &Watch::none()).unwrap();
        let rings = primes.map(|p| ring(p, &KATSURA_NAMES, order.clone()));
        let images: Vec<_> = rings.iter().map(|ring| read(ring, &KATSURA_4)).collect();
        let mixed: Vec<Vec<[u32; 4]>> = (0..5)
            .map(|i| {
                (0..images[0][i].terms().len())
                    .map(|j| std::array::from_fn(|l| images[l][i].terms()[j].coefficient as u32))
                    .collect()
            })
            .collect();
        let replayed = trace.replay(primes.map(|p| p as u32), &mixed, &Watch::none()).unwrap();
        for (l, lane) in replayed.iter().enumerate() {
            let alone = f4(&rings[l], &images[l], &Watch::none()).unwrap();
            assert_eq!(lane.as_ref(), Some(&coefficients(&alone)), "{} in {order}", primes[l]);
        }
    }
}

/// a*x + y, x + y with a = 1 has another basis than with a = 2.
#[test]
fn a_lane_that_differs_is_reported() {
    let ring = ring(101, &["x", "y"], Order::GrevLex);
    let (learned, trace) = Trace::learn(&ring, &read(&ring, &["2*x+y", "x+y"]), &Watch::none()).unwrap();
    assert_eq!(learned.polynomials, read(&ring, &["y", "x"]));
    let generators = vec![vec![[2, 1, 3], [1, 1, 1]], vec![[1, 1, 1], [1, 1, 1]]];
    let replayed = trace.replay([101; 3], &generators, &Watch::none()).unwrap();
    assert_eq!(replayed, [Some(vec![vec![1], vec![1]]), None, Some(vec![vec![1], vec![1]])]);
    // More terms than in the learned run: x + y with y learned as absent.
    let (_, trace) = Trace::learn(&ring, &read(&ring, &["x+y", "x-y+1"]), &Watch::none()).unwrap();
    let error = trace.replay([101], &[vec![[1]], vec![[1]]], &Watch::none()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::BadValue);
}

#[test]
fn unit_zero_and_no_generators() {
    let ring = ring(2147483647, &["x", "y"], Order::GrevLex);
    let found = f4(&ring, &read(&ring, &["x*y-1", "x^2", "y^3-x"]), &Watch::none()).unwrap();
    assert!(found.is_unit_ideal());
    assert_eq!(found.polynomials, read(&ring, &["1"]));
    assert!(f4(&ring, &[], &Watch::none()).unwrap().polynomials.is_empty());
    assert!(f4(&ring, &read(&ring, &["0", "x-x"]), &Watch::none()).unwrap().polynomials.is_empty());
    let (_, trace) = Trace::learn(&ring, &read(&ring, &["0", "5"]), &Watch::none()).unwrap();
    assert_eq!(trace.replay([7], &[vec![], vec![[3]]], &Watch::none()).unwrap(), [Some(vec![vec![1]])]);
}

/// Degrees above 127 need wider lanes; above 32767 there are none.
#[test]
fn large_exponents() {
    let ring = ring(32003, &["x", "y"], Order::GrevLex);
    let generators = read(&ring, &["x^200-y", "y^3-x^150"]);
    let found = f4(&ring, &generators, &Watch::none()).unwrap();
    assert_eq!(found.polynomials, by_buchberger(&ring, &generators).unwrap().polynomials);
    assert!(is_groebner_basis(&ring, &found.polynomials).unwrap());
    let power = |variable| ring.pow(&ring.variable(variable), 20_000);
    let generators =
        [ring.sub(&power(0), &ring.variable(1)), ring.sub(&ring.mul(&ring.variable(0), &power(1)), &ring.one())];
    let error = f4(&ring, &generators, &Watch::none()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Overflow);
}

/// x1 = x2 = ... = xn = 1 by differences, for numbers of variables that need one to eight words.
#[test]
fn many_variables() {
    for count in [1, 7, 8, 15, 16, 23, 24, 31, 32, 47, 63] {
        let names: Vec<String> = (0..count).map(|i| format!("x{i}")).collect();
        for order in [Order::GrevLex, Order::Lex, Order::Block(vec![Block { size: 1, graded: true }; count])] {
            let ring = PolynomialRing::new(Zp::new(101).unwrap(), &names, order).unwrap();
            let differences = (1..count).map(|i| format!("x{}-x{i}", i - 1));
            let texts: Vec<String> = differences.chain([format!("x{}^2-1", count - 1), "x0^3-1".into()]).collect();
            let generators: Vec<_> = texts.iter().map(|text| corpus::read(&ring, text)).collect();
            match f4(&ring, &generators, &Watch::none()) {
                Ok(found) => {
                    assert_eq!(found.polynomials.len(), count);
                    let vanishes = |i| normal_form(&ring, &corpus::read(&ring, &format!("x{i}-1")), &found.polynomials);
                    assert!((0..count).all(|i| vanishes(i).unwrap().is_zero()));
                }
                Err(error) => assert!(count > 30 && error.kind() == ErrorKind::Overflow, "{count}: {error}"),
            }
        }
    }
}

#[test]
fn bad_moduli_and_budgets() {
    let wide = ring(2305843009213693951 - 30, &["x"], Order::Lex);
    assert_eq!(f4(&wide, &[], &Watch::none()).unwrap_err().kind(), ErrorKind::BadValue);
    let ring = ring(2147483647, &KATSURA_NAMES, Order::GrevLex);
    let generators = read(&ring, &KATSURA_4);
    let stopped = |watch: Watch| f4(&ring, &generators, &watch).unwrap_err().kind();
    assert_eq!(stopped(Watch::none().with_cancel(Arc::new(AtomicBool::new(true)))), ErrorKind::Cancelled);
    assert_eq!(stopped(Watch::none().with_time(Duration::ZERO)), ErrorKind::Budget);
    assert_eq!(stopped(Watch::none().with_terms(100)), ErrorKind::Budget);
    let (_, trace) = Trace::learn(&ring, &generators, &Watch::none()).unwrap();
    let cancelled = Watch::none().with_cancel(Arc::new(AtomicBool::new(true)));
    let error = trace.replay::<1>([101], &lanes(&generators), &cancelled).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Cancelled);
}
