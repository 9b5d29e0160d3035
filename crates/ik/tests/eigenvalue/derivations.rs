//! The folders in `derivations/` whose joints are found together.

use std::path::{Path, PathBuf};

use groebot_ik::Watch;
use groebot_ik::derive::{Derivation, Source};

/// The names of the folders, and their numbers of complex solutions.
const FOLDERS: [(&str, usize); 9] = [
    ("booster_leg_like", 16),
    ("crx_like", 16),
    ("gen3_like", 16),
    ("general_4r2p", 8),
    ("general_5r1p", 16),
    ("general_6r", 16),
    ("jaco_like", 16),
    ("ur5_calibrated", 16),
    ("xarm6_like", 16),
];

fn folder(name: &str) -> PathBuf {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations").join(name)
}

/// A chain without an order of joints is derived by eigenvalues automatically.
#[test]
fn these_chains_have_so_many_solutions_by_eigenvalues() {
    for (name, dimension) in FOLDERS {
        let source = Source::read(&folder(name)).unwrap();
        let text = std::fs::read_to_string(folder(name).join("certificate.json")).unwrap();
        let derived = Derivation::prove_source(&source, &text).unwrap();
        assert!(derived.eigenvalue().is_some(), "{name} is solved by another method");
        assert_eq!(derived.dimension(), Some(dimension), "{name}");
    }
}

#[test]
fn a_chain_that_nothing_solves_is_still_refused() {
    let mut source = Source::read(&folder("general_6r")).unwrap();
    let mut parts = source.chain.clone().unwrap().parts().clone();
    parts.joints.pop();
    parts.task = groebot_robot::kinematics::Task::Position;
    source.chain = Some(groebot_robot::kinematics::Chain::new(parts).unwrap());
    source.ideal = None;
    assert!(Derivation::of(&source, &Watch::none()).is_err());
}
