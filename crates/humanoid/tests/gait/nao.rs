//! Joint angles of a walk, checked by forward kinematics and by the derived solver for both legs together.

use groebot_humanoid::gait::{Gait, Regular, TICK, Walk};
use groebot_robot::kinematics::Chain;
use groebot_robot::motion::{Bounds, Trajectory, findings};
use groebot_robot::robots;
use groebot_robot::spatial::Pose;

use super::{regular, request, robot, walk};

/// The joint values of a leg at a sample.
fn leg(walk: &Walk, sample: usize, prefix: &str) -> Vec<f64> {
    let start = robot().0.joint(&format!("{prefix}HipYawPitch")).unwrap();
    walk.motion.postures[sample].q[start..start + 6].to_vec()
}

pub fn feet_are_where_they_should_be(walk: &Walk) {
    let chains: [(Chain, &str); 2] = [(robots::nao_left_leg(), "L"), (robots::nao_right_leg(), "R")];
    for (sample, reference) in walk.references.iter().enumerate() {
        let torso = walk.motion.postures[sample].world_from_torso;
        for ((chain, prefix), sole) in chains.iter().zip(&reference.world_from_soles) {
            let reached: Pose = torso * chain.forward(&leg(walk, sample, prefix)).unwrap();
            let miss = (reached.to_homogeneous() - sole.to_homogeneous()).amax();
            assert!(miss < 1e-9, "{sample} {prefix}: {miss}");
        }
        assert_eq!(leg(walk, sample, "L")[0], leg(walk, sample, "R")[0], "one actuator");
        let up = torso.rotation * nalgebra::Vector3::z();
        assert!((up.z - 1.0).abs() < 1e-12, "the torso is upright");
    }
}

#[test]
fn forward_kinematics_puts_the_feet_on_their_prints() {
    feet_are_where_they_should_be(&walk(&request(&regular())).unwrap());
    feet_are_where_they_should_be(&walk(&request(&Regular { turn: 0.3, length: 0.02, ..regular() })).unwrap());
}

/// The derived solver for both legs with one shared actuator has the torso's heading as an unknown. The walk's posture is among its solutions.
#[test]
fn turning_agrees_with_the_derived_solver_of_both_legs() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../derivations/nao_legs_yaw");
    let program = groebot_ik::folder::program(folder.as_ref()).unwrap();
    let walk = walk(&request(&Regular { turn: 0.3, length: 0.02, ..regular() })).unwrap();
    let turned = |sample: &usize| leg(&walk, *sample, "L")[0].abs() > 0.02;
    let samples: Vec<usize> = (0..walk.references.len()).step_by(97).filter(turned).collect();
    assert!(samples.len() >= 2);
    for sample in samples.into_iter().take(2) {
        let posture = &walk.motion.postures[sample];
        let from_torso = |sole: &Pose| {
            let p = sole.translation.vector - posture.world_from_torso.translation.vector;
            let r = sole.rotation.to_rotation_matrix();
            [p.x, p.y, p.z].into_iter().chain(r.matrix().transpose().iter().copied()).collect::<Vec<f64>>()
        };
        let [left, right] = walk.references[sample].world_from_soles.each_ref().map(from_torso);
        let target: Vec<f64> = left.into_iter().chain([0.0, 0.0]).chain(right).collect();
        let yaw = posture.world_from_torso.rotation.scaled_axis().z;
        let mut expected = vec![yaw, 0.0, 0.0];
        expected.extend(leg(&walk, sample, "L"));
        expected.extend(&leg(&walk, sample, "R")[1..]);
        let misses = program.solve_numbers(&target).unwrap().into_iter().map(|solution| {
            solution
                .q
                .iter()
                .zip(&expected)
                .map(|(a, b)| groebot_robot::spatial::angle::difference(*a, *b).abs())
                .fold(0.0, f64::max)
        });
        let nearest = misses.fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-9, "{sample}: {nearest}");
    }
}

#[test]
fn csv_is_sampled_at_100_hz_with_one_actuator_for_both_hips() {
    let walk = walk(&request(&regular())).unwrap();
    let written = walk.trajectory(&robot().0);
    let read = Trajectory::from_csv(&walk.to_csv(&robot().0)).unwrap();
    let column = |name: &str| read.joints.iter().position(|joint| joint.name == name).unwrap();
    assert_eq!((read.joints.len(), column("HeadYaw"), column("HeadPitch")), (24, 0, 1));
    assert_eq!(read.times.len(), walk.balances.len());
    for (row, q) in read.q.iter().enumerate() {
        assert_eq!(read.times[row], (row as f64) / 100.0);
        assert_eq!(q[column("LHipYawPitch")], q[column("RHipYawPitch")]);
        assert!((q[column("LKneePitch")] - leg(&walk, row, "L")[3]).abs() < 1e-9);
        let off = read.base[row].inv_mul(&written.base[row]).to_homogeneous() - nalgebra::Matrix4::identity();
        assert!(off.amax() < 1e-8 && (read.points[0].at[row] - written.points[0].at[row]).norm() < 1e-8);
    }
    assert_eq!(read.contacts[0].stands, written.contacts[0].stands);
    let text = walk.to_json(&robot().0);
    let back = Trajectory::from_json(&text).unwrap();
    assert_eq!(
        (&back.q, &back.times, &back.joints, &back.figures),
        (&written.q, &written.times, &written.joints, &written.figures)
    );
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!((&json["format"], &json["walk"]["tick"]), (&2.into(), &TICK.into()));
    assert_eq!(json["walk"]["summary"]["gait"], "sine");
    assert_eq!(json["walk"]["support"].as_array().unwrap().len(), read.times.len());
    assert!(findings(&written, &Bounds { margin: 0.01, speed_share: 0.9, ..Bounds::default() }).is_empty());
    let svg = walk.to_svg(&robot().0);
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n") && svg.contains("LKneePitch"));
    assert_eq!(svg.matches("<polygon").count(), 2 + walk.schedule.route.steps.len());
}

#[test]
fn the_same_request_has_the_same_walk() {
    let request = groebot_humanoid::gait::Request { gait: Gait::Preview, ..request(&regular()) };
    let [a, b] = [(); 2].map(|()| walk(&request).unwrap());
    assert!(a == b);
}
