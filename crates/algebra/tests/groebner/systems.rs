//! The engine compared with the systems of `tests/corpus/groebner/systems`, whose properties are from Singular and from
//! the literature.

use groebot_algebra::Watch;
use groebot_algebra::groebner::modular::{self, Status};
use groebot_algebra::groebner::{Basis, Options, Quotient, Strategy, basis, basis_modulo_prime};
use groebot_algebra::number::{Field, Rationals, Zp};
use groebot_algebra::poly::Order;

use crate::corpus::systems::{Answer, Canonical, Facts, System, all, basis_hash, system};

/// Systems that Buchberger's engine solves quickly: few solutions, few unknowns, short equations.
fn is_quick(system: &System, answer: &Answer) -> bool {
    let most = if answer.field == "Q" { 8 } else { 16 };
    let length: usize = system.generators.iter().map(String::len).sum();
    answer.facts.degree <= most && system.variables.len() <= 6 && length <= 500
}

/// Directly in grevlex, then in lex if there are finitely many solutions.
fn by_buchberger<F: Canonical>(field: F, system: &System, order: &Order) -> Facts {
    let options = Options { strategy: Strategy::Sugar, cofactors: false };
    let direct = |order: &Order| {
        let ring = system.ring(field.clone(), order);
        basis(&ring, &system.generators(&ring), &options, &Watch::none()).expect("a basis")
    };
    let graded = direct(&Order::GrevLex);
    facts(&match (order, Quotient::new(&graded)) {
        (Order::GrevLex, _) => graded,
        (_, Err(_)) => direct(order),
        (_, Ok(quotient)) => quotient.basis_in(&system.ring(field.clone(), order), &Watch::none()).expect("a basis"),
    })
}

fn modulo_prime(p: u64, system: &System, order: &Order) -> Facts {
    let ring = system.ring(Zp::new(p).expect("a prime"), order);
    facts(&basis_modulo_prime(&ring, &system.generators(&ring), &Watch::none()).expect("a basis"))
}

fn by_many_primes(system: &System, order: &Order) -> Facts {
    let ring = system.ring(Rationals, order);
    let found = modular::basis(&ring, &system.generators(&ring), &Options::default(), &Watch::none()).expect("a basis");
    assert_eq!(found.status, Status::Probable, "{}", system.name);
    facts(&found.basis)
}

fn facts<F: Canonical>(found: &Basis<F>) -> Facts {
    Facts {
        dimension: found.independent_variables().map_or(-1, |free| free.len() as i64),
        degree: degree(found),
        size: found.polynomials.len(),
        hash: basis_hash(&found.ring, &found.polynomials),
    }
}

/// The degree of the ideal of leading monomials: the sum over the largest sets of free variables of the number of
/// standard monomials in the other variables, with the free ones as units.
fn degree<F: Field>(basis: &Basis<F>) -> usize {
    let layout = basis.ring.layout();
    let leads: Vec<Vec<u32>> = basis.leading_monomials().iter().map(|m| layout.exponents(m)).collect();
    let Some(free) = basis.independent_variables() else { return 0 };
    let count = basis.ring.variables().len();
    let sets = (0..1_u32 << count).filter(|set| set.count_ones() as usize == free.len());
    sets.map(|set| standard_beside(&leads, set, count)).sum()
}

/// The number of standard monomials in the variables outside `set`, with those of `set` as units; 0 if infinite or
/// none.
fn standard_beside(leads: &[Vec<u32>], set: u32, count: usize) -> usize {
    let bound: Vec<usize> = (0..count).filter(|v| set & (1 << v) == 0).collect();
    let local: Vec<Vec<u32>> = leads.iter().map(|lead| bound.iter().map(|&v| lead[v]).collect()).collect();
    let is_power = |lead: &Vec<u32>, v: usize| lead.iter().enumerate().all(|(u, &e)| u == v || e == 0);
    let is_finite = (0..bound.len()).all(|v| local.iter().any(|lead| is_power(lead, v)));
    if is_finite { standard_from(&local, &mut vec![0; bound.len()], 0) } else { 0 }
}

