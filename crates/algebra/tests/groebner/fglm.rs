//! Change of order and minimal polynomials: agreement of the word engine, the generic one, known bases and direct
//! computations.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
use std::time::Duration;

use groebot_algebra::groebner::ideal::eliminate;
use groebot_algebra::groebner::{Basis, Options, Quotient, WordQuotient, basis, change_order};
use groebot_algebra::number::{BigInt, Rationals, Ring, Zp};
use groebot_algebra::poly::univariate::Univariate;
use groebot_algebra::poly::{Order, Polynomial, PolynomialRing};
use groebot_algebra::{ErrorKind, Watch};
use proptest::prelude::*;

use crate::corpus::groebner::{Case, all, case, read_basis};
use crate::corpus::{read, read_all};
use crate::poly::sparse::{Sparse, build, orders, sparse};

const LARGE: u64 = 2147483647;

fn find(ring: &PolynomialRing<Zp>, generators: &[Polynomial<u64>]) -> Basis<Zp> {
    basis(ring, generators, &Options::default(), &Watch::none()).unwrap()
}

fn ring_in(ring: &PolynomialRing<Zp>, order: Order) -> PolynomialRing<Zp> {
    PolynomialRing::new(*ring.field(), ring.variables(), order).unwrap()
}

/// The GrevLex basis of a system in `x`, `y`, `z`.
fn graded(p: u64, texts: &[&str]) -> Basis<Zp> {
    let ring = PolynomialRing::new(Zp::new(p).unwrap(), &["x", "y", "z"], Order::GrevLex).unwrap();
    find(&ring, &texts.iter().map(|text| read(&ring, text)).collect::<Vec<_>>())
}

fn finite_over(prime: u64) -> impl Fn(&Case) -> bool {
    move |case| {
        let field = case.field == "Q" || case.field == format!("GF({prime})");
        field && case.order == Order::Lex && case.facts.dimension == 0
    }
}

/// A known basis over Q is also a basis modulo a prime that divides no coefficient: 2^31 - 1 is lucky for all these
/// files.
#[test]
fn the_known_lexicographic_bases_are_found() {
    let mut cases = 0;
    for p in [LARGE, 32003] {
        let select = finite_over(p);
        for case in all().iter().filter(|case| select(case) && (p == LARGE || case.field != "Q")) {
            let lex = case.ring(&Zp::new(p).unwrap());
            let start = ring_in(&lex, Order::GrevLex);
            let start = find(&start, &case.generators(&start));
            let found = change_order(&start, &lex, &Watch::none()).unwrap();
            assert!(found.polynomials == read_basis(&lex, &case.basis), "{}: another basis", case.file);
            let quotient = WordQuotient::new(&start, &Watch::none()).unwrap();
            assert_eq!(Some(quotient.dimension()), case.facts.quotient_dimension, "{}", case.file);
            assert_eq!(quotient.basis_in(start_ring(&start), &Watch::none()).unwrap(), start, "{}", case.file);
            cases += 1;
        }
    }
    assert!(cases >= 19, "{cases}");
}

fn start_ring(basis: &Basis<Zp>) -> &PolynomialRing<Zp> {
    &basis.ring
}

/// Shape position, a symmetric ideal, multiple points in and out of shape position, a single point; modulo primes of all sizes.
#[test]
fn special_positions_come_out_as_computed_directly() {
    let systems: [&[&str]; 8] = [
        &["x^2 + y + z - 1", "x + y^2 + z - 1", "x + y + z^2 - 1"],
        &["x^2 - 1", "y^2 - 1", "z^2 - 1"],
        &["x^2", "x*y", "y^2", "z^3 - z"],
        &["x - z^2", "y - z^3", "z^5"],
        &["x^2", "y^2 - x", "z^2 - y"],
        &["x - 1", "y + 1", "z"],
        &["x*y - z", "y*z - x", "x*z - y", "x^3 + y - z"],
        &["(x + y)^2 - z", "(x - z)^3", "y^2 - y*z"],
    ];
    for p in [2, 3, 7, 32003, LARGE, (1 << 61) - 1] {
        for system in systems {
            let start = graded(p, system);
            if start.require_zero_dimensional().is_err() {
                continue;
            }
            for order in orders() {
                let target = ring_in(&start.ring, order);
                let moved: Vec<_> =
                    start.polynomials.iter().map(|f| start.ring.transfer(f, &target).unwrap()).collect();
                let found = change_order(&start, &target, &Watch::none()).unwrap();
                assert_eq!(found, find(&target, &moved), "{system:?} modulo {p}");
            }
        }
    }
}

