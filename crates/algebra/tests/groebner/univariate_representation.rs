//! The rational univariate representation: planted solutions, a check of its definition with other arithmetic, and
//! refusals.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use groebot_algebra::groebner::{Basis, Options, UnivariateRepresentation, basis, univariate_representation};
use groebot_algebra::number::{BigInt, BigRational, Field, Rationals, Ring};
use groebot_algebra::poly::univariate::{Univariate, UnivariateRing};
use groebot_algebra::poly::{Order, Polynomial, PolynomialRing, Width, parse};
use groebot_algebra::{ErrorKind, Result, Watch};
use proptest::prelude::*;

use crate::corpus::groebner::{case, read_basis};

type Ground = PolynomialRing<Rationals>;
type Poly = Polynomial<BigRational>;

fn system(variables: &[&str], equations: &[&str]) -> (Ground, Vec<Poly>) {
    let ring = PolynomialRing::new(Rationals, variables, Order::GrevLex).unwrap();
    let generators = equations.iter().map(|text| parse(text).unwrap().evaluate(&ring).unwrap()).collect();
    (ring, generators)
}

fn basis_of(ring: &Ground, generators: &[Poly]) -> Basis<Rationals> {
    let found = basis(ring, generators, &Options::default(), &Watch::none()).unwrap();
    found.with_width(ring.layout().width()).unwrap()
}

fn represent(ring: &Ground, generators: &[Poly]) -> Result<UnivariateRepresentation> {
    univariate_representation(&basis_of(ring, generators), generators, &Watch::none())
}

fn over_rationals(ring: &UnivariateRing<Rationals>, f: &Univariate<BigInt>) -> Univariate<BigRational> {
    ring.polynomial(f.coefficients.iter().map(|c| BigRational::from_integer(c.clone())).collect())
}

/// `1 / a` modulo `f`, by Euclid's algorithm over Q.
fn inverse(
    ring: &UnivariateRing<Rationals>,
    a: &Univariate<BigRational>,
    f: &Univariate<BigRational>,
) -> Univariate<BigRational> {
    let (mut left, mut right) = (f.clone(), a.clone());
    let (mut left_factor, mut right_factor) = (ring.zero(), ring.one());
    while let Some((quotient, rest)) = ring.div_rem(&left, &right) {
        let factor = ring.sub(&left_factor, &ring.mul(&quotient, &right_factor));
        (left, right) = (right, rest);
        (left_factor, right_factor) = (right_factor, factor);
    }
    let unit = Rationals.inverse(left.leading().unwrap()).unwrap();
    ring.scale(&left_factor, &unit)
}

/// The definition: `f` is square-free, the generators vanish at `g / f'` modulo `f`, and the form takes the value `t` there.
fn assert_represents(representation: &UnivariateRepresentation, ring: &Ground, generators: &[Poly]) {
    let line = UnivariateRing::new(Rationals, "t");
    let f = over_rationals(&line, &representation.polynomial);
    let slope = line.derivative(&f);
    assert_eq!(line.gcd(&f, &slope).degree(), Some(0), "f is square-free");
    let reduce = |p: &Univariate<BigRational>| line.div_rem(p, &f).unwrap().1;
    let denominator = inverse(&line, &slope, &f);
    let numerators = representation.numerators.iter();
    let values: Vec<_> = numerators.map(|g| reduce(&line.mul(&over_rationals(&line, g), &denominator))).collect();
    let constant = |c: &BigRational| line.monomial(c.clone(), 0);
    for generator in generators {
        assert!(line.is_zero(&reduce(&ring.substitute(generator, &line, &values, constant))), "a generator vanishes");
    }
    let terms = representation.form.iter().zip(&values);
    let form =
        terms.fold(line.zero(), |sum, (&c, x)| line.add(&sum, &line.scale(x, &BigRational::from_integer(c.into()))));
    assert_eq!(form, reduce(&line.monomial(line.field().one(), 1)), "the form is the parameter");
}

/// A univariate polynomial with planted roots and multiplicities: `product (x - n/d)^m`.
fn planted(variable: &str, roots: &[(i64, i64, usize)]) -> String {
    let factor = |&(n, d, m): &(i64, i64, usize)| format!("({d}*({variable}) - ({n}))^{m}");
    roots.iter().map(factor).collect::<Vec<_>>().join("*")
}

