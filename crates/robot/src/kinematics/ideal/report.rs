//! Report of an idealisation: [`Report`], its [`Relation`]s and the axes that [moved](Moved).

use std::fmt;
use std::ops::Range;

use super::meeting::gatherings;
use super::{SAME, line, size, turn};
use crate::kinematics::{Chain, Joint, JointKind, LengthUnit};
use crate::spatial::exact::vector::{Line, cosine, cross, is_zero, length, sine, sub};

/// Kind of relation between consecutive joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RelationKind {
    /// The directions of two neighbours are parallel.
    Parallel,
    /// The directions of two neighbours are perpendicular.
    Perpendicular,
    /// The axes of two or more neighbours intersect in one point.
    Meeting,
    /// The axes of two neighbours are coaxial.
    Coincident,
    /// The common normals of three neighbours intersect: the middle joint has no offset.
    Level,
}

/// A relation that a description fails by less than the tolerance.
#[derive(Clone, Debug, PartialEq)]
pub struct Relation {
    /// The indices of the joints.
    pub joints: Range<usize>,
    /// The relation that was made exact.
    pub kind: RelationKind,
    /// The error of the description: an angle \[rad\], or a distance in the chain's length unit.
    pub by: f64,
}

/// The difference between a joint's axis and the ideal one.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Moved {
    /// The name of the joint; `None` for the tip.
    pub joint: Option<String>,
    /// The angle between the axes \[rad\].
    pub angle: f64,
    /// The distance between the axes in the chain's length unit.
    pub distance: f64,
}

/// Report of [`Chain::ideal`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// The tolerance: radians, and fractions of the reach.
    pub tolerance: f64,
    /// The unit of the distances.
    pub length_unit: LengthUnit,
    /// The reach, in the length unit.
    pub reach: f64,
    /// The relations that were made exact, from base to tip.
    pub relations: Vec<Relation>,
    /// The axes that moved, and the tip. Shifts of earlier joints also move the later ones.
    pub moved: Vec<Moved>,
}

impl Report {
    /// Builds the report on `ideal`, the idealisation of `described`.
    pub(super) fn new(described: &Chain, ideal: &Chain, tolerance: f64) -> Self {
        Report {
            relations: relations(described, ideal),
            moved: moved(described, ideal),
            ..Report::of_exact(described, tolerance)
        }
    }

    /// The report on an unchanged chain.
    pub(super) fn of_exact(chain: &Chain, tolerance: f64) -> Self {
        let (length_unit, reach) = (chain.length_unit(), size(chain));
        Report { tolerance, length_unit, reach, relations: Vec::new(), moved: Vec::new() }
    }

    /// Whether nothing was changed.
    pub fn is_empty(&self) -> bool {
        self.moved.is_empty()
    }

    /// The largest difference between the ideal robot and the description, joint by joint: radians, or fractions of the
    /// reach.
    pub fn deviation(&self) -> f64 {
        self.moved.iter().map(|moved| moved.deviation(self.reach)).fold(0.0, f64::max)
    }

    /// An upper bound of the difference between the tips of the two robots for any joint values: radians, and fractions
    /// of the reach.
    ///
    /// A joint whose axis is rotated by `a` and shifted by `d` differs from the ideal joint by a rigid motion before
    /// the joint and its inverse after it. So the angle differs by at most `2 a`, and the position by at most
    /// `2 (a r + d)`, where `r` is the reach. The bound is the sum over the joints plus the tip's own difference.
    pub fn bound(&self) -> f64 {
        self.moved.iter().map(|moved| 2.0 * (moved.angle + moved.distance / self.reach)).sum()
    }

    /// Whether the ideal robot is equal to the described one in doubles.
    pub fn is_same(&self) -> bool {
        self.deviation() <= SAME
    }
}

/// The relations that hold exactly in `ideal` but not in `described`, sorted by their first joint.
fn relations(described: &Chain, ideal: &Chain) -> Vec<Relation> {
    let pairs = described.joints().windows(2).zip(ideal.joints().windows(2)).enumerate();
    let mut found: Vec<Relation> = pairs.flat_map(|(first, (own, meant))| of_pair(first, own, meant)).collect();
    for joints in gatherings(ideal.joints()) {
        let axes = &described.joints()[joints.clone()];
        let point = line(&axes[0]).nearest(&line(&axes[1]));
        let by = axes.iter().map(|axis| line(axis).distance(&point)).fold(0.0, f64::max);
        found.push(Relation { joints, kind: RelationKind::Meeting, by });
    }
    let triples = described.joints().windows(3).zip(ideal.joints().windows(3)).enumerate();
    found.extend(triples.filter_map(|(first, (own, meant))| level(first, own, meant)));
    found.retain(|relation| relation.by > 0.0);
    found.sort_by_key(|relation| (relation.joints.start, relation.joints.end));
    found
}

/// The relations of two neighbours, except an intersection.
fn of_pair(first: usize, own: &[Joint], meant: &[Joint]) -> Vec<Relation> {
    let is_parallel = sine(&meant[0].axis, &meant[1].axis) == 0.0;
    let is_upright = cosine(&meant[0].axis, &meant[1].axis) == 0.0;
    let is_one = is_parallel && turn(meant) && line(&meant[0]).distance(&meant[1].point) == 0.0;
    let relation = |kind, by: f64| Relation { joints: first..first + 2, kind, by };
    let mut found = Vec::new();
    if is_parallel {
        found.push(relation(RelationKind::Parallel, sine(&own[0].axis, &own[1].axis).asin()));
    }
    if is_upright {
        found.push(relation(RelationKind::Perpendicular, cosine(&own[0].axis, &own[1].axis).asin()));
    }
    if is_one {
        found.push(relation(RelationKind::Coincident, line(&own[0]).distance(&own[1].point)));
    }
    found
}

