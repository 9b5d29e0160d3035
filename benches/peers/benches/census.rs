//! Comparison of each solver with its peers in one run, as CSV on standard output: times, the worst accuracy over many ordinary poses, and lost poses and wrong
//! solutions at ordinary and singular poses.
//!
//!     cd benches/peers && cargo bench --bench census > ../record/YYYY-MM-DD-peers.csv

use std::hint::black_box;
use std::process::Command;

use groebot::kinematics::{Chain, JointKind};
use groebot::robots;
use groebot::spatial::Pose;
use groebot_peers::by_batch;
use groebot_peers::by_c::{self, Compiled};
use groebot_peers::by_ik_geo::IkGeo;
use groebot_peers::by_library::Read;
use groebot_peers::by_opw::Opw;
use groebot_peers::by_print::{self, Target};
use groebot_peers::census::Census;
use groebot_peers::inputs::{COUNT, many_poses, singular_poses};
use groebot_peers::rounds::{Contender, medians};
use groebot_peers::{Joints, Pairs};

/// Number of ordinary poses, and of singular ones.
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

/// Computes all solutions of a pose.
type Solutions<'a> = dyn Fn(&Pose) -> Vec<Joints> + 'a;

/// Same as `Solutions`, but for the target of a generated solver.
type ByTarget<'a> = dyn Fn(&Target) -> Vec<Joints> + 'a;

/// A solver: functions that solve all poses, the first poses and joint vectors, and one that returns the solutions of a pose.
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
    // Batches are solved by this thread alone, whose time is measured.
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global();
    alone.expect("no other pool");
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
    let (ik_geo, opw, read) = (IkGeo::new(&chain), Opw::new(&chain), Read::new(name));
    let mut solvers = ours(name, &chain, &poses, &q);
    solvers.extend(ours_by_batch(name, &chain, &poses, &q));
    solvers.extend(by_c::solvers(name).flat_map(|compiled| ours_in_c(compiled, &poses, &q)));
    solvers.extend(ours_as_read(&read, &poses, &q));
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

/// One target at a time, with angles and with cosines and sines.
fn ours<'a>(name: &str, chain: &'a Chain, poses: &[Pose], q: &'a [Joints]) -> Vec<Solver<'a>> {
    let printed = by_print::solver(name).expect("a printed solver");
    let solver = |name, pass: fn(&[Target]) -> usize, solutions: Box<ByTarget<'a>>| {
        ours_with(name, poses, pass, solutions, printed.forward, q)
    };
    vec![
        solver("groebot-printed", printed.pass, Box::new(move |target| (printed.solutions)(target))),
        solver("groebot-pairs", printed.pass_by_pairs, Box::new(move |target| angles(chain, (printed.pairs)(target)))),
    ]
}

/// All targets as one batch, with angles and with cosines and sines.
fn ours_by_batch<'a>(name: &str, chain: &'a Chain, poses: &[Pose], q: &'a [Joints]) -> Vec<Solver<'a>> {
    let printed = by_print::solver(name).expect("a printed solver");
    let Some(batches) = by_batch::solver(name) else { return Vec::new() };
    let solver = |name, pass: fn(&[Target]) -> usize, solutions: Box<ByTarget<'a>>| {
        ours_with(name, poses, pass, solutions, printed.forward, q)
    };
    vec![
        solver("groebot-batch", batches.pass, Box::new(move |target| (batches.solutions)(target))),
        solver(
            "groebot-batch-pairs",
            batches.pass_by_pairs,
            Box::new(move |target| angles(chain, (batches.pairs)(target))),
        ),
    ]
}

/// C code of one compiler: one target at a time, and all as one batch.
fn ours_in_c<'a>(compiled: &'static Compiled, poses: &[Pose], q: &'a [Joints]) -> [Solver<'a>; 2] {
    let [one, many] = compiled.names();
    let forward = |all: &[Joints]| compiled.forward(all);
    let solutions = || Box::new(|target: &Target| compiled.solutions(target));
    [
        ours_with(one, poses, |targets| compiled.pass(targets), solutions(), forward, q),
        ours_with(many, poses, |targets| compiled.batch(targets), solutions(), forward, q),
    ]
}

/// The library: one target at a time, and all as one batch.
fn ours_as_read<'a>(read: &'a Read, poses: &[Pose], q: &'a [Joints]) -> [Solver<'a>; 2] {
    let forward = |all: &[Joints]| read.forward(all);
    let solutions = || Box::new(|target: &Target| read.solutions(target));
    [
        ours_with("groebot-library", poses, |targets| read.pass(targets), solutions(), forward, q),
        ours_with("groebot-library-batch", poses, |targets| read.batch(targets), solutions(), forward, q),
    ]
}

/// Joint values from cosines and sines.
fn angles(chain: &Chain, list: Vec<Pairs>) -> Vec<Joints> {
    let turns = |joint: usize| chain.joints()[joint].kind == JointKind::Revolute;
    let joints = |pairs: Pairs| {
        std::array::from_fn(|joint| {
            let [cosine, sine] = pairs[joint];
            if turns(joint) { sine.atan2(cosine) } else { cosine }
        })
    };
    list.into_iter().map(joints).collect()
}

fn ours_with<'a>(
    name: &'static str,
    poses: &[Pose],
    pass: impl Fn(&[Target]) -> usize + 'a,
    solutions: Box<ByTarget<'a>>,
    forward: impl Fn(&[Joints]) + 'a,
    q: &'a [Joints],
) -> Solver<'a> {
    let targets: Vec<_> = poses.iter().map(by_print::target).collect();
    Solver {
        name,
        pass: Box::new(move |count| {
            black_box(pass(black_box(&targets[..count])));
        }),
        forward: Box::new(move || forward(&q[..COUNT])),
        solutions: Box::new(move |pose| solutions(&by_print::target(pose))),
    }
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
