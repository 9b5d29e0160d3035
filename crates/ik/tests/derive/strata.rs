//! Strata of the parameters: the solutions where the generic formulas divide by zero.
//!
//! Bases marked "Singular" are compared with tests/corpus/groebner, which the program Singular computed.

use groebot_algebra::poly::parse;
use groebot_ik::derive::equations::tree::{Node, Outcome};
use groebot_ik::derive::{Derivation, Orders, System, derive_tree};
use groebot_ik::{ErrorKind, Watch};
use groebot_robot::document::Document;

use super::seed::{derive, source, symbolic_leg, two_links};

fn find<'a>(tree: &'a Node, label: &str) -> &'a Node {
    let labels: Vec<_> = tree.walk().iter().map(|node| node.label.clone()).collect();
    let found = tree.walk().into_iter().find(|node| node.label == label && !matches!(node.outcome, Outcome::Seen(_)));
    found.unwrap_or_else(|| panic!("no stratum {label} among {labels:?}"))
}

/// The basis in a corpus file.
fn singular(name: &str) -> Vec<String> {
    let path = format!("{}/tests/corpus/groebner/{name}.toml", concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let text = std::fs::read_to_string(path).unwrap();
    let document = Document::parse(&text).unwrap();
    document.root().required("basis").unwrap().texts().unwrap().into_iter().map(Into::into).collect()
}

fn assert_basis(node: &Node, expected: &[String]) {
    let solved = node.solved().unwrap();
    let ring = &solved.triangular.ring;
    let expected: Vec<_> =
        expected.iter().map(|text| ring.monic(&parse(text).unwrap().evaluate(ring).unwrap())).collect();
    assert_eq!(solved.certified.basis, expected, "{}", node.label);
}

#[test]
fn generic_bases_are_singular_s() {
    for (mechanism, corpus) in [("nao_leg_sagittal", "nao_leg-lex-q_px_pz"), ("nao_arm_planar", "nao_arm-lex-q_py_pz")]
    {
        assert_basis(
            &derive(source(mechanism).system.unwrap()).equations().unwrap().method.requested,
            &singular(corpus),
        );
    }
    assert_basis(
        &derive(symbolic_leg()).equations().unwrap().method.requested,
        &singular("nao_leg_symbolic-lex-q_px_pz_l1_l2"),
    );
    assert_basis(
        &derive(super::seed::symbolic_arm()).equations().unwrap().method.requested,
        &singular("nao_arm_symbolic-lex-q_py_pz_l1_l2"),
    );
}

#[test]
fn the_stratum_where_the_source_divides_by_zero_is_derived() {
    let leg = derive(source("nao_leg_sagittal").system.unwrap());
    assert_basis(find(&leg.equations().unwrap().method.requested, "pz = 0"), &singular("nao_leg_pz0-lex-q_px"));
    let arm = derive(source("nao_arm_planar").system.unwrap());
    assert_basis(find(&arm.equations().unwrap().method.requested, "pz = 0"), &singular("nao_arm_pz0-lex-q_py"));
}

#[test]
fn another_order_of_the_leg_has_no_such_stratum() {
    let leg = derive(source("nao_leg_sagittal").system.unwrap());
    let searched = leg.equations().unwrap().method.searched.as_ref().unwrap();
    assert_eq!(searched.solved().unwrap().certified.order, ["c4", "c3", "s3", "s4"]);
    assert_basis(searched, &singular("nao_leg_inverted-lex-q_px_pz"));
    assert!(find(searched, "pz = 0").solved().unwrap().inherited);
    assert_eq!(leg.program().cases().count(), 1, "one case serves every target");
}

#[test]
fn the_base_is_out_of_reach_unless_the_links_are_equal() {
    let leg = derive(source("nao_leg_sagittal").system.unwrap());
    assert!(matches!(
        find(&leg.equations().unwrap().method.requested, "pz = 0, px = 0").outcome,
        Outcome::Inconsistent(_)
    ));
    assert_eq!(leg.program().solve_numbers(&[0.0, 0.0]).unwrap(), []);

    let symbolic = derive(symbolic_leg());
    let folded =
        symbolic.equations().unwrap().method.requested.walk().into_iter().filter_map(|node| match &node.outcome {
            Outcome::SelfMotion(self_motion) => Some((node.label.clone(), self_motion.free.clone())),
            _ => None,
        });
    let folded: Vec<_> = folded.collect();
    assert!(
        !folded.is_empty() && folded.iter().all(|(label, free)| label.contains("L1") && *free == [0]),
        "{folded:?}"
    );
    let answers = symbolic.program().solve_numbers(&[0.0, 0.0, 100.0, 100.0]).unwrap();
    assert_eq!(answers.len(), 1, "{answers:?}");
    assert_eq!(answers[0].free, [0], "the hip is free when the ankle is at the hip");
    assert!((answers[0].q[1].abs() - std::f64::consts::PI).abs() < 1e-12);
    assert_eq!(symbolic.program().solve_numbers(&[0.0, 0.0, 100.0, 102.9]).unwrap(), []);
}

#[test]
fn lengths_assumed_positive_exclude_strata() {
    let with = derive_tree(&symbolic_leg(), Orders::Requested, &Watch::none()).unwrap();
    let excluded: Vec<_> = with.excluded.iter().map(|e| e.factor.to_string()).collect();
    assert_eq!(excluded, ["L1", "L2"]);
    let text = two_links("leg", ["c4", "c3", "s4", "s3"]).replace("positive = true", "positive = false");
    let without = derive_tree(&System::from_toml(&text).unwrap(), Orders::Requested, &Watch::none()).unwrap();
    assert!(without.children.iter().any(|child| child.label == "L1 = 0"));
}

/// Targets at distances `1e-k` on both sides of the stratum: the number of solutions and their quality do not change.
#[test]
fn targets_near_a_stratum_are_solved_like_any_other() {
    for (name, free) in [("nao_leg_sagittal", 150.0), ("nao_arm_planar", 150.0)] {
        let derivation = derive(source(name).system.unwrap());
        for k in 0..=18 {
            for sign in [-1.0, 1.0] {
                let small = sign * 10f64.powi(-k);
                for target in [[free, small], [small, free]] {
                    let answers = derivation.program().solve_numbers(&target).unwrap();
                    assert_eq!(answers.len(), 2, "{name} {target:?}: {answers:?}");
                    assert!(answers.iter().all(|a| a.residual < 1e-11), "{name} {target:?}: {answers:?}");
                }
            }
        }
        assert_eq!(derivation.program().solve_numbers(&[free, 0.0]).unwrap().len(), 2);
    }
}

fn error_of(text: &str) -> groebot_ik::Error {
    Derivation::of_problem(System::from_toml(text).unwrap(), &Watch::none()).unwrap_err()
}

const JOINTS: &str = "[[joint]]\nname = \"a\"\ncosine = \"c1\"\nsine = \"s1\"\n\
                      [[joint]]\nname = \"b\"\ncosine = \"c2\"\nsine = \"s2\"\n";

/// One term with a degree beyond every monomial is refused before its expansion.
#[test]
fn a_hopeless_degree_is_refused() {
    let text = format!("name = \"x\"\nequations = [\"(c1^1000)^1000 = 1\", \"c2 = s1\"]\n{JOINTS}");
    let error = System::from_toml(&text).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Overflow);
    assert_eq!(error.place().line, Some(2));
}

