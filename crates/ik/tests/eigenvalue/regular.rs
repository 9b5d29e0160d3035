//! The regular formulations, modulo primes.

use groebot_algebra::number::{Zp, primes_below};
use groebot_ik::ErrorKind;
use groebot_ik::derive::eigenvalue::{Determinant, Residue, all, formulations, solver};
use groebot_ik::solver::eigenvalue::Formulation;
use groebot_robot::kinematics::{Chain, Task};

use super::{Random, chain, random_chain, rational};

#[test]
fn every_formulation_of_a_general_chain_is_regular() {
    let regular = formulations(&random_chain(&mut Random::new(11))).unwrap();
    assert!(regular.iter().map(|regular| regular.formulation).eq(all()));
    assert!(regular.iter().all(|regular| regular.determinants.iter().all(|determinant| determinant.value != 0)));
}

#[test]
fn a_determinant_is_the_same_every_time() {
    let chain = random_chain(&mut Random::new(12));
    let formulation = Formulation { hidden: 2, second: false };
    let prime = primes_below(1 << 31).next().unwrap();
    let once = Determinant::evaluate(&chain, formulation, prime, 3).unwrap();
    assert_eq!(Determinant::evaluate(&chain, formulation, prime, 3).unwrap(), once);
    assert_ne!(Determinant::evaluate(&chain, formulation, prime, 4).unwrap(), once);
}

#[test]
fn residues_are_a_field() {
    let field = Zp::new(101).unwrap();
    let [a, b] = [5, 77].map(|value| Residue::new(value, field));
    assert_eq!((a + b - b).value, 5);
    assert_eq!((a * b * b.inverse().unwrap()).value, 5);
    assert_eq!((a + -a).value, 0);
    assert!(Residue::image(&rational(1, 101), field).is_none());
}

/// With three axes through one point and three parallel ones, no formulation that hides a joint of the wrist is regular.
#[test]
fn special_chains_have_fewer_regular_formulations() {
    let vector = |entries: [i64; 3]| entries.map(|entry| rational(entry, 10));
    let axes = [
        ([0, 0, 10], [0, 0, 0]),
        ([0, 10, 0], [0, 0, 3]),
        ([0, 10, 0], [4, 0, 3]),
        ([0, 10, 0], [8, 0, 3]),
        ([0, 0, 10], [8, 1, 0]),
        ([0, 10, 0], [8, 0, 1]),
    ];
    let regular = formulations(&chain(&axes.map(|(axis, point)| (vector(axis), vector(point))))).unwrap();
    let hidden: Vec<_> = regular.iter().map(|regular| regular.formulation.hidden).collect();
    assert_eq!(hidden, [1, 1]);
}

#[test]
fn other_chains_are_refused() {
    let general = random_chain(&mut Random::new(13));
    let position = general.with_task(Task::Position, general.direction().clone(), Vec::new()).unwrap();
    assert_eq!(solver(&position).unwrap_err().kind(), ErrorKind::Unsupported);
    let mut parts = general.parts().clone();
    parts.joints.pop();
    assert_eq!(solver(&Chain::new(parts).unwrap()).unwrap_err().kind(), ErrorKind::Unsupported);
}
