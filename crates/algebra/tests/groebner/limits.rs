//! Progress, cancellation, budgets, and exponents that overflow their lanes.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use groebot_algebra::groebner::buchberger::buchberger;
use groebot_algebra::groebner::ideal::eliminate;
use groebot_algebra::groebner::{Basis, Options, Quotient, Strategy, basis};
use groebot_algebra::number::{BigInt, BigRational, Rationals, Ring, Zp};
use groebot_algebra::poly::{Fractions, Order, Polynomial, PolynomialRing, Width};
use groebot_algebra::{ErrorKind, Watch};

use crate::corpus::groebner::case;
use crate::corpus::read;

type Modular = (PolynomialRing<Zp>, Vec<Polynomial<u64>>);

/// A computation of several seconds.
fn long() -> Modular {
    let case = case("katsura_5-lex-gf32003");
    let ring = case.ring(&Zp::new(32003).unwrap());
    let generators = case.generators(&ring);
    (ring, generators)
}

/// A computation of some milliseconds.
fn short() -> Modular {
    let case = case("katsura_4-grevlex-gf32003");
    let ring = case.ring(&Zp::new(32003).unwrap());
    let generators = case.generators(&ring);
    (ring, generators)
}

fn normal() -> Options {
    Options { strategy: Strategy::Normal, cofactors: false }
}

/// A watch whose listener sets its cancel flag at report number `stop`, and the number of reports.
fn cancelled_at(stop: usize) -> (Watch, Arc<AtomicUsize>) {
    let (flag, reports) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicUsize::new(0)));
    let (raised, counted) = (flag.clone(), reports.clone());
    let listener = move |_: groebot_algebra::watch::Progress<'_>| {
        if counted.fetch_add(1, Relaxed) + 1 == stop {
            raised.store(true, Relaxed);
        }
    };
    (Watch::none().with_listener(listener).with_cancel(flag), reports)
}

#[test]
fn a_raised_flag_ends_the_work_at_once() {
    let (ring, generators) = long();
    let (watch, reports) = cancelled_at(5);
    assert_eq!(basis(&ring, &generators, &normal(), &watch).unwrap_err().kind(), ErrorKind::Cancelled);
    assert_eq!(reports.load(Relaxed), 5, "no pair is begun after the flag");
    let (watch, reports) = cancelled_at(1);
    assert_eq!(buchberger(&ring, &generators, &watch).unwrap_err().kind(), ErrorKind::Cancelled);
    assert_eq!(reports.load(Relaxed), 1);
    let raised = Watch::none().with_cancel(Arc::new(AtomicBool::new(true)));
    assert_eq!(eliminate(&ring, &generators, &["x0"], &raised).unwrap_err().kind(), ErrorKind::Cancelled);
}

#[test]
fn a_change_of_order_is_followed_and_stopped() {
    let (ring, generators) = short();
    let quotient = Quotient::new(&basis(&ring, &generators, &normal(), &Watch::none()).unwrap()).unwrap();
    let lex = PolynomialRing::new(*ring.field(), ring.variables(), Order::Lex).unwrap();
    let (watch, reports) = cancelled_at(7);
    assert_eq!(quotient.basis_in(&lex, &watch).unwrap_err().kind(), ErrorKind::Cancelled);
    assert_eq!(reports.load(Relaxed), 7);
    let (watch, reports) = cancelled_at(usize::MAX);
    assert!(quotient.basis_in(&lex, &watch).is_ok());
    assert!(reports.load(Relaxed) >= quotient.dimension());
}

#[test]
fn the_time_budget_holds() {
    let (ring, generators) = long();
    let start = Instant::now();
    let watch = Watch::none().with_time(Duration::from_millis(300));
    let error = basis(&ring, &generators, &normal(), &watch).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Budget);
    assert!(error.message().contains("0.3 s"), "{error}");
    assert!(start.elapsed() < Duration::from_secs(3), "{:?}", start.elapsed());
}

#[test]
fn the_term_budget_holds() {
    let (ring, generators) = short();
    let run = |terms| basis(&ring, &generators, &normal(), &Watch::none().with_terms(terms));
    assert_eq!(run(40).unwrap_err().kind(), ErrorKind::Budget);
    assert_eq!(run(100_000).unwrap().quotient_dimension(), Some(16));
}

#[test]
fn progress_counts_up() {
    let (ring, generators) = short();
    let lines = Arc::new(Mutex::new(Vec::new()));
    let seen = lines.clone();
    let watch = Watch::none().with_listener(move |line| {
        seen.lock().unwrap().push((line.stage.to_owned(), line.done, line.open));
    });
    basis(&ring, &generators, &normal(), &watch).unwrap();
    let lines = lines.lock().unwrap();
    assert!(lines.len() > 10 && lines.iter().all(|(stage, ..)| stage == "Groebner basis"));
    assert!(lines.iter().enumerate().all(|(index, (_, done, _))| *done == index));
    assert_eq!(lines.last().unwrap().2, 0, "nothing is open when the last pair is reduced");
}

