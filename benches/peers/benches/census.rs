//! One run that holds what matters of each solver beside its peers, as CSV on the standard output: times, the accuracy at the worst of many
//! ordinary poses, poses lost and answers wrong there and where the robot is singular.
//!
//!     cd benches/peers && cargo bench --bench census > ../record/YYYY-MM-DD-peers.csv

use std::hint::black_box;
use std::process::Command;

use groebot::kinematics::Chain;
use groebot::robots;
use groebot::spatial::Pose;
use groebot_peers::Joints;
use groebot_peers::by_batch;
use groebot_peers::by_ik_geo::IkGeo;
use groebot_peers::by_opw::Opw;
use groebot_peers::by_print;
use groebot_peers::census::Census;
use groebot_peers::inputs::{COUNT, many_poses, singular_poses};
use groebot_peers::rounds::{Contender, medians};

/// Ordinary poses, and singular ones.
const ORDINARY: usize = 100_000;
const SINGULAR: usize = 10_000;
const ROBOTS: [&str; 9] = [
    "puma",
    "ur5",
    "irb120",
    "stanford",
    "nao_left_leg",
    "nao_right_leg",
    "rh0_right_leg",
    "teo_leg",
    "spherical_wrist",
];

/// All answers to a pose.
type Solutions<'a> = dyn Fn(&Pose) -> Vec<Joints> + 'a;

/// A solver: how it goes over all poses, over the first of them, and over joint vectors, and what it answers to one pose.
struct Solver<'a> {
    name: &'static str,
    pass: Box<dyn Fn(usize) + 'a>,
    forward: Box<dyn Fn() + 'a>,
    solutions: Box<Solutions<'a>>,
}

fn main() {
    println!(
        "robot,solver,pose_ns,mean_ns,forward_ns,poses,lost,wrong,worst_position,worst_rotation,singular,singular_lost,singular_wrong,commit"
    );
    let only: Vec<String> = std::env::args().skip(1).filter(|name| !name.starts_with('-')).collect();
    for name in ROBOTS.iter().filter(|name| only.is_empty() || only.iter().any(|only| only == *name)) {
        contest(name);
    }
}

fn chain_of(name: &str) -> Chain {
    let text =
        || std::fs::read_to_string(format!("{}/../../derivations/{name}/0_chain.toml", env!("CARGO_MANIFEST_DIR")));
    let known = robots::ALL.iter().find(|robot| robot.name() == name);
    known.map_or_else(
        || Chain::from_toml(&text().expect("a derivation's chain")).expect("a valid chain"),
        |robot| robot.chain(),
    )
}

fn contest(name: &str) {
    let chain = chain_of(name);
    let (q, poses): (Vec<Vec<f64>>, Vec<Pose>) = many_poses(&chain, ORDINARY).into_iter().unzip();
    let q: Vec<Joints> = q.iter().map(|q| std::array::from_fn(|i| q[i])).collect();
    let singular = singular_poses(&chain, SINGULAR);
    let (ik_geo, opw) = (IkGeo::new(&chain), Opw::new(&chain));
    let mut solvers = vec![ours(name, &poses, &q)];
    solvers.extend(ours_by_batch(name, &poses, &q));
    solvers.extend(ik_geo.as_ref().map(|peer| by_ik_geo(peer, &poses, &q)));
    solvers.extend(opw.as_ref().map(|peer| by_opw(peer, &poses, &q)));
    let measure = |inputs: usize, rounds: usize| {
        let contender = |solver| Contender::new("", move || (pass_of(solver))(inputs));
        medians(inputs, rounds, &mut solvers.iter().map(contender).collect::<Vec<_>>())
    };
    let (usual, mean) = (measure(COUNT, 101), measure(ORDINARY, 5));
    let mut all: Vec<Contender<'_>> = solvers.iter().map(|solver| Contender::new("", || (solver.forward)())).collect();
    let forward = medians(COUNT, 101, &mut all);
    for (i, solver) in solvers.iter().enumerate() {
        let [at, hard] = [&poses, &singular].map(|poses| Census::of(&chain, poses, &solver.solutions));
        println!(
            "{name},{},{:.1},{:.1},{:.1},{},{},{},{:.2e},{:.2e},{},{},{},{}",
            solver.name,
            usual[i],
            mean[i],
            forward[i],
            at.poses,
            at.lost,
            at.wrong,
            at.position,
            at.rotation,
            hard.poses,
            hard.lost,
            hard.wrong,
            commit()
        );
    }
}

fn pass_of<'a>(solver: &'a Solver<'_>) -> &'a dyn Fn(usize) {
    &solver.pass
}

fn ours<'a>(name: &str, poses: &[Pose], q: &'a [Joints]) -> Solver<'a> {
    let printed = by_print::solver(name).expect("a printed solver");
    let targets: Vec<_> = poses.iter().map(by_print::target).collect();
    Solver {
        name: "groebot-printed",
        pass: Box::new(move |count| {
            black_box((printed.pass)(black_box(&targets[..count])));
        }),
        forward: Box::new(move || (printed.forward)(&q[..COUNT])),
        solutions: Box::new(move |pose| (printed.solutions)(&by_print::target(pose))),
    }
}

fn ours_by_batch<'a>(name: &str, poses: &[Pose], q: &'a [Joints]) -> Option<Solver<'a>> {
    let (printed, batches) = (by_print::solver(name)?, by_batch::solver(name)?);
    let targets: Vec<_> = poses.iter().map(by_print::target).collect();
    Some(Solver {
        name: "groebot-batch",
        pass: Box::new(move |count| {
            black_box((batches.pass)(black_box(&targets[..count])));
        }),
        forward: Box::new(move || (printed.forward)(&q[..COUNT])),
        solutions: Box::new(move |pose| (batches.solutions)(&by_print::target(pose))),
    })
}

fn by_ik_geo<'a>(peer: &'a IkGeo, poses: &[Pose], q: &'a [Joints]) -> Solver<'a> {
    let targets: Vec<_> = poses.iter().map(|pose| peer.target(pose)).collect();
    Solver {
        name: "ik-geo",
        pass: Box::new(move |count| {
            targets[..count].iter().for_each(|target| drop(black_box(peer.solve(black_box(target)))))
        }),
        forward: Box::new(move || peer.forward(&q[..COUNT])),
        solutions: Box::new(move |pose| peer.solutions(&peer.target(pose))),
    }
}

fn by_opw<'a>(peer: &'a Opw, poses: &[Pose], q: &'a [Joints]) -> Solver<'a> {
    let targets: Vec<_> = poses.iter().map(|pose| peer.target(pose)).collect();
    Solver {
        name: "opw",
        pass: Box::new(move |count| {
            targets[..count].iter().for_each(|target| drop(black_box(peer.solutions(black_box(target)))))
        }),
        forward: Box::new(move || peer.forward(&q[..COUNT])),
        solutions: Box::new(move |pose| peer.solutions(&peer.target(pose))),
    }
}

/// The commit that was measured.
fn commit() -> String {
    let out = Command::new("git").args(["describe", "--always", "--dirty", "--exclude=*"]).output();
    out.map_or_else(|_| "unknown".to_owned(), |out| String::from_utf8_lossy(&out.stdout).trim().to_owned())
}
