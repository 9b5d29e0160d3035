//! The ideal robot: directions first, then places from the base to the tip, each relative to the one before.

use num_traits::{Signed, ToPrimitive, Zero};

use super::meeting::{Gathering, gatherings};
use super::{Moved, lengths, line};
use crate::Result;
use crate::kinematics::exact_vector::{Line, add, cosine, cross, dot, is_zero, scale, sine, sub};
use crate::kinematics::frame::ROUNDING;
use crate::kinematics::{Chain, ChainParts, ExactMatrix, ExactVector, Joint, JointKind, Tip};
use crate::number::BigRational;

/// `chain` with what almost holds made exact.
pub(super) fn ideal(chain: &Chain, tolerance: f64) -> Result<Chain> {
    let directions = directions(chain.joints(), tolerance);
    let mut placing = Placing::new(chain, &directions, lengths(chain, tolerance));
    for place in 0..chain.joints().len() {
        placing.place(place);
    }
    let tip = placing.tip(chain, tolerance);
    let joint = |(joint, line): (&Joint, Line)| Joint { axis: line.direction, point: line.point, ..joint.clone() };
    let joints: Vec<Joint> = chain.joints().iter().zip(placing.ideal).map(joint).collect();
    if joints == chain.joints() && tip == *chain.tip() {
        return Ok(chain.clone());
    }
    Chain::new(ChainParts { joints, tip, ..chain.parts().clone() })
}

/// The ideal directions: each like an earlier one, or perpendicular to the one before, or simple, else as it is.
fn directions(joints: &[Joint], tolerance: f64) -> Vec<ExactVector> {
    let mut ideal: Vec<ExactVector> = Vec::new();
    for joint in joints {
        let own = &joint.axis;
        let like = ideal.iter().find(|earlier| sine(own, earlier) <= tolerance).map(|earlier| along(earlier, own));
        let straight = like.or_else(|| upright(own, &ideal, tolerance)).or_else(|| simple(own, tolerance));
        // A direction that is exact already keeps its own length.
        let straight = straight.filter(|straight| !is_zero(&cross(straight, own)));
        ideal.push(straight.unwrap_or_else(|| own.clone()));
    }
    ideal
}

/// `direction`, or its opposite, so that it points like `own`.
fn along(direction: &ExactVector, own: &ExactVector) -> ExactVector {
    if dot(direction, own).is_negative() { direction.each_ref().map(|x| -x) } else { direction.clone() }
}

/// The direction in the signs of the greatest entries, `[0, 1, -1]` for `[1e-6, 0.7071, -0.7072]`, if that is within `tolerance`. No diagonal
/// where only roundings are made good: a rotation that was made rational leads next to one, and its axes have rational lengths.
fn simple(direction: &ExactVector, tolerance: f64) -> Option<ExactVector> {
    let greatest = direction.iter().map(Signed::abs).max()?;
    let half = greatest / BigRational::from_integer(2.into());
    let signs = direction.each_ref().map(|x| if x.abs() < half { BigRational::zero() } else { x.signum() });
    let is_diagonal = signs.iter().filter(|sign| !sign.is_zero()).count() > 1;
    (sine(direction, &signs) <= tolerance && !(is_diagonal && tolerance <= ROUNDING)).then_some(signs)
}

/// A direction within `tolerance` that is perpendicular to the last of `earlier`: the simple one, the one that is perpendicular to
/// another earlier one too, or `own` without its component along the last.
fn upright(own: &ExactVector, earlier: &[ExactVector], tolerance: f64) -> Option<ExactVector> {
    let before = earlier.last().filter(|before| cosine(own, before) <= tolerance)?;
    let simple = simple(own, tolerance).filter(|simple| dot(simple, before).is_zero());
    let normals = earlier.iter().map(|other| cross(before, other)).filter(|normal| !is_zero(normal));
    let normal = || normals.map(|normal| along(&normal, own)).find(|normal| sine(own, normal) <= tolerance);
    let share = dot(own, before) / dot(before, before);
    simple.or_else(normal).or_else(|| Some(sub(own, &scale(before, &share))))
}

/// The axes on their way to their ideal places.
struct Placing<'a> {
    joints: &'a [Joint],
    directions: &'a [ExactVector],
    tolerance: f64,
    groups: Vec<Gathering>,
    /// The points about which the axes are straightened, on the true axes.
    pivots: Vec<ExactVector>,
    ideal: Vec<Line>,
}

impl<'a> Placing<'a> {
    fn new(chain: &'a Chain, directions: &'a [ExactVector], tolerance: f64) -> Self {
        let groups = gatherings(chain.joints(), tolerance);
        Placing { joints: chain.joints(), directions, tolerance, groups, pivots: Vec::new(), ideal: Vec::new() }
    }

