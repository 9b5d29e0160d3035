//! The programs of `derivations/`, with the chains that they solve. Those of thin folders are proved again.

use std::f64::consts::PI;
use std::fs;
use std::path::{Path, PathBuf};

use groebot_ik::derive::InputFile;
use groebot_ik::folder;
use groebot_ik::solver::{JointValue, Program};
use groebot_robot::kinematics::{Chain, Task};

/// A program and its chain; `None` for a system of equations.
pub struct Stored {
    pub name: String,
    pub program: Program,
    pub chain: Option<Chain>,
}

/// All of them, by name.
pub fn all() -> Vec<Stored> {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations");
    let mut folders: Vec<PathBuf> = fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    folders.iter().map(|folder| stored(folder)).collect()
}

/// Some of them, in the order of their names.
pub fn named(names: &[&str]) -> Vec<Stored> {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations");
    let mut names = names.to_vec();
    names.sort_unstable();
    names.iter().map(|name| stored(&root.join(name))).collect()
}

fn stored(folder: &Path) -> Stored {
    let program = folder::program(folder).unwrap();
    let chain = InputFile::read(folder).unwrap().chain(&Default::default()).unwrap();
    Stored { name: folder.file_name().unwrap().to_str().unwrap().to_owned(), program, chain }
}

/// Random joint values. In every third set, some joints have values at which configurations are singular.
pub fn joint_values(program: &Program, count: usize, mut between: impl FnMut(f64, f64) -> f64) -> Vec<Vec<f64>> {
    let mut vector = |k: usize| {
        let mut q: Vec<f64> = program
            .joints
            .iter()
            .map(|joint| match joint.value {
                JointValue::Angle { .. } => between(-PI, PI),
                JointValue::Plain(_) => program.scale * between(-1.0, 1.0),
            })
            .collect();
        if k % 3 == 2 {
            let place = (between(0.0, 1.0) * q.len() as f64) as usize;
            let special = [0.0, PI / 2.0, PI, -PI / 2.0, 1e-9][k / 3 % 5];
            q[place.min(program.joints.len() - 1)] = special;
        }
        q
    };
    (0..count).map(&mut vector).collect()
}

/// The target of joint values by the chain's own forward kinematics, which shares no code with the program's.
pub fn reached(chain: &Chain, q: &[f64]) -> Vec<f64> {
    let tip = chain.forward(q).unwrap();
    let (p, r) = (tip.translation, tip.rotation.to_rotation_matrix());
    let position = [p.x, p.y, p.z];
    let rows = (0..9).map(|i| r[(i / 3, i % 3)]);
    let aim = r * chain.aim().into_inner();
    let aim = [aim.x, aim.y, aim.z];
    let mut target: Vec<f64> = match chain.task() {
        Task::Pose => position.into_iter().chain(rows).collect(),
        Task::Position => position.to_vec(),
        Task::Rotation => rows.collect(),
        Task::Ray => position.into_iter().chain(aim).collect(),
        Task::Direction => aim.to_vec(),
        Task::PositionPitchRoll => {
            let (roll, pitch, _) = tip.rotation.euler_angles();
            position.into_iter().chain([pitch, roll]).collect()
        }
        Task::PositionYaw { axis } => {
            let [a, b] = axis.across();
            position.into_iter().chain([aim[b].atan2(aim[a])]).collect()
        }
        Task::PlanarPosition { plane } => plane.coordinates().map(|k| position[k]).to_vec(),
        Task::PlanarPose { plane } => {
            let (a, b) = ((plane.normal() + 1) % 3, (plane.normal() + 2) % 3);
            let turn = r[(b, a)].atan2(r[(a, a)]);
            plane.coordinates().map(|k| position[k]).into_iter().chain([turn]).collect()
        }
    };
    target.extend(chain.given().into_iter().map(|joint| q[joint]));
    target
}