/// Input bases need not be reduced, in the word engine and in the generic one.
#[test]
fn a_basis_that_is_not_reduced_gives_the_reduced_one() {
    let start = graded(32003, &["x^2 + y + z - 1", "x + y^2 + z - 1", "x + y + z^2 - 1"]);
    let mut loose = start.clone();
    let (ring, last) = (&start.ring, start.polynomials.len() - 1);
    let multiple = ring.mul(&start.polynomials[0], &read(ring, "5*x + 1"));
    loose.polynomials[last] = ring.scale(&start.polynomials[last], &77);
    loose.polynomials.push(multiple);
    loose.polynomials[0] = ring.add(&loose.polynomials[0], &ring.zero());
    for order in [Order::Lex, Order::GrevLex] {
        let target = ring_in(ring, order);
        let expected = change_order(&start, &target, &Watch::none()).unwrap();
        assert_eq!(change_order(&loose, &target, &Watch::none()).unwrap(), expected);
        assert_eq!(Quotient::new(&loose).unwrap().basis_in(&target, &Watch::none()).unwrap(), expected);
    }
}

/// The generator in `t` of the ideal with `t - f`, all other unknowns eliminated: the minimal polynomial by Buchberger's algorithm.
fn by_elimination(start: &Basis<Zp>, f: &Polynomial<u64>) -> Univariate<u64> {
    let names: Vec<&str> = start.ring.variables().iter().map(String::as_str).collect();
    let all: Vec<&str> = names.iter().copied().chain(["t"]).collect();
    let ring = PolynomialRing::new(*start.ring.field(), &all, Order::GrevLex).unwrap();
    let transfer = |f: &Polynomial<u64>| start.ring.transfer(f, &ring).unwrap();
    let mut generators: Vec<_> = start.polynomials.iter().map(transfer).collect();
    generators.push(ring.sub(&ring.variable(names.len()), &transfer(f)));
    let found = eliminate(&ring, &generators, &names, &Watch::none()).unwrap();
    let [polynomial] = found.polynomials.as_slice() else { panic!("one generator in one unknown") };
    let mut coefficients = vec![0; found.ring.degree(polynomial) as usize + 1];
    for term in polynomial.terms() {
        coefficients[found.ring.layout().degree(&term.monomial) as usize] = term.coefficient;
    }
    Univariate { coefficients }
}

fn agree_on_minimal_polynomials(start: &Basis<Zp>, f: &Polynomial<u64>) {
    let expected = by_elimination(start, f);
    let generic = Quotient::new(start).unwrap().minimal_polynomial(f, &Watch::none()).unwrap();
    assert_eq!(generic, expected, "generic");
    let word = WordQuotient::new(start, &Watch::none()).unwrap().minimal_polynomial(f, &Watch::none()).unwrap();
    assert_eq!(word, expected, "word");
}

#[test]
fn minimal_polynomials_are_those_of_elimination() {
    let forms = ["z", "y", "x + 2*y - 3*z", "x*y + z^2 - 1", "x^3*y", "4", "0", "2*z"];
    let systems: [&[&str]; 4] = [
        &["x^2 + y + z - 1", "x + y^2 + z - 1", "x + y + z^2 - 1"],
        &["x^2 - 1", "y^2 - 1", "z^2 - 1"],
        &["x^2", "y^2 - x", "z^2 - y"],
        &["x^3 - 2", "y^2 - x*y + 1", "z - x*y"],
    ];
    for p in [2, 7, 32003, LARGE] {
        for system in systems {
            let start = graded(p, system);
            forms.iter().for_each(|form| agree_on_minimal_polynomials(&start, &read(&start.ring, form)));
        }
    }
}

