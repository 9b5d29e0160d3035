//! Covers of known systems: proofs, number of strata compared with Singular, texts, and refusal of wrong covers.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use groebot_algebra::groebner::cover::{Cover, Kind, RealPoints, Space, check, cover};
use groebot_algebra::number::{BigRational, Rationals, Ring};
use groebot_algebra::poly::{Fraction, Fractions, Order, Polynomial, PolynomialRing};
use groebot_algebra::{ErrorKind, Watch};

use crate::corpus::cover::{System, all, system};
use crate::corpus::{read, read_all};

type Parametric = Polynomial<Fraction<BigRational>>;

fn covered(system: &System, space: &Space<BigRational>) -> (Cover<Rationals>, Vec<Parametric>) {
    let ring = system.ring(Rationals);
    let generators = system.generators(&ring);
    let found = cover(&ring, &generators, space, &Watch::none()).unwrap_or_else(|e| panic!("{}: {e}", system.name));
    (found, generators)
}

/// Every property of a cover is proved, and Singular's grobcov.lib, which produced the corpus, has no fewer segments.
#[test]
fn every_system_is_covered_with_no_more_strata_than_singular_has() {
    let systems = all();
    assert!(systems.len() >= 20);
    for system in &systems {
        let (found, generators) = covered(system, &Space::all());
        let strata = found.strata.len();
        assert!(strata <= system.segments, "{}: {strata} strata, Singular {}", system.name, system.segments);
        let proof = check(&found, &generators, &Watch::none()).unwrap_or_else(|e| panic!("{}: {e}", system.name));
        assert_eq!((proof.strata, proof.disjoint_pairs), (strata, strata * (strata - 1) / 2), "{}", system.name);
    }
}

/// Numbers of solutions of the leg, by hand. Hip and ankle cannot coincide at the origin with legs of 100 and 102.9. On
/// the isotropic lines c4 is still determined, and the equations are linear.
#[test]
fn the_strata_of_the_nao_leg() {
    let leg = system("nao_leg");
    let (found, _) = covered(&leg, &Space::all());
    let parameters = found.ring.field().ring();
    let kind_at = |equations: &[&str]| {
        let equations: Vec<_> = equations.iter().map(|text| read(parameters, text)).collect();
        let hits = found.strata.iter().filter(|stratum| stratum.region.equations == equations);
        hits.map(|stratum| stratum.kind).collect::<Vec<_>>()
    };
    assert_eq!(found.strata.len(), 4);
    assert_eq!(kind_at(&[]), [Kind::Finite(2)]);
    assert_eq!(kind_at(&["pz"]), [Kind::Finite(2)]);
    assert_eq!(kind_at(&["px^2 + pz^2"]), [Kind::Finite(1)]);
    assert_eq!(kind_at(&["pz", "px"]), [Kind::Inconsistent]);
}

#[test]
fn the_leg_in_words() {
    let (found, _) = covered(&system("nao_leg"), &Space::all());
    let text = found.with_real_points(&Watch::none()).unwrap().to_string();
    for line in [
        "parameters px, pz: four strata; solutions are complex and counted with multiplicity",
        "where pz = 0 and px != 0: two solutions; for instance at px = 1, pz = 0",
        "where px^2 + pz^2 = 0 and pz != 0: one solution; no real point: px^2 + pz^2 is zero at no real point here",
        "where pz = 0 and px = 0: no solution",
    ] {
        assert!(text.contains(line), "{line}\nis not in\n{text}");
    }
}

/// The quadratic equation.
#[test]
fn the_quadratic_equation_has_four_strata() {
    let (found, _) = covered(&system("quadratic"), &Space::all());
    let value = |n: i64| BigRational::from_integer(n.into());
    let kind = |a, b, c| found.at(&Rationals, &[value(a), value(b), value(c)], &BigRational::clone).unwrap().kind;
    assert_eq!(kind(1, 0, 0), Kind::Finite(2));
    assert_eq!(kind(0, 5, 7), Kind::Finite(1));
    assert_eq!(kind(0, 0, 7), Kind::Inconsistent);
    assert_eq!(kind(0, 0, 0), Kind::Family(1));
}

/// An element may need two polynomials: where `a d = b c`, the root of `a x + b` and `c x + d` is `-b/a` or `-d/c`.
#[test]
fn an_element_with_two_representatives() {
    let (found, _) = covered(&system("linear_two_in_one"), &Space::all());
    let most =
        found.strata.iter().flat_map(|stratum| &stratum.basis).map(|element| element.representatives.len()).max();
    assert_eq!(most, Some(2));
}

