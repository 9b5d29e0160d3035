//! Imperfect descriptions: which axes almost meet, or are almost parallel or perpendicular, and the ideal robot that is meant.
//! Main types: [`Near`], [`SnapReport`].
//!
//! A description rounded to five decimals, or a calibrated one, has no exact structure, so that no closed form fits it.
//! [`near_misses`] tells what is almost there, [`Chain::snapped`] makes it so. The difference is judged exactly: a relation that
//! holds is left alone, whatever the tolerance.

mod ideal;
mod meeting;

use std::fmt;
use std::ops::Range;

use super::exact_vector::{Line, cosine, sine};
use super::{Chain, Joint, JointKind, LengthUnit};
use meeting::gatherings;

/// What joints in a row almost have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NearRelation {
    /// The directions of two neighbours are parallel.
    Parallel,
    /// The directions of two neighbours are perpendicular.
    Perpendicular,
    /// The axes of two or more neighbours meet in one point.
    Meeting,
    /// The axes of two neighbours are one line.
    Coincident,
}

/// A relation that almost holds: within the tolerance, but not exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct Near {
    /// The places of the joints.
    pub joints: Range<usize>,
    /// What almost holds.
    pub relation: NearRelation,
    /// By how much it fails: an angle \[rad\], or a distance in the chain's length unit.
    pub by: f64,
}

/// How far a joint's axis is from the ideal one.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    /// The name of the joint; none for the tip.
    pub joint: Option<String>,
    /// The angle \[rad\] by which it was turned.
    pub angle: f64,
    /// The distance in the chain's length unit by which it was shifted.
    pub distance: f64,
}

/// What [`Chain::snapped`] did.
#[derive(Clone, Debug, PartialEq)]
pub struct SnapReport {
    /// The tolerance: radians, and metres.
    pub tolerance: f64,
    /// The unit of the distances here.
    pub length_unit: LengthUnit,
    /// What almost held before.
    pub near: Vec<Near>,
    /// The axes, and the tip, that were moved. Shifts of earlier joints carry the later ones along.
    pub moved: Vec<Moved>,
}

/// The line of a revolute joint's axis, or through a prismatic joint's point.
fn line(joint: &Joint) -> Line {
    Line { point: joint.point.clone(), direction: joint.axis.clone() }
}

/// The relations of neighbouring joints of `chain` that fail, but by no more than `tolerance`: an angle in radians, a distance in
/// metres. Places count for revolute joints only.
pub fn near_misses(chain: &Chain, tolerance: f64) -> Vec<Near> {
    let pairs = chain.joints().windows(2).enumerate();
    let mut near: Vec<Near> = pairs.flat_map(|(first, pair)| near_pair(first, pair, chain, tolerance)).collect();
    let meeting = gatherings(chain.joints(), lengths(chain, tolerance)).into_iter().filter(|group| group.by > 0.0);
    near.extend(meeting.map(|group| Near { joints: group.joints, relation: NearRelation::Meeting, by: group.by }));
    near.sort_by_key(|near| (near.joints.start, near.joints.end));
    near
}

/// A length of `tolerance` metres in the unit of `chain`.
fn lengths(chain: &Chain, tolerance: f64) -> f64 {
    tolerance / chain.length_unit().metres()
}

/// What two neighbours almost have in common, but for a meeting point.
fn near_pair(first: usize, pair: &[Joint], chain: &Chain, tolerance: f64) -> Vec<Near> {
    let [a, b] = pair else { return Vec::new() };
    let (sine, cosine) = (sine(&a.axis, &b.axis), cosine(&a.axis, &b.axis));
    let turn = |both: [&Joint; 2]| both.iter().all(|joint| joint.kind == JointKind::Revolute);
    let distance = line(a).distance(&b.point);
    let within = |by: f64, limit: f64| by > 0.0 && by <= limit;
    let near = |relation, by| Near { joints: first..first + 2, relation, by };
    let mut found = Vec::new();
    if within(sine, tolerance) {
        found.push(near(NearRelation::Parallel, sine.asin()));
    }
    if within(cosine, tolerance) {
        found.push(near(NearRelation::Perpendicular, cosine.asin()));
    }
    if turn([a, b]) && sine <= tolerance && within(distance, lengths(chain, tolerance)) {
        found.push(near(NearRelation::Coincident, distance));
    }
    found
}

impl Chain {
    /// The ideal robot within `tolerance` (radians, and metres) of this one, and what was changed: directions that are almost
    /// parallel to an earlier axis, to a coordinate axis or to the bisector of two, or almost perpendicular to the axis before,
    /// become so; axes of neighbours that almost meet do meet; offsets of less than the tolerance along a coordinate axis from
    /// one axis to the next become zero, and so does the tip's from the last axis. All numbers stay rational. A chain whose
    /// relations all hold exactly, or fail by more, is not changed.
    ///
    /// Angles and offsets of one joint to the next count, so that roundings do not add up; in the base frame the tip may move by
    /// as many tolerances as there are joints, and by each turned axis times its distance.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] for a tolerance that is not in \[0, 0.1\].
    pub fn snapped(&self, tolerance: f64) -> crate::Result<(Chain, SnapReport)> {
        if !(0.0..=0.1).contains(&tolerance) {
            let text = format!("the tolerance is {tolerance}; give radians and metres from 0 to 0.1, such as 1e-5");
            return Err(crate::Error::new(crate::ErrorKind::BadValue, text));
        }
        let chain = ideal::ideal(self, tolerance)?;
        let moved = ideal::moved(self, &chain);
        let near = near_misses(self, tolerance);
        Ok((chain, SnapReport { tolerance, length_unit: self.length_unit(), near, moved }))
    }
}

impl SnapReport {
    /// Whether nothing was changed.
    pub fn is_empty(&self) -> bool {
        self.moved.is_empty()
    }
}

impl Near {
    /// In words, lengths in `unit`: `joints 4-6 almost meet in one point, by 5e-6 m`.
    pub fn words(&self, unit: LengthUnit) -> String {
        let joints = format!("joints {}-{}", self.joints.start + 1, self.joints.end);
        let (by, unit) = (format!("{:.1e}", self.by), unit.symbol());
        match self.relation {
            NearRelation::Parallel => format!("{joints} are almost parallel, by {by} rad"),
            NearRelation::Perpendicular => format!("{joints} are almost perpendicular, by {by} rad"),
            NearRelation::Meeting => format!("{joints} almost meet in one point, by {by} {unit}"),
            NearRelation::Coincident => format!("{joints} almost have one axis, by {by} {unit}"),
        }
    }
}

/// One line for each relation, then one for each axis that was moved.
impl fmt::Display for SnapReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return write!(f, "nothing within {:e} rad and m had to be changed", self.tolerance);
        }
        let near = self.near.iter().map(|near| near.words(self.length_unit));
        let moved = self.moved.iter().map(|moved| {
            let name = moved.joint.as_deref().map_or("the tip".to_owned(), |name| format!("the axis of {name}"));
            let unit = self.length_unit.symbol();
            format!("{name} turned by {:.1e} rad and shifted by {:.1e} {unit}", moved.angle, moved.distance)
        });
        f.write_str(&near.chain(moved).collect::<Vec<_>>().join("\n"))
    }
}