    /// Puts the next joint where it belongs: like the one before in a shared point or line, else at its offset from it.
    fn place(&mut self, place: usize) {
        let pivot = self.pivot(place);
        let direction = self.directions[place].clone();
        let line = match self.shared(place) {
            Some(point) => {
                Line { point: Line { point, direction: direction.clone() }.foot(&self.offset(&pivot)), direction }
            }
            None => Line { point: self.straightened(&pivot), direction },
        };
        self.pivots.push(pivot);
        self.ideal.push(line);
        self.carry(place);
    }

    /// A point of the true axis: its own, or, for an axis that is turned, the one nearest to where the axis before is held.
    fn pivot(&self, place: usize) -> ExactVector {
        let joint = &self.joints[place];
        match self.pivots.last() {
            Some(before) if joint.axis != self.directions[place] => line(joint).foot(before),
            _ => joint.point.clone(),
        }
    }

    /// `pivot`, at its offset from the joint before.
    fn offset(&self, pivot: &ExactVector) -> ExactVector {
        let last = self.pivots.last().zip(self.ideal.last());
        last.map_or_else(|| pivot.clone(), |(before, line)| add(&line.point, &sub(pivot, before)))
    }

    /// The same without small steps along the coordinate axes.
    fn straightened(&self, pivot: &ExactVector) -> ExactVector {
        let (Some(before), Some(line)) = (self.pivots.last(), self.ideal.last()) else { return pivot.clone() };
        let step = sub(pivot, before).map(|x| if small(&x, self.tolerance) { BigRational::zero() } else { x });
        add(&line.point, &step)
    }

    /// A point that the axis has to pass: where its group meets, or on the axis before when the two are one line.
    fn shared(&self, place: usize) -> Option<ExactVector> {
        let before = place.checked_sub(1)?;
        if let Some(group) =
            self.groups.iter().find(|group| group.joints.start < place && group.joints.contains(&place))
        {
            return Some(group.point.clone());
        }
        let (a, b) = (&self.joints[before], &self.joints[place]);
        let turn = [a, b].iter().all(|joint| joint.kind == JointKind::Revolute);
        let one_line = turn && is_zero(&cross(&self.directions[before], &self.directions[place]));
        let near = line(a).distance(&line(b).foot(&self.pivots[before])) <= self.tolerance;
        (one_line && near).then(|| self.ideal[before].point.clone())
    }

    /// Moves the point of the group that begins with this joint onto its ideal axis.
    fn carry(&mut self, place: usize) {
        let Some(group) = self.groups.iter_mut().find(|group| group.joints.start == place) else { return };
        let moved = sub(&self.ideal[place].point, &self.pivots[place]);
        group.point = self.ideal[place].foot(&add(&group.point, &moved));
    }

    /// The tip at its offset from the last axis, on it when it almost is.
    fn tip(&self, chain: &Chain, tolerance: f64) -> Tip {
        let tip = chain.tip();
        let expected = self.offset(&tip.point);
        let on_axis = |line: &&Line| line.distance(&expected) <= self.tolerance;
        let turns = self.joints.last().is_some_and(|joint| joint.kind == JointKind::Revolute);
        let axis = self.ideal.last().filter(on_axis).filter(|_| turns);
        let point = axis.map_or_else(|| self.straightened(&tip.point), |axis| axis.foot(&expected));
        Tip { point, rotation: straight(&tip.rotation, tolerance) }
    }
}

fn small(x: &BigRational, tolerance: f64) -> bool {
    x.to_f64().is_some_and(|x| x.abs() <= tolerance)
}

/// `rotation` with all entries rounded to -1, 0 or 1, if each is within `tolerance` of that.
fn straight(rotation: &ExactMatrix, tolerance: f64) -> ExactMatrix {
    let whole = rotation.each_ref().map(|row| row.each_ref().map(BigRational::round));
    let mut entries = rotation.iter().flatten().zip(whole.iter().flatten());
    if entries.all(|(x, whole)| small(&(x - whole), tolerance)) { whole } else { rotation.clone() }
}

/// The axes, and the tip, that differ between the true chain and the ideal one.
pub(super) fn moved(chain: &Chain, ideal: &Chain) -> Vec<Moved> {
    let joints = chain.joints().iter().zip(ideal.joints());
    let axes = joints.map(|(a, b)| Moved {
        joint: Some(a.name.clone()),
        angle: sine(&a.axis, &b.axis).asin(),
        distance: if a.kind == JointKind::Revolute { line(b).distance(&a.point) } else { 0.0 },
    });
    let (from, to) = (chain.base_from_tip(), ideal.base_from_tip());
    let tip = Moved {
        joint: None,
        angle: if chain.tip().rotation == ideal.tip().rotation { 0.0 } else { from.rotation.angle_to(&to.rotation) },
        distance: (from.translation.vector - to.translation.vector).norm(),
    };
    axes.chain([tip]).filter(|moved| moved.angle > 0.0 || moved.distance > 0.0).collect()
}
