//! The engine, the operations on ideals and the reference algorithm, compared with the known bases of the corpus.

use groebot_algebra::Watch;
use groebot_algebra::groebner::buchberger::{buchberger, is_groebner_basis};
use groebot_algebra::groebner::ideal::eliminate;
use groebot_algebra::groebner::verify::{Claim, verify};
use groebot_algebra::groebner::{Basis, Options, Quotient, Strategy, basis, normal_form};
use groebot_algebra::number::{Field, Ring};
use groebot_algebra::poly::{Order, PolynomialRing};

use crate::corpus::groebner::{Case, all, case, read_basis};
use crate::corpus::{Check, over, read, read_all};

const BOTH: [Strategy; 2] = [Strategy::Normal, Strategy::Sugar];

/// Direct computations that take more than half a second in the test profile. The ignored test runs them.
const SLOW: [(&str, Strategy); 7] = [
    ("cyclic_5-lex-gf32003", Strategy::Normal),
    ("cyclic_6-grevlex-q", Strategy::Sugar),
    ("enneper-lex-q", Strategy::Normal),
    ("katsura_4-lex-q", Strategy::Sugar),
    ("katsura_6-grevlex-q", Strategy::Normal),
    ("katsura_6-grevlex-q", Strategy::Sugar),
    ("noon_3-lex-q", Strategy::Normal),
];

/// Direct computations that do not end within 15 seconds: coefficients over Q or Q(px,pz) become huge in lexicographic
/// computations (or with the normal strategy). The same bases are computed by change of order.
const HOPELESS: [(&str, Strategy); 7] = [
    ("cyclic_5-lex-q", Strategy::Normal),
    ("cyclic_6-grevlex-q", Strategy::Normal),
    ("katsura_4-lex-q", Strategy::Normal),
    ("katsura_5-lex-gf32003", Strategy::Normal),
    ("katsura_5-lex-q", Strategy::Normal),
    ("katsura_5-lex-q", Strategy::Sugar),
    ("nao_leg_inverted-lex-q_px_pz", Strategy::Sugar),
];

fn check_all(select: impl Fn(&Case) -> bool, check: impl FnMut(&Case)) -> usize {
    let cases: Vec<Case> = all().into_iter().filter(select).collect();
    cases.iter().for_each(check);
    cases.len()
}

/// The engine's basis of a case equals the known one.
struct Engine<'a>(&'a Case, Strategy);

impl Check for Engine<'_> {
    fn run<F: Field>(&self, field: F) {
        let Engine(case, strategy) = *self;
        let ring = case.ring(&field);
        let options = Options { strategy, cofactors: false };
        let found = basis(&ring, &case.generators(&ring), &options, &Watch::none()).unwrap();
        assert_eq!(found.ring, ring, "{}", case.file);
        assert!(found.polynomials == read_basis(&ring, &case.basis), "{} {strategy:?}: another basis", case.file);
        assert_eq!(found.is_unit_ideal(), case.facts.dimension == -1, "{}", case.file);
    }
}

#[test]
fn the_engine_finds_the_known_bases() {
    let mut runs = 0;
    check_all(
        |_| true,
        |case| {
            for strategy in BOTH {
                let key = (case.file.as_str(), strategy);
                if !SLOW.contains(&key) && !HOPELESS.contains(&key) {
                    over(&case.field, &case.parameters, &Engine(case, strategy));
                    runs += 1;
                }
            }
        },
    );
    assert!(runs >= 2 * 80 - SLOW.len() - HOPELESS.len());
}

#[test]
#[ignore = "half a minute"]
fn the_engine_finds_the_slow_known_bases() {
    for (file, strategy) in SLOW {
        let case = case(file);
        over(&case.field, &case.parameters, &Engine(&case, strategy));
    }
}

/// Checks dimension, quotient ring and membership as given in the files.
struct Facts<'a>(&'a Case);

