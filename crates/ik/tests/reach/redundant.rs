//! Maps of redundant arms without the value of a given joint, compared with plane geometry, forward kinematics and solvers with a joint given.

use std::f64::consts::TAU;
use std::sync::OnceLock;
use std::time::Duration;

use groebot_ik::reach::{Measure, ReachMap, Request, Survey};
use groebot_ik::solver::Program;
use groebot_ik::{ErrorKind, Result, Watch, derive};
use groebot_robot::kinematics::Chain;
use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

use super::grid;
use crate::codegen::random;
use crate::derive::redundant as derived;

const FREE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

fn map(chain: &Chain, program: &Program, request: &Request) -> Result<ReachMap> {
    Survey::new(&program.solver(), program, Some(chain), request)?.map(&Watch::none())
}

/// Three links of 0.5, 0.4 and 0.15 m that place their end in a plane.
fn planar() -> &'static (Chain, Program) {
    static ARM: OnceLock<(Chain, Program)> = OnceLock::new();
    ARM.get_or_init(|| {
        let text =
            include_str!("../../../../derivations/planar_3r/0_chain.toml").replace("planar_pose", "planar_position");
        let chain = Chain::from_toml(&text).unwrap();
        let program = derive(&chain).unwrap().program().clone();
        (chain, program)
    })
}

/// The law of cosines: with the elbow and the wrist in [0, pi] in sum, the distance falls with both angles. The shoulder turns freely.
#[test]
fn limited_joints_of_three_links_reach_a_ring() {
    let (chain, program) = planar();
    let places = grid([(-1.1, 1.1, 23), (-1.1, 1.1, 23), (0.0, 0.0, 1)]);
    let distance = |elbow: f64, wrist: f64| {
        let (x, y) =
            (0.5 + 0.4 * elbow.cos() + 0.15 * (elbow + wrist).cos(), 0.4 * elbow.sin() + 0.15 * (elbow + wrist).sin());
        x.hypot(y)
    };
    for [elbow, wrist] in [[[0.5, 1.0], [0.0, 0.4]], [[0.2, 2.0], [0.1, 0.8]], [[1.0, 1.05], [0.3, 0.35]]] {
        let (least, most) = (distance(elbow[1], wrist[1]), distance(elbow[0], wrist[0]));
        let limits = Some(vec![FREE, elbow, wrist]);
        let request = Request { measure: Measure::Limits, limits, ..Request::new(places) };
        let found = map(chain, program, &request).unwrap();
        for (place, entry) in found.entries.iter().enumerate() {
            let [x, y, _] = places.at(place);
            let wanted = u32::from((least..=most).contains(&x.hypot(y)));
            assert_eq!((entry.reached, entry.answers, entry.open), (wanted, wanted, 0), "{x} {y}: {least} {most}");
        }
        assert!(found.limited && found.measure == Measure::Limits);
    }
}

/// NAO's hand with four joints: each place that forward kinematics of a joint vector within limits reaches, and none beyond the length of the arm.
#[test]
fn places_of_joint_vectors_within_limits_are_reached() {
    let text = include_str!("../../../../derivations/nao_left_arm_position/0_chain.toml");
    let chain = Chain::from_toml(&text.replace("given = [\"ElbowYaw\"]\n", "")).unwrap();
    let program = derive(&chain).unwrap().program().clone();
    let mut between = random();
    let request = |at: Vector3<f64>| Request {
        measure: Measure::Limits,
        ..Request::new(grid([0, 1, 2].map(|axis| (at[axis], at[axis], 1))))
    };
    let solver = program.solver();
    let reached = |at: Vector3<f64>| {
        let request = request(at);
        let survey = Survey::new(&solver, &program, Some(&chain), &request).unwrap();
        survey.entries(0..1, None).unwrap()[0].reached
    };
    let shoulder = Vector3::new(0.0, 0.098, 0.1);
    // The upper arm with its elbow's offset, and the forearm to the hand.
    let length = 0.105f64.hypot(0.015) + 0.1137f64.hypot(0.012_31);
    for _ in 0..200 {
        let q: Vec<f64> =
            chain.joints().iter().map(|joint| joint.limits.map_or(0.0, |(low, high)| between(low, high))).collect();
        let at = chain.forward(&q).unwrap().translation.vector;
        assert_eq!(reached(at), 1, "{q:?}");
        assert!((at - shoulder).norm() < length);
        let beyond = shoulder + (at - shoulder).normalize() * (length + between(1e-3, 0.5));
        assert_eq!(reached(beyond), 0, "{q:?}");
    }
}

