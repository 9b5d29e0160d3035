//! Chains far from the frame in which their targets are given: rounding hides their solutions.

use nalgebra::Point3;

use super::Chain;
use crate::document::shown;
use crate::spatial::Screw;
use crate::{Error, ErrorKind, Result};

/// The greatest distance from the base frame, in reaches of the chain, at which it is solved. There the coordinates of a target in doubles are
/// rounded by 1e-13 of the reach, a tenth of what answers may miss; from about three times as far solutions are lost.
const FAR: f64 = 1e3;

impl Chain {
    /// The distance of the joint axis that is farthest from the origin of the base frame, in reaches; zero without an axis or a reach.
    pub fn remoteness(&self) -> f64 {
        let axes = self.screws().iter().filter_map(Screw::axis);
        let distance = axes.map(|axis| axis.distance_to(&Point3::origin())).fold(0.0, f64::max);
        if self.reach() > 0.0 { distance / self.reach() } else { 0.0 }
    }

    /// Fails where the chain is more than a thousand of its reaches from the base frame; `near` is a link that is nearer, where there are links.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] with the distance and what to choose instead.
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
            "`{}` is {far:.0} of its reaches from its base frame, where rounding of targets hides solutions ({FAR} are allowed): {instead}, and \
             add the place of that frame at run time",
            shown(self.name())
        );
        Err(Error::new(ErrorKind::Unsupported, text))
    }
}
