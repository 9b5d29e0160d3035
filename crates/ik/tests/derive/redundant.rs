//! Chains with one joint more than their task determines: the solver with each joint as the given one, its proof and its program.

use std::sync::OnceLock;

use groebot_ik::derive::redundant::Part;
use groebot_ik::derive::{Derivation, Ends, Problem, Source};
use groebot_ik::solver::{Program, RedundantPart};
use groebot_ik::{ErrorKind, Watch};
use groebot_robot::kinematics::{Chain, Target};
use serde_json::Value;

/// The arm of `derivations/iiwa14` without its given joint.
pub fn iiwa() -> Chain {
    let text = include_str!("../../../../derivations/iiwa14/0_chain.toml");
    Chain::from_toml(&text.replace("given = [\"A3\"]\n", "")).unwrap()
}

/// The source of an arm after the planner has chosen the joint of the main solver.
fn source(chain: &Chain) -> Source {
    let mut source = Source::of_chain(chain.clone(), &Ends::default()).unwrap();
    source.choose_given(&Watch::none()).unwrap().unwrap();
    source
}

pub fn derived() -> &'static (Source, Derivation) {
    static DERIVED: OnceLock<(Source, Derivation)> = OnceLock::new();
    DERIVED.get_or_init(|| {
        let source = source(&iiwa());
        let derivation = Derivation::of(&source, &Watch::none()).unwrap();
        (source, derivation)
    })
}

#[test]
fn a_chain_without_given_joint_requests_all_of_them() {
    let (source, _) = derived();
    assert!(source.ends.redundant);
    assert_eq!(source.ends.given.len(), 1);
    let task = source.ends.to_toml();
    assert!(task.contains("redundant = true\n"), "{task}");
    assert_eq!(Ends::from_toml(&task).unwrap(), source.ends);
}

#[test]
fn a_given_joint_requests_only_that_one() {
    let given = |ends: &Ends| {
        let mut source = Source::of_chain(ends.apply_to(iiwa()).unwrap(), ends).unwrap();
        source.choose_given(&Watch::none()).unwrap();
        source.ends.redundant
    };
    assert!(!given(&Ends { given: vec!["A3".to_owned()], ..Ends::default() }));
    assert!(!given(&Ends { chooses: true, ..Ends::default() }));
}

/// The elbow A4 is determined by the distance from shoulder to wrist; with any other joint given, eight closed-form solutions remain.
#[test]
fn every_joint_but_the_elbow_has_a_closed_form() {
    let (source, derivation) = derived();
    let parts = derivation.redundancy().unwrap().parts();
    assert_eq!(parts.len(), 7);
    for (joint, part) in parts.iter().enumerate() {
        let is_given = source.ends.given == [derivation.program().joints[joint].name.clone()];
        match part {
            Part::Main => assert!(is_given && derivation.dimension() == Some(8), "{joint}"),
            Part::Derived(other) => {
                assert!(!is_given && other.sequential().is_some() && other.dimension() == Some(8), "{joint}");
            }
            Part::Constant => assert_eq!(joint, 3),
            _ => panic!("{part:?}"),
        }
    }
}

/// Joint values within limits are among the solutions of the pose that they reach, whichever of their values is given.
#[test]
fn each_solver_finds_the_joint_values_that_made_the_pose() {
    let (chain, (_, derivation)) = (iiwa(), derived());
    let q = [0.3, -0.6, 0.4, 1.1, -0.2, 0.7, 0.5];
    let target = Target::Pose(chain.forward(&q).unwrap());
    let main = derivation.program();
    let redundancy = main.redundancy.as_ref().unwrap();
    for (joint, part) in redundancy.parts.iter().enumerate() {
        let program = match part {
            RedundantPart::Main => main,
            RedundantPart::Program(program) => program,
            _ => continue,
        };
        let answers = program.solver().solve_given(target, &[q[joint]]).unwrap();
        let is_same = |own: &[f64]| own.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(answers.iter().any(|answer| is_same(&answer.q)), "{joint}: {answers:?}");
    }
}

#[test]
fn the_certificate_proves_every_part_again() {
    let (source, derivation) = derived();
    let text = derivation.certificate().unwrap();
    let again = Derivation::prove_source(source, &text).unwrap();
    assert_eq!(&again, derivation);
    assert_eq!(again.certificate().unwrap(), text);
}

/// The error for the certificate of the arm after a change.
fn refusal(change: impl FnOnce(&mut Vec<Value>)) -> String {
    let (source, derivation) = derived();
    let mut certificate: Value = serde_json::from_str(&derivation.certificate().unwrap()).unwrap();
    change(certificate["claims"]["given"].as_array_mut().unwrap());
    let error = Derivation::prove_source(source, &certificate.to_string()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Certificate, "{error}");
    error.to_string()
}