#[test]
fn exponents_that_outgrow_their_lanes_restart_in_wider_ones() {
    let ring = PolynomialRing::new(Zp::new(32003).unwrap(), &["x", "y"], Order::Lex).unwrap();
    let generators = ["x^20 - y^9", "x^7*y^100 - 1"].map(|text| read(&ring, text));
    let wide = basis(&ring, &generators, &normal(), &Watch::none()).unwrap();
    assert_eq!(wide.ring, ring);
    let degree = wide.polynomials.iter().map(|f| ring.degree(f)).max().unwrap();
    assert!(degree > Width::Bits8.max_degree(), "{degree}");
    let narrow = ring.with_width(Width::Bits8);
    let narrow_generators = generators.each_ref().map(|f| ring.transfer(f, &narrow).unwrap());
    let found = basis(&narrow, &narrow_generators, &normal(), &Watch::none()).unwrap();
    assert_eq!(found.ring, ring, "as wide as the basis needs");
    assert_eq!(found.polynomials, wide.polynomials);
    let eliminated = eliminate(&narrow, &narrow_generators, &["x"], &Watch::none()).unwrap();
    assert_eq!(eliminated.polynomials.len(), 1);
}

#[test]
fn exponents_beyond_all_lanes_are_an_error() {
    let ring = PolynomialRing::new(Rationals, &["x", "y"], Order::Lex).unwrap().with_width(Width::Bits32);
    let term = |exponents: &[u32]| {
        ring.term(BigRational::from_integer(BigInt::from(1)), ring.layout().pack(exponents).unwrap())
    };
    let high = 1_500_000_000;
    let generators = [ring.add(&term(&[high, 1]), &term(&[0, 0])), ring.add(&term(&[1, high]), &term(&[0, 1]))];
    assert_eq!(basis(&ring, &generators, &normal(), &Watch::none()).unwrap_err().kind(), ErrorKind::Overflow);
    assert_eq!(buchberger(&ring, &generators, &Watch::none()).unwrap_err().kind(), ErrorKind::Overflow);
}

/// The standard monomials have a larger degree than the basis.
#[test]
fn a_quotient_larger_than_the_lanes_is_counted() {
    let ring = PolynomialRing::new(Rationals, &["x", "y"], Order::GrevLex).unwrap().with_width(Width::Bits8);
    let polynomials = ["y^100 - 1", "x^100 - 1"].map(|text| read(&ring, text)).to_vec();
    let found = Basis { ring, polynomials, cofactors: Vec::new() };
    assert_eq!(found.quotient_dimension(), Some(10_000));
    assert!(found.quotient_basis().is_none());
    assert_eq!(Quotient::new(&found).unwrap_err().kind(), ErrorKind::Overflow);
}

#[test]
fn coefficients_that_are_no_field_are_an_error() {
    let fractions = Fractions::new(Rationals, &["v"]).unwrap();
    let four = fractions.ring().from_integer(&BigInt::from(4));
    let field = fractions.with_square(0, &four).unwrap();
    let ring = PolynomialRing::new(field, &["x", "y"], Order::Lex).unwrap();
    let generators = ["(v - 2)*x + y", "(v + 2)*x*y - 1"].map(|text| read(&ring, text));
    let error = basis(&ring, &generators, &normal(), &Watch::none()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::BadValue);
    assert!(error.message().contains("v - 2"), "{error}");
    assert_eq!(buchberger(&ring, &generators, &Watch::none()).unwrap_err().kind(), ErrorKind::BadValue);
}

#[test]
fn questions_with_wrong_names_or_fields_are_refused() {
    let (ring, generators) = short();
    let kind = |names: &[&str]| eliminate(&ring, &generators, names, &Watch::none()).unwrap_err().kind();
    assert_eq!(kind(&["x0", "w"]), ErrorKind::UnknownName);
    assert_eq!(kind(&["x0", "x0"]), ErrorKind::DuplicateName);
    let found = basis(&ring, &generators, &normal(), &Watch::none()).unwrap();
    let quotient = Quotient::new(&found).unwrap();
    let other_field = PolynomialRing::new(Zp::new(7).unwrap(), ring.variables(), Order::Lex).unwrap();
    assert_eq!(quotient.basis_in(&other_field, &Watch::none()).unwrap_err().kind(), ErrorKind::BadValue);
    let other_names = PolynomialRing::new(*ring.field(), &["x0", "w"], Order::Lex).unwrap();
    assert_eq!(quotient.basis_in(&other_names, &Watch::none()).unwrap_err().kind(), ErrorKind::UnknownName);
}

#[test]
fn free_and_contradictory_systems_say_so() {
    let ring = PolynomialRing::new(Rationals, &["x", "y", "z"], Order::Lex).unwrap();
    let find = |texts: &[&str]| {
        let generators: Vec<_> = texts.iter().map(|text| read(&ring, text)).collect();
        basis(&ring, &generators, &Options::default(), &Watch::none()).unwrap()
    };
    let free = find(&["x*y - 1"]).require_zero_dimensional().unwrap_err();
    assert_eq!(free.kind(), ErrorKind::PositiveDimensional);
    assert!(free.message().ends_with("x, z"), "{free}");
    let unit = find(&["x*y - 1", "x", "z^9 - y"]);
    assert_eq!(unit.require_zero_dimensional().unwrap_err().kind(), ErrorKind::Inconsistent);
    assert_eq!((unit.quotient_dimension(), unit.quotient_basis()), (Some(0), Some(Vec::new())));
    let names: Vec<String> = (0..40).map(|k| format!("x{k}")).collect();
    let many = PolynomialRing::new(Rationals, &names, Order::GrevLex).unwrap();
    let pairs: Vec<_> = (0..20).map(|k| many.mul(&many.variable(2 * k), &many.variable(2 * k + 1))).collect();
    let found = basis(&many, &pairs, &Options::default(), &Watch::none()).unwrap();
    assert_eq!(found.independent_variables().map(|free| free.len()), Some(20));
}
