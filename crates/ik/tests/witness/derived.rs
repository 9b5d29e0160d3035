//! The chains of `derivations/`, derived from their descriptions and checked by all witnesses.
//!
//! `cargo test --release -- --ignored the_counts_of_the_chains --nocapture` prints the rows of `benches/record/DATE-derive-chains.csv`.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI};
use std::path::{Path, PathBuf};
use std::time::Instant;

use groebot_ik::derive::{Derivation, Ends, InputFile};
use groebot_ik::witness::chain::check_chain;
use groebot_ik::witness::{ByScrews, Options, Report, Solver};
use groebot_ik::{Result, Watch};
use groebot_robot::kinematics::{Chain, Solution};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

use super::read;

/// Folders whose descriptions need another derivation: planar formulas in the notation of their source, and a robot whose rounded axes must first be made
/// exact.
const OTHER_WAYS: [&str; 3] = ["irb4600_rounded", "nao_arm_planar", "nao_leg_sagittal"];

/// Folders of chains without an order of joints: see `tests/eigenvalue`.
const TOGETHER: [&str; 9] = [
    "booster_leg_like",
    "crx_like",
    "gen3_like",
    "general_4r2p",
    "general_5r1p",
    "general_6r",
    "jaco_like",
    "ur5_calibrated",
    "xarm6_like",
];

/// All committed chains, with the names of their folders.
fn chains() -> Vec<(String, Chain)> {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations");
    let mut folders: Vec<PathBuf> = std::fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    let name = |folder: &PathBuf| folder.file_name().unwrap().to_str().unwrap().to_owned();
    let chain = |folder: &PathBuf| InputFile::read(folder).unwrap().chain(&Ends::default()).unwrap();
    let named = folders.iter().filter(|folder| {
        let name = name(folder);
        !OTHER_WAYS.contains(&name.as_str()) && !TOGETHER.contains(&name.as_str())
    });
    named.filter_map(|folder| Some((name(folder), chain(folder)?))).collect()
}

fn check(chain: &Chain, derived: &Derivation, options: &Options) -> Result<Report> {
    check_chain(chain, derived.program(), derived.dimension(), options, &Watch::none())
}

fn failures_text(report: &Report, most: usize) -> String {
    let lines = report.failures().take(most).map(|row| format!("{row}; from {:?}\n", row.joints));
    lines.collect()
}