/// sqrt(2) + sqrt(3) has the minimal polynomial t^4 - 10 t^2 + 1.
#[test]
fn a_minimal_polynomial_over_the_rationals() {
    let ring = PolynomialRing::new(Rationals, &["x", "y"], Order::GrevLex).unwrap();
    let generators = read_all(&ring, &["x^2 - 2", "y^2 - 3"].map(str::to_owned));
    let start = basis(&ring, &generators, &Options::default(), &Watch::none()).unwrap();
    let found = Quotient::new(&start).unwrap().minimal_polynomial(&read(&ring, "x + y"), &Watch::none()).unwrap();
    let expected = [1, 0, -10, 0, 1].map(|n| Rationals.from_integer(&BigInt::from(n)));
    assert_eq!(found.coefficients, expected);
}

#[test]
fn bad_input_is_refused() {
    let start = graded(32003, &["x^2 - y", "y^2 - z", "z^2 - x"]);
    let quotient = WordQuotient::new(&start, &Watch::none()).unwrap();
    let kind = |result: groebot_algebra::Result<Basis<Zp>>| result.unwrap_err().kind();
    let other_names = PolynomialRing::new(*start.ring.field(), &["x", "w"], Order::Lex).unwrap();
    assert_eq!(kind(quotient.basis_in(&other_names, &Watch::none())), ErrorKind::UnknownName);
    let other_field = PolynomialRing::new(Zp::new(7).unwrap(), &["x", "y", "z"], Order::Lex).unwrap();
    assert_eq!(kind(change_order(&start, &other_field, &Watch::none())), ErrorKind::BadValue);
    let foreign = other_names.with_width(groebot_algebra::poly::Width::Bits32).variable(0);
    assert_eq!(quotient.minimal_polynomial(&foreign, &Watch::none()).unwrap_err().kind(), ErrorKind::BadValue);
    let free = graded(32003, &["x*y - 1"]);
    assert_eq!(
        kind(change_order(&free, &ring_in(&free.ring, Order::Lex), &Watch::none())),
        ErrorKind::PositiveDimensional
    );
    let unit = graded(32003, &["x", "x - 1"]);
    assert_eq!(kind(change_order(&unit, &ring_in(&unit.ring, Order::Lex), &Watch::none())), ErrorKind::Inconsistent);
    let wide = graded((1 << 61) - 1, &["x^2 - y", "y^2 - z", "z^2 - x"]);
    assert_eq!(WordQuotient::new(&wide, &Watch::none()).unwrap_err().kind(), ErrorKind::BadValue);
}

/// A watch that stops at report number `stop`.
fn stopped_at(stop: usize) -> (Watch, Arc<AtomicUsize>) {
    let (flag, reports) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicUsize::new(0)));
    let (raised, counted) = (flag.clone(), reports.clone());
    let listener = move |_: groebot_algebra::watch::Progress<'_>| {
        if counted.fetch_add(1, Relaxed) + 1 == stop {
            raised.store(true, Relaxed);
        }
    };
    (Watch::none().with_listener(listener).with_cancel(flag), reports)
}

/// Shape position reports two powers for each solution; cyclic-5 needs the enumeration of monomials after its first
/// powers.
#[test]
fn the_work_is_followed_and_stopped() {
    for (file, least) in [("katsura_4-grevlex-gf32003", 32), ("cyclic_5-grevlex-gf32003", 70)] {
        let case = case(file);
        let ring = case.ring(&Zp::new(32003).unwrap());
        let start = find(&ring, &case.generators(&ring));
        let lex = ring_in(&ring, Order::Lex);
        let (watch, reports) = stopped_at(usize::MAX);
        assert!(change_order(&start, &lex, &watch).is_ok());
        let count = reports.load(Relaxed);
        assert!(count >= least, "{file}: {count}");
        for stop in [3, count - 2] {
            let (watch, reports) = stopped_at(stop);
            assert_eq!(change_order(&start, &lex, &watch).unwrap_err().kind(), ErrorKind::Cancelled);
            assert_eq!(reports.load(Relaxed), stop);
        }
    }
}

