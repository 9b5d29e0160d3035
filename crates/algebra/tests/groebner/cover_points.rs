//! At random points of every stratum, the specialised basis equals the basis computed at the point: over Q, prime
//! fields and extensions.

use groebot_algebra::ErrorKind;
use groebot_algebra::Watch;
use groebot_algebra::groebner::cover::{Candidates, Cover, Region, Space, check, cover, rational_roots, sample};
use groebot_algebra::groebner::{Options, Strategy as Selection, basis};
use groebot_algebra::number::{BigInt, BigRational, Extension, Field, Rationals, Ring, Zp};
use groebot_algebra::poly::univariate::{Univariate, UnivariateRing};
use groebot_algebra::poly::{Fraction, Fractions, Order, Polynomial, PolynomialRing};
use proptest::prelude::*;

use crate::corpus::cover::{System, all};
use crate::poly::sparse::{Sparse, build, sparse};

type Parametric<F> = Polynomial<Fraction<<F as Ring>::Element>>;

/// Pseudorandom numbers, the same every time.
struct Dice(u64);

impl Dice {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % limit
    }
}

/// A cover over `F` and a field `G` for points.
struct Setting<'a, F: Field, G: Field, Embed> {
    cover: &'a Cover<F>,
    generators: &'a [Parametric<F>],
    field: G,
    embed: Embed,
}

impl<F: Field, G: Field, Embed: Fn(&F::Element) -> G::Element> Setting<'_, F, G, Embed> {
    /// Asserts that at `point` there is exactly one stratum, whose specialised basis is the basis of the specialised generators.
    fn agrees_at(&self, point: &[G::Element]) {
        let ring = &self.cover.ring;
        let parameters = ring.field().ring();
        let inside = |region: &Region<F::Element>| region.contains(parameters, &self.field, point, &self.embed);
        let hits: Vec<_> = self.cover.strata.iter().filter(|stratum| inside(&stratum.region)).collect();
        assert_eq!(hits.len(), 1, "{point:?} lies on one stratum");
        let order = ring.layout().order().clone();
        let target = PolynomialRing::new(self.field.clone(), ring.variables(), order).unwrap();
        let value = |c: &Fraction<F::Element>| parameters.substitute(c.numerator(), &self.field, point, &self.embed);
        let system: Vec<_> =
            self.generators.iter().map(|f| ring.map_into(f, &target, |c| Ok(value(c))).unwrap()).collect();
        let options = Options { strategy: Selection::Normal, cofactors: false };
        let fresh = basis(&target, &system, &options, &Watch::none()).unwrap();
        let specialised = hits[0].specialise(ring, point, &target, &self.embed).unwrap();
        assert_eq!(specialised.polynomials, fresh.polynomials, "at {point:?}");
    }

    /// Points on the strata, `tries` on each.
    fn points(&self, tries: usize, candidates: &mut Candidates<'_, G::Element>) -> Vec<Vec<G::Element>> {
        let parameters = self.cover.ring.field().ring();
        let ring = PolynomialRing::new(self.field.clone(), parameters.variables(), Order::GrevLex).unwrap();
        let image = |f: &Polynomial<F::Element>| parameters.map_into(f, &ring, |c| Ok((self.embed)(c))).unwrap();
        let images = |list: &Vec<Polynomial<F::Element>>| list.iter().map(image).collect::<Vec<_>>();
        let mut points = Vec::new();
        for stratum in &self.cover.strata {
            let exclusions = stratum.region.exclusions.iter().map(images).collect();
            let region = Region { equations: images(&stratum.region.equations), exclusions };
            for _ in 0..tries {
                points.extend(sample(&ring, &region, candidates, &Watch::none()).unwrap());
            }
        }
        points
    }
}

/// Points of a finite field given by all its elements.
fn finite_candidates<G: Field>(
    field: &G,
    elements: Vec<G::Element>,
) -> impl FnMut(Option<&Univariate<G::Element>>) -> Vec<G::Element> {
    let (ring, field, mut dice) = (UnivariateRing::new(field.clone(), "x"), field.clone(), Dice(7));
    move |condition| match condition {
        None => (0..4).map(|_| elements[dice.below(elements.len())].clone()).collect(),
        Some(f) => elements.iter().filter(|x| field.is_zero(&ring.evaluate(f, x))).cloned().collect(),
    }
}

/// Number of points that were compared over GF(p) and over the extension `t^d + low`.
fn compared_over(system: &System, p: u64, low: Vec<u64>) -> usize {
    let prime = Zp::new(p).unwrap();
    if !system.exists_over(&prime) {
        return 0;
    }
    let ring = system.ring(prime);
    let generators = system.generators(&ring);
    let found = cover(&ring, &generators, &Space::all(), &Watch::none()).unwrap();
    let base = Setting { cover: &found, generators: &generators, field: prime, embed: |c: &u64| *c };
    let points = base.points(2, &mut finite_candidates(&prime, (0..p).collect()));
    points.iter().for_each(|point| base.agrees_at(point));
    let larger = Extension::new(prime, "t", low).unwrap();
    let embed = |c: &u64| larger.embed(c);
    let extended = Setting { cover: &found, generators: &generators, field: larger.clone(), embed };
    let elements = elements(&larger, p);
    let more = extended.points(2, &mut finite_candidates(&larger, elements));
    more.iter().for_each(|point| extended.agrees_at(point));
    points.len() + more.len()
}

