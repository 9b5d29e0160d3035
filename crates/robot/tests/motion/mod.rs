//! Trajectories: their table and JSON, checks, and paths along poses.

mod spline;
mod states;
mod table;
mod trajectory;

use groebot_robot::motion::{Contact, Figure, JointTrack, Track, Trajectory};
use groebot_robot::spatial::Pose;
use nalgebra::{Point3, UnitQuaternion, Vector3};

/// Three samples at uneven times with all features of a trajectory.
pub fn sample() -> Trajectory {
    let joint =
        |name: &str, slides| JointTrack { name: name.into(), slides, limits: Some((-1.0, 1.0)), speed: Some(2.0) };
    let pose = |x: f64| {
        Pose::from_parts(
            Vector3::new(x, 0.25, 0.5).into(),
            UnitQuaternion::from_scaled_axis(Vector3::new(0.1, x, -0.3)),
        )
    };
    let points = |z: f64| [0.0, 0.1, 0.2].map(|x| Point3::new(x, -x, z)).to_vec();
    Trajectory {
        robot: "r".into(),
        joints: vec![joint("hip", false), joint("mast_x", true)],
        times: vec![0.0, 0.1, 0.3],
        q: vec![vec![0.0, 0.5], vec![0.1, 0.4], vec![0.5, 0.4]],
        base: [0.0, 0.1, 0.2].map(pose).to_vec(),
        contacts: vec![Contact {
            name: "left".into(),
            poses: [0.5, 0.6, 0.7].map(pose).to_vec(),
            stands: vec![true, false, true],
        }],
        points: vec![Track { name: "com".into(), at: points(0.5) }],
        figures: vec![Figure { name: "margin".into(), unit: "m".into(), values: vec![0.01, 0.02, -0.005] }],
    }
}
