//! What solves the legs of a humanoid. Main trait: [`Legs`].

use nalgebra::Point3;

use crate::Result;
use crate::spatial::Pose;

/// A configuration of a whole humanoid.
#[derive(Clone, Debug, PartialEq)]
pub struct Posture {
    /// The pose of the torso in the world.
    pub world_from_torso: Pose,
    /// The values of all joints \[rad\].
    pub q: Vec<f64>,
}

/// A solver of both legs at once.
pub trait Legs {
    /// The posture with the soles at the poses `world_from_soles`, left and right, and the upright torso's origin at `torso` \[m\]. The
    /// torso's heading is that of the middle of the feet, or, where the legs share a motor, what the motor makes it. Of several
    /// answers it is the nearest to `last`; the limits of the joints are not looked at. The joints of other limbs stay as in `last`.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] when a foot is out of reach, or the legs do not agree on the motor that they share.
    fn stand(&self, world_from_soles: &[Pose; 2], torso: &Point3<f64>, last: &Posture) -> Result<Posture>;

    /// A posture with bent knees and the arms near the trunk, from which [`Legs::stand`] finds the right answers; the torso is at the
    /// origin.
    fn crouch(&self) -> Posture;
}
