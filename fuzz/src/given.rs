//! Inputs of targets in addition to their bytes: committed descriptions and derivations, read once.

use std::sync::LazyLock;

use groebot::derive::{Description, Ends, InputFile, Source};
use groebot::dynamics::{Base, Equations};
use groebot::kinematics::Chain;
use groebot::model::Robot;
use groebot::solver::Program;

/// The planar arm of two joints, and the files of its folder.
pub(super) const PLANAR_2R: &str = include_str!("../../derivations/planar_2r/0_chain.toml");
pub(super) const PLANAR_2R_CERTIFICATE: &str = include_str!("../../derivations/planar_2r/certificate.json");
pub(super) const PLANAR_2R_DYNAMICS: &str = include_str!("../../derivations/planar_2r/7_dynamics.json");
pub(super) const PLANAR_2R_EQUATIONS: &str = include_str!("../../derivations/planar_2r/7_dynamics.txt");
/// The equations of a planar leg, a chain of six joints solved together, and two legs.
const NAO_LEG: &str = include_str!("../../derivations/nao_arm_planar/0_system.toml");
const CRX_LIKE: &str = include_str!("../../derivations/crx_like/0_chain.toml");

/// The chain of the planar arm.
pub(super) static CHAIN: LazyLock<Chain> = LazyLock::new(|| Chain::from_toml(PLANAR_2R).expect("is committed"));

/// A chain with a pose as target, with revolute joints and a prismatic one.
pub(super) static ARM: LazyLock<Chain> = LazyLock::new(|| {
    let text = include_str!("../../derivations/stanford/0_chain.toml");
    Chain::from_toml(text).expect("is committed")
});

/// The solver of a pose, whose targets may be given with quaternions.
pub(super) static SOLVER: LazyLock<Program> = LazyLock::new(|| {
    let text = include_str!("../../derivations/stanford/5_program.json");
    Program::from_json(text).expect("is committed")
});

/// The equations of motion of one joint.
pub(super) static HINGE: LazyLock<Equations> = LazyLock::new(|| {
    let robot = Robot::from_urdf(include_str!("../../tests/corpus/dynamics/faults/hinge.urdf"));
    Equations::unchecked(&robot.expect("is committed"), Base::Fixed).expect("is committed")
});

/// The sources of derivations of three kinds: equations, a chain, an eigenvalue problem.
pub(super) static SOURCES: LazyLock<[Source; 3]> = LazyLock::new(|| {
    let system = groebot::derive::System::from_toml(NAO_LEG).expect("is committed");
    let chain = |text| Description::Chain(Box::new(Chain::from_toml(text).expect("is committed")));
    [
        source("0_system.toml", NAO_LEG, Description::System(system)),
        source("0_chain.toml", PLANAR_2R, chain(PLANAR_2R)),
        source("0_chain.toml", CRX_LIKE, chain(CRX_LIKE)),
    ]
});

fn source(name: &'static str, text: &str, description: Description) -> Source {
    let input = InputFile { path: name.into(), name, text: text.to_owned(), description, ends: Ends::default() };
    Source::of(input, &Ends::default()).expect("is committed")
}

/// The robot of the walk targets.
pub(super) static WALKER: LazyLock<Robot> = LazyLock::new(groebot::robots::nao_v5);
