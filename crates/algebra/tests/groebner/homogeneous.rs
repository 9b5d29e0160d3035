//! Homogenised systems and their bases, computed with a known Hilbert series.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use groebot_algebra::groebner::{Basis, Options, basis, dehomogenise, hilbert_driven, homogenise, reduced_basis};
use groebot_algebra::number::{BigInt, Zp};
use groebot_algebra::poly::{Block, Order, Polynomial, PolynomialRing};
use groebot_algebra::{ErrorKind, Watch};
use proptest::prelude::*;

use crate::corpus::groebner::case;
use crate::corpus::{read, read_all};
use crate::poly::sparse::{build, orders, sparse};

fn plain(ring: &PolynomialRing<Zp>, generators: &[Polynomial<u64>]) -> Basis<Zp> {
    basis(ring, generators, &Options::default(), &Watch::none()).unwrap()
}

/// A watch that counts the reduced pairs.
fn counting() -> (Watch, Arc<AtomicUsize>) {
    let count = Arc::new(AtomicUsize::new(0));
    let counted = count.clone();
    (Watch::none().with_listener(move |_| _ = counted.fetch_add(1, Relaxed)), count)
}

/// The homogenised case in Lex with the series of its GrevLex basis.
fn lexicographic(file: &str) -> (PolynomialRing<Zp>, Vec<Polynomial<u64>>, groebot_algebra::groebner::HilbertSeries) {
    let case = case(file);
    let field = Zp::new(32003).unwrap();
    let graded = case.ring_in(&field, Order::GrevLex);
    let (homogeneous, lifted) = homogenise(&graded, &case.generators(&graded), "h").unwrap();
    let series = plain(&homogeneous, &lifted).hilbert_series().unwrap();
    let lex = PolynomialRing::new(field, homogeneous.variables(), Order::Lex).unwrap();
    let moved = lifted.iter().map(|f| homogeneous.transfer(f, &lex).unwrap()).collect();
    (lex, moved, series)
}

const SYSTEMS: [&str; 6] = [
    "circle_cubic-lex-q",
    "cyclic_4-lex-q",
    "katsura_3-lex-q",
    "twisted_cubic_projective-lex-q",
    "cox_little_oshea_2_7-lex-q",
    "enneper-lex-q",
];

#[test]
fn a_known_series_leads_to_the_same_basis_with_fewer_pairs() {
    let (mut all, mut some) = (0, 0);
    for file in SYSTEMS {
        let (ring, generators, series) = lexicographic(file);
        let (watch, count) = counting();
        let direct = basis(&ring, &generators, &Options::default(), &watch).unwrap();
        all += count.load(Relaxed);
        let (watch, count) = counting();
        let driven = hilbert_driven(&ring, &generators, &series, &watch).unwrap();
        some += count.load(Relaxed);
        assert_eq!(driven, direct, "{file}");
    }
    assert!(some * 2 < all, "{some} of {all} pairs");
}

#[test]
fn a_wrong_series_and_other_input_are_refused() {
    let (ring, generators, series) = lexicographic("katsura_3-lex-q");
    let mut larger = series.clone();
    larger.numerator[3] += BigInt::from(1);
    let mut smaller = series.clone();
    smaller.numerator[4] -= BigInt::from(1);
    for wrong in [larger, smaller] {
        let error = hilbert_driven(&ring, &generators, &wrong, &Watch::none()).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::BadValue, "{error}");
    }
    let affine = [read(&ring, "x0^2 - h^2"), read(&ring, "x1^2 - h")];
    let error = hilbert_driven(&ring, &affine, &series, &Watch::none()).unwrap_err();
    assert!(error.message().contains("generator 2 is not homogeneous"), "{error}");
}

#[test]
fn names_are_checked() {
    let ring = PolynomialRing::new(Zp::new(7).unwrap(), &["x", "y"], Order::Lex).unwrap();
    assert_eq!(homogenise(&ring, &[], "y").unwrap_err().kind(), ErrorKind::DuplicateName);
    assert_eq!(dehomogenise(&ring, &[], "z").unwrap_err().kind(), ErrorKind::UnknownName);
}

#[test]
fn degrees_are_filled_up_by_the_new_variable() {
    let ring = PolynomialRing::new(Zp::new(101).unwrap(), &["x", "y"], Order::elimination(1, 2)).unwrap();
    let texts = ["x^2*y + 3*x - 5", "x + 1", "0", "7"].map(str::to_owned);
    let (target, lifted) = homogenise(&ring, &read_all(&ring, &texts), "h").unwrap();
    let expected = ["x^2*y + 3*x*h^2 - 5*h^3", "x + h", "0", "7"].map(str::to_owned);
    assert_eq!(lifted, read_all(&target, &expected));
    let sizes = Order::Block(vec![Block { size: 1, graded: true }; 3]);
    assert_eq!((target.layout().order(), target.variables()[2].as_str()), (&sizes, "h"));
    let (middle, lowered) = dehomogenise(&target, &lifted, "y").unwrap();
    assert_eq!(lowered[0], read(&middle, "x^2 + 3*x*h^2 - 5*h^3"));
}

proptest! {
    #![proptest_config(crate::cases(40))]

    /// In every order a basis of the homogenised system gives one of the system.
    #[test]
    fn a_homogeneous_basis_gives_the_affine_one(
        generators in prop::collection::vec(sparse(3, 3, 2), 1..4),
        order in 0usize..4,
    ) {
        let ring = PolynomialRing::new(Zp::new(32003).unwrap(), &["x", "y", "z"], orders()[order].clone()).unwrap();
        let generators: Vec<_> = generators.iter().map(|f| build(&ring, f)).collect();
        let (lifted_ring, lifted) = homogenise(&ring, &generators, "h").unwrap();
        let (back_ring, back) = dehomogenise(&lifted_ring, &lifted, "h").unwrap();
        prop_assert_eq!((&back_ring, &back), (&ring, &generators));
        let watch = Watch::none().with_time(std::time::Duration::from_secs(1));
        let homogeneous = basis(&lifted_ring, &lifted, &Options::default(), &watch);
        prop_assume!(homogeneous.is_ok());
        let homogeneous = homogeneous.unwrap();
        let (_, affine) = dehomogenise(&homogeneous.ring, &homogeneous.polynomials, "h").unwrap();
        let cofactors = vec![Vec::new(); affine.len()];
        let reduced = reduced_basis(&ring, affine, cofactors, &Watch::none()).unwrap();
        prop_assert_eq!(reduced.polynomials, plain(&ring, &generators).polynomials);
        let series = homogeneous.hilbert_series().unwrap();
        let driven = hilbert_driven(&lifted_ring, &lifted, &series, &Watch::none()).unwrap();
        prop_assert_eq!(driven, homogeneous);
    }
}