#[test]
fn contradicting_equations_are_refused() {
    let text = format!("name = \"x\"\nequations = [\"c1 + c2 = 1\", \"c1 + c2 = 2\", \"s1 = s2\"]\n{JOINTS}");
    assert_eq!(error_of(&text).kind(), ErrorKind::Inconsistent);
    let text = format!(
        "name = \"x\"\nequations = [\"c1 = 2*s1\", \"c2 = p\", \"s2 = p\"]\n[[parameter]]\nname = \"p\"\n{JOINTS}"
    );
    assert_eq!(error_of(&text).kind(), ErrorKind::Inconsistent, "p^2 = 1/2 is no generic target");
}

#[test]
fn more_joints_than_equations_names_the_free_ones() {
    let text = format!("name = \"x\"\nequations = [\"c1 = p\"]\n[[parameter]]\nname = \"p\"\n{JOINTS}");
    let error = error_of(&text);
    assert_eq!(error.kind(), ErrorKind::PositiveDimensional);
    assert!(error.message().contains(" b "), "{error}");
    assert!(!error.message().contains(" a,"), "{error}");
}

#[test]
fn cancelled_and_bounded_derivations_end_with_their_reason() {
    let system = source("nao_leg_sagittal").system.unwrap();
    let flag = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(true));
    let error = Derivation::of_problem(system.clone(), &Watch::none().with_cancel(flag)).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Cancelled);
    let error =
        Derivation::of_problem(system.clone(), &Watch::none().with_time(std::time::Duration::ZERO)).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Budget);
    let error = Derivation::of_problem(system, &Watch::none().with_terms(10)).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Budget);
}
