//! The invariants of neighbouring joints: points on all their axes, common directions, planes in which they move.

use super::mechanism::ScrewJoint;
use super::relation::{Measure, Object};
use super::vector;
use groebot_robot::kinematics::ExactVector;

/// The invariants of a row of neighbouring joints.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Features {
    /// The invariant point, or one point of a common axis.
    points: Vec<ExactVector>,
    /// A basis of the invariant directions.
    directions: Vec<ExactVector>,
    /// A basis of the normals of planes that are mapped to themselves.
    normals: Vec<ExactVector>,
    /// The common axis: one of its points and its direction.
    line: Option<(ExactVector, ExactVector)>,
    /// A point of the planes.
    anchor: ExactVector,
}

impl Features {
    /// The invariants of a row of joints. If there is a choice of directions, they are adapted to the joint with the axis `neighbour`.
    pub fn of(row: &[&ScrewJoint], neighbour: &ExactVector) -> Self {
        let turns: Vec<&ScrewJoint> = row.iter().copied().filter(|joint| joint.is_revolute()).collect();
        let slides: Vec<&ScrewJoint> = row.iter().copied().filter(|joint| !joint.is_revolute()).collect();
        let point = if slides.is_empty() { common_point(&turns) } else { None };
        let on_line = |(point, direction): &(ExactVector, ExactVector)| {
            let line = Object::Line { point: point.clone(), direction: direction.clone() };
            row.iter().all(|joint| leaves(joint, &line, Measure::Moment))
        };
        Features {
            directions: shared_directions(&turns, neighbour),
            normals: normals(&turns, &slides, neighbour),
            line: point.clone().map(|point| (point, turns[0].axis.clone())).filter(on_line),
            anchor: row.first().map_or_else(vector::zero, |joint| joint.point.clone()),
            points: point.into_iter().collect(),
        }
    }

    /// The invariants of an empty row, which keeps everything fixed: directions adapted to the joint with the axis `neighbour`, and `points`.
    pub fn of_nothing(neighbour: &ExactVector, points: Vec<ExactVector>) -> Self {
        let frame = vector::frame(neighbour).to_vec();
        let anchor = points.first().cloned().unwrap_or_else(vector::zero);
        Features { directions: frame.clone(), normals: frame, points, line: None, anchor }
    }

    /// Whether there are no invariants.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty() && self.directions.is_empty() && self.normals.is_empty()
    }

    /// All measures between an invariant of this row, fixed, and an invariant of `tail`, moved.
    pub fn pairs(&self, tail: &Features) -> Vec<(Measure, Object, Object)> {
        let each = |measure, fixed: &[Object], moved: &[Object]| -> Vec<(Measure, Object, Object)> {
            let with = |a: &Object| moved.iter().map(|b| (measure, a.clone(), b.clone())).collect::<Vec<_>>();
            fixed.iter().flat_map(with).collect()
        };
        let directions = |list: &[ExactVector]| list.iter().cloned().map(Object::Direction).collect::<Vec<_>>();
        let points = |list: &[ExactVector]| list.iter().cloned().map(Object::Point).collect::<Vec<_>>();
        let line = |(point, direction): (ExactVector, ExactVector)| Object::Line { point, direction };
        let planes: Vec<Object> =
            tail.normals.iter().map(|normal| line((tail.anchor.clone(), normal.clone()))).collect();
        let lines = |features: &Features| features.line.clone().map(line).into_iter().collect::<Vec<_>>();
        [
            each(Measure::Angle, &directions(&self.directions), &directions(&tail.directions)),
            each(Measure::Offset, &directions(&self.normals), &points(&tail.points)),
            each(Measure::Offset, &points(&self.points), &planes),
            each(Measure::Distance, &points(&self.points), &points(&tail.points)),
            each(Measure::Moment, &lines(self), &lines(tail)),
        ]
        .concat()
    }
}