fn elements(field: &Extension<Zp>, p: u64) -> Vec<Vec<u64>> {
    let digits = |mut n: u64| {
        let digit = |_| {
            let digit = n % p;
            n /= p;
            digit
        };
        (0..field.degree()).map(digit).collect()
    };
    (0..p.pow(field.degree() as u32)).map(digits).collect()
}

/// 2 is not a square modulo 11 and 13, 3 not modulo 7; t^3 + t + 1 has no root modulo 5.
#[test]
fn specialised_bases_over_finite_fields() {
    for (p, low) in [(11, vec![9, 0]), (13, vec![11, 0]), (7, vec![4, 0]), (5, vec![1, 1, 0])] {
        let points: usize = all().iter().map(|system| compared_over(system, p, low.clone())).sum();
        assert!(points >= 150, "only {points} points modulo {p}");
    }
}

#[test]
fn specialised_bases_over_a_larger_prime() {
    let points: usize = all().iter().map(|system| compared_over_prime(system, 251)).sum();
    assert!(points >= 150, "only {points} points");
}

fn compared_over_prime(system: &System, p: u64) -> usize {
    let field = Zp::new(p).unwrap();
    let ring = system.ring(field);
    let generators = system.generators(&ring);
    let found = cover(&ring, &generators, &Space::all(), &Watch::none()).unwrap();
    let setting = Setting { cover: &found, generators: &generators, field, embed: |c: &u64| *c };
    let points = setting.points(3, &mut finite_candidates(&field, (0..p).collect()));
    points.iter().for_each(|point| setting.agrees_at(point));
    points.len()
}

#[test]
fn specialised_bases_over_the_rationals() {
    let mut dice = Dice(11);
    let mut candidates = |condition: Option<&Univariate<BigRational>>| match condition {
        Some(f) => rational_roots(f),
        None => {
            let mut value = |_| BigRational::new(BigInt::from(dice.below(19)) - 9, BigInt::from(dice.below(3)) + 1);
            (0..8).map(&mut value).collect()
        }
    };
    let mut compared = 0;
    for system in all() {
        let ring = system.ring(Rationals);
        let generators = system.generators(&ring);
        let found = cover(&ring, &generators, &Space::all(), &Watch::none()).unwrap();
        let setting = Setting { cover: &found, generators: &generators, field: Rationals, embed: BigRational::clone };
        let points = setting.points(3, &mut candidates);
        points.iter().for_each(|point| setting.agrees_at(point));
        compared += points.len();
    }
    assert!(compared >= 180, "{compared}");
}

/// A random system in x, y with parameters a, b: its cover is proved, and correct at every point of a small plane.
fn is_covered(systems: &[Sparse]) -> bool {
    let prime = Zp::new(7).unwrap();
    let names = PolynomialRing::new(prime, &["x", "y", "a", "b"], Order::Lex).unwrap();
    let ring = PolynomialRing::new(Fractions::new(prime, &["a", "b"]).unwrap(), &["x", "y"], Order::Lex).unwrap();
    let values: Vec<_> = ["x", "y", "a", "b"].iter().map(|name| ring.generator(name).unwrap()).collect();
    let number = |c: &u64| ring.from_integer(&BigInt::from(*c));
    let generators: Vec<_> =
        systems.iter().map(|f| names.substitute(&build(&names, f), &ring, &values, number)).collect();
    let watch = Watch::none().with_time(std::time::Duration::from_millis(500));
    let found = match cover(&ring, &generators, &Space::all(), &watch) {
        Ok(found) => found,
        Err(error) => {
            assert_eq!(error.kind(), ErrorKind::Budget);
            return false;
        }
    };
    match check(&found, &generators, &watch) {
        Ok(proof) => assert_eq!(proof.strata, found.strata.len()),
        Err(error) => assert_eq!(error.kind(), ErrorKind::Budget, "{error}\n{found}"),
    }
    let setting = Setting { cover: &found, generators: &generators, field: prime, embed: |c: &u64| *c };
    for a in 0..7 {
        (0..7).for_each(|b| setting.agrees_at(&[a, b]));
    }
    true
}

proptest! {
    #![proptest_config(crate::cases(40))]

    #[test]
    fn random_systems(systems in prop::collection::vec(sparse(4, 3, 2), 1..3)) {
        prop_assume!(is_covered(&systems));
    }
}