impl Check for Facts<'_> {
    fn run<F: Field>(&self, field: F) {
        let case = self.0;
        let ring = case.ring(&field);
        let known = Basis { polynomials: read_basis(&ring, &case.basis), ring: ring.clone(), cofactors: Vec::new() };
        let free = known.independent_variables();
        assert_eq!(free.as_ref().map_or(-1, |free| free.len() as i64), case.facts.dimension, "{}", case.file);
        assert_eq!(known.require_zero_dimensional().is_ok(), case.facts.dimension == 0, "{}", case.file);
        assert_eq!(known.quotient_dimension(), case.facts.quotient_dimension, "{}", case.file);
        if let (Some(monomials), Some(texts)) = (known.quotient_basis(), &case.facts.standard_monomials) {
            let mut expected: Vec<_> = texts.iter().map(|text| read(&ring, text).terms()[0].monomial.clone()).collect();
            expected.sort_by(|a, b| ring.layout().compare(a, b));
            assert_eq!(monomials, expected, "{}", case.file);
        }
        for membership in &case.memberships {
            let f = read(&ring, &membership.polynomial);
            let remainder = normal_form(&ring, &f, &known.polynomials).unwrap();
            assert_eq!(remainder, read(&ring, &membership.normal_form), "{}: {}", case.file, membership.polynomial);
            assert_eq!(known.contains(&f).unwrap(), membership.member, "{}: {}", case.file, membership.polynomial);
        }
    }
}

#[test]
fn dimensions_quotients_and_members_are_known() {
    let cases = check_all(|_| true, |case| over(&case.field, &case.parameters, &Facts(case)));
    assert!(cases >= 80);
}

struct Eliminate<'a>(&'a Case);

impl Check for Eliminate<'_> {
    fn run<F: Field>(&self, field: F) {
        let case = self.0;
        let ring = case.ring(&field);
        for elimination in &case.eliminations {
            let names: Vec<&str> = elimination.eliminate.iter().map(String::as_str).collect();
            let found = eliminate(&ring, &case.generators(&ring), &names, &Watch::none()).unwrap();
            let kept: Vec<&String> =
                case.variables.iter().filter(|name| !elimination.eliminate.contains(name)).collect();
            assert_eq!(found.ring.variables().iter().collect::<Vec<_>>(), kept);
            let ordered = PolynomialRing::new(field.clone(), &kept, case.order.clone()).unwrap();
            let moved: Vec<_> = found.polynomials.iter().map(|f| found.ring.transfer(f, &ordered).unwrap()).collect();
            let moved = basis(&ordered, &moved, &Options::default(), &Watch::none()).unwrap();
            assert_eq!(moved.polynomials, read_basis(&ordered, &elimination.basis), "{}: {names:?}", case.file);
            if case.order == Order::GrevLex {
                assert_eq!(found.polynomials, moved.polynomials, "{}: already reduced", case.file);
            }
        }
    }
}

#[test]
fn elimination_ideals_are_known() {
    let cases =
        check_all(|case| !case.eliminations.is_empty(), |case| over(&case.field, &case.parameters, &Eliminate(case)));
    assert!(cases >= 16);
}

/// The elimination ideal of the circle's parametrisation is the circle: over Q modulo primes with a proof, modulo p by
/// F4.
#[test]
fn a_parametrised_circle_is_eliminated_over_every_field() {
    struct Circle;
    impl Check for Circle {
        fn run<F: Field>(&self, field: F) {
            let ring = PolynomialRing::new(field, &["t", "x", "y"], Order::Lex).unwrap();
            let generators = ["(1 + t^2)*x - 1 + t^2", "(1 + t^2)*y - 2*t"].map(|text| read(&ring, text));
            let found = eliminate(&ring, &generators, &["t"], &Watch::none()).unwrap();
            assert_eq!(found.ring.variables(), ["x", "y"]);
            assert_eq!(found.polynomials, [read(&found.ring, "x^2 + y^2 - 1")]);
        }
    }
    for field in ["Q", "GF(32003)", "GF(2147483647)", "GF(4294967311)"] {
        over(field, &[], &Circle);
    }
    over("Q", &["a".to_owned()], &Circle);
}

/// A known basis passes Buchberger's criterion (NAO 6.2.3). Without one of its elements it is not a basis of the ideal.
struct Criterion<'a>(&'a Case);