/// With nonzero lengths there are fewer strata, and they still cover the whole space.
#[test]
fn a_space_without_zero_lengths() {
    let leg = system("nao_leg_symbolic");
    let ring = leg.ring(Rationals);
    let lengths = read_all(ring.field().ring(), &["L1".to_owned(), "L2".to_owned()]);
    let (all, _) = covered(&leg, &Space::all());
    let (found, generators) = covered(&leg, &Space { equations: Vec::new(), nonzero: lengths });
    check(&found, &generators, &Watch::none()).unwrap();
    assert!(found.strata.len() < all.strata.len());
    let point = [1, 1, 0, 1].map(|n: i64| BigRational::from_integer(n.into()));
    assert!(found.at(&Rationals, &point, &BigRational::clone).is_none(), "L1 = 0 was left out");
    assert!(all.at(&Rationals, &point, &BigRational::clone).is_some());
}

/// Equations on the parameters: the leg on the line pz = 0 has one stratum less than without them.
#[test]
fn a_space_with_an_equation() {
    let leg = system("nao_leg");
    let line = read(leg.ring(Rationals).field().ring(), "pz");
    let (found, generators) = covered(&leg, &Space { equations: vec![line], nonzero: Vec::new() });
    check(&found, &generators, &Watch::none()).unwrap();
    let kinds: Vec<_> = found.strata.iter().map(|stratum| stratum.kind).collect();
    assert_eq!(kinds, [Kind::Finite(2), Kind::Inconsistent]);
}

/// Parameters with a relation, c^2 + s^2 = 1: `c x = s` has no solution where c = 0, as s is not zero there.
#[test]
fn related_parameters_keep_their_relation() {
    let fractions = Fractions::new(Rationals, &["c", "s"]).unwrap();
    let square = read(fractions.ring(), "1 - c^2");
    let ring = PolynomialRing::new(fractions.with_square(1, &square).unwrap(), &["x"], Order::Lex).unwrap();
    let generators = [read(&ring, "c*x - s")];
    let found = cover(&ring, &generators, &Space::all(), &Watch::none()).unwrap();
    check(&found, &generators, &Watch::none()).unwrap();
    let mut kinds: Vec<_> = found.strata.iter().map(|stratum| stratum.kind).collect();
    kinds.sort_by_key(|kind| *kind == Kind::Inconsistent);
    assert_eq!(kinds, [Kind::Finite(1), Kind::Inconsistent]);
}

#[test]
fn an_impossible_space_has_no_strata() {
    let leg = system("nao_leg");
    let one = leg.ring(Rationals).field().ring().one();
    let (found, generators) = covered(&leg, &Space { equations: vec![one], nonzero: Vec::new() });
    assert!(found.strata.is_empty());
    check(&found, &generators, &Watch::none()).unwrap();
}

/// No generators, no unknowns in them, zeros: every point is a solution, or the parameters alone decide.
#[test]
fn equations_that_say_little() {
    let ring = system("linear_one").ring(Rationals);
    let kinds = |texts: &[&str]| {
        let generators: Vec<_> = texts.iter().map(|text| read(&ring, text)).collect();
        let found = cover(&ring, &generators, &Space::all(), &Watch::none()).unwrap();
        check(&found, &generators, &Watch::none()).unwrap();
        found.strata.iter().map(|stratum| stratum.kind).collect::<Vec<_>>()
    };
    assert_eq!(kinds(&[]), [Kind::Family(1)]);
    assert_eq!(kinds(&["0"]), [Kind::Family(1)]);
    assert_eq!(kinds(&["3"]), [Kind::Inconsistent]);
    assert_eq!(kinds(&["u*v"]), [Kind::Inconsistent, Kind::Family(1)]);
}

fn refusal(change: impl FnOnce(&mut Cover<Rationals>)) -> String {
    let (mut found, generators) = covered(&system("nao_leg"), &Space::all());
    change(&mut found);
    let error = check(&found, &generators, &Watch::none()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Certificate);
    error.message().to_owned()
}

