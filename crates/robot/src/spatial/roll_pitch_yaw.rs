//! Roll, pitch and yaw as in RobotMan (RH0, appendix D), and the six coordinates of a body that it builds with them.
//!
//! `R = Rx(roll) Ry(pitch) Rz(yaw)`: rotations about the body's own axes x, then y, then z, or equivalently about the
//! fixed axes z, then y, then x. URDF and nalgebra use the opposite order, `Rz(yaw) Ry(pitch) Rx(roll)`. In the thesis'
//! frames y points up, so a rotation about the vertical is its pitch.

use std::f64::consts::PI;

use nalgebra::{Translation3, UnitQuaternion, Vector3};

use super::{Pose, angle, pose};

/// Maximum cosine of the pitch at which roll and yaw rotate about one line and roll is set to zero.
pub(crate) const SINGULAR: f64 = 4.0 * f64::EPSILON;

/// Angles \[rad\] with `R = Rx(roll) Ry(pitch) Rz(yaw)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollPitchYaw {
    /// About x.
    pub roll: f64,
    /// About y.
    pub pitch: f64,
    /// About z.
    pub yaw: f64,
}

impl RollPitchYaw {
    /// The rotation with these angles.
    pub fn rotation(&self) -> UnitQuaternion<f64> {
        let turn = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
        turn(Vector3::x_axis(), self.roll) * turn(Vector3::y_axis(), self.pitch) * turn(Vector3::z_axis(), self.yaw)
    }

    /// The angles of `rotation`: pitch in \[-pi/2, pi/2\], roll and yaw in (-pi, pi\].
    ///
    /// At pitch pi/2 only roll + yaw is determined, at -pi/2 only yaw - roll: there (to 4 epsilon) roll is zero.
    pub fn of(rotation: &UnitQuaternion<f64>) -> Self {
        let r = rotation.to_rotation_matrix().into_inner();
        let cosine = r[(1, 2)].hypot(r[(2, 2)]);
        let roll = if cosine <= SINGULAR { 0.0 } else { (-r[(1, 2)]).atan2(r[(2, 2)]) };
        let (s, c) = roll.sin_cos();
        let yaw = (c * r[(1, 0)] + s * r[(2, 0)]).atan2(c * r[(1, 1)] + s * r[(2, 1)]);
        RollPitchYaw { roll: angle::wrap(roll), pitch: r[(0, 2)].atan2(cosine), yaw: angle::wrap(yaw) }
    }

    /// The other three angles of the same rotation, in (-pi, pi\]: pi - pitch, and roll and yaw plus pi.
    #[must_use]
    pub fn other(&self) -> Self {
        RollPitchYaw {
            roll: angle::wrap(self.roll + PI),
            pitch: angle::wrap(PI - self.pitch),
            yaw: angle::wrap(self.yaw + PI),
        }
    }
}

/// The rigid transform with the body coordinates (x, y, z, roll, pitch, yaw), metres and radians; RobotMan f(2).
pub fn pose_of_coordinates(coordinates: &[f64; 6]) -> Pose {
    let [x, y, z, roll, pitch, yaw] = *coordinates;
    Pose::from_parts(Translation3::new(x, y, z), RollPitchYaw { roll, pitch, yaw }.rotation())
}

/// The body coordinates (x, y, z, roll, pitch, yaw) of `g`, metres and radians, with the angles of
/// [`RollPitchYaw::of`]; RobotMan f(4).
pub fn coordinates_of_pose(g: &Pose) -> [f64; 6] {
    let RollPitchYaw { roll, pitch, yaw } = RollPitchYaw::of(&g.rotation);
    let position = pose::position(g);
    [position.x, position.y, position.z, roll, pitch, yaw]
}
