//! Random small ideals: agreement of the engine, its strategies, the reference algorithm, the checker and the change of
//! order.

use std::time::Duration;

use groebot_algebra::groebner::buchberger::{buchberger, is_groebner_basis};
use groebot_algebra::groebner::verify::{Claim, verify};
use groebot_algebra::groebner::{Options, Quotient, Strategy as Selection, basis, normal_form};
use groebot_algebra::number::{Field, Rationals, Zp};
use groebot_algebra::poly::{Order, PolynomialRing};
use groebot_algebra::{ErrorKind, Watch};
use proptest::prelude::*;

use crate::poly::sparse::{Sparse, build, orders, sparse};

/// Whether everything agrees; `false` when the computation takes more than a second.
fn agree<F: Field>(field: F, order: Order, generators: &[Sparse]) -> bool {
    let ring = PolynomialRing::new(field, &["x", "y", "z"], order).unwrap();
    let generators: Vec<_> = generators.iter().map(|f| build(&ring, f)).collect();
    let find = |strategy| {
        let watch = Watch::none().with_time(Duration::from_secs(1));
        match basis(&ring, &generators, &Options { strategy, cofactors: true }, &watch) {
            Ok(found) => Some(found),
            Err(error) => {
                assert_eq!(error.kind(), ErrorKind::Budget);
                None
            }
        }
    };
    let (Some(normal), Some(sugar)) = (find(Selection::Normal), find(Selection::Sugar)) else { return false };
    assert_eq!(normal.polynomials, sugar.polynomials, "one reduced basis");
    assert!(is_groebner_basis(&ring, &normal.polynomials).unwrap());
    for found in [&normal, &sugar] {
        let claim = Claim { generators: &generators, basis: &found.polynomials, cofactors: &found.cofactors };
        verify(&ring, &claim, &Watch::none()).unwrap();
    }
    if let Ok(reference) = buchberger(&ring, &generators, &Watch::none().with_time(Duration::from_millis(200))) {
        let reduces = |f, by: &[_]| normal_form(&ring, f, by).unwrap().is_zero();
        assert!(reference.iter().all(|f| reduces(f, &normal.polynomials)));
        assert!(normal.polynomials.iter().all(|f| reduces(f, &reference)));
    }
    if normal.require_zero_dimensional().is_ok() {
        let quotient = Quotient::new(&normal).unwrap();
        assert_eq!(quotient.basis_in(&ring, &Watch::none()).unwrap().polynomials, normal.polynomials, "the same order");
    }
    true
}

proptest! {
    #![proptest_config(crate::cases(40))]

    #[test]
    fn modulo_a_prime(generators in prop::collection::vec(sparse(3, 3, 2), 1..4), order in 0usize..4) {
        let p = if generators.len() == 2 { 2 } else { 32003 };
        prop_assume!(agree(Zp::new(p).unwrap(), orders()[order].clone(), &generators));
    }

    #[test]
    fn over_the_rationals(generators in prop::collection::vec(sparse(3, 3, 1), 1..4), order in 0usize..4) {
        prop_assume!(agree(Rationals, orders()[order].clone(), &generators));
    }
}