#[test]
fn false_covers_are_refused() {
    let line = |found: &Cover<Rationals>| {
        let pz = read(found.ring.field().ring(), "pz");
        found.strata.iter().position(|stratum| stratum.region.equations == [pz.clone()]).unwrap()
    };
    let check_message = |text: &str, part: &str| assert!(text.contains(part), "{text}");
    let missing = refusal(|found| drop(found.strata.remove(line(found))));
    check_message(&missing, "no stratum contains the points where pz = 0");
    check_message(&refusal(|found| found.strata.push(found.strata[0].clone())), "share points");
    check_message(&refusal(|found| found.strata[0].region.exclusions.clear()), "share points");
    let strange = refusal(|found| {
        let generic = found.strata[0].basis.clone();
        let index = line(found);
        found.strata[index].basis = generic;
    });
    check_message(&strange, "leading coefficients vanish");
    check_message(&refusal(|found| drop(found.strata[0].basis.pop())), "does not reduce to zero");
    let shifted = refusal(|found| {
        let f = &mut found.strata[0].basis[0].representatives[0];
        *f = found.ring.add(f, &found.ring.one());
    });
    check_message(&shifted, "is not everywhere in the ideal");
}

#[test]
fn denominators_are_refused() {
    let ring = system("linear_one").ring(Rationals);
    let error = cover(&ring, &[read(&ring, "x + 1/u")], &Space::all(), &Watch::none()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::BadValue);
    assert!(error.message().contains("multiply the equation"), "{error}");
}

#[test]
fn a_cover_stops_on_request() {
    let leg = system("nao_leg_symbolic");
    let ring = leg.ring(Rationals);
    let stopped = |watch: &Watch| cover(&ring, &leg.generators(&ring), &Space::all(), watch).unwrap_err().kind();
    let raised = Watch::none().with_cancel(Arc::new(AtomicBool::new(true)));
    assert_eq!(stopped(&raised), ErrorKind::Cancelled);
    assert_eq!(stopped(&Watch::none().with_time(Duration::from_millis(1))), ErrorKind::Budget);
    assert_eq!(stopped(&Watch::none().with_terms(20)), ErrorKind::Budget);
}

/// Zero sets of polynomials, and whether they have real points: by hand.
#[test]
fn real_points_of_zero_sets() {
    let verdict = |zero: &str| {
        let fractions = Fractions::new(Rationals, &["a", "b"]).unwrap();
        let ring = PolynomialRing::new(fractions, &["x"], Order::Lex).unwrap();
        let generators = [read(&ring, &format!("({zero})*x - 1"))];
        let found = cover(&ring, &generators, &Space::all(), &Watch::none()).unwrap();
        let found = found.with_real_points(&Watch::none()).unwrap();
        found.strata.into_iter().find(|stratum| stratum.kind == Kind::Inconsistent).unwrap().real
    };
    for none in
        ["a^2 + 1", "a^2 + a*b + b^2 + 1", "a^4 + a + 1", "(a^2 + 1)*(b^4 + a^2 + 3)", "a^2 - 4*a*b + 5*b^2 - 2*b + 2"]
    {
        assert!(matches!(verdict(none), RealPoints::None(_)), "{none}: {:?}", verdict(none));
    }
    for rational in
        ["a^2 + b^2", "a*b", "a*b + 1", "a + b^2 + 1", "a^2 + b^2 - 1", "a^2 + 2*a*b + b^2", "a^2*b^2 + a^2 + b^2"]
    {
        assert!(matches!(verdict(rational), RealPoints::At(_)), "{rational}: {:?}", verdict(rational));
    }
    for irrational in ["a^2 - 2", "a^3 - 2", "a^3 + 2", "a^2 + b^2 - 3", "a^4 - 2*b^4 - 7"] {
        assert!(matches!(verdict(irrational), RealPoints::Some(_)), "{irrational}: {:?}", verdict(irrational));
    }
}

/// A sample point is on its stratum.
#[test]
fn exhibited_points_lie_on_their_strata() {
    let mut exhibited = 0;
    for system in all() {
        let (found, _) = covered(&system, &Space::all());
        let found = found.with_real_points(&Watch::none()).unwrap();
        for stratum in &found.strata {
            if let RealPoints::At(point) = &stratum.real {
                assert_eq!(found.at(&Rationals, point, &BigRational::clone), Some(stratum), "{}", system.name);
                exhibited += 1;
            }
        }
    }
    assert!(exhibited >= 60, "{exhibited}");
}

/// The solution 1/a changes to 0 at a = 0. Both strata have the leading monomial x, but no polynomial has the correct
/// value on both.
#[test]
fn strata_without_a_common_basis_stay_apart() {
    let (found, _) = covered(&system("jump"), &Space::all());
    let kinds: Vec<_> = found.strata.iter().map(|stratum| stratum.kind).collect();
    assert_eq!(kinds, [Kind::Finite(1), Kind::Finite(1)]);
}