/// Whether the middle one of three axes, which do not intersect in one point, has no offset.
fn level(first: usize, own: &[Joint], meant: &[Joint]) -> Option<Relation> {
    let offset = |axes: &[Joint]| {
        let [before, own, after] = [0, 1, 2].map(|place| line(&axes[place]));
        let bends = |other: &Line| !is_zero(&cross(&own.direction, &other.direction));
        let feet = (bends(&before) && bends(&after)).then(|| (own.nearest(&before), own.nearest(&after)));
        feet.map(|(a, b)| (a == b, length(&sub(&a, &b))))
    };
    let meets = |pair: &[Joint]| line(&pair[0]).gap(&line(&pair[1])) == 0.0;
    let (is_level, _) = offset(meant).filter(|_| turn(meant))?;
    let is_new = is_level && !(meets(&meant[..2]) && meets(&meant[1..]));
    let by = offset(own).map_or(0.0, |(_, by)| by);
    is_new.then_some(Relation { joints: first..first + 3, kind: RelationKind::Level, by })
}

/// The axes that differ, and the tip.
pub(super) fn moved(described: &Chain, ideal: &Chain) -> Vec<Moved> {
    let joints = described.joints().iter().zip(ideal.joints());
    let axes = joints.map(|(a, b)| Moved {
        joint: Some(a.name.clone()),
        angle: sine(&a.axis, &b.axis).asin(),
        distance: if a.kind == JointKind::Revolute { line(b).distance(&a.point) } else { 0.0 },
    });
    let (from, to) = (described.base_from_tip(), ideal.base_from_tip());
    let is_turned = described.tip().rotation != ideal.tip().rotation;
    let tip = Moved {
        joint: None,
        angle: if is_turned { from.rotation.angle_to(&to.rotation) } else { 0.0 },
        distance: (from.translation.vector - to.translation.vector).norm(),
    };
    axes.chain([tip]).filter(|moved| moved.angle > 0.0 || moved.distance > 0.0).collect()
}

impl Moved {
    /// The greater of the angle and the distance in units of `reach`.
    pub(crate) fn deviation(&self, reach: f64) -> f64 {
        self.angle.max(self.distance / reach)
    }

    /// Describes the difference, without rounding errors of doubles: `turned by 1.0e-5 rad and shifted by 2.0e-5 m`.
    fn words(&self, reach: f64, unit: LengthUnit) -> String {
        let turn = (self.angle > SAME).then(|| format!("turned by {:.1e} rad", self.angle));
        let shift =
            (self.distance / reach > SAME).then(|| format!("shifted by {:.1e} {}", self.distance, unit.symbol()));
        turn.into_iter().chain(shift).collect::<Vec<_>>().join(" and ")
    }
}

impl Relation {
    /// Describes the relation, with lengths in `unit`: `axes 4 to 6 meet in one point, which they miss by 5e-6 m`.
    pub fn words(&self, unit: LengthUnit) -> String {
        let axes = format!("axes {} to {}", self.joints.start + 1, self.joints.end);
        let pair = format!("axes {} and {}", self.joints.start + 1, self.joints.end);
        let (by, unit) = (format!("{:.1e}", self.by), unit.symbol());
        match self.kind {
            RelationKind::Parallel => format!("{pair} are parallel; they are {by} rad off"),
            RelationKind::Perpendicular => format!("{pair} are perpendicular; they are {by} rad off"),
            RelationKind::Meeting if self.joints.len() == 2 => format!("{pair} meet; they pass at {by} {unit}"),
            RelationKind::Meeting => format!("{axes} meet in one point; they miss it by {by} {unit}"),
            RelationKind::Coincident => format!("{pair} are one line; they are {by} {unit} apart"),
            RelationKind::Level => {
                format!("axis {} has no offset between its neighbours; it has {by} {unit}", self.joints.start + 2)
            }
        }
    }
}

impl Report {
    /// The sentence of a README that introduces [`Report::lines`].
    pub fn sentence(&self) -> String {
        format!(
            "The solver is derived for the ideal robot within {:e} rad, or of the reach. Each answer is polished by Newton's method on the robot as \
             described, and measured on it. What was taken to be meant:",
            self.tolerance,
        )
    }

    /// One line for each relation whose error exceeds rounding in doubles, then the differences of the axes.
    pub fn lines(&self) -> Vec<String> {
        let is_length = |kind| !matches!(kind, RelationKind::Parallel | RelationKind::Perpendicular);
        let share = |relation: &Relation| relation.by / if is_length(relation.kind) { self.reach } else { 1.0 };
        let (reported, rounding): (Vec<_>, Vec<_>) = self.relations.iter().partition(|relation| share(relation) > SAME);
        let mut lines: Vec<String> = reported.iter().map(|relation| relation.words(self.length_unit)).collect();
        if !rounding.is_empty() {
            let ending = if rounding.len() == 1 { "relation misses" } else { "relations miss" };
            lines.push(format!("{} {ending} by rounding of doubles only, up to 1e-15", rounding.len()));
        }
        lines.extend(self.moved.iter().filter(|moved| moved.deviation(self.reach) > SAME).map(|moved| {
            let name = moved.joint.as_deref().map_or("the tip".to_owned(), |name| format!("the axis of {name}"));
            format!("{name} is {}", moved.words(self.reach, self.length_unit))
        }));
        lines
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return write!(f, "nothing within {:e} rad, or of the reach, had to be changed", self.tolerance);
        }
        f.write_str(&self.lines().join("\n"))
    }
}
