//! The example of a MoveIt 2 plugin (`examples/moveit2`): compiled with printed solvers, and called like MoveIt does.
//!
//! `moveit/include` replaces the headers of ROS 2 and MoveIt 2. If `GROEBOT_MOVEIT_INCLUDE` has the folders of the real ones, separated by colons, the plugin
//! is compiled with them, too, and not linked.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use groebot_ik::codegen::single_file;
use groebot_ik::solver::Program;
use groebot_robot::kinematics::Chain;
use nalgebra::{Quaternion, UnitQuaternion};

use super::harness::{build, compile_c, feed};
use super::redundant::panda;
use super::{random, stored};

/// Error codes of MoveIt.
const SUCCESS: f64 = 1.0;
const TIMED_OUT: f64 = -6.0;
const NO_IK_SOLUTION: f64 = -31.0;

/// One search, in the order of the driver's input.
#[derive(Clone)]
struct Search {
    /// Position, then the quaternion x, y, z, w.
    pose: Vec<f64>,
    seed: Vec<f64>,
    /// Negative: none.
    consistency: f64,
    /// How many candidates the callback refuses. Negative: no callback.
    refused: f64,
    timeout: f64,
    /// Negative: none.
    locked: f64,
}

impl Search {
    fn new(chain: &Chain, q: &[f64], seed: &[f64]) -> Search {
        let tip = chain.forward(q).unwrap();
        let pose = tip.translation.vector.iter().chain(tip.rotation.coords.iter()).copied().collect();
        Search { pose, seed: seed.to_vec(), consistency: -1.0, refused: -1.0, timeout: 1e9, locked: -1.0 }
    }

    fn numbers(&self) -> Vec<f64> {
        let options = [self.consistency, self.refused, self.timeout, self.locked];
        self.pose.iter().chain(&self.seed).copied().chain(options).collect()
    }
}

/// The driver's output for one search: lists of joint values, the pose of the tip, and the error code.
#[derive(Default)]
struct Answer {
    candidates: Vec<Vec<f64>>,
    solution: Vec<Vec<f64>>,
    tip: Vec<Vec<f64>>,
    all: Vec<Vec<f64>>,
    samples: Vec<Vec<f64>>,
    code: f64,
}

/// The limits of the robot model.
type Limits = Vec<[f64; 2]>;

/// A plugin for one arm.
struct Plugin {
    folder: tempfile::TempDir,
    chain: Chain,
    limits: Limits,
}

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The plugin's sources with these folders of headers.
fn compile(folder: &Path, headers: &[PathBuf], arguments: &[&str]) -> Option<()> {
    let example = repository().join("examples/moveit2");
    let mut command = Command::new("g++");
    command.args("-std=c++17 -Wall -Wextra -Werror -O0 -I.".split(' '));
    command.args(["-DGROEBOT_BASE=\"base\"", "-DGROEBOT_TIP=\"tip\""]);
    command
        .arg(format!("-I{}", example.display()))
        .args(headers.iter().map(|path| format!("-isystem{}", path.display())));
    command.args(["kinematics.cpp", "solver.cpp"].map(|name| example.join(name)));
    build(command.args(arguments).current_dir(folder))
}

/// `None` if a compiler is missing.
fn plugin(program: &Program, chain: &Chain, limits: Limits) -> Option<Plugin> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let program = Program { name: "arm".into(), ..program.clone() };
    fs::write(path.join("arm.c"), single_file::c(&program, "arm.c", false)).unwrap();
    compile_c(path, &["-c", "arm.c"])?;
    let ours = repository().join("crates/ik/tests/codegen/moveit");
    let driver = ours.join("driver.cpp");
    compile(path, &[ours.join("include")], &[driver.to_str().unwrap(), "arm.o", "-lm", "-o", "plugin"])?;
    if let Some(real) = std::env::var_os("GROEBOT_MOVEIT_INCLUDE") {
        compile(path, &std::env::split_paths(&real).collect::<Vec<_>>(), &["-c"])?;
    }
    Some(Plugin { folder, chain: chain.clone(), limits })
}

