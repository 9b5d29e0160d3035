//! The deflection of the joints under the robot's weight. Main function: [`static_torques`].

use nalgebra::{Point3, Vector3};

use super::distribution::Part;
use crate::Result;
use crate::gait::{Biped, GRAVITY, Posture};
use groebot_robot::spatial::{Pose, Screw};

/// The torque of each joint with which the robot is at rest in a posture \[N m; N of a prismatic joint\]. The soles at `soles` carry its weight as distributed.
pub(super) fn static_torques(
    biped: &Biped,
    posture: &Posture,
    soles: &[Pose; 2],
    parts: &[Part; 2],
) -> Result<Vec<f64>> {
    let model = &biped.model;
    let placed = model.place(&posture.world_from_torso, &posture.q)?;
    let mut torques = vec![0.0; model.joints().len()];
    let mut press = |body: usize, at: Point3<f64>, force: f64| {
        for joint in model.path(body) {
            let force = Vector3::new(0.0, 0.0, force);
            torques[joint] -= match model.joints()[joint].screw.moved(&placed.motion(joint + 1)) {
                Screw::Revolute(axis) => axis.direction().dot(&(at - axis.point()).cross(&force)),
                Screw::Prismatic(direction) => direction.dot(&force),
            };
        }
    };
    for body in 0..=model.joints().len() {
        let inertia = model.inertia_of(body);
        press(body, placed.motion(body) * inertia.centre_of_mass(), -inertia.mass() * GRAVITY);
    }
    for ((foot, sole), part) in biped.feet.iter().zip(soles).zip(parts) {
        let at = sole * Point3::new(part.pressure.x, part.pressure.y, 0.0);
        press(foot.body, at, part.share * model.mass() * GRAVITY);
    }
    Ok(torques)
}
