//! Check of the assumptions of a task: the chain stays in a plane, or the tip rotates about one axis only.

use nalgebra::Vector3;

use super::parts::TOLERANCE;
use super::validate::check_plane;
use super::{BaseAxis, Chain, Joint, JointKind};
use crate::document::shown;
use crate::spatial::exact::vector::{show, sine, unit};
use crate::{Error, ErrorKind, Result};

/// Maximum tilt of the tip \[rad\] by rounding. The axes of ideal robots are exact.
const TILT: f64 = 1e-9;

impl Chain {
    /// Checks that no joint leaves the plane of a planar task by more than 1e-6 rad. For a task with an angle about an
    /// axis, checks that no joint tilts the tip. A described chain may violate this, its ideal must not.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] with the joint, or with the direction that is not perpendicular to the axis.
    #[doc(hidden)]
    pub fn check_task(&self) -> Result<()> {
        if let Some(axis) = self.task().axis() {
            self.check_aim(axis)?;
            return self.check_tilt(axis);
        }
        let Some(plane) = self.task().plane() else { return Ok(()) };
        let mut joints = self.joints().iter().enumerate();
        let kept = joints.try_for_each(|(index, joint)| check_plane(index, joint, plane, TOLERANCE));
        kept.map_err(|fault| fault.error)
    }

    /// The direction of a base axis in the tip frame.
    fn axis_from_tip(&self, axis: BaseAxis, q: &[f64]) -> Result<Vector3<f64>> {
        Ok(self.forward(q)?.rotation.inverse() * Vector3::ith(axis.coordinate(), 1.0))
    }

    /// Checks that the tip's direction is perpendicular to `axis`, about which its angle is measured.
    fn check_aim(&self, axis: BaseAxis) -> Result<()> {
        let off = self.aim().dot(&self.axis_from_tip(axis, &vec![0.0; self.joints().len()])?).abs();
        if off <= TOLERANCE {
            return Ok(());
        }
        let text = format!(
            "the direction {} of the tip is not perpendicular to the base's {}, the axis of its angle (deviation {off:.1e}); give a perpendicular one (`direction`, `--direction`; by default {}), or another axis (`axis`, `--axis`)",
            show(self.direction()),
            axis.name(),
            show(&self.task().usual_direction())
        );
        Err(Error::new(ErrorKind::BadValue, text))
    }

    /// Checks that the tip rotates about `axis` only, for all joint values.
    fn check_tilt(&self, axis: BaseAxis) -> Result<()> {
        let still = self.axis_from_tip(axis, &vec![0.0; self.joints().len()])?;
        let moved = (1..=3).map(|round| self.axis_from_tip(axis, &self.some_values(round)));
        let tilts = moved.collect::<Result<Vec<_>>>()?.iter().any(|moved| (moved - still).norm() > TILT);
        if !tilts {
            return Ok(());
        }
        let normal = unit(axis.coordinate());
        let tilts = |joint: &&Joint| joint.kind == JointKind::Revolute && sine(&joint.axis, &normal) > TOLERANCE;
        let name = self.joints().iter().find(tilts).map(|joint| format!("joint `{}`", shown(&joint.name)));
        let text = format!(
            "{} tilts the tip; the task `position_yaw` is for arms whose tip rotates only about the base's {}: SCARAs, gantries, palletizers with a linkage that keeps the tip level (mimic joints)",
            name.as_deref().unwrap_or("a joint"),
            axis.name()
        );
        Err(Error::new(ErrorKind::BadValue, text))
    }

    /// Sample joint values. Mimic joints follow their leaders.
    fn some_values(&self, round: usize) -> Vec<f64> {
        let value = |joint: usize| 0.37 * round as f64 + 0.61 * joint as f64;
        let mut q: Vec<f64> = (0..self.joints().len()).map(value).collect();
        for place in 0..q.len() {
            if let Some((leader, mimic)) = self.leader(place) {
                let [factor, offset] = mimic.law();
                q[place] = factor * q[leader] + offset;
            }
        }
        q
    }
}