/// Random systems with finitely many solutions: a power of each unknown is a leading monomial. A square of the ideal
/// has multiple points only.
fn finite_system() -> impl Strategy<Value = (Vec<u32>, Vec<Sparse>, Vec<Sparse>, bool)> {
    let tails = prop::collection::vec(sparse(3, 4, 1), 3);
    (prop::collection::vec(1u32..=3, 3), tails, prop::collection::vec(sparse(3, 3, 2), 0..2), any::<bool>())
}

fn build_system(
    ring: &PolynomialRing<Zp>,
    (powers, tails, further, squared): &(Vec<u32>, Vec<Sparse>, Vec<Sparse>, bool),
) -> Vec<Polynomial<u64>> {
    let mut system: Vec<_> = powers
        .iter()
        .zip(tails)
        .enumerate()
        .map(|(v, (&power, tail))| {
            let low = build(ring, tail)
                .terms()
                .iter()
                .filter(|t| ring.layout().degree(&t.monomial) < power)
                .cloned()
                .collect::<Vec<_>>();
            ring.add(&ring.pow(&ring.variable(v), power), &ring.collect(low))
        })
        .collect();
    system.extend(further.iter().map(|f| build(ring, f)));
    if *squared && powers.iter().product::<u32>() <= 4 {
        return system.iter().enumerate().flat_map(|(k, f)| system[k..].iter().map(|g| ring.mul(f, g))).collect();
    }
    system
}

proptest! {
    #![proptest_config(crate::cases(60))]

    #[test]
    fn a_change_of_order_equals_the_direct_computation(system in finite_system(), prime in 0usize..3, order in 0usize..4) {
        let field = Zp::new([7, 32003, LARGE][prime]).unwrap();
        let ring = PolynomialRing::new(field, &["x", "y", "z"], Order::GrevLex).unwrap();
        let start = find(&ring, &build_system(&ring, &system));
        prop_assume!(start.require_zero_dimensional().is_ok());
        let target = ring_in(&ring, orders()[order].clone());
        let moved: Vec<_> = start.polynomials.iter().map(|f| ring.transfer(f, &target).unwrap()).collect();
        let watch = Watch::none().with_time(Duration::from_secs(1));
        let direct = basis(&target, &moved, &Options::default(), &watch);
        prop_assume!(direct.is_ok());
        let found = change_order(&start, &target, &Watch::none()).unwrap();
        prop_assert_eq!(&found, &direct.unwrap());
        prop_assert_eq!(&found, &Quotient::new(&start).unwrap().basis_in(&target, &Watch::none()).unwrap());
    }

    #[test]
    fn fewer_variables_give_the_elimination_ideal(system in finite_system(), prime in 0usize..3) {
        let field = Zp::new([7, 32003, LARGE][prime]).unwrap();
        let ring = PolynomialRing::new(field, &["x", "y", "z"], Order::GrevLex).unwrap();
        let start = find(&ring, &build_system(&ring, &system));
        prop_assume!(start.require_zero_dimensional().is_ok());
        for (kept, gone) in [(vec!["y", "z"], vec!["x"]), (vec!["z"], vec!["x", "y"]), (vec!["x", "z"], vec!["y"])] {
            let target = PolynomialRing::new(field, &kept, Order::GrevLex).unwrap();
            let found = change_order(&start, &target, &Watch::none()).unwrap();
            let watch = Watch::none().with_time(Duration::from_secs(1));
            let direct = eliminate(&ring, &start.polynomials, &gone, &watch);
            prop_assume!(direct.is_ok());
            prop_assert_eq!(found.polynomials, direct.unwrap().polynomials);
        }
    }

    #[test]
    fn minimal_polynomials_of_random_polynomials(system in finite_system(), form in sparse(3, 3, 1), prime in 0usize..3) {
        let field = Zp::new([7, 32003, LARGE][prime]).unwrap();
        let ring = PolynomialRing::new(field, &["x", "y", "z"], Order::GrevLex).unwrap();
        let start = find(&ring, &build_system(&ring, &system));
        prop_assume!(start.require_zero_dimensional().is_ok());
        agree_on_minimal_polynomials(&start, &build(&ring, &form));
    }
}
