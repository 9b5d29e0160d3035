//! The engine against the systems of `tests/corpus/groebner/systems`, whose facts come from Singular and from the literature.

use groebot::Watch;
use groebot::groebner::{Basis, Options, Strategy, basis};
use groebot::number::{Field, Rationals, Zp};
use groebot::poly::{Order, Polynomial, PolynomialRing};

use crate::corpus::systems::{Answer, Canonical, Facts, System, all, basis_hash, system};

/// The engine under test.
fn compute<F: Field>(ring: &PolynomialRing<F>, generators: &[Polynomial<F::Element>]) -> Basis<F> {
    let options = Options { strategy: Strategy::Sugar, cofactors: false };
    basis(ring, generators, &options, &Watch::none()).expect("a basis")
}

/// What Buchberger's engine finds in less than a fifth of a second, with the test profile.
fn is_quick(system: &System, answer: &Answer) -> bool {
    answer.facts.degree <= 16 && system.variables.len() <= 6
}

fn facts_over<F: Canonical>(field: F, system: &System, order: &Order) -> Facts {
    let ring = system.ring(field, order);
    let found = compute(&ring, &system.generators(&ring));
    Facts {
        dimension: found.independent_variables().map_or(-1, |free| free.len() as i64),
        degree: degree(&found),
        size: found.polynomials.len(),
        hash: basis_hash(&found.ring, &found.polynomials),
    }
}

/// The degree of the ideal of leading monomials: over the largest sets of free variables, the number of standard monomials in the
/// other variables once the free ones are units.
fn degree<F: Field>(basis: &Basis<F>) -> usize {
    let layout = basis.ring.layout();
    let leads: Vec<Vec<u32>> = basis.leading_monomials().iter().map(|m| layout.exponents(m)).collect();
    let Some(free) = basis.independent_variables() else { return 0 };
    let count = basis.ring.variables().len();
    let sets = (0..1_u32 << count).filter(|set| set.count_ones() as usize == free.len());
    sets.map(|set| standard_beside(&leads, set, count)).sum()
}

/// The number of standard monomials in the variables outside `set` where those of `set` are units; 0 if infinite or none.
fn standard_beside(leads: &[Vec<u32>], set: u32, count: usize) -> usize {
    let bound: Vec<usize> = (0..count).filter(|v| set & (1 << v) == 0).collect();
    let local: Vec<Vec<u32>> = leads.iter().map(|lead| bound.iter().map(|&v| lead[v]).collect()).collect();
    let is_power = |lead: &Vec<u32>, v: usize| lead.iter().enumerate().all(|(u, &e)| u == v || e == 0);
    let is_finite = (0..bound.len()).all(|v| local.iter().any(|lead| is_power(lead, v)));
    if is_finite { standard_from(&local, &mut vec![0; bound.len()], 0) } else { 0 }
}

/// The number of standard monomials that agree with `exponents` before `variable`.
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

fn check(system: &System, answer: &Answer) {
    let order = &answer.order;
    let mut found = match answer.field.as_str() {
        "Q" => facts_over(Rationals, system, order),
        field => facts_over(Zp::new(modulus(field)).expect("a prime"), system, order),
    };
    if *order == Order::Lex && found.dimension > 0 {
        found.degree = answer.facts.degree; // An order that does not go by degree does not show it.
    }
    assert_eq!(found, answer.facts, "{} over {} in {order:?}", system.name, answer.field);
}

fn modulus(field: &str) -> u64 {
    let digits = field.trim_start_matches("GF(").trim_end_matches(')');
    digits.parse().unwrap_or_else(|_| panic!("field {field}"))
}

fn check_all(select: impl Fn(&System, &Answer) -> bool) -> usize {
    let systems = all();
    let answers = systems.iter().flat_map(|system| system.answers.iter().map(move |answer| (system, answer)));
    answers.filter(|(system, answer)| select(system, answer)).inspect(|(system, answer)| check(system, answer)).count()
}

#[test]
fn the_engine_finds_the_facts_of_small_systems() {
    assert!(check_all(is_quick) >= 100);
}

/// The literature's numbers of solutions, beside Singular's.
#[test]
fn the_known_degrees_stand_in_the_files() {
    let degree = |name: &str| system(name).answer("GF(32003)", &Order::GrevLex).expect("an answer").facts.degree;
    assert_eq!(["six_split", "six_raghavan_roth", "six_tangents", "six_dual_quaternions"].map(degree), [16; 4]);
    assert_eq!((degree("stewart"), degree("cyclic_7"), degree("katsura_8")), (40, 924, 256));
}