impl Check for Criterion<'_> {
    fn run<F: Field>(&self, field: F) {
        let case = self.0;
        let ring = case.ring(&field);
        let known = read_basis(&ring, &case.basis);
        assert!(is_groebner_basis(&ring, &known).unwrap(), "{}", case.file);
        for f in &case.generators(&ring) {
            assert!(normal_form(&ring, f, &known).unwrap().is_zero(), "{}", case.file);
        }
    }
}

#[test]
fn known_bases_pass_the_criterion() {
    let small = |case: &Case| case.basis.iter().map(String::len).sum::<usize>() < 6000;
    assert!(check_all(small, |case| over(&case.field, &case.parameters, &Criterion(case))) >= 70);
}

#[test]
fn what_is_no_basis_fails_the_criterion() {
    let case = case("cox_little_oshea_2_7-grevlex-q");
    let ring = case.ring(&groebot_algebra::number::Rationals);
    assert!(!is_groebner_basis(&ring, &case.generators(&ring)).unwrap());
}

/// Changes the order of the engine's grevlex basis to the known lexicographic one, and back.
struct ChangeOfOrder<'a>(&'a Case);

impl Check for ChangeOfOrder<'_> {
    fn run<F: Field>(&self, field: F) {
        let case = self.0;
        let (lex, graded) = (case.ring_in(&field, Order::Lex), case.ring_in(&field, Order::GrevLex));
        let options = Options { strategy: Strategy::Normal, cofactors: false };
        let start = basis(&graded, &case.generators(&graded), &options, &Watch::none()).unwrap();
        let quotient = Quotient::new(&start).unwrap();
        assert_eq!(Some(quotient.dimension()), case.facts.quotient_dimension, "{}", case.file);
        let moved = quotient.basis_in(&lex, &Watch::none()).unwrap();
        assert!(moved.polynomials == read_basis(&lex, &case.basis), "{}: another basis", case.file);
    }
}

fn is_lex_and_finite(case: &Case) -> bool {
    case.order == Order::Lex && case.facts.dimension == 0
}

#[test]
fn a_change_of_order_gives_the_known_lexicographic_bases() {
    let cases = check_all(is_lex_and_finite, |case| over(&case.field, &case.parameters, &ChangeOfOrder(case)));
    assert!(cases >= 20);
}

/// Changes the order of a lexicographic basis to the graded one, and eliminates the greatest variable.
struct Back<'a>(&'a Case);

impl Check for Back<'_> {
    fn run<F: Field>(&self, field: F) {
        let case = self.0;
        let lex = case.ring(&field);
        let known = Basis { polynomials: read_basis(&lex, &case.basis), ring: lex.clone(), cofactors: Vec::new() };
        let quotient = Quotient::new(&known).unwrap();
        let graded = case.ring_in(&field, Order::GrevLex);
        let options = Options { strategy: Strategy::Normal, cofactors: false };
        let direct = basis(&graded, &case.generators(&graded), &options, &Watch::none()).unwrap();
        assert_eq!(
            quotient.basis_in(&graded, &Watch::none()).unwrap().polynomials,
            direct.polynomials,
            "{}",
            case.file
        );
        let fewer = PolynomialRing::new(field, &case.variables[1..], Order::Lex).unwrap();
        let eliminated = quotient.basis_in(&fewer, &Watch::none()).unwrap();
        let kept = known.polynomials.iter().filter(|f| lex.degree_in(f, 0) == 0);
        let kept: Vec<_> = kept.map(|f| lex.transfer(f, &fewer).unwrap()).collect();
        assert_eq!(eliminated.polynomials, kept, "{}", case.file);
    }
}

#[test]
fn a_change_of_order_goes_back_and_eliminates() {
    let small = |case: &Case| is_lex_and_finite(case) && case.facts.quotient_dimension <= Some(12);
    assert!(check_all(small, |case| over(&case.field, &case.parameters, &Back(case))) >= 15);
}