/// The rotations of the spiral (M. Alexa 2022, listing 1).
fn spiral(count: usize) -> Vec<Matrix3<f64>> {
    let (phi, psi) = (2f64.sqrt(), 1.533_751_168_755_204_3_f64);
    let rotation = |number: usize| {
        let s = number as f64 + 0.5;
        let (t, d) = (s / count as f64, TAU * s);
        let (r, big, alpha, beta) = (t.sqrt(), (1.0 - t).sqrt(), d / phi, d / psi);
        let (x, y, z, w) = (r * alpha.sin(), r * alpha.cos(), big * beta.sin(), big * beta.cos());
        Rotation3::from(UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))).into_inner()
    };
    (0..count).map(rotation).collect()
}

/// An iiwa: a target counts if the solver of one joint has a solution within limits for one of many values of this joint, and only if a solution exists.
#[test]
fn poses_count_if_some_value_of_the_given_joint_has_a_solution_within_limits() {
    let chain = derived::iiwa();
    let program = derived::derived().1.program();
    let (solver, orientations) = (program.solver(), 25);
    let limits: Vec<[f64; 2]> =
        chain.joints().iter().map(|joint| joint.limits.unwrap()).map(|(low, high)| [low, high]).collect();
    let [low, high] = limits[program.given_joints[0].joint];
    let places = grid([(0.3, 0.7, 3), (0.2, 0.2, 1), (0.2, 0.9, 3)]);
    let request = Request { measure: Measure::Limits, orientations, ..Request::new(places) };
    let found = map(&chain, program, &request).unwrap();
    let (mut sampled, mut reached) = (0, 0);
    for (place, entry) in found.entries.iter().enumerate() {
        let at = places.at(place);
        let is_within = |turn: &Matrix3<f64>| {
            let pose: Vec<f64> = at.into_iter().chain(turn.transpose().iter().copied()).collect();
            (0..=200).any(|k| {
                let target = [&pose[..], &[low + (high - low) * f64::from(k) / 200.0]].concat();
                !solver.solve_within(&target, &limits).unwrap().is_empty()
            })
        };
        let own = spiral(orientations).iter().filter(|turn| is_within(turn)).count();
        // A grid may miss narrow arcs, but all its solutions are counted.
        assert!(
            entry.reached as usize + entry.open as usize >= own && entry.answers == entry.reached,
            "{place}: {entry:?} {own}"
        );
        (sampled, reached) = (sampled + own, reached + entry.reached as usize);
    }
    assert!(sampled > 50 && sampled < 9 * orientations && reached - sampled <= 3, "{sampled} {reached}");
}

#[test]
fn other_measures_and_wrong_limits_are_refused() {
    let (chain, program) = planar();
    let here = Request::new(grid([(0.3, 0.3, 1), (0.1, 0.1, 1), (0.0, 0.0, 1)]));
    for measure in [Measure::Count, Measure::Manipulability] {
        let error = map(chain, program, &Request { measure, limits: Some(vec![FREE; 3]), ..here.clone() }).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Unsupported);
        assert!(error.message().contains("the measure `limits` is allowed"), "{error}");
    }
    // The description has no limits.
    let within = Request { measure: Measure::Limits, ..here.clone() };
    assert_eq!(map(chain, program, &within).unwrap_err().kind(), ErrorKind::BadValue);
    for limits in [vec![FREE; 2], vec![[1.0, 0.0]; 3], vec![[f64::NAN, 0.0]; 3]] {
        let error = map(chain, program, &Request { limits: Some(limits), ..within.clone() }).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::BadValue);
    }
    // With the value of the given joint, all measures are allowed.
    assert!(map(chain, program, &Request { given: vec![0.1], ..here }).is_ok());
}

#[test]
fn long_maps_of_redundant_arms_can_be_stopped() {
    let program = derived::derived().1.program();
    let places = grid([(-1.0, 1.0, 100), (-1.0, 1.0, 100), (-1.0, 1.0, 100)]);
    let request = Request { measure: Measure::Limits, orientations: 1000, ..Request::new(places) };
    let solver = program.solver();
    let survey = Survey::new(&solver, program, None, &request).unwrap();
    let budget = Watch::none().with_time(Duration::from_millis(30));
    assert_eq!(survey.map(&budget).unwrap_err().kind(), ErrorKind::Budget);
}
