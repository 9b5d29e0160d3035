//! Families of systems in the benchmarks, compared with the files of the corpus.

#[path = "../../../../benches/algebra/families.rs"]
mod written;

use groebot_algebra::number::{BigRational, Rationals};
use groebot_algebra::poly::{Order, Polynomial, PolynomialRing};

use crate::corpus::read_all;
use crate::corpus::systems::{System, all};

/// The polynomials of `texts`, monic, since a family may have other factors.
fn monic(ring: &PolynomialRing<Rationals>, texts: &[String]) -> Vec<Polynomial<BigRational>> {
    read_all(ring, texts).iter().map(|f| ring.monic(f)).collect()
}

fn check(system: &System, family: &str, size: usize) {
    let (variables, texts) = written::member(family, size).expect("a family");
    assert_eq!(variables, system.variables, "{}", system.name);
    let ring = system.ring(Rationals, &Order::GrevLex);
    assert_eq!(monic(&ring, &texts), monic(&ring, &system.generators), "{}", system.name);
}

#[test]
fn the_families_are_those_of_the_corpus() {
    let systems = all();
    let members = systems.iter().filter_map(|system| {
        let (family, size) = system.name.rsplit_once('_')?;
        Some((system, family, size.parse().ok()?))
    });
    let members: Vec<_> = members.filter(|(_, family, _)| written::member(family, 3).is_some()).collect();
    members.iter().for_each(|(system, family, size)| check(system, family, *size));
    assert!(members.len() >= 35, "{} members", members.len());
}
