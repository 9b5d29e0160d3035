//! Check for chains far from the frame of their targets, whose solutions are lost by rounding.

use nalgebra::Point3;

use super::Chain;
use crate::document::shown;
use crate::spatial::Screw;
use crate::{Error, ErrorKind, Result};

/// Maximum distance from the base frame, in units of the chain's reach. There the coordinates of a target in doubles
/// are rounded by 1e-13 of the reach, a tenth of the tolerance of solutions. At about three times this distance
/// solutions are lost.
const FAR: f64 = 1e3;

impl Chain {
    /// The largest distance of a joint axis from the origin of the base frame, in units of the reach; zero without an
    /// axis or a reach.
    pub fn remoteness(&self) -> f64 {
        let axes = self.screws().iter().filter_map(Screw::axis);
        let distance = axes.map(|axis| axis.distance_to(&Point3::origin())).fold(0.0, f64::max);
        if self.reach() > 0.0 { distance / self.reach() } else { 0.0 }
    }

    /// Checks that the chain is at most a thousand times its reach away from the base frame. `near` is a closer link,
    /// if there are links.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] with the distance and a remedy.
    pub fn check_base(&self, near: Option<&str>) -> Result<()> {
        let far = self.remoteness();
        if far <= FAR {
            return Ok(());
        }
        let instead = match near {
            Some(link) => format!("choose a base link nearer to the arm, `{}` (`--base`)", shown(link)),
            None => "choose a base frame nearer to the arm".to_owned(),
        };
        let text = format!(
            "the distance of `{}` from its base frame is {far:.0} times its reach ({FAR} are allowed), so that solutions are lost by rounding of targets: {instead}, and add the pose of that frame at run time",
            shown(self.name())
        );
        Err(Error::new(ErrorKind::Unsupported, text))
    }
}
