//! The ideal robot that a description means: [`Chain::ideal`]. Main type: [`Report`].
//!
//! A description is a measurement: exporters write 6.1e-17 for zero, 1.5707963 for a quarter turn, five decimals. Closed forms need axes that
//! meet, are parallel or perpendicular exactly. [`Chain::ideal`] takes what holds within a tolerance for what is meant, from the base to the
//! tip, each joint relative to the one before, so that each relation of neighbouring axes is decided once and roundings do not add up. All
//! numbers stay rational, and a relation that holds, or fails by more, is left alone.

mod directions;
mod meeting;
mod places;
mod report;

pub use super::parts::{TOLERANCE, WIDEST};
use super::{Chain, ChainParts, Joint, JointKind, Task, Tip};
use crate::{Error, ErrorKind, Result};
use report::moved;
pub use report::{Moved, Relation, RelationKind, Report};

use crate::spatial::exact::vector::Line;

/// Where answers are polished anyway, lengths are rounded to decimals within this share of the tolerance.
const GRAIN: f64 = 1e-3;
/// Numbers this near to one another are the same in doubles: radians, and shares of the reach.
pub const SAME: f64 = 1e-15;

impl Chain {
    /// The ideal robot within [`TOLERANCE`] of this one, and what was taken for what.
    ///
    /// Directions that are almost parallel to the axis before, or perpendicular to it, become so, along coordinate axes and bisectors where that
    /// is near; axes of neighbours that almost meet do, so that three or more meet in one point where they almost do; parallel axes that are
    /// almost one line become it; offsets along an axis that are almost zero become zero, and so does the tip's from the last axis. What the
    /// description [means](super::Meant) by rounded numbers is taken first. A chain of which nothing is to be changed is returned as it is.
    pub fn ideal(&self) -> (Chain, Report) {
        self.ideal_within(TOLERANCE).unwrap_or_else(|_| (self.clone(), Report::of_exact(self, TOLERANCE)))
    }

    /// The same within `tolerance`, in radians and shares of the reach; with zero each digit is taken at its word.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a tolerance that is not in \[0, 0.1\]; as [`Chain::check_task`].
    pub fn ideal_within(&self, tolerance: f64) -> Result<(Chain, Report)> {
        if !(0.0..=WIDEST).contains(&tolerance) {
            let text = format!(
                "the tolerance is {tolerance}; give radians, which are shares of the reach as well, from 0 to {WIDEST}, such as 1e-5"
            );
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let told = ChainParts { meant: None, ..self.parts().clone() };
        if tolerance == 0.0 {
            let chain = Chain::new(told)?;
            chain.check_task()?;
            return Ok((chain, Report::of_exact(self, tolerance)));
        }
        let meant = match self.parts().meant.as_deref().cloned() {
            Some(meant) => Chain::new(ChainParts { joints: meant.joints, tip: meant.tip, ..told })?,
            None => Chain::new(told)?,
        };
        let chain = self.chosen(&meant, tolerance)?;
        chain.check_task()?;
        let report = Report::new(self, &chain, tolerance);
        Ok((chain, report))
    }

    /// What is exact stays as it is; what is off by rounding is rounded back; where answers are polished anyway, lengths may be short.
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

    /// `ideal`, with the tip turned as described where nothing else differs and the tip is asked for a pose: no relation of axes depends on it.
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

/// A length that is `tolerance` of the reach of `chain`, in its unit.
fn lengths(chain: &Chain, tolerance: f64) -> f64 {
    tolerance * size(chain)
}

/// The reach, or a tenth of the first joint's distance from the base where that is more, as of a head whose axes meet at its tip; one for a chain
/// that is a point there.
fn size(chain: &Chain) -> f64 {
    let distance = chain.joints().first().map_or(0.0, |joint| joint.location().coords.norm());
    let size = chain.reach().max(0.1 * distance);
    if size > 0.0 { size } else { 1.0 }
}

/// The line of a revolute joint's axis, or through a prismatic joint's point.
fn line(joint: &Joint) -> Line {
    Line { point: joint.point.clone(), direction: joint.axis.clone() }
}

/// Whether all of these turn.
fn turn(joints: &[Joint]) -> bool {
    joints.iter().all(|joint| joint.kind == JointKind::Revolute)
}
