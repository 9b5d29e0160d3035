//! An arm of the corpus with its solvers. Derivations are stored, because those of general arms take minutes.

use std::path::{Path, PathBuf};

use groebot_ik::Watch;
use groebot_ik::derive::{Derivation, Source};
use groebot_ik::solver::Program;
use groebot_ik::solver::redundant::{ArmTarget, RedundantSolver};
use groebot_robot::kinematics::Chain;
use groebot_robot::spatial::Pose;
use groebot_runtime::redundant::{Q, Target};

/// An arm, its chain as described, and its solvers.
pub struct Arm {
    pub name: String,
    pub chain: Chain,
    pub solver: RedundantSolver,
}

/// The name of a description.
pub fn name(file: &Path) -> String {
    file.file_stem().expect("a file has a name").to_string_lossy().into_owned()
}

/// The file of an arm's programs: in the folder `PROGRAMS`, else in `target/programs` of this package.
fn stored(name: &str) -> PathBuf {
    let usual = || Path::new(env!("CARGO_MANIFEST_DIR")).join("target/programs");
    std::env::var_os("PROGRAMS").map_or_else(usual, PathBuf::from).join(format!("{name}.json"))
}

fn derived(file: &Path) -> Program {
    let mut source = Source::read(file).expect("a description");
    source.choose_given(&Watch::none()).expect("a given joint");
    Derivation::of(&source, &Watch::none()).expect("a derivation").program().clone()
}

impl Arm {
    /// Reads a description, and its programs if they are stored. Otherwise derives and stores them.
    pub fn read(file: &Path) -> Arm {
        let name = name(file);
        let stored = stored(&name);
        let program = match std::fs::read_to_string(&stored) {
            Ok(text) => Program::from_json(&text).expect("a stored program"),
            Err(_) => {
                let program = derived(file);
                std::fs::create_dir_all(stored.parent().expect("a folder")).expect("a folder for programs");
                std::fs::write(&stored, program.to_json()).expect("a file for programs");
                program
            }
        };
        let source = Source::read(file).expect("a description");
        let solver = program.redundant_solver().expect("a redundant arm");
        Arm { name, chain: source.chain.expect("a chain"), solver }
    }

    /// The pose of joint values, by the library's forward kinematics.
    pub fn pose(&self, q: &Q) -> Pose {
        self.chain.forward(&q[..self.chain.joints().len()]).expect("values of all joints")
    }

    /// The target of joint values.
    pub fn target(&self, q: &Q) -> Target {
        row(&self.solver.target(self.pose(q)).expect("a pose"))
    }

    /// How much joint values miss a pose: the distance relative to the characteristic length, plus the angle \[rad\].
    pub fn missed(&self, pose: &Pose, q: &Q) -> f64 {
        let own = self.pose(q);
        let off = (own.translation.vector - pose.translation.vector).norm() / self.solver.arm_data().length;
        off + own.rotation.angle_to(&pose.rotation)
    }

    /// Whether joint values are within the described limits, with the tolerance of limits.
    pub fn is_within(&self, q: &Q) -> bool {
        let pairs = self.solver.limits();
        pairs.pairs().iter().zip(q).all(|([low, high], value)| (low - 1.1e-9..=high + 1.1e-9).contains(value))
    }
}

fn row(target: &ArmTarget) -> Target {
    let mut row = [0.0; 12];
    row[..target.numbers().len()].copy_from_slice(target.numbers());
    row
}