fn roots(denominator: i64) -> impl Strategy<Value = Vec<(i64, i64, usize)>> {
    prop::collection::btree_map(-9i64..9, 1usize..3, 1..4)
        .prop_map(move |map| map.into_iter().map(|(n, m)| (n, denominator, m)).collect())
}

proptest! {
    #![proptest_config(crate::cases(24))]

    /// `p(x + a y) = q(y + b x) = 0`: a grid of points, each with the product of two multiplicities.
    #[test]
    fn grids_of_multiple_points_are_found(p in roots(1), q in roots(3), a in -2i64..3, b in -2i64..3) {
        prop_assume!(a * b != 1);
        let equations = [planted(&format!("x + {a}*y"), &p), planted(&format!("y + {b}*x"), &q)];
        let (ring, generators) = system(&["x", "y"], &[&equations[0], &equations[1]]);
        let representation = represent(&ring, &generators).unwrap();
        assert_represents(&representation, &ring, &generators);
        prop_assert_eq!(representation.count(), p.len() * q.len());
        let mut expected = std::collections::BTreeMap::new();
        for (_, _, m) in &p {
            for (_, _, n) in &q {
                *expected.entry(m * n).or_insert(0usize) += 1;
            }
        }
        let found = representation.multiplicities.iter().map(|(m, f)| (*m, f.degree().unwrap())).collect();
        prop_assert_eq!(expected, found);
    }

    #[test]
    fn random_quadrics_meet_in_the_number_of_points_of_bezouts_theorem(c in prop::collection::vec(-9i64..10, 18)) {
        let quadric = |c: &[i64]| {
            let monomials = ["x^2", "x*y", "y^2", "x", "y", "1"];
            monomials.iter().zip(c).map(|(m, c)| format!("({c})*{m}")).collect::<Vec<_>>().join(" + ")
        };
        let (ring, generators) = system(&["x", "y"], &[&quadric(&c[..6]), &quadric(&c[6..12])]);
        let found = basis_of(&ring, &generators);
        prop_assume!(found.quotient_dimension() == Some(4));
        let representation = univariate_representation(&found, &generators, &Watch::none()).unwrap();
        assert_represents(&representation, &ring, &generators);
        let total: usize = representation.multiplicities.iter().map(|(m, f)| m * f.degree().unwrap()).sum();
        prop_assert_eq!(total, 4);
    }
}

#[test]
fn fat_points_that_no_single_curve_holds() {
    for (equations, count, multiplicity) in [
        (&["x^2", "x*y", "y^2"][..], 1, 3),
        (&["(x-1)^3", "(x-1)*(y+2)", "(y+2)^4"], 1, 6),
        (&["x^2*y^2 - x^2", "x*y*(x-y)", "y^3 - y^5", "x^3 - x^5"], 5, 0),
    ] {
        let (ring, generators) = system(&["x", "y"], equations);
        let representation = represent(&ring, &generators).unwrap();
        assert_represents(&representation, &ring, &generators);
        if multiplicity > 0 {
            assert_eq!((representation.count(), representation.multiplicities[0].0), (count, multiplicity));
        }
        let total: usize = representation.multiplicities.iter().map(|(m, f)| m * f.degree().unwrap()).sum();
        assert_eq!(Some(total), basis_of(&ring, &generators).quotient_dimension());
    }
}

/// A point with smaller multiplicity that shares the value of a coordinate with another point. No coordinate may be
/// used as a separating form, and the hidden point must be found.
#[test]
fn points_with_equal_coordinates_are_distinguished() {
    let (ring, generators) = system(&["x", "y"], &["x^2*(x-1)", "y*(y-1)", "x*(x-1)*y", "x*(1-y)*(x-1)"]);
    let representation = represent(&ring, &generators).unwrap();
    assert_represents(&representation, &ring, &generators);
    assert_eq!(representation.count(), 4);
    assert!(representation.form.iter().all(|&c| c != 0));
}

#[test]
fn a_basis_in_any_order_serves() {
    let equations = ["x^2 + y^2 + z^2 - 3", "x*y + z - 2", "x^3 - y*z"];
    let (ring, generators) = system(&["x", "y", "z"], &equations);
    let graded = represent(&ring, &generators).unwrap();
    let lex = PolynomialRing::new(Rationals, ring.variables(), Order::Lex).unwrap();
    let moved: Vec<_> = generators.iter().map(|f| ring.transfer(f, &lex).unwrap()).collect();
    let representation = represent(&lex, &moved).unwrap();
    assert_represents(&representation, &lex, &moved);
    assert_eq!((representation.count(), representation), (graded.count(), graded));
}

