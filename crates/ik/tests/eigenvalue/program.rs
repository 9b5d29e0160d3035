//! Six axes as a program and as a derivation: solutions, JSON, certificate.

use groebot_ik::derive::Derivation;
use groebot_ik::solver::Program;
use groebot_ik::solver::eigenvalue::{SixAxes, SixAxesParts};
use groebot_ik::{ErrorKind, Watch};
use groebot_robot::kinematics::Chain;

use super::{Random, distance, random_chain};

/// The numbers of the target that `q` reaches.
fn target(chain: &Chain, q: &[f64; 6]) -> Vec<f64> {
    let pose = chain.forward(q).unwrap();
    let rotation = pose.rotation.to_rotation_matrix();
    let entries = (0..9).map(|entry| rotation[(entry / 3, entry % 3)]);
    pose.translation.vector.iter().copied().chain(entries).collect()
}

fn derived(seed: u64) -> Derivation {
    Derivation::by_eigenvalues(&random_chain(&mut Random::new(seed)), &Watch::none()).unwrap()
}

#[test]
fn a_program_gives_back_the_joints() {
    let derived = derived(15);
    assert_eq!(derived.dimension(), Some(16));
    let mut random = Random::new(16);
    for _ in 0..50 {
        let q = random.angles();
        let solutions =
            derived.program().solve_numbers(&target(derived.eigenvalue().unwrap().problem.measured(), &q)).unwrap();
        assert!(solutions.len().is_multiple_of(2) && solutions.len() <= 16);
        let near = |found: &[f64]| distance(&found.try_into().unwrap(), &q) < 1e-9;
        assert_eq!(solutions.iter().filter(|solution| near(&solution.q)).count(), 1);
        assert!(solutions.iter().all(|solution| solution.residual < 1e-12));
    }
}

#[test]
fn a_program_is_the_same_after_json() {
    let program = derived(17).program().clone();
    assert_eq!(Program::from_json(&program.to_json()).unwrap(), program);
}

#[test]
fn a_certificate_proves_the_derivation_again() {
    let derived = derived(18);
    let text = derived.certificate().unwrap();
    assert!(text.contains("\"eigenvalue_problem\""), "{text}");
    assert_eq!(Derivation::prove(derived.problem().clone(), &text).unwrap(), derived);
}

#[test]
fn a_wrong_certificate_is_refused() {
    let derived = derived(19);
    let text = derived.certificate().unwrap();
    let value = derived.eigenvalue().unwrap().method.formulations[0].determinants[0].value;
    let wrong = text.replacen(&value.to_string(), &(value + 1).to_string(), 1);
    let error = Derivation::prove(derived.problem().clone(), &wrong).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Certificate, "{error}");
    let other = random_chain(&mut Random::new(20));
    assert_eq!(Derivation::prove(&other, &text).unwrap_err().kind(), ErrorKind::Certificate);
}

#[test]
fn malformed_axes_are_refused() {
    let program = derived(21).program().clone();
    let text = program.to_json();
    let wrong = |from: &str, to: &str| Program::from_json(&text.replacen(from, to, 1)).unwrap_err();
    assert!(wrong("\"hidden\": ", "\"hidden\": 1").to_string().contains("six axes"));
    let parts = program.cases().flat_map(|case| &case.steps).find_map(|step| match step {
        groebot_ik::solver::Step::SixAxes(six) => Some(six.parts().clone()),
        _ => None,
    });
    let parts = parts.unwrap();
    assert!(SixAxes::new(SixAxesParts { length: 0.0, ..parts.clone() }).is_err());
    assert!(SixAxes::new(SixAxesParts { formulations: Vec::new(), ..parts }).is_err());
}
