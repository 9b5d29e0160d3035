//! Derived programs compared with the screw solver, by an independent comparison.

use std::f64::consts::PI;

use groebot_ik::Watch;
use groebot_ik::solver::Program;
use groebot_ik::witness::{Options, check_equations};
use groebot_robot::kinematics::screw::two_link::TwoLink;
use groebot_robot::spatial::{Axis, angle};
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

use super::{derive, from_text, read, two_link_text};

/// Two links along z with axes along y.
struct Links {
    solver: TwoLink,
    lengths: [f64; 2],
}

/// A joint vector; a free joint is `None`.
type Answer = [Option<f64>; 2];

impl Links {
    fn new(first: f64, second: f64) -> Links {
        let hip = Axis::new(Vector3::y(), Point3::origin()).unwrap();
        let knee = Axis::new(Vector3::y(), Point3::new(0.0, 0.0, first)).unwrap();
        let solver = TwoLink::new(hip, knee, Point3::new(0.0, 0.0, first + second)).unwrap();
        Links { solver, lengths: [first, second] }
    }

    /// The smaller singular value of the Jacobian over the reach: |det| = L1 L2 |sin|, divided by its Frobenius norm.
    fn sigma(&self, q: [f64; 2]) -> f64 {
        let [a, b] = self.lengths;
        let columns = (a * a + b * b + 2.0 * a * b * q[1].cos()).max(0.0).sqrt().hypot(b);
        a * b * q[1].sin().abs() / columns / (a + b)
    }

    fn miss(&self, q: [f64; 2], target: [f64; 2]) -> f64 {
        let tip = self.solver.forward(q);
        (tip.x - target[0]).hypot(tip.z - target[1]) / self.solver.reach()
    }

    /// Whether `b` represents `a`: they match within the tolerance, and all joint vectors between them reach the target.
    fn same(&self, a: Answer, b: Answer, target: [f64; 2]) -> bool {
        let from = [0, 1].map(|j| a[j].or(b[j]).unwrap_or(0.0));
        let step = [0, 1].map(|j| b[j].map_or(0.0, |b| angle::difference(b, from[j])));
        let gap = step[0].abs().max(step[1].abs());
        let sigma = self.sigma(from);
        let tolerance = if sigma > 1e-3 { 1e-9 } else { (1e-13 / sigma).max(1e-7) };
        let between = |share: f64| self.miss([from[0] + share * step[0], from[1] + share * step[1]], target);
        let worst = [0.25, 0.5, 0.75, 1.0].map(between).into_iter().fold(0.0, f64::max);
        gap <= tolerance && worst <= 1e-11
    }

    /// The disagreement of the two solvers at a target, if there is one.
    fn objection(&self, ours: &[Answer], target: [f64; 2]) -> Option<String> {
        let point = Point3::new(target[0], 0.0, target[1]);
        let theirs: Vec<Answer> = self.solver.solve(&point).unwrap().iter().map(|answer| answer.q).collect();
        let lost = |some: &[Answer], others: &[Answer]| {
            let sure = |a: &&Answer| self.miss(a.map(|q| q.unwrap_or(0.0)), target) <= 1e-13;
            some.iter().filter(sure).any(|a| !others.iter().any(|b| self.same(*a, *b, target)))
        };
        let wrong = ours.iter().any(|a| self.miss(a.map(|q| q.unwrap_or(0.0)), target) > 4e-12);
        let differ = wrong || ours.len() > 2 || lost(ours, &theirs) || lost(&theirs, ours);
        differ.then(|| format!("{:?} at {target:?}: {ours:?}, by screws {theirs:?}", self.lengths))
    }
}

fn leg_answers(program: &Program, target: [f64; 2]) -> Vec<Answer> {
    let answers = program.solve_numbers(&target).unwrap();
    answers.iter().map(|a| [0, 1].map(|j| (!a.free.contains(&j)).then_some(a.q[j]))).collect()
}

/// Targets of two links: arbitrary, near the two boundary circles, near the z axis, near the x axis, near the base.
fn target(lengths: [f64; 2]) -> impl Strategy<Value = [f64; 2]> {
    let [a, b] = lengths;
    let reach = a + b;
    let tiny = (1..=16_i32, any::<bool>())
        .prop_map(|(k, minus): (i32, bool)| 10_f64.powi(-k) * if minus { -1.0 } else { 1.0 });
    let tiny = prop_oneof![1 => Just(0.0), 8 => tiny];
    let turn = prop_oneof![2 => -PI..PI, 1 => prop::sample::select(vec![0.0, PI / 2.0, PI, -PI / 2.0])];
    let circle = prop::sample::select(vec![a + b, (a - b).abs()]);
    prop_oneof![
        (-1.1 * reach..1.1 * reach, -1.1 * reach..1.1 * reach).prop_map(|(x, z)| [x, z]),
        (circle, turn.clone(), tiny.clone()).prop_map(|(r, turn, tiny): (f64, f64, f64)| {
            let r = r * (1.0 + tiny);
            [r * turn.sin(), r * turn.cos()]
        }),
        (tiny.clone(), -reach..reach).prop_map(move |(tiny, along)| [tiny * reach, along]),
        (tiny.clone(), -reach..reach).prop_map(move |(tiny, along)| [along, tiny * reach]),
        (tiny, turn).prop_map(move |(tiny, turn): (f64, f64)| [reach * tiny * turn.sin(), reach * tiny * turn.cos()]),
    ]
}

