//! Reachability of arms, compared with independent computations.

use std::f64::consts::{PI, TAU};

use groebot_ik::Watch;
use groebot_ik::reach::{Measure, Request, Survey};
use groebot_robot::kinematics::screw::ScrewSolver;
use groebot_robot::kinematics::{Chain, Target};
use groebot_robot::spatial::Pose;
use nalgebra::{Isometry3, Matrix3, Quaternion, Rotation3, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

use super::{derivation, grid, map};

/// Random rotations from four normal numbers, independent of the library's orientations.
fn rotations(count: usize) -> Vec<UnitQuaternion<f64>> {
    let mut runner = TestRunner::deterministic();
    let mut chance = || (0.0..1.0f64).new_tree(&mut runner).unwrap().current();
    let mut normal = || (-2.0 * (1.0 - chance()).ln()).sqrt() * (TAU * chance()).cos();
    (0..count)
        .map(|_| UnitQuaternion::from_quaternion(Quaternion::new(normal(), normal(), normal(), normal())))
        .collect()
}

#[test]
fn two_links_reach_a_ring() {
    let (long, short) = (0.5, 0.4);
    let places = grid([(-1.0, 1.0, 41), (-1.0, 1.0, 41), (0.0, 0.0, 1)]);
    let found = map("planar_2r", &Request { measure: Measure::Manipulability, ..Request::new(places) }).unwrap();
    for (place, entry) in found.entries.iter().enumerate() {
        let [x, y, _] = places.at(place);
        let distance = x.hypot(y);
        // The law of cosines; Yoshikawa's measure of two links is l1 l2 |sin q2|.
        let cosine = (distance * distance - long * long - short * short) / (2.0 * long * short);
        if (cosine.abs() - 1.0).abs() < 1e-6 {
            continue;
        }
        let answers = if cosine.abs() < 1.0 { 2 } else { 0 };
        assert_eq!((entry.answers, entry.reached), (answers, answers / 2), "{x} {y}");
        let wanted = if answers == 2 { long * short * (1.0 - cosine * cosine).sqrt() } else { 0.0 };
        let off = |own: f32| (f64::from(own) - wanted).abs();
        // Entries of maps are in single precision.
        assert!(off(entry.best) < 1e-7 && off(entry.mean) < 1e-7, "{x} {y}: {entry:?}");
    }
    assert!(found.reached() > 600 && found.index(0) == 0.0);
}

#[test]
fn limits_leave_what_is_within() {
    let places = grid([(-0.8, 0.8, 9), (0.05, 0.85, 9), (0.0, 0.0, 1)]);
    // The elbow bends in one direction. The shoulder's limits need a whole turn, which no solution has initially.
    let limits = vec![[TAU, TAU + PI], [0.0, 3.0]];
    let within = map("planar_2r", &Request { limits: Some(limits), ..Request::new(places) }).unwrap();
    let mut kept = 0;
    for (place, entry) in within.entries.iter().enumerate() {
        let [x, y, _] = places.at(place);
        let cosine = (x * x + y * y - 0.41) / 0.4;
        let wanted = cosine.abs() < 1.0 && {
            let elbow = cosine.acos();
            let shoulder = y.atan2(x) - (0.4 * elbow.sin()).atan2(0.5 + 0.4 * elbow.cos());
            (0.0..=PI).contains(&shoulder.rem_euclid(TAU)) && elbow <= 3.0
        };
        assert_eq!(entry.answers, u32::from(wanted), "{x} {y}");
        kept += entry.answers;
    }
    assert!(kept > 10 && (kept as usize) < places.places());
}

#[test]
fn self_motions_are_walked_to_within_limits() {
    // On its yaw axis the polar arm may rotate freely; half of all rotations are within limits.
    let places = grid([(0.0, 0.0, 1), (1.0, 1.6, 4), (0.0, 0.0, 1)]);
    let free = [f64::NEG_INFINITY, f64::INFINITY];
    let all = map("polar", &Request::new(places)).unwrap();
    assert_eq!(all.reached(), 4);
    for yaw in [[0.3, 0.45], [-2.9, -2.75], [2.9, 3.05]] {
        let within = map("polar", &Request { limits: Some(vec![yaw, free, free]), ..Request::new(places) }).unwrap();
        assert_eq!(within.reached(), 4, "{yaw:?}");
    }
    // Beside the axis no rotation is within limits.
    let beside = grid([(0.3, 0.3, 1), (1.0, 1.6, 4), (0.0, 0.0, 1)]);
    let within = map("polar", &Request { limits: Some(vec![[0.3, 0.4], free, free]), ..Request::new(beside) }).unwrap();
    assert_eq!(within.reached(), 0);
}

/// The share of random rotations that the screw solver reaches at a place, and the number of solutions for all of them.
fn by_screws(chain: &Chain, at: Vector3<f64>, rotations: &[UnitQuaternion<f64>]) -> (f64, f64) {
    let screws = ScrewSolver::new(chain).unwrap();
    let counts = rotations.iter().map(|rotation| {
        screws.solve(&Target::Pose(Isometry3::from_parts(Translation3::from(at), *rotation))).unwrap().len()
    });
    let counts: Vec<usize> = counts.collect();
    let reached = counts.iter().filter(|count| **count > 0).count();
    (reached as f64 / counts.len() as f64, counts.iter().sum::<usize>() as f64 / counts.len() as f64)
}

#[test]
fn arms_of_six_joints_reach_what_the_screw_solver_reaches_by_chance() {
    let rotations = rotations(1500);
    for name in ["ur5", "puma"] {
        let (chain, _) = derivation(name);
        let reach = chain.reach();
        let places =
            grid([(0.1 * reach, 0.85 * reach, 4), (0.15 * reach, 0.15 * reach, 1), (0.3 * reach, 0.3 * reach, 1)]);
        let mut between = 0;
        let witness: Vec<(f64, f64)> =
            (0..places.places()).map(|place| by_screws(&chain, places.at(place).into(), &rotations)).collect();
        for seed in [None, Some(11)] {
            let found = map(name, &Request { orientations: 1500, seed, ..Request::new(places) }).unwrap();
            for (place, entry) in found.entries.iter().enumerate() {
                let (share, answers) = witness[place];
                let own = f64::from(entry.answers) / 1500.0;
                // Four standard deviations of a count over 1,500 random rotations, with up to eight solutions each.
                let (bound, slack) = (4.0 * 0.5 / 1500f64.sqrt(), 4.0 * 4.0 / 1500f64.sqrt());
                assert!((found.index(place) - share).abs() < bound, "{name} {place}: {} {share}", found.index(place));
                assert!((own - answers).abs() < slack, "{name} {place}: {own} {answers}");
                between += usize::from(share > 0.05 && share < 0.95);
            }
        }
        assert!(between > 0, "{name}");
    }
}

#[test]
fn tilts_and_directions_and_angles_are_spread_too() {
    // A ray, pitch and roll, and the angle in a plane: the share agrees with that for other orientations.
    let tasks =
        [("nao_left_arm", [0.06, 0.13, 0.11]), ("upright_arm", [0.3, 0.2, 0.4]), ("planar_3r", [0.5, 0.3, 0.0])];
    for (name, at) in tasks {
        let places = grid(at.map(|at| (at, at, 1)));
        let share = |orientations: usize, seed: Option<u64>| {
            map(name, &Request { orientations, seed, ..Request::new(places) }).unwrap().index(0)
        };
        let dense = share(20_000, None);
        assert!(dense > 0.01, "{name}: {dense}");
        for (count, seed) in [(2000, None), (2000, Some(5)), (1999, Some(6))] {
            assert!((share(count, seed) - dense).abs() < 0.05, "{name}: {} {dense}", share(count, seed));
        }
    }
}

/// The columns of the Jacobian in the base's axes, by finite differences of forward kinematics.
fn differences(chain: &Chain, q: &[f64]) -> Vec<[f64; 6]> {
    let step = 1e-6;
    let pose = |joint: usize, step: f64| -> Pose {
        let mut q = q.to_vec();
        q[joint] += step;
        chain.forward(&q).unwrap()
    };
    let column = |joint: usize| {
        let (before, after) = (pose(joint, -step), pose(joint, step));
        let v = (after.translation.vector - before.translation.vector) / (2.0 * step);
        let w = (after.rotation * before.rotation.inverse()).scaled_axis() / (2.0 * step);
        [v.x, v.y, v.z, w.x, w.y, w.z]
    };
    (0..q.len()).map(column).collect()
}

#[test]
fn manipulability_is_that_of_differences() {
    for name in ["ur5", "puma", "stanford", "iiwa14", "scara", "polar"] {
        let (chain, _) = derivation(name);
        let q: Vec<f64> = (0..chain.joints().len()).map(|joint| 0.3 + 0.37 * joint as f64).collect();
        let columns = differences(&chain, &q);
        let rows = if name == "polar" { 3 } else { 6 };
        let jacobian = nalgebra::DMatrix::from_fn(rows, columns.len(), |row, column| columns[column][row]);
        // The product of the singular values.
        let wanted: f64 = jacobian.singular_values().iter().product();
        let own = chain.manipulability(&q);
        assert!((own - wanted).abs() < 1e-6 * wanted.max(1e-3), "{name}: {own} {wanted}");
        assert!(own > 1e-4, "{name}: {own}");
    }
}

#[test]
fn units_and_joints_that_follow_leave_the_manipulability_as_it_is() {
    let arm = |unit: &str, scale: f64, more: &str| {
        let text = format!(
            "name = \"arm\"\n{unit}\ntask = {{ kind = \"planar_position\", plane = \"xy\" }}\ntip = {{ point = [{}, 0, 0] }}\n\
             [[joint]]\nname = \"A\"\ntype = \"revolute\"\naxis = [0, 0, 1]\npoint = [0, 0, 0]\n\
             [[joint]]\nname = \"B\"\ntype = \"revolute\"\naxis = [0, 0, 1]\npoint = [{}, 0, 0]\n{more}",
            0.9 * scale,
            0.5 * scale,
        );
        Chain::from_toml(&text).unwrap()
    };
    let q = [0.3, 1.1];
    let wanted = 0.5 * 0.4 * f64::sin(1.1);
    for chain in [arm("", 1.0, ""), arm("length_unit = \"mm\"", 1000.0, "")] {
        assert!((chain.manipulability(&q) - wanted).abs() < 1e-12, "{}", chain.manipulability(&q));
    }
    let more = "[[joint]]\nname = \"C\"\ntype = \"revolute\"\naxis = [0, 0, 1]\npoint = [0.7, 0, 0]\nmimic = { joint = \"B\", multiplier = -0.5 }";
    let chain = arm("", 1.0, more);
    let q = [0.3, 1.1, -0.55];
    let columns = differences(&chain, &q);
    // Two motions: that of the first joint, and that of the second one with the joint that follows it.
    let [a, b] = [columns[0], std::array::from_fn(|row| columns[1][row] - 0.5 * columns[2][row])];
    let wanted = (a[0] * b[1] - a[1] * b[0]).abs();
    assert!(wanted > 0.05 && (chain.manipulability(&q) - wanted).abs() < 1e-8, "{} {wanted}", chain.manipulability(&q));
}

#[test]
fn places_beyond_the_chain_are_counted_as_by_the_solver() {
    for (name, reach, seed) in
        [("ur5", 1.6, None), ("ur5", 1.0, Some(3)), ("puma", 1.2, None), ("nao_left_arm", 0.35, None)]
    {
        let (chain, program) = derivation(name);
        let axis = (-reach, reach, 11);
        let (request, solver) = (Request { orientations: 30, seed, ..Request::new(grid([axis; 3])) }, program.solver());
        let by = |chain: Option<&Chain>| {
            Survey::new(&solver, &program, chain, &request).unwrap().map(&Watch::none()).unwrap()
        };
        let whole = by(None);
        assert_eq!(whole, by(Some(&chain)), "{name}");
        assert!(whole.reached() > 100, "{name}");
    }
}

#[test]
fn the_best_and_the_mean_are_those_of_all_answers() {
    let (chain, program) = derivation("puma");
    let reach = chain.reach();
    let at = [0.4 * reach, 0.2 * reach, 0.3 * reach];
    // One orientation at a place: the identity rotated by the seed of the place. There are as many maps as orientations.
    let request =
        Request { orientations: 50, measure: Measure::Manipulability, ..Request::new(grid(at.map(|at| (at, at, 1)))) };
    let solver = program.solver();
    let found = Survey::new(&solver, &program, Some(&chain), &request).unwrap().map(&Watch::none()).unwrap();
    // The rotation of the spiral in the form of the paper (M. Alexa 2022, listing 1).
    let (phi, psi) = (2f64.sqrt(), 1.533_751_168_755_204_3_f64);
    let (mut best, mut sum, mut reached) = (0.0f64, 0.0, 0);
    for number in 0..50 {
        let s = f64::from(number) + 0.5;
        let (t, d) = (s / 50.0, TAU * s);
        let (r, big, alpha, beta) = (t.sqrt(), (1.0 - t).sqrt(), d / phi, d / psi);
        let (x, y, z, w) = (r * alpha.sin(), r * alpha.cos(), big * beta.sin(), big * beta.cos());
        let turn: Matrix3<f64> =
            Rotation3::from(UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))).into_inner();
        let target: Vec<f64> = at.into_iter().chain(turn.transpose().iter().copied()).collect();
        let own = solver.solve_numbers(&target).unwrap();
        let most = own.iter().map(|answer| chain.manipulability(&answer.q)).fold(0.0, f64::max);
        (best, sum, reached) = (best.max(most), sum + most, reached + u32::from(!own.is_empty()));
    }
    let entry = found.entries[0];
    assert_eq!(entry.reached, reached);
    let off = |own: f32, wanted: f64| (f64::from(own) - wanted).abs() / wanted;
    assert!(off(entry.best, best) < 1e-6 && off(entry.mean, sum / f64::from(reached)) < 1e-6, "{entry:?}");
}