/// Whether the value that `measure` uses of `object` is invariant under the joint.
pub fn leaves(joint: &ScrewJoint, object: &Object, measure: Measure) -> bool {
    let along = |direction: &ExactVector| vector::parallel(&joint.axis, direction);
    let across = |direction: &ExactVector| vector::dot(&joint.axis, direction) == Default::default();
    let through = |point: &ExactVector| along(&vector::sub(point, &joint.point));
    match (object, measure, joint.is_revolute()) {
        (Object::Point(point), _, true) => through(point),
        (Object::Point(_), _, false) => false,
        (Object::Direction(_), Measure::Angle, false) => true,
        (Object::Direction(direction), _, true) => along(direction),
        (Object::Direction(direction), _, false) => across(direction),
        (Object::Line { direction, .. }, Measure::Offset, true) => along(direction),
        (Object::Line { direction, .. }, Measure::Offset, false) => across(direction),
        (Object::Line { point, direction }, _, true) => along(direction) && through(point),
        (Object::Line { direction, .. }, _, false) => along(direction),
    }
}

/// The common point of the axes of all `joints`: the first joint's point if they are all one line. `None` if a joint is prismatic.
pub fn common_point_of(joints: &[ScrewJoint]) -> Option<ExactVector> {
    let turns: Vec<&ScrewJoint> = joints.iter().filter(|joint| joint.is_revolute()).collect();
    if turns.len() == joints.len() { common_point(&turns) } else { None }
}

/// The common point of all axes: the intersection, or the first joint's point if they are all one line.
fn common_point(turns: &[&ScrewJoint]) -> Option<ExactVector> {
    let first = turns.first()?;
    let other = turns.iter().find(|joint| !vector::parallel(&joint.axis, &first.axis));
    let point = match other {
        None => first.point.clone(),
        Some(other) => crossing(first, other)?,
    };
    let object = Object::Point(point.clone());
    turns.iter().all(|joint| leaves(joint, &object, Measure::Distance)).then_some(point)
}

/// The point of the first axis nearest to the other one, which is not parallel to it.
fn crossing(first: &ScrewJoint, other: &ScrewJoint) -> Option<ExactVector> {
    let normal = vector::cross(&first.axis, &other.axis);
    let between = vector::sub(&other.point, &first.point);
    let square = vector::dot(&normal, &normal);
    let along = vector::dot(&vector::cross(&between, &other.axis), &normal) / square;
    Some(vector::add(&first.point, &vector::scale(&first.axis, &along)))
}

fn shared_directions(turns: &[&ScrewJoint], neighbour: &ExactVector) -> Vec<ExactVector> {
    match turns {
        [] => vector::frame(neighbour).to_vec(),
        [first, rest @ ..] if rest.iter().all(|joint| vector::parallel(&joint.axis, &first.axis)) => {
            vec![first.axis.clone()]
        }
        _ => Vec::new(),
    }
}

/// Directions along all revolute axes and perpendicular to all prismatic ones.
fn normals(turns: &[&ScrewJoint], slides: &[&ScrewJoint], neighbour: &ExactVector) -> Vec<ExactVector> {
    let candidates = match (turns, slides) {
        ([first, ..], _) => vec![first.axis.clone()],
        ([], [first, rest @ ..]) => match rest.iter().find(|joint| !vector::parallel(&joint.axis, &first.axis)) {
            None => across(&first.axis, neighbour),
            Some(other) => vec![vector::tidy(&vector::cross(&first.axis, &other.axis))],
        },
        ([], []) => Vec::new(),
    };
    let stays = |normal: &ExactVector| {
        let object = Object::Direction(normal.clone());
        turns.iter().chain(slides).all(|joint| leaves(joint, &object, Measure::Offset))
    };
    candidates.into_iter().filter(stays).collect()
}

/// Two directions perpendicular to `axis`, the first of them also perpendicular to `neighbour`.
fn across(axis: &ExactVector, neighbour: &ExactVector) -> Vec<ExactVector> {
    let first = match vector::cross(axis, neighbour) {
        cross if vector::is_zero(&cross) => vector::perpendicular(axis),
        cross => vector::tidy(&cross),
    };
    vec![first.clone(), vector::tidy(&vector::cross(axis, &first))]
}
