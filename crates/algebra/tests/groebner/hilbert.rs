//! Hilbert series against Singular's and against the definition.

use groebot_algebra::groebner::{Basis, HilbertSeries, Options, Quotient, basis};
use groebot_algebra::number::{BigInt, BigRational, Field, Rationals};
use groebot_algebra::poly::univariate::UnivariateRing;
use groebot_algebra::poly::{Order, PolynomialRing};
use groebot_algebra::{ErrorKind, Watch};
use proptest::prelude::*;

use crate::corpus::groebner::case;
use crate::corpus::{Check, over, read_all};
use crate::poly::sparse::{build, sparse};

/// A file of the corpus with its first and second series, its dimension (-1 for the unit ideal) and its degree.
type Known = (&'static str, &'static [i64], &'static [i64], i64, i64);

/// Computed by Singular 4.3.1: `ideal j = std(i); hilb(j, 1); hilb(j, 2); dim(j); mult(j);` over each file's generators
/// in order dp.
const CORPUS: [Known; 17] = [
    ("circle_parametrised-grevlex-q", &[1, 0, -3, 2], &[1, 2], 1, 3),
    ("cyclic_4-grevlex-q", &[1, -1, -1, 0, 1, 0, 1, 0, -2, 1], &[1, 2, 2, 1, 0, -1, -1], 1, 4),
    ("cyclic_5-grevlex-q", &[1, -1, -1, -1, -1, 12, -14, 6, 1, 1, -13, 15, -5], &[1, 4, 9, 14, 14, 13, 10, 5], 0, 70),
    (
        "cyclic_6-grevlex-gf32003",
        &[1, -1, -1, -4, 1, 34, -60, 37, -5, 3, -1, -34, 59, -36, 6, 1],
        &[1, 5, 14, 25, 26, 26, 25, 21, 12, 1],
        0,
        156,
    ),
    ("enneper-grevlex-q", &[1, 0, -1, -7, 12, -5], &[1, 3, 5], 2, 9),
    ("fat_point-grevlex-q", &[1, 0, -2, 0, 1], &[1, 2, 1], 0, 4),
    ("generic_minors_3x3-grevlex-q", &[1, 0, -9, 16, -9, 0, 1], &[1, 4, 1], 5, 6),
    ("inconsistent-grevlex-q", &[], &[], -1, 0),
    ("katsura_4-grevlex-q", &[1, -1, -4, 4, 6, -6, -4, 4, 1, -1], &[1, 4, 6, 4, 1], 0, 16),
    ("nodal_cubic-grevlex-q", &[1, 0, -3, 2], &[1, 2], 1, 3),
    ("noon_3-grevlex-q", &[1, 0, 0, -3, -2, 3, 5, -4], &[1, 3, 6, 7, 4], 0, 21),
    ("redundant-grevlex-q", &[1, 0, -3, 2], &[1, 2], 0, 3),
    ("twisted_cubic-grevlex-q", &[1, 0, -3, 2], &[1, 2], 1, 3),
    ("twisted_cubic_parametrised-grevlex-q", &[1, -1, -3, 5, -2], &[1, 2], 1, 3),
    ("twisted_cubic_projective-grevlex-q", &[1, 0, -3, 2], &[1, 2], 2, 3),
    ("whitney_umbrella-grevlex-q", &[1, -1, -3, 5, -2], &[1, 2], 2, 3),
    ("zero_ideal-grevlex-q", &[1], &[1], 2, 1),
];

fn integers(list: &[i64]) -> Vec<BigInt> {
    list.iter().map(|&n| BigInt::from(n)).collect()
}

fn agrees<F: Field>(found: &Basis<F>, known: &Known) {
    let (name, first, second, dimension, degree) = *known;
    let series = found.hilbert_series().unwrap();
    assert_eq!(series.numerator, integers(first), "{name}: first series");
    let reduced = (integers(second), usize::try_from(dimension).unwrap_or(0));
    assert_eq!(series.reduced(), reduced, "{name}: second series");
    assert_eq!(series.dimension(), usize::try_from(dimension).ok(), "{name}: dimension");
    assert_eq!(series.dimension(), found.independent_variables().map(|free| free.len()), "{name}: dimension");
    assert_eq!(found.degree().unwrap(), BigInt::from(degree), "{name}: degree");
    if dimension == 0 {
        assert_eq!(Some(Quotient::new(found).unwrap().dimension()), usize::try_from(degree).ok(), "{name}: solutions");
    }
}

struct Series<'a>(&'a Known);

impl Check for Series<'_> {
    fn run<F: Field>(&self, field: F) {
        let case = case(self.0.0);
        let ring = case.ring(&field);
        agrees(&basis(&ring, &case.generators(&ring), &Options::default(), &Watch::none()).unwrap(), self.0);
    }
}

#[test]
fn the_series_of_the_corpus_are_singulars() {
    for known in &CORPUS {
        over(&case(known.0).field, &[], &Series(known));
    }
}

fn graded(variables: &[&str], texts: &[&str]) -> Basis<Rationals> {
    let ring = PolynomialRing::new(Rationals, variables, Order::GrevLex).unwrap();
    let texts: Vec<String> = texts.iter().map(|&text| text.to_owned()).collect();
    basis(&ring, &read_all(&ring, &texts), &Options::default(), &Watch::none()).unwrap()
}