/// The number of standard monomials that start with `exponents` before `variable`.
fn standard_from(leads: &[Vec<u32>], exponents: &mut Vec<u32>, variable: usize) -> usize {
    let is_standard = |exponents: &[u32]| !leads.iter().any(|lead| lead.iter().zip(exponents).all(|(a, b)| a <= b));
    if variable == exponents.len() || !is_standard(exponents) {
        return usize::from(is_standard(exponents));
    }
    let mut found = 0;
    while is_standard(exponents) {
        found += standard_from(leads, exponents, variable + 1);
        exponents[variable] += 1;
    }
    exponents[variable] = 0;
    found
}

/// An order that does not compare degrees does not determine the degree of a positive-dimensional ideal.
fn compare(mut found: Facts, system: &System, answer: &Answer) {
    if answer.order == Order::Lex && found.dimension > 0 {
        found.degree = answer.facts.degree;
    }
    assert_eq!(found, answer.facts, "{} over {} in {:?}", system.name, answer.field, answer.order);
}

fn check_buchberger(system: &System, answer: &Answer) {
    let found = match answer.field.as_str() {
        "Q" => by_buchberger(Rationals, system, &answer.order),
        field => by_buchberger(Zp::new(modulus(field)).expect("a prime"), system, &answer.order),
    };
    compare(found, system, answer);
}

fn modulus(field: &str) -> u64 {
    let digits = field.trim_start_matches("GF(").trim_end_matches(')');
    digits.parse().unwrap_or_else(|_| panic!("field {field}"))
}

fn check_all(check: impl Fn(&System, &Answer), select: impl Fn(&System, &Answer) -> bool) -> usize {
    let systems = all();
    let answers = systems.iter().flat_map(|system| system.answers.iter().map(move |answer| (system, answer)));
    answers.filter(|(system, answer)| select(system, answer)).inspect(|(system, answer)| check(system, answer)).count()
}

#[test]
fn buchberger_finds_the_facts_of_small_systems() {
    assert!(check_all(check_buchberger, is_quick) >= 100);
}

fn check_modulo_prime(system: &System, answer: &Answer) {
    compare(modulo_prime(modulus(&answer.field), system, &answer.order), system, answer);
}

fn check_rational(system: &System, answer: &Answer) {
    compare(by_many_primes(system, &answer.order), system, answer);
}

/// Systems whose bases modulo a prime take more than 0.4 s each with the test profile.
fn is_long(system: &System) -> bool {
    ["cyclic_8", "eco_12", "katsura_10", "noon_8", "six_tangents"].contains(&system.name.as_str())
}

/// Over Q: all systems in grevlex. In lex, where the modular computation uses that order itself, those with few
/// solutions.
fn is_quick_by_many_primes(answer: &Answer) -> bool {
    answer.field == "Q" && (answer.order == Order::GrevLex || answer.facts.degree <= 48)
}

#[test]
fn f4_finds_the_facts_modulo_primes() {
    assert!(check_all(check_modulo_prime, |system, answer| answer.field != "Q" && !is_long(system)) >= 200);
}

#[test]
#[ignore = "takes ten seconds"]
fn f4_finds_the_facts_of_long_systems() {
    assert!(check_all(check_modulo_prime, |system, answer| answer.field != "Q" && is_long(system)) >= 8);
}

#[test]
fn many_primes_find_the_facts_over_the_rationals() {
    assert!(check_all(check_rational, |_, answer| is_quick_by_many_primes(answer)) >= 75);
}

/// The numbers of solutions in the literature, compared with Singular's.
#[test]
fn the_files_have_the_known_degrees() {
    let degree = |name: &str| system(name).answer("GF(32003)", &Order::GrevLex).expect("an answer").facts.degree;
    assert_eq!(["six_split", "six_raghavan_roth", "six_tangents", "six_dual_quaternions"].map(degree), [16; 4]);
    assert_eq!((degree("stewart"), degree("cyclic_7"), degree("katsura_8")), (40, 924, 256));
}