impl Plugin {
    fn answers(&self, searches: &[Search]) -> Vec<Answer> {
        let mut text = String::new();
        for number in self.limits.iter().flatten().copied().chain(searches.iter().flat_map(Search::numbers)) {
            writeln!(text, "{number:e}").unwrap();
        }
        let output = feed(&self.folder.path().join("plugin"), text);
        let mut answers = vec![Answer::default()];
        for line in output.lines() {
            let (name, numbers) = line.split_once(' ').unwrap();
            let numbers: Vec<f64> = numbers.split(' ').map(|word| word.parse().unwrap()).collect();
            let answer = answers.last_mut().unwrap();
            match name {
                "candidate" => answer.candidates.push(numbers),
                "solution" => answer.solution.push(numbers),
                "tip" => answer.tip.push(numbers),
                "all" => answer.all.push(numbers),
                "sample" => answer.samples.push(numbers),
                _ => {
                    answer.code = numbers[0];
                    answers.push(Answer::default());
                }
            }
        }
        answers.pop();
        assert_eq!(answers.len(), searches.len());
        for (search, answer) in searches.iter().zip(&answers) {
            self.check(search, answer);
        }
        answers
    }

    /// All joint values reach the pose and are within limits and consistency limits; lists are in order of distance.
    fn check(&self, search: &Search, answer: &Answer) {
        for list in [&answer.candidates, &answer.solution, &answer.all, &answer.samples] {
            for q in list {
                let tip = self.chain.forward(q).unwrap();
                assert!(difference(tip.translation.vector.as_slice(), &search.pose[..3]) < 1e-7, "{q:?}");
                assert!(tip.rotation.angle_to(&rotation(&search.pose)) < 1e-7, "{q:?}");
                for ((value, seed), [low, high]) in q.iter().zip(&search.seed).zip(&self.limits) {
                    assert!(low <= value && value <= high, "{q:?}");
                    assert!(search.consistency < 0.0 || (value - seed).abs() <= search.consistency + 1e-12, "{q:?}");
                }
            }
        }
        for list in [&answer.all, &answer.samples] {
            assert!(list.is_sorted_by(|a, b| distance(a, &search.seed) <= distance(b, &search.seed) + 1e-9));
        }
        for tip in &answer.tip {
            assert!(difference(&tip[..3], &search.pose[..3]) < 1e-7);
            assert!(rotation(tip).angle_to(&rotation(&search.pose)) < 1e-7);
        }
        assert_eq!(answer.solution.len(), usize::from(answer.code == SUCCESS));
    }
}

fn rotation(pose: &[f64]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::new(pose[6], pose[3], pose[4], pose[5]))
}

fn difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt()
}

/// Pairs of joint values within limits: random ones, and others at most 0.02 from them, or anywhere.
fn pairs(limits: &[[f64; 2]], count: usize) -> Vec<[Vec<f64>; 3]> {
    let mut between = random();
    let mut pair = || {
        let q: Vec<f64> = limits.iter().map(|[low, high]| between(*low, *high)).collect();
        let near = q.iter().zip(limits).map(|(q, [low, high])| (q + between(-0.02, 0.02)).clamp(*low, *high)).collect();
        let far = limits.iter().map(|[low, high]| between(*low, *high)).collect();
        [q, near, far]
    };
    (0..count).map(|_| pair()).collect()
}