/// By the same commands. The first is `minor(m, 2)` of the generic 2 x 4 matrix, Segre's threefold.
#[test]
fn further_series_are_singulars() {
    let minors = ["b*e - a*f", "c*e - a*g", "d*e - a*h", "c*f - b*g", "d*f - b*h", "d*g - c*h"];
    let segre = graded(&["a", "b", "c", "d", "e", "f", "g", "h"], &minors);
    agrees(&segre, &("Segre", &[1, 0, -6, 8, -3], &[1, 3], 5, 4));
    let four = ["x", "y", "z", "w"];
    let embedded = graded(&four, &["x^2", "x*y", "x*z^3", "y^2*z^2*w"]);
    agrees(&embedded, &("embedded", &[1, 0, -2, 1, -1, 1], &[1, 2, 1, 1], 2, 5));
    let monomial = graded(&four, &["x^5*y", "y^4*z^3", "x^2*z^2*w^3", "w^7*x"]);
    let first = &[1, 0, 0, 0, 0, 0, -1, -2, -1, 0, 0, 2, 2, 1, 0, -1, -1];
    agrees(&monomial, &("monomial", first, &[1, 2, 3, 4, 5, 6, 6, 4, 1, -2, -5, -6, -5, -3, -1], 2, 10));
    let complete = graded(&four, &["x^2*y^3 - z^4*w", "x*w^3 - y^2*z^2"]);
    agrees(&complete, &("complete", &[1, 0, 0, 0, -1, -1, 0, 0, 0, 1], &[1, 2, 3, 4, 4, 3, 2, 1], 2, 20));
    let cubic = graded(&four, &["x^3 + y^3 - 1", "x*y*z"]);
    agrees(&cubic, &("cubic", &[1, 0, 0, -2, 0, 0, 1], &[1, 2, 3, 2, 1], 2, 9));
}

/// A form of degree d on the twisted cubic is one of degree 3d on the line; on Segre's P1 x P3 it is one of degree (d, d).
#[test]
fn hilbert_polynomials_are_known() {
    let ring = UnivariateRing::new(Rationals, "d");
    let whole = |n: i64| BigRational::from_integer(BigInt::from(n));
    let cubic = graded(&["x", "y", "z", "w"], &["x*z - y^2", "y*w - z^2", "x*w - y*z"]).hilbert_series().unwrap();
    assert_eq!(cubic.polynomial(), ring.polynomial(vec![whole(1), whole(3)]));
    assert_eq!(cubic.regularity(), 0);
    let minors = ["b*e - a*f", "c*e - a*g", "d*e - a*h", "c*f - b*g", "d*f - b*h", "d*g - c*h"];
    let segre = graded(&["a", "b", "c", "d", "e", "f", "g", "h"], &minors).hilbert_series().unwrap();
    for d in 0..9i64 {
        let binomial = (d + 1) * (d + 3) * (d + 2) * (d + 1) / 6;
        assert_eq!(ring.evaluate(&segre.polynomial(), &whole(d)), whole(binomial));
        assert_eq!(segre.value(d as usize), BigInt::from(binomial));
    }
    let unit = HilbertSeries { numerator: Vec::new(), variables: 3 };
    assert_eq!((unit.polynomial(), unit.value(4), unit.degree()), (ring.polynomial(vec![]), 0.into(), 0.into()));
}

#[test]
fn a_lexicographic_basis_that_is_not_homogeneous_has_no_series() {
    let ring = PolynomialRing::new(Rationals, &["x", "y"], Order::Lex).unwrap();
    let find = |text: &str| {
        let generators = read_all(&ring, &[text.to_owned()]);
        basis(&ring, &generators, &Options::default(), &Watch::none()).unwrap()
    };
    assert_eq!(find("x - y^2").hilbert_series().unwrap_err().kind(), ErrorKind::BadValue);
    assert_eq!(find("x*y - y^2").degree().unwrap(), BigInt::from(2));
}

/// The exponent vectors with this sum in three variables.
fn exponents(degree: u32) -> impl Iterator<Item = [u32; 3]> {
    (0..=degree).flat_map(move |a| (0..=degree - a).map(move |b| [a, b, degree - a - b]))
}

proptest! {
    #![proptest_config(crate::cases(60))]

    /// By definition, the number of monomials of a degree that no leading monomial divides. From some degree on it is a
    /// polynomial.
    #[test]
    fn values_count_standard_monomials(generators in prop::collection::vec(sparse(3, 1, 5), 0..6)) {
        let ring = PolynomialRing::new(Rationals, &["x", "y", "z"], Order::GrevLex).unwrap();
        let generators: Vec<_> = generators.iter().map(|f| build(&ring, f)).collect();
        let found = basis(&ring, &generators, &Options::default(), &Watch::none()).unwrap();
        let series = found.hilbert_series().unwrap();
        let line = UnivariateRing::new(Rationals, "d");
        for degree in 0..18 {
            let standard = exponents(degree).filter(|e| {
                let monomial = ring.monomial(e).unwrap();
                !found.leading_monomials().iter().any(|lead| ring.layout().divides(lead, &monomial))
            });
            let count = BigInt::from(standard.count());
            let at = BigRational::from_integer(BigInt::from(degree));
            let polynomial = line.evaluate(&series.polynomial(), &at);
            if degree as usize >= series.regularity() {
                prop_assert_eq!(polynomial, BigRational::from_integer(count.clone()));
            } else if degree as usize + 1 == series.regularity() {
                prop_assert_ne!(polynomial, BigRational::from_integer(count.clone()));
            }
            prop_assert_eq!(series.value(degree as usize), count);
        }
    }
}