/// Systems on which the algorithm of NAO section 6.3, which has no criteria, takes longer than a second.
const REFERENCE_IS_SLOW: [&str; 14] = [
    "cyclic_5",
    "cyclic_6",
    "enneper-lex",
    "katsura_2-lex",
    "katsura_3",
    "katsura_4",
    "katsura_5",
    "katsura_6",
    "nao_arm-",
    "nao_arm_symbolic",
    "nao_leg-",
    "nao_leg_inverted",
    "nao_leg_symbolic",
    "noon_3-lex",
];

/// Systems whose cofactors are too large to be computed and checked in a second.
const PROOF_IS_SLOW: [&str; 10] = [
    "cyclic_5-lex",
    "cyclic_6",
    "enneper-lex",
    "katsura_3-lex",
    "katsura_4-lex",
    "katsura_5-grevlex-q",
    "katsura_5-lex",
    "katsura_6",
    "noon_3-lex",
    "large_coefficients-lex",
];

fn is_none_of(list: &'static [&str]) -> impl Fn(&Case) -> bool {
    |case| !list.iter().any(|start| case.file.starts_with(start))
}

/// The reference's basis and the known one reduce each other to zero, and the reference's basis passes the criterion.
struct Reference<'a>(&'a Case);

impl Check for Reference<'_> {
    fn run<F: Field>(&self, field: F) {
        let case = self.0;
        let ring = case.ring(&field);
        let known = read_basis(&ring, &case.basis);
        let found = buchberger(&ring, &case.generators(&ring), &Watch::none()).unwrap();
        assert!(is_groebner_basis(&ring, &found).unwrap(), "{}", case.file);
        let reduces = |f, by: &[_]| normal_form(&ring, f, by).unwrap().is_zero();
        assert!(found.iter().all(|f| reduces(f, &known)), "{}", case.file);
        assert!(known.iter().all(|f| reduces(f, &found)), "{}", case.file);
    }
}

#[test]
fn the_reference_finds_the_known_ideals() {
    let select = |case: &Case| is_none_of(&REFERENCE_IS_SLOW)(case) && case.file != "nao_leg_pose-lex-q";
    let cases = check_all(select, |case| over(&case.field, &case.parameters, &Reference(case)));
    assert!(cases >= 45, "{cases}");
}

/// The engine's cofactors prove the known basis.
struct Proved<'a>(&'a Case);

impl Check for Proved<'_> {
    fn run<F: Field>(&self, field: F) {
        let case = self.0;
        let ring = case.ring(&field);
        let generators = case.generators(&ring);
        let options = Options { strategy: Strategy::Normal, cofactors: true };
        let found = basis(&ring, &generators, &options, &Watch::none()).unwrap();
        let claim = Claim { generators: &generators, basis: &found.polynomials, cofactors: &found.cofactors };
        let proof = verify(&ring, &claim, &Watch::none()).unwrap_or_else(|error| panic!("{}: {error}", case.file));
        let size = found.polynomials.len();
        assert_eq!((proof.cofactor_rows, proof.generators), (size, generators.len()), "{}", case.file);
        assert_eq!(proof.pairs, size * size.saturating_sub(1) / 2, "{}", case.file);
    }
}

#[test]
fn the_checker_accepts_what_the_engine_proves() {
    let cases = check_all(is_none_of(&PROOF_IS_SLOW), |case| over(&case.field, &case.parameters, &Proved(case)));
    assert!(cases >= 60, "{cases}");
}

/// An obsolete name or an incorrectly read basis would make all tests above meaningless.
#[test]
fn the_lists_of_exceptions_name_files() {
    for (file, _) in SLOW.iter().chain(&HOPELESS) {
        assert!(!case(file).generators.is_empty());
    }
    let leg = case("nao_leg-lex-q_px_pz");
    assert_eq!((leg.basis.len(), leg.memberships.len(), leg.facts.quotient_dimension), (4, 5, Some(2)));
    assert!(leg.memberships.iter().any(|m| m.member) && leg.memberships.iter().any(|m| !m.member));
    let ring =
        leg.ring(&groebot_algebra::poly::Fractions::new(groebot_algebra::number::Rationals, &leg.parameters).unwrap());
    assert!(read_all(&ring, &leg.basis).iter().all(|f| !ring.is_zero(f)));
}
