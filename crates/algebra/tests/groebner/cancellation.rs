//! Number of calls to the watch, counted and not timed. All engines stop at the call that reports cancellation.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use groebot_algebra::groebner::cover::{Space, cover};
use groebot_algebra::groebner::parametric::{self, Method};
use groebot_algebra::groebner::{Options, basis_modulo_prime, change_order, f4, modular};
use groebot_algebra::number::{Rationals, Zp};
use groebot_algebra::poly::{Order, PolynomialRing};
use groebot_algebra::{ErrorKind, Result, Watch, real};

use super::blocks;
use crate::corpus::groebner::case;

const PATIENCE: usize = 1 << 40;

/// Runs `work` to its end and checks that it called the watch at least `often` times. Then cancels it at the start, in
/// the middle and near the end: it fails with `Cancelled` and does not call the watch again.
fn asks_often<T>(often: usize, work: impl Fn(&Watch) -> Result<T>) {
    let left = Arc::new(AtomicUsize::new(PATIENCE));
    work(&Watch::none().with_patience(left.clone())).unwrap_or_else(|error| panic!("{error}"));
    let requested = PATIENCE - left.load(Relaxed);
    assert!(requested >= often, "the watch was called {requested} times");
    for patience in [0, 1, requested / 4, requested / 2, requested - 1] {
        let left = Arc::new(AtomicUsize::new(patience));
        let error = work(&Watch::none().with_patience(left.clone())).err().expect("it is cancelled");
        assert_eq!(error.kind(), ErrorKind::Cancelled, "after {patience} of {requested}");
        assert_eq!(left.load(Relaxed), 0);
    }
}

#[test]
fn modulo_a_prime() {
    let case = case("katsura_5-grevlex-gf32003");
    let ring = case.ring(&Zp::new(2_147_483_647).unwrap());
    let generators = case.generators(&ring);
    asks_often(40, |watch| f4(&ring, &generators, watch));
    let graded = f4(&ring, &generators, &Watch::none()).unwrap();
    let lex = PolynomialRing::new(*ring.field(), ring.variables(), Order::Lex).unwrap();
    asks_often(20, |watch| change_order(&graded, &lex, watch));
    asks_often(60, |watch| basis_modulo_prime(&lex, &generators, watch));
}

#[test]
fn over_the_rationals() {
    let case = case("katsura_4-grevlex-q");
    let ring = case.ring(&Rationals);
    let generators = case.generators(&ring);
    asks_often(150, |watch| modular::basis(&ring, &generators, &Options::default(), watch));
    let found = modular::basis(&ring, &generators, &Options::default(), &Watch::none()).unwrap();
    asks_often(50, |watch| modular::prove(&found, &ring, &generators, watch));
    asks_often(200, |watch| real::solve(&ring, &generators, &real::Options::default(), watch));
}

#[test]
fn with_parameters() {
    for (method, often) in
        [(Method::Direct, 20), (Method::Variables, 20), (Method::Modular, 50), (Method::Interpolation, 500)]
    {
        let block = blocks::nao_leg();
        let options = parametric::Options { method: Some(method) };
        asks_often(often, |watch| parametric::basis(&block.ring, &block.generators, &options, watch));
    }
    let block = blocks::puma_position();
    let options = parametric::Options { method: Some(Method::Interpolation) };
    asks_often(5_000, |watch| parametric::basis(&block.ring, &block.generators, &options, watch));
}

#[test]
fn for_all_parameters() {
    let block = blocks::nao_leg();
    asks_often(200, |watch| cover(&block.ring, &block.generators, &Space::all(), watch));
}