#[test]
fn every_chain_passes_some_of_its_checks() {
    let mut failed = Vec::new();
    for (name, chain) in chains() {
        let start = Instant::now();
        let derived = match Derivation::sequentially(&chain, &Watch::none()) {
            Ok(derived) => derived,
            Err(error) => {
                println!("{name}: {error}");
                failed.push(name);
                continue;
            }
        };
        let taken = start.elapsed();
        let report =
            check(&chain, &derived, &Options { targets: 60, oracle: 1, exact: 6, seed: 6, ..Options::default() })
                .unwrap();
        println!(
            "{name}: {} solutions, {taken:.2?}; {}\n{}",
            derived.dimension().unwrap(),
            report.summary(),
            failures_text(&report, 6)
        );
        if report.failures().count() > 0 {
            failed.push(name);
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}

/// RH0's hand at 5e-11 m from the axis of the second joint, at the double root of the first: four solutions, as by screw theory.
#[test]
fn a_poorly_determined_angle_is_found() {
    let (_, chain) = chains().into_iter().find(|(name, _)| name == "rh0_arm").unwrap();
    let derived = Derivation::sequentially(&chain, &Watch::none()).unwrap();
    let screws = ByScrews::new(&chain).unwrap();
    let solver = derived.program().solver();
    for q in [[2.9299499523295327, -0.5595037167059775, -2.730454790267445], [-2.744637149732931, 1.99631, -2.73045479]]
    {
        let target = derived.reached(&q).unwrap();
        let found = solver.solve_numbers(&target).unwrap();
        // The second joint moves the hand by 1e-10 m per rad, and the target is rounded to 1e-16 m.
        let near = |a: &Solution, q: &[f64]| a.q.iter().zip(q).all(|(a, b)| (a - b).abs() < 1e-5);
        assert!(found.iter().any(|answer| near(answer, &q)), "{q:?}: {found:?}");
        let expected = screws.solve(&target).unwrap();
        assert_eq!(found.len(), expected.len(), "{q:?}: {found:?}\n{expected:?}");
    }
}

fn named(name: &str) -> (Chain, Derivation) {
    let (_, chain) = chains().into_iter().find(|(folder, _)| folder == name).unwrap();
    let derived = Derivation::sequentially(&chain, &Watch::none()).unwrap();
    (chain, derived)
}

/// The hip's yaw is free where one ankle pitch makes the roll a right angle. At a tenth of a radian from it, the other ankle pitch gives isolated solutions.
/// Their number is that of screw theory, and a self-motion contains the joints that made the target.
#[test]
fn a_self_motion_leaves_the_isolated_answers_next_to_it() {
    let (chain, derived) = named("teo_leg");
    let screws = ByScrews::new(&chain).unwrap();
    let straight = [-1.7449671303623484, -FRAC_PI_2, 1.6596867378555082, PI, 1.04472323442393, 2.0882958610197297];
    let bent =
        [-1.1416860189863716, FRAC_PI_2, 2.7271525371587795, 2.6300492957661383, 0.025887027639579507, 2.3680767039];
    let solver = derived.program().solver();
    for q in [straight, bent] {
        let target = derived.reached(&q).unwrap();
        let found = solver.solve_numbers(&target).unwrap();
        let expected = screws.solve(&target).unwrap();
        let isolated = |list: &[Solution]| list.iter().filter(|answer| answer.free.is_empty()).count();
        assert_eq!(isolated(&found), isolated(&expected), "{q:?}: {found:?}\n{expected:?}");
        assert_eq!(found.len(), expected.len(), "{q:?}: {found:?}\n{expected:?}");
    }
}

/// Isolated solutions and self-motions next to each other, in NAO's arm. The cases are:
/// * isolated solutions at 0.001 to 0.02 rad from a self-motion, which were reported as members of it;
/// * a self-motion with a branching within a tenth of a radian, which hid it;
/// * a self-motion of the elbow that meets one of the shoulder.
///
/// The numbers of solutions and of self-motions are those of screw theory, which may report several members of one self-motion.
#[test]
fn answers_beside_a_self_motion_are_isolated() {
    let (chain, derived) = named("nao_left_arm");
    let screws = ByScrews::new(&chain).unwrap();
    let solver = derived.program().solver();
    for q in [
        [-2.1181439729666236, -1.1153124227434787, 3.054851516480267, PI, 1.3995036173656856],
        [-2.4952264818136127, -1.712693381399061, -2.7778912204222905, 3.0028530738514303, 0.05311130956628407],
        [2.497871718673305, 1.4288992721907323, -0.41289268101423593, -2.4555539814107243, 1.7957857342835857],
        [-0.12385353081924944, -1.712693381399061, 0.8613016489776131, PI, 2.4270131098555385],
        [1.9704230982243562, -1.712693381399061, -0.6801266552832805, PI, 0.6853713977081761],
    ] {
        let target = derived.reached(&q).unwrap();
        let found = solver.solve_numbers(&target).unwrap();
        let expected = screws.solve(&target).unwrap();
        let isolated = |list: &[Solution]| list.iter().filter(|answer| answer.free.is_empty()).count();
        assert_eq!(isolated(&found), isolated(&expected), "{q:?}: {found:?}\n{expected:?}");
        assert!(found.iter().any(|answer| !answer.free.is_empty()), "{q:?}: {found:?}");
    }
}

/// NAO's leg with the roll at its singular value and the knee at 1e-4 to 6e-3 rad from fully folded. The hip's yaw is free in four self-motions, as by screw
/// theory. All reported solutions belong to these.
#[test]
fn a_self_motion_next_to_a_folded_knee_is_found() {
    let (chain, derived) = named("nao_left_leg");
    let screws = ByScrews::new(&chain).unwrap();
    let solver = derived.program().solver();
    for q in [
        [
            0.45451946273238164,
            -0.7853981633974485,
            -0.566570565825915,
            -3.1376396298819573,
            -0.31217450785536416,
            -0.08460781878992085,
        ],
        [
            -1.5988854446896346,
            2.356194490192345,
            -2.6959322579491696,
            -3.141485438630129,
            -2.402020018497936,
            -1.7903819881030252,
        ],
        [
            -2.184116102085869,
            2.356194490192345,
            -1.4068132846963755,
            -3.1358444088963315,
            -2.0587161296542122,
            2.688899054666499,
        ],
    ] {
        let target = derived.reached(&q).unwrap();
        let found = solver.solve_numbers(&target).unwrap();
        let expected = screws.solve(&target).unwrap();
        let self_motions = |list: &[Solution]| list.iter().filter(|answer| answer.free == [0]).count();
        assert!(self_motions(&found) >= self_motions(&expected).min(4), "{q:?}: {found:?}\n{expected:?}");
        assert!(found.iter().all(|answer| answer.free == [0]), "{q:?}: {found:?}");
    }
}

/// NAO's leg with the ankle's pitch near a right angle. The self-motions of both knee solutions are 8e-4 rad apart. They were reported as two, but there are
/// four, as by screw theory.
#[test]
fn self_motions_next_to_each_other_are_separate() {
    let (chain, derived) = named("nao_left_leg");
    let screws = ByScrews::new(&chain).unwrap();
    let q = [
        0.6944674764381844,
        0.8123455706692138,
        -2.6241819725399775,
        -0.00040843953925184806,
        -1.5705950258884551,
        -0.033058641838879854,
    ];
    let target = derived.reached(&q).unwrap();
    let self_motions = |list: Vec<Solution>| list.iter().filter(|answer| answer.free == [5]).count();
    let expected = self_motions(screws.solve(&target).unwrap());
    assert_eq!((self_motions(derived.program().solve_numbers(&target).unwrap()), expected), (4, 4));
}

/// NAO's arm next to targets where its solutions meet in pairs: eight solutions. Pairs are 4e-7 rad apart in the shoulder and 2e-6 rad in the wrist, and
/// between them the equations have errors of only 7e-15. They were reported as four.
#[test]
fn close_answers_are_two() {
    let (chain, derived) = named("nao_left_arm");
    let screws = ByScrews::new(&chain).unwrap();
    let q = [0.8627998442172125, -2.3824601626755086, 2.5481778138821483, -1.356032992644737, -1.6545327338122349];
    let target = derived.reached(&q).unwrap();
    let (found, expected) = (derived.program().solve_numbers(&target).unwrap(), screws.solve(&target).unwrap());
    assert_eq!((found.len(), expected.len()), (8, 8), "{found:?}\n{expected:?}");
}

/// The arm is stretched and the wrist parallel to it. The self-motions cover 0.046, 0.006 and 0.001 rad of the last joint's circle. They were reported as
/// several isolated solutions, none of them the joint values that made the target.
#[test]
fn a_self_motion_on_a_small_part_of_the_circle_is_found() {
    let (chain, derived) = named("ur5");
    let solver = derived.program().solver();
    for q in [
        [1.7831333503075366, 1.7935589547926682, 0.0, -1.596449081918493, PI, 2.6668881695581392],
        [1.9718164955569466, 2.150909511394738, 0.0, -1.574327778109324, PI, -2.0946209055636196],
        [0.014418844465883485, -2.013769168566549, 0.0, -1.5713535665710783, PI, -0.41288617615122725],
    ] {
        let found = solver.solve_numbers(&derived.reached(&q).unwrap()).unwrap();
        assert!(found.iter().any(|answer| answer.free == [5]), "{q:?}: {found:?}");
        let beside = |a: &Solution| a.free.is_empty() && (a.q[4].abs() - PI).abs() < 1e-6;
        assert!(!found.iter().any(beside), "{q:?}: {found:?}");
    }
    let report =
        check(&chain, &derived, &Options { targets: 700, oracle: 0, exact: 0, seed: 9, ..Options::default() }).unwrap();
    assert_eq!(report.failures().count(), 0, "{}", failures_text(&report, 6));
}

/// The last axis is parallel to those of the arm, so the wrist rotates along a part of the circle, within the reach of the elbow. From the first joint values
/// it rotates in both directions; from the second ones, with the arm stretched, in one.
#[test]
fn a_self_motion_along_a_part_of_the_circle_is_found() {
    let (_, derived) = named("offset_wrist");
    let bent = [-2.3196916176, -2.0761626803, 0.0983141029, -1.5544591030, -FRAC_PI_2, 2.1506580949];
    let stretched = [1.5756778981, -0.2200531633, 0.0, -1.2689545032, -FRAC_PI_2, 1.8006871953];
    let solver = derived.program().solver();
    for q in [bent, stretched] {
        let target = derived.reached(&q).unwrap();
        let found = solver.solve_numbers(&target).unwrap();
        assert!(found.iter().any(|answer| answer.free == [5]), "{q:?}: {found:?}");
        for answer in found {
            let reached = derived.reached(&answer.q).unwrap();
            assert!(reached.iter().zip(&target).all(|(a, b)| (a - b).abs() < 1e-12), "{answer:?}");
        }
    }
}

/// The robot as described, whose wrist axes miss each other by 1e-5 m, solved by the closed form of the ideal one. Near singular poses it may have more
/// solutions than the ideal robot: ten by exact counting at rational poses. So no bound is given.
#[test]
fn a_rounded_robot_is_solved_at_singular_poses_too() {
    let source = read("irb4600_rounded");
    let derived = Derivation::of(&source, &Watch::none()).unwrap();
    let options = Options { targets: 60, oracle: 1, exact: 6, seed: 6, ..Options::default() };
    let report = check_chain(
        derived.sequential().unwrap().problem.measured(),
        derived.program(),
        None,
        &options,
        &Watch::none(),
    )
    .unwrap();
    assert_eq!(report.failures().count(), 0, "{}\n{}", report.summary(), failures_text(&report, 6));
}

/// Next to the folded arm, the ideal robot has one double root. The described robot has two solutions, 0.03 rad apart.
#[test]
fn both_answers_of_a_rounded_robot_next_to_its_folded_arm_are_found() {
    let derived = Derivation::of(&read("irb4600_rounded"), &Watch::none()).unwrap();
    let q = [
        -2.419657322913249,
        1.0825525108643583,
        1.7500260841334363,
        1.3606631884633862,
        -1.8578153759044664,
        -0.612636560626624,
    ];
    let elsewhere = [-2.419657094109, 1.054870837519, 1.752177158433, 1.353371642241, -1.852398087691, -0.638629516560];
    let target = derived.reached(&q).unwrap();
    let found = derived.program().solve_numbers(&target).unwrap();
    for near in [q, elsewhere] {
        let is_found = |a: &Solution| a.q.iter().zip(near).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(found.iter().any(is_found), "{near:?}: {found:?}");
        let reached = derived.reached(&near).unwrap();
        assert!(reached.iter().zip(&target).all(|(a, b)| (a - b).abs() < 1e-11), "{near:?}");
    }
}

/// Next to the stretched and the folded arm, the ideal robot has one double root or none. The described robot has two solutions.
#[test]
fn a_rounded_robot_keeps_both_answers_next_to_its_stretched_arm() {
    let derived = Derivation::of(&read("irb4600_rounded"), &Watch::none()).unwrap();
    // The wrist is 0.96 m ahead of axis 3 and 0.175 m above it; axis 2 is vertically below axis 3.
    let stretched = 0.175_f64.atan2(0.96) - FRAC_PI_2;
    let solver = derived.program().solver();
    for (straight, width) in [(stretched, 1e-3), (stretched, 1e-2), (stretched + PI, 1e-3), (stretched + PI, 1e-2)] {
        let mut runner = TestRunner::new(Config { failure_persistence: None, ..Config::with_cases(250) });
        let run = |mut q: [f64; 6]| {
            q[2] = straight + width * q[2] / 3.0;
            // Next to a straight wrist, joints 4 and 6 are poorly determined.
            prop_assume!(q[4].sin().abs() > 0.05);
            let found = solver.solve_numbers(&derived.reached(&q).unwrap()).unwrap();
            // Where both solutions nearly meet, rounding of the target gives larger errors of the joints.
            let singular_values =
                derived.sequential().unwrap().problem.measured().spatial_jacobian(&q).unwrap().singular_values();
            let known = f64::max(1e-6, 1e-13 / singular_values.min());
            let is_found = |a: &Solution| a.q.iter().zip(q).all(|(a, b)| (a - b).abs() < known);
            prop_assert!(found.iter().any(is_found), "{q:?}: {found:?}");
            Ok(())
        };
        runner.run(&prop::array::uniform6(-3.0..3.0), run).unwrap();
    }
}

/// The number of targets by number of solutions, such as `4:10 8:990`.
fn histogram(report: &Report) -> String {
    let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
    report.rows.iter().for_each(|row| *counts.entry(row.solutions).or_default() += 1);
    counts.iter().map(|(answers, rows)| format!("{answers}:{rows}")).collect::<Vec<_>>().join(" ")
}

/// For each chain, or for the named ones: 100,000 targets of all kinds, and 1,000 exact counts.
#[test]
#[ignore = "hours: GROEBOT_CHAINS=puma,ur5 cargo test --release -- --ignored the_counts_of_the_chains --nocapture"]
fn the_counts_of_the_chains() {
    println!(
        "chain,solutions,run,class,targets,failed,counted_exactly,by_screws,residual_p50,residual_p99,residual_p99.9,residual_max,joints_max,answers,seconds"
    );
    let mut failed = Vec::new();
    let requested = std::env::var("GROEBOT_CHAINS").unwrap_or_default();
    let requested: Vec<&str> = requested.split(',').filter(|name| !name.is_empty()).collect();
    for (name, chain) in
        chains().into_iter().filter(|(name, _)| requested.is_empty() || requested.contains(&name.as_str()))
    {
        let derived = Derivation::sequentially(&chain, &Watch::none()).unwrap();
        // A third of the targets are random, and the first of these are counted.
        for (run, targets, exact) in [("poses", 100_000, 0), ("counts", 2_860, 1_000)] {
            let start = Instant::now();
            let report =
                check(&chain, &derived, &Options { targets, oracle: 0, exact, seed: 9, ..Options::default() }).unwrap();
            let seconds = start.elapsed().as_secs_f64();
            print_classes(&name, run, derived.dimension().unwrap(), &report, seconds);
            if report.failures().count() > 0 {
                println!(
                    "# {name}\n{}",
                    failures_text(&report, 10).lines().map(|line| format!("# {line}\n")).collect::<String>()
                );
                failed.push(name.clone());
            }
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}

fn print_classes(name: &str, run: &str, dimension: usize, report: &Report, seconds: f64) {
    let summary = report.summary();
    for class in report.accuracy().classes {
        let shown = |value: Option<f64>| value.map(|value| format!("{value:.1e}")).unwrap_or_default();
        let residuals = [0.5, 0.99, 0.999, 1.0].map(|share| shown(class.residual(share))).join(",");
        let joints = shown(class.distance(1.0));
        println!(
            "{name},{dimension},{run},{},{},{},{},{},{residuals},{joints},{},{seconds:.0}",
            class.name,
            class.rows,
            class.failed,
            summary.exact,
            summary.screw,
            histogram(report)
        );
    }
}