#[test]
fn damaged_certificates_are_refused() {
    let text = refusal(|given| drop(given.pop()));
    assert!(text.contains("the parts are not those of the joints A1, A2"), "{text}");
    let text = refusal(|given| given.swap(0, 1));
    assert!(text.contains("the parts are not those of the joints"), "{text}");
    let text = refusal(|given| {
        let claims = given[0]["claims"].take();
        given[6]["claims"] = claims;
        given[0]["claims"] = serde_json::json!({ "unsolved": "none" });
    });
    assert!(text.contains("A7 given"), "{text}");
    let text = refusal(|given| given[1]["claims"] = serde_json::json!({ "constant": {} }));
    assert!(text.contains("A2 given") && text.contains("no relation proves"), "{text}");
    let main = |given: &mut Vec<Value>| {
        let own = &derived().0.ends.given[0];
        let proof = given.iter_mut().find(|proof| proof["joint"] == own.as_str()).unwrap();
        proof["claims"] = serde_json::json!({ "unsolved": "none" });
    };
    assert!(refusal(main).contains("there is no proof for the given joint"));
}

#[test]
fn a_proof_for_one_given_joint_does_not_replace_that_for_all() {
    let (source, derivation) = derived();
    let Problem::Chain(problem) = Problem::of(source).unwrap() else { panic!("a chain") };
    let alone = Derivation::of_problem(*problem, &Watch::none()).unwrap();
    let text = Derivation::prove_source(source, &alone.certificate().unwrap()).unwrap_err().to_string();
    assert!(text.contains("missing"), "{text}");
    let mut only = source.clone();
    only.ends.redundant = false;
    let text = Derivation::prove_source(&only, &derivation.certificate().unwrap()).unwrap_err().to_string();
    assert!(text.contains("superfluous"), "{text}");
}

#[test]
fn a_program_with_redundancy_is_read_back() {
    let program = derived().1.program();
    assert_eq!(&Program::from_json(&program.to_json()).unwrap(), program);
    let limits = program.redundancy.as_ref().unwrap().limit_pairs();
    assert!((limits[3][1] - 120_f64.to_radians()).abs() < 1e-15, "{limits:?}");
}

/// The error of validation after a change.
fn malformed(change: impl FnOnce(&mut Program)) -> String {
    let mut program = derived().1.program().clone();
    change(&mut program);
    let error = program.validate().unwrap_err();
    assert_eq!(error.kind(), ErrorKind::BadValue);
    error.to_string()
}

#[test]
fn malformed_redundancies_are_refused() {
    let text = malformed(|program| program.redundancy.as_mut().unwrap().lines.truncate(6));
    assert!(text.contains("one line, one pair of limits and one part per joint"), "{text}");
    let text = malformed(|program| program.redundancy.as_mut().unwrap().lines[2].direction = [0.0, 0.0, 2.0]);
    assert!(text.contains("length one"), "{text}");
    let text = malformed(|program| program.redundancy.as_mut().unwrap().rotation[0] = [0.0, 1.0, 0.0]);
    assert!(text.contains("not a rotation"), "{text}");
    let text = malformed(|program| program.redundancy.as_mut().unwrap().position[1] = f64::NAN);
    assert!(text.contains("finite"), "{text}");
    let text = malformed(|program| program.redundancy.as_mut().unwrap().limits[0] = Some([1.0, -1.0]));
    assert!(text.contains("limits"), "{text}");
    let text = malformed(|program| program.redundancy.as_mut().unwrap().parts.swap(0, 1));
    assert!(text.contains("part"), "{text}");
    let text = malformed(|program| {
        let given = program.given_joints[0].joint;
        program.redundancy.as_mut().unwrap().parts[given] = RedundantPart::Constant;
    });
    assert!(text.contains("the given joint has no program"), "{text}");
    let text = malformed(|program| {
        let parts = &mut program.redundancy.as_mut().unwrap().parts;
        let part = parts.iter_mut().find_map(|part| match part {
            RedundantPart::Program(other) => Some(other),
            _ => None,
        });
        part.unwrap().joints[5].name = "another".to_owned();
    });
    assert!(text.contains("another task, other joints"), "{text}");
    let text = malformed(|program| program.redundancy.as_mut().unwrap().closed.as_mut().unwrap().grid = 9);
    assert!(text.contains("joints with a program"), "{text}");
    let text = malformed(|program| {
        let redundancy = program.redundancy.as_mut().unwrap();
        let section = redundancy.closed.as_mut().unwrap().sections.first_mut();
        section.expect("an iiwa has sections").value = f64::INFINITY;
    });
    assert!(text.contains("finite values"), "{text}");
}
