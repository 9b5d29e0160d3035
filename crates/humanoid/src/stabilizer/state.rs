//! What a stabiliser reads and returns.

use nalgebra::{UnitQuaternion, Vector3};

/// The force and the moment of the floor on a sole.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SoleForce {
    /// The force in the frame of the sole \[N\].
    pub force: Vector3<f64>,
    /// The moment about the origin of the sole's frame, in this frame \[N m\].
    pub moment: Vector3<f64>,
}

/// The measured state of a walking robot.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// The time since the start of the walk \[s\].
    pub time: f64,
    /// The position of each joint, in the order of the robot's joints ([`crate::gait::Biped::joints`]) \[rad\].
    pub q: Vec<f64>,
    /// The orientation of the base, the description's root link: world from base. The z axis of the world is vertical. Footsteps correct the
    /// heading since the first state; if it drifts, the walk turns with it ([`StabilizerGains::heading`](super::StabilizerGains::heading)).
    pub orientation: UnitQuaternion<f64>,
    /// The angular velocity of the base, in the frame of the base \[rad/s\].
    pub angular_velocity: Vector3<f64>,
    /// The forces on the soles, left and right.
    pub soles: [SoleForce; 2],
}

/// The targets of the joints' position controllers.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct JointTargets {
    /// The position of each joint \[rad\].
    pub positions: Vec<f64>,
    /// Its feed-forward velocity \[rad/s\].
    pub velocities: Vec<f64>,
}