/// The poses of joint values, which are themselves a solution: the nearest one is as near to the seed, or nearer.
fn finds_the_nearest(plugin: &Plugin) {
    let pairs = pairs(&plugin.limits, 20);
    let mut searches = Vec::new();
    for [q, near, far] in &pairs {
        searches.push(Search::new(&plugin.chain, q, far));
        searches.push(Search { consistency: 0.05, ..Search::new(&plugin.chain, q, near) });
    }
    let answers = plugin.answers(&searches);
    for (search, answer) in searches.iter().zip(&answers) {
        assert_eq!(answer.code, SUCCESS, "{:?}", search.pose);
    }
    for ([q, near, far], answer) in pairs.iter().zip(answers.chunks(2)) {
        assert!(distance(&answer[0].solution[0], far) <= distance(q, far) + 1e-7);
        assert_eq!(answer[0].solution[0], answer[0].all[0]);
        assert!(distance(&answer[1].solution[0], near) <= distance(q, near) + 1e-7);
    }
}

/// Refused candidates are followed by others, until the time is over; out of reach there is none.
fn respects_the_callback(plugin: &Plugin, refused: usize) {
    for [q, _, far] in pairs(&plugin.limits, 5) {
        let plain = Search { refused: refused as f64, ..Search::new(&plugin.chain, &q, &far) };
        let endless = Search { refused: 1e9, timeout: 0.0, ..plain.clone() };
        let mut beyond = plain.clone();
        beyond.pose[0] += 3.0;
        let short = Search { consistency: 1e-9, ..plain.clone() };
        let answers = plugin.answers(&[plain, endless, beyond, short]);
        let found = &answers[0].candidates;
        assert_eq!((answers[0].code, found.len()), (SUCCESS, refused + 1));
        assert_eq!(answers[0].solution[0], found[refused]);
        for (k, candidate) in found.iter().enumerate() {
            let is_new = found[..k].iter().all(|other| difference(candidate, other) > 1e-7);
            assert!(is_new, "{candidate:?} comes again");
        }
        assert_eq!((answers[1].code, answers[1].candidates.len()), (TIMED_OUT, 1));
        for answer in &answers[2..] {
            assert_eq!((answer.code, answer.candidates.len()), (NO_IK_SOLUTION, 0));
        }
    }
}

/// The limits of the Panda's description; the robot model has narrower ones for joint 4.
fn panda_plugin() -> Option<Plugin> {
    let arm = panda();
    let mut limits: Limits =
        arm.chain.joints().iter().map(|joint| joint.limits.unwrap()).map(|(a, b)| [a, b]).collect();
    limits[3] = [-2.9, -0.3];
    plugin(&arm.program, &arm.chain, limits)
}

#[test]
fn a_moveit_plugin_of_a_panda_finds_the_nearest_solution_on_arcs() {
    let Some(plugin) = panda_plugin() else { return };
    finds_the_nearest(&plugin);
    respects_the_callback(&plugin, 8);
}

/// A joint that is locked has the value of the seed, and the samples of arcs are dense.
#[test]
fn a_moveit_plugin_of_a_panda_locks_a_joint_and_samples_arcs() {
    let Some(plugin) = panda_plugin() else { return };
    for (k, [q, _, far]) in pairs(&plugin.limits, 14).into_iter().enumerate() {
        let joint = k % 7;
        let locked = Search { locked: joint as f64, ..Search::new(&plugin.chain, &q, &q) };
        let answers = plugin.answers(&[locked, Search::new(&plugin.chain, &q, &far)]);
        assert!((answers[0].solution[0][joint] - q[joint]).abs() < 1e-9);
        assert!(distance(&answers[0].solution[0], &q) < 1e-6);
        // Samples are at most 0.1 apart, lengths relative to 1 rad. The joint values of the pose are on an arc.
        let nearest = answers[1].samples.iter().map(|sample| distance(sample, &q)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 0.051, "{nearest}");
    }
}

#[test]
fn a_moveit_plugin_of_a_ur5_finds_the_nearest_solution() {
    let stored = stored::named(&["ur5"]).remove(0);
    let limits = vec![[-6.3, 6.3]; 6];
    let Some(plugin) = plugin(&stored.program, &stored.chain.unwrap(), limits) else { return };
    finds_the_nearest(&plugin);
    respects_the_callback(&plugin, 1);
}