#[test]
fn degrees_that_outgrow_the_lanes_of_the_basis_are_no_obstacle() {
    let (ring, generators) = system(&["x", "y"], &["x^127 - 2", "y^2 - x"]);
    let narrow = basis_of(&ring, &generators).with_width(Width::Bits8).unwrap();
    let moved: Vec<_> = generators.iter().map(|f| ring.transfer(f, &narrow.ring).unwrap()).collect();
    let representation = univariate_representation(&narrow, &moved, &Watch::none()).unwrap();
    assert_eq!((representation.count(), representation.form), (254, vec![0, 1]));
}

#[test]
fn one_point_and_no_variables() {
    let (ring, generators) = system(&["x", "y"], &["2*x - 1", "x + y"]);
    let representation = represent(&ring, &generators).unwrap();
    assert_represents(&representation, &ring, &generators);
    let (ring, generators) = system(&[], &["0"]);
    assert_eq!(represent(&ring, &generators).unwrap().count(), 1);
}

/// The bases are Singular's (tests/corpus); all solutions are simple.
#[test]
fn katsura_6_and_cyclic_6_have_as_many_points_as_their_dimension() {
    for (name, count) in [("katsura_6-grevlex-q", 64), ("cyclic_6-grevlex-q", 156)] {
        let case = case(name);
        let ring = case.ring(&Rationals);
        let polynomials = read_basis(&ring, &case.basis);
        let basis = Basis { ring: ring.clone(), polynomials, cofactors: Vec::new() };
        let representation = univariate_representation(&basis, &case.generators(&ring), &Watch::none()).unwrap();
        assert_eq!(representation.count(), count);
        assert_eq!(representation.multiplicities[0].0, 1);
    }
}

#[test]
fn ideals_without_finitely_many_points_are_refused() {
    let (ring, generators) = system(&["x", "y"], &["x*y - 1", "x*y - 2"]);
    assert_eq!(represent(&ring, &generators).unwrap_err().kind(), ErrorKind::Inconsistent);
    let (ring, generators) = system(&["x", "y"], &["x*y - 1"]);
    assert_eq!(represent(&ring, &generators).unwrap_err().kind(), ErrorKind::PositiveDimensional);
}

#[test]
fn the_basis_of_another_ideal_is_refused() {
    let (ring, generators) = system(&["x", "y"], &["x^2 + y^2 - 5", "x*y - 2"]);
    let (_, others) = system(&["x", "y"], &["x^2 + y^2 - 5", "x*y - 1"]);
    let error = univariate_representation(&basis_of(&ring, &others), &generators, &Watch::none()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::BadValue);
    let (_, unreduced) = system(&["x", "y"], &["x^2 - 1", "y - x^3"]);
    let wrong = Basis { ring, polynomials: unreduced, cofactors: Vec::new() };
    assert_eq!(
        univariate_representation(&wrong, &[], &Watch::none()).unwrap_err().kind(),
        ErrorKind::PositiveDimensional
    );
}

#[test]
fn a_raised_flag_ends_the_work() {
    let (ring, generators) = system(&["x", "y"], &["x^2 + y^2 - 5", "x*y - 2"]);
    let watch = Watch::none().with_cancel(Arc::new(AtomicBool::new(true)));
    let error = univariate_representation(&basis_of(&ring, &generators), &generators, &watch).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Cancelled);
}

#[test]
fn polynomials_are_evaluated_at_the_points() {
    let (ring, generators) = system(&["x", "y"], &["x^2 - 2", "y - x - 1"]);
    let representation = represent(&ring, &generators).unwrap();
    let h = parse("y^2/3 - 2*x/3").unwrap().evaluate(&ring).unwrap();
    let (value, factor) = representation.substitute(&ring, &h, &Watch::none()).unwrap();
    let line = UnivariateRing::new(Rationals, "t");
    let [f, value, slope] =
        [&representation.polynomial, &value, &representation.slope()].map(|p| over_rationals(&line, p));
    let expected = line.scale(&line.mul(&slope, &slope), &BigRational::from_integer(factor));
    assert!(line.checked_div(&line.sub(&value, &expected), &f).is_some(), "(x + 1)^2/3 - 2 x/3 = 1 where x^2 = 2");
    let (other, _) = system(&["y", "x"], &[]);
    assert_eq!(
        representation.substitute(&other, &other.one(), &Watch::none()).unwrap_err().kind(),
        ErrorKind::BadValue
    );
}
