//! Solvers of chains that share actuators: printed from their programs, compiled, and compared with them.

use std::path::Path;

use groebot_ik::folder;
use groebot_robot::kinematics::Chain;

use super::harness::compare_hosted;
use super::random;
use super::stored::reached;

/// Number of joints of a leg that the other leg does not share: the last ones of its chain.
const OWN: usize = 5;

/// The poses of both feet for joint values in (-1, 1), by the chains' own forward kinematics. Given joints are zero.
fn target(folder: &Path) -> Vec<f64> {
    let [left, right] = ["left.toml", "right.toml"].map(|file| Chain::read(&folder.join(file)).unwrap());
    let mut between = random();
    let mut q: Vec<f64> = left.joints().iter().map(|_| between(-1.0, 1.0)).collect();
    left.given().into_iter().for_each(|joint| q[joint] = 0.0);
    let mut target = reached(&left, &q);
    let own = q.len() - OWN;
    q[own..].iter_mut().for_each(|value| *value = between(-1.0, 1.0));
    target.extend(&reached(&right, &q)[..12]);
    target
}

#[test]
fn committed_solvers_of_coupled_chains_answer_like_their_programs() {
    for (name, least) in [("nao_legs_poses", 16), ("nao_legs_yaw", 16)] {
        let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations").join(name);
        let program = folder::program(&folder).unwrap();
        let targets = [target(&folder), vec![9.0; program.inputs.len()]];
        if let Some(report) = compare_hosted(&program, &targets) {
            assert!(report.answers >= least && report.refused == 1, "{name}: {report:?}");
        }
    }
}
