//! Nanoseconds per pose, all solutions, on the same poses: groebot's generated solvers and screw solver compared with
//! their peers.
//!
//!     cd benches/peers && cargo bench --bench poses

use std::hint::black_box;
use std::io::Result;

use groebot::kinematics::Target;
use groebot::kinematics::screw::ScrewSolver;
use groebot::robots::{self, Known};
use groebot_peers::by_batch;
use groebot_peers::by_ik_geo::IkGeo;
use groebot_peers::by_opw::Opw;
use groebot_peers::by_print;
use groebot_peers::inputs::poses;
use groebot_peers::rounds::{Contender, measure};

fn main() -> Result<()> {
    robots::ALL.iter().try_for_each(contest)
}

fn contest(robot: &Known) -> Result<()> {
    let chain = robot.chain();
    let poses: Vec<_> = poses(&chain).into_iter().map(|(_, pose)| pose).collect();
    let mut contenders = Vec::new();
    if let Some(solve) = by_print::solver(robot.name()) {
        let targets: Vec<_> = poses.iter().map(by_print::target).collect();
        assert!((solve.pass)(&targets) >= targets.len(), "{}: every pose has an answer", robot.name());
        contenders.push(Contender::new("groebot-printed", move || {
            black_box((solve.pass)(black_box(&targets)));
        }));
    }
    if let Some(batches) = by_batch::solver(robot.name()) {
        let targets: Vec<_> = poses.iter().map(by_print::target).collect();
        contenders.push(Contender::new("groebot-batch", move || {
            black_box((batches.pass)(black_box(&targets)));
        }));
        let targets: Vec<_> = poses.iter().map(by_print::target).collect();
        contenders.push(Contender::new("groebot-batch-pairs", move || {
            black_box((batches.pass_by_pairs)(black_box(&targets)));
        }));
    }
    if let Ok(ours) = ScrewSolver::new(&chain) {
        let targets: Vec<_> = poses.iter().map(|pose| Target::Pose(*pose)).collect();
        contenders.push(Contender::new("groebot", move || {
            for target in &targets {
                let _ = black_box(ours.solve(black_box(target)));
            }
        }));
    }
    if let Some(peer) = IkGeo::new(&chain) {
        let targets: Vec<_> = poses.iter().map(|pose| peer.target(pose)).collect();
        contenders.push(Contender::new("ik-geo", move || {
            for target in &targets {
                black_box(peer.solve(black_box(target)));
            }
        }));
    }
    if let Some(peer) = Opw::new(&chain) {
        let targets: Vec<_> = poses.iter().map(|pose| peer.target(pose)).collect();
        contenders.push(Contender::new("opw", move || {
            for target in &targets {
                black_box(peer.solutions(black_box(target)));
            }
        }));
    }
    if contenders.len() > 1 {
        print!("{}", measure(&format!("poses/{}", robot.name()), poses.len(), contenders)?);
    }
    Ok(())
}
