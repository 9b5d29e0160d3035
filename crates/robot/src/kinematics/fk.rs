//! Numeric forward kinematics as a product of exponentials (Brockett 1984; RH0 2.1.4).

use nalgebra::{Unit, Vector3};

use super::Chain;
use crate::spatial::{Pose, Screw};
use crate::{Error, ErrorKind, Result};

impl Chain {
    /// The unit vector in the tip frame of the direction for the tasks `ray` and `direction`.
    #[doc(hidden)]
    pub fn aim(&self) -> Unit<Vector3<f64>> {
        self.numeric.aim
    }

    /// The joints' screws from base to tip, in the base frame at the zero configuration, in the chain's length unit.
    pub fn screws(&self) -> &[Screw] {
        &self.numeric.screws
    }

    /// The pose of the tip at the zero configuration, in the chain's length unit.
    pub fn base_from_tip(&self) -> Pose {
        self.numeric.base_from_tip
    }

    /// Computes the pose base_from_tip, in the chain's length unit, for the joint values `q` from base to tip: radians
    /// (revolute) or the chain's length unit (prismatic). It is `e^(S1 q1) ... e^(Sn qn) M`, RH0 (2-20) and (2-27).
    /// Joint limits are not checked.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] unless `q` has one finite value per joint.
    pub fn forward(&self, q: &[f64]) -> Result<Pose> {
        let screws = self.screws();
        if q.len() != screws.len() {
            let message = format!("{} joint values are given; the chain has {} joints", q.len(), screws.len());
            return Err(Error::new(ErrorKind::BadValue, message));
        }
        if let Some(index) = q.iter().position(|value| !value.is_finite()) {
            let message = format!("joint `{}`: the value {} is not finite", self.joints()[index].name, q[index]);
            return Err(Error::new(ErrorKind::BadValue, message));
        }
        let steps = screws.iter().zip(q).rev();
        Ok(steps.fold(self.base_from_tip(), |pose, (screw, &q)| screw.exp(q) * pose))
    }

    /// The length of the polyline from the first joint's point over the other joints' points to the tip, in the chain's
    /// length unit. It bounds the tip's distance from the first joint's point while prismatic joints are at zero.
    pub fn reach(&self) -> f64 {
        self.numeric.reach
    }
}