#[test]
fn the_derived_leg_and_the_screw_solver_agree() {
    let program = derive(&read("nao_leg_sagittal")).program().clone();
    let links = Links::new(100.0, 102.9);
    let mut runner = proptest::test_runner::TestRunner::new(config(4000));
    let run = runner.run(&target(links.lengths), |target| {
        let objection = links.objection(&leg_answers(&program, target), target);
        prop_assert!(objection.is_none(), "{}", objection.unwrap());
        Ok(())
    });
    run.unwrap();
}

#[test]
fn random_two_link_chains_and_the_screw_solver_agree() {
    // For links with a ratio of 500 to 1, the program may miss a solution next to the boundary.
    let lengths = (40..4000_u32, 40..4000_u32, any::<bool>());
    let mut chains = proptest::test_runner::TestRunner::new(config(10));
    let run = chains.run(&lengths, |(a, b, equal)| {
        let b = if equal { a } else { b };
        let (first, both) = (f64::from(a) / 16.0, f64::from(a + b) / 16.0);
        let program =
            derive(&from_text(&two_link_text(&format!("{a}/16"), &format!("{}/16", a + b)))).program().clone();
        let links = Links::new(first, both - first);
        let mut targets = proptest::test_runner::TestRunner::new(config(400));
        let run = targets.run(&target(links.lengths), |target| {
            let objection = links.objection(&leg_answers(&program, target), target);
            prop_assert!(objection.is_none(), "{}", objection.unwrap());
            Ok(())
        });
        prop_assert!(run.is_ok(), "{run:?}");
        Ok(())
    });
    run.unwrap();
}

/// NAO's arm as two links along z with axes along y. Its q4 is the forearm's absolute angle from the y axis, so q2 + relative = pi/2 - q4.
fn arm_answers(program: &Program, target: [f64; 2]) -> Vec<Answer> {
    let answers = program.solve_numbers(&target).unwrap();
    answers.iter().map(|a| [Some(a.q[0]), Some(angle::wrap(PI / 2.0 - a.q[1] - a.q[0]))]).collect()
}

#[test]
fn the_derived_arm_and_the_screw_solver_agree() {
    let program = derive(&read("nao_arm_planar")).program().clone();
    let links = Links::new(105.0, 113.7);
    let mut runner = proptest::test_runner::TestRunner::new(config(4000));
    let run = runner.run(&target(links.lengths), |target| {
        let objection = links.objection(&arm_answers(&program, target), target);
        prop_assert!(objection.is_none(), "{}", objection.unwrap());
        Ok(())
    });
    run.unwrap();
}

/// The arm is nearly stretched and nearly along y. The two values of s2 differ by less than the accuracy of a discriminant.
#[test]
fn the_arm_next_to_a_stratum_and_to_full_stretch_keeps_both_answers() {
    let program = derive(&read("nao_arm_planar")).program().clone();
    let links = Links::new(105.0, 113.7);
    let targets = [
        [218.699_999_214_967_42, -0.012_839_658_859_070_078],
        [218.699_357_515_133_5, -0.002187],
        [218.699_721_950_694_28, -0.348_724_996_339_951_74],
        [218.696_689_591_455_08, 1.203_312_420_837_327],
        [-8.699_998_829_036_634, 0.004_530_578_466_596_467],
        [-8.699_986_264_064_847, -0.015_459_838_189_099_266],
        [8.699_983_549_983_548, -0.016_918_378_453_969_627],
    ];
    for target in targets {
        let answers = arm_answers(&program, target);
        assert_eq!(answers.len(), 2, "{target:?}: {answers:?}");
        assert_eq!(links.objection(&answers, target), None);
    }
}

/// For each mechanism: 100,000 targets and 1,000 exact counts. The printed lines are rows of benches/record/.
#[test]
#[ignore = "takes minutes: cargo test --release -- --ignored the_counts_of_the_design"]
fn the_counts_of_the_design() {
    for folder in ["nao_arm_planar", "nao_leg_sagittal"] {
        let source = read(folder);
        let program = derive(&source).program().clone();
        for (targets, exact) in [(100_000, 0), (1_000, 1_000)] {
            let options = Options { targets, exact, oracle: 0, seed: 2, ..Options::default() };
            let start = std::time::Instant::now();
            let report = check_equations(&source, &program, &options, &Watch::none()).unwrap();
            println!("{folder}: {}; {:.1} s", report.summary(), start.elapsed().as_secs_f64());
            let failures: Vec<String> = report.failures().take(20).map(|row| row.to_string()).collect();
            assert!(failures.is_empty(), "{}", failures.join("\n"));
        }
    }
    let program = derive(&read("nao_arm_planar")).program().clone();
    let links = Links::new(105.0, 113.7);
    let mut runner = proptest::test_runner::TestRunner::new(config(100_000));
    let run = runner.run(&target(links.lengths), |target| {
        let objection = links.objection(&arm_answers(&program, target), target);
        prop_assert!(objection.is_none(), "{}", objection.unwrap());
        Ok(())
    });
    run.unwrap();
}

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { failure_persistence: None, ..crate::cases(cases) }
}
