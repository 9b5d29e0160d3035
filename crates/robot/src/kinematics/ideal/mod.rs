//! Idealisation: the nearest ideal robot of a description: [`Chain::ideal`]. Main type: [`Report`].
//!
//! A description is a measurement: exporters write 6.1e-17 for zero, 1.5707963 for a quarter turn, five decimals.
//! Closed forms need axes that exactly intersect, are parallel or perpendicular. [`Chain::ideal`] makes relations exact
//! that hold within a tolerance. It proceeds from base to tip, each joint relative to the previous one. So each
//! relation of neighbouring axes is decided once, and rounding errors do not add up. All numbers stay rational. A
//! relation that already holds, or fails by more than the tolerance, is unchanged.

mod directions;
mod meeting;
mod places;
mod report;

pub use super::parts::TOLERANCE;
use super::parts::WIDEST;
use super::{Chain, ChainParts, Joint, JointKind, Task, Tip};
use crate::{Error, ErrorKind, Result};
use report::moved;
pub use report::{Moved, Relation, RelationKind, Report};

use crate::spatial::exact::vector::Line;

/// If solutions are polished on the described robot, lengths are rounded to decimals within this fraction of the
/// tolerance.
const GRAIN: f64 = 1e-3;
/// Numbers that differ by less are equal in doubles: radians, and fractions of the reach.
pub(crate) const SAME: f64 = 1e-15;

impl Chain {
    /// Computes the ideal robot within [`TOLERANCE`] of this one, and a report of the differences.
    ///
    /// Directions that are almost parallel or perpendicular to the previous axis become so, along coordinate axes and
    /// bisectors if these are near. Neighbouring axes that almost intersect do, also three or more in one point.
    /// Parallel axes that are almost coaxial become coaxial. Offsets along an axis that are almost zero become zero,
    /// also the tip's offset from the last axis. The exact values of [rounded numbers](super::Meant) are substituted
    /// first. A chain without changes is returned unchanged.
    pub fn ideal(&self) -> (Chain, Report) {
        self.ideal_within(TOLERANCE).unwrap_or_else(|_| (self.clone(), Report::of_exact(self, TOLERANCE)))
    }

    /// Same as [`Chain::ideal`], but within `tolerance`, in radians and fractions of the reach. With zero, every digit
    /// is exact.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a tolerance that is not in \[0, 0.1\]; those of [`Chain::check_task`].
    pub fn ideal_within(&self, tolerance: f64) -> Result<(Chain, Report)> {
        if !(0.0..=WIDEST).contains(&tolerance) {
            let text = format!(
                "the tolerance is {tolerance}; give radians (and fractions of the reach) from 0 to {WIDEST}, such as 1e-5"
            );
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let described = ChainParts { meant: None, ..self.parts().clone() };
        if tolerance == 0.0 {
            let chain = Chain::new(described)?;
            chain.check_task()?;
            return Ok((chain, Report::of_exact(self, tolerance)));
        }
        let meant = match self.parts().meant.as_deref().cloned() {
            Some(meant) => Chain::new(ChainParts { joints: meant.joints, tip: meant.tip, ..described })?,
            None => Chain::new(described)?,
        };
        let chain = self.chosen(&meant, tolerance)?;
        chain.check_task()?;
        let report = Report::new(self, &chain, tolerance);
        Ok((chain, report))
    }

    /// Keeps exact numbers, undoes rounding errors, and permits short lengths if solutions are polished on the
    /// described robot.
    fn chosen(&self, meant: &Chain, tolerance: f64) -> Result<Chain> {
        let placed = |grain: f64| places::ideal(meant, tolerance, grain);
        let untouched = placed(0.0)?;
        if untouched == *meant {
            return self.with_own_tip(untouched);
        }
        let rounded = self.with_own_tip(placed(SAME / tolerance)?)?;
        let is_same = moved(self, &rounded).iter().all(|moved| moved.deviation(size(self)) <= SAME);
        if is_same { Ok(rounded) } else { self.with_own_tip(placed(GRAIN)?) }
    }

    /// `ideal` with the described orientation of the tip, if nothing else differs and the task is a pose. No relation
    /// of axes depends on this orientation.
    fn with_own_tip(&self, ideal: Chain) -> Result<Chain> {
        let (moved, reach) = (moved(self, &ideal), size(self));
        let is_same = |moved: &Moved| {
            let angle = if moved.joint.is_some() { moved.angle } else { 0.0 };
            angle.max(moved.distance / reach) <= SAME
        };
        let is_whole = moved.iter().all(|moved| moved.deviation(reach) <= SAME);
        if self.task() != Task::Pose || is_whole || !moved.iter().all(is_same) {
            return Ok(ideal);
        }
        let tip = Tip { rotation: self.tip().rotation.clone(), ..ideal.tip().clone() };
        Chain::new(ChainParts { tip, ..ideal.into() })
    }
}

/// A length equal to `tolerance` times the reach of `chain`, in its unit.
fn lengths(chain: &Chain, tolerance: f64) -> f64 {
    tolerance * size(chain)
}

/// The reach, or a tenth of the first joint's distance from the base if that is larger. An example is a head whose axes
/// intersect at its tip. One for a chain that is a single point at the origin.
fn size(chain: &Chain) -> f64 {
    let distance = chain.joints().first().map_or(0.0, |joint| joint.location().coords.norm());
    let size = chain.reach().max(0.1 * distance);
    if size > 0.0 { size } else { 1.0 }
}

/// The line of a revolute joint's axis, or through a prismatic joint's point.
fn line(joint: &Joint) -> Line {
    Line { point: joint.point.clone(), direction: joint.axis.clone() }
}

/// Whether all of these joints are revolute.
fn turn(joints: &[Joint]) -> bool {
    joints.iter().all(|joint| joint.kind == JointKind::Revolute)
}
