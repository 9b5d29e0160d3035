//! Arcs of arms of seven joints, compared with those of `tests/corpus/redundant`, which were computed with numpy from random solutions, without this library.

use std::fs;
use std::path::{Path, PathBuf};

use groebot_ik::Watch;
use groebot_ik::derive::{Derivation, Source};
use groebot_ik::solver::redundant::Arcs;
use groebot_robot::spatial::angle;
use serde_json::Value;

/// Below this least singular value, curves cross or nearly do, and two programs may join their branches differently.
const ORDINARY: f64 = 1e-3;

fn corpus() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/corpus/redundant")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// The ends of the corpus' arcs, with the joints at their limits.
fn ends(arcs: &[Value]) -> Vec<(String, Vec<f64>)> {
    let of = |arc: &Value| -> Vec<(String, Vec<f64>)> {
        let entries = arc.as_array().unwrap()[2..].chunks(2);
        entries.map(|pair| (pair[0].as_str().unwrap().to_owned(), numbers(&pair[1]))).collect()
    };
    arcs.iter().flat_map(of).filter(|(at, _)| at != "closed").collect()
}

/// The difference between the arcs of a pose and those of the corpus.
fn fault(found: &Arcs, expected: &[Value]) -> Option<String> {
    if found.arcs.len() != expected.len() {
        return Some(format!("{} arcs instead of {}", found.arcs.len(), expected.len()));
    }
    let mut lengths: Vec<f64> = found.arcs.iter().map(|arc| arc.length).collect();
    lengths.sort_by(|a, b| b.total_cmp(a));
    for (own, arc) in lengths.iter().zip(expected) {
        let length = arc[0].as_f64().unwrap();
        if (own - length).abs() > 1e-5 * (1.0 + length) {
            return Some(format!("an arc of length {own} instead of {length}"));
        }
    }
    let own: Vec<_> =
        found.arcs.iter().flat_map(|arc| [&arc.start, &arc.end]).filter(|end| end.joint.is_some()).collect();
    for (at, q) in ends(expected) {
        let is_same = |end: &&&groebot_ik::solver::redundant::ArcEnd| {
            let sign = if end.is_upper { '+' } else { '-' };
            let name = format!("{}{sign}", end.joint.unwrap() + 1);
            at.split(' ').any(|one| one == name)
                && end.q.iter().zip(&q).all(|(a, b)| angle::difference(*a, *b).abs() < 1e-5)
        };
        if !own.iter().any(|end| is_same(&end)) {
            return Some(format!("no end at {at}, {q:?}"));
        }
    }
    None
}

/// Checks the ordinary poses of an arm. Returns their number.
fn check(name: &str) -> usize {
    let mut source = Source::read(&corpus().join(format!("arms/{name}.urdf"))).unwrap();
    let chain = source.chain.clone().unwrap();
    source.choose_given(&Watch::none()).unwrap();
    let derivation = Derivation::of(&source, &Watch::none()).unwrap();
    let solver = derivation.program().redundant_solver().unwrap();
    let page: Value =
        serde_json::from_str(&fs::read_to_string(corpus().join(format!("{name}.json"))).unwrap()).unwrap();
    let is_ordinary =
        |pose: &&Value| pose["sigma"].as_f64().is_some_and(|sigma| sigma >= ORDINARY) && pose["kind"] != "limits";
    let poses: Vec<&Value> = page["poses"].as_array().unwrap().iter().filter(is_ordinary).collect();
    let faults: Vec<String> = poses
        .iter()
        .filter_map(|pose| {
            let q = match pose.get("q") {
                Some(q) => numbers(q),
                None => numbers(&pose["degrees"]).iter().map(|degrees| degrees.to_radians()).collect(),
            };
            let target = solver.target(chain.forward(&q).unwrap()).unwrap();
            let found = solver.arcs(&target, &solver.limits()).unwrap();
            Some(format!("{q:?}: {}", fault(&found, pose["arcs"].as_array().unwrap())?))
        })
        .collect();
    assert!(faults.is_empty(), "{name}: {} of {}\n{}", faults.len(), poses.len(), faults.join("\n"));
    poses.len()
}

#[test]
fn a_panda_has_the_arcs_of_the_corpus() {
    assert!(check("panda") >= 8);
}

#[test]
fn an_openarm_has_the_arcs_of_the_corpus() {
    assert!(check("openarm") >= 8);
}

#[test]
fn an_iiwa_has_the_arcs_of_the_corpus() {
    assert!(check("iiwa14") >= 3);
}

#[test]
fn a_pr2_has_the_arcs_of_the_corpus() {
    assert!(check("pr2") >= 8);
}

#[test]
fn a_talos_has_the_arcs_of_the_corpus() {
    assert!(check("talos") >= 8);
}

#[test]
#[ignore = "minutes: eigenvalue problems with each joint given"]
fn other_arms_have_the_arcs_of_the_corpus() {
    let names = ["baxter", "fetch", "g1", "gen3", "gr1", "iiwa14_offset", "jaco7", "rizon4", "tiago", "vega", "xarm7"];
    let counts: Vec<usize> = names.iter().map(|name| check(name)).collect();
    assert!(counts.iter().all(|count| *count >= 2), "{counts:?}");
}
