//! Text on a chain's geometry: which axes meet or are parallel, and why joints cancel in a relation.

use std::ops::Range;

use super::document::Line;
use crate::derive::closure::{Letter, Measure, Mechanism, Object, Relation, ScrewJoint, common_point, parallel, show};
use groebot_robot::kinematics::Task;

/// Neighbouring axes that meet or are parallel, one line for each group.
pub fn common(mechanism: &Mechanism) -> Vec<Line> {
    let joints = mechanism.joints();
    let aligned = |row: &[ScrewJoint]| row.iter().all(|joint| parallel(&joint.axis, &row[0].axis));
    let mut lines = Vec::new();
    for range in longest(joints, |row| common_point(row).is_some() && !aligned(row)) {
        let point = common_point(&joints[range.clone()]).map(|point| show(&point)).unwrap_or_default();
        lines.push(
            Line::of(&format!("The axes of {} meet in the point ", numbers(range.clone()))).formula(&point).and("."),
        );
    }
    for range in longest(joints, |row| row.iter().all(ScrewJoint::is_revolute) && aligned(row)) {
        let along = show(&joints[range.start].axis);
        lines.push(Line::of(&format!("The axes of {} are parallel, along ", numbers(range))).formula(&along).and("."));
    }
    lines
}

/// The ranges of two or more neighbouring joints that pass the test and are not part of a longer such range.
fn longest(joints: &[ScrewJoint], test: impl Fn(&[ScrewJoint]) -> bool) -> Vec<Range<usize>> {
    let mut found: Vec<Range<usize>> = Vec::new();
    for start in 0..joints.len() {
        let end = (start + 2..=joints.len()).rev().find(|&end| test(&joints[start..end]));
        if let Some(end) = end.filter(|&end| found.iter().all(|other| other.end < end)) {
            found.push(start..end);
        }
    }
    found
}

/// Reasons why joints do not occur in `relation`: one line for each of its two objects.
pub fn cancelled(mechanism: &Mechanism, relation: &Relation) -> Vec<Line> {
    let line = |object: &Object, idle: &[usize], seen: bool| {
        let what = Line::of("The ").and(noun(object, relation.measure)).and(" ").formula(&vector(object));
        if idle.is_empty() {
            return what.and(match seen {
                true => " is the only part of the tip's pose that the task specifies there.",
                false => " was chosen arbitrarily: the loop is cut where no joint is.",
            });
        }
        let verb = if idle.len() == 1 { " leaves" } else { " leave" };
        let who = numbers(idle.iter().copied());
        what.and(&format!(": {who}{verb} it in place, because {}.", reason(mechanism, idle, object, relation.measure)))
    };
    let [run, tail] = relation.cancelled(mechanism);
    // Coordinates of the tip that the task does not use are not constrained after the last joint.
    let partly = !matches!(mechanism.seen(), Task::Pose | Task::PlanarPose { .. } | Task::PositionYaw { .. });
    let at_tip = relation.right.0.last() == Some(&Letter::Target);
    vec![line(&relation.fixed, &run, false), line(&relation.moved, &tail, partly && at_tip)]
}

/// The statement of a relation with this measure.
pub fn conserved(measure: Measure) -> &'static str {
    match measure {
        Measure::Angle => {
            "the angle between the two, hence their scalar product, is equal along both paths round the loop"
        }
        Measure::Offset => "the distance along the normal between the two is equal along both paths round the loop",
        Measure::Distance => "the distance between the two, hence its square, is equal along both paths round the loop",
        Measure::Moment => "the mutual moment of the two is equal along both paths round the loop",
        Measure::Follow => "the position of one joint determines that of the other",
    }
}

/// The geometric condition under which a single equation does not determine its joint.
pub fn degenerate(measure: Measure) -> &'static str {
    match measure {
        Measure::Angle => {
            "one of the two directions is parallel to the joint's axis, so that a rotation about it changes no angle"
        }
        Measure::Offset => {
            "the normal is parallel to the joint's axis, or the point is on it, so that a rotation changes nothing in the equation"
        }
        Measure::Distance => {
            "one of the two points is on the joint's axis, so that a rotation about it changes no distance"
        }
        Measure::Moment => "a rotation about the axis does not change the moment of the two lines",
        Measure::Follow => "this case does not occur: the law determines the joint everywhere",
    }
}

fn noun(object: &Object, measure: Measure) -> &'static str {
    match (object, measure) {
        (Object::Point(_), _) => "point",
        (_, Measure::Offset) => "plane normal to",
        (Object::Direction(_), _) => "direction",
        (Object::Line { .. }, _) => "line along",
    }
}

fn vector(object: &Object) -> String {
    match object {
        Object::Point(vector) | Object::Direction(vector) => show(vector),
        Object::Line { direction, .. } => show(direction),
    }
}

fn reason(mechanism: &Mechanism, idle: &[usize], object: &Object, measure: Measure) -> String {
    let (turns, slides): (Vec<usize>, Vec<usize>) =
        idle.iter().partition(|&&place| mechanism.joints()[place].is_revolute());
    let axes = |list: &[usize]| if list.len() == 1 { "its axis" } else { "their axes" };
    let turning = match (object, measure) {
        _ if turns.is_empty() => None,
        (Object::Point(_), _) => Some(format!("it is on {}", axes(&turns))),
        (Object::Line { .. }, Measure::Moment) => Some(format!("it is the line of {}", axes(&turns))),
        (_, Measure::Offset) => Some(format!("the normal is along {}", axes(&turns))),
        _ => Some(format!("it is along {}", axes(&turns))),
    };
    let sliding = match measure {
        _ if slides.is_empty() => None,
        Measure::Angle => Some("a translation does not rotate it".to_owned()),
        Measure::Offset => Some("the translation is along the plane".to_owned()),
        _ => Some("the translation is along it".to_owned()),
    };
    turning.into_iter().chain(sliding).collect::<Vec<_>>().join(", and ")
}

/// Joints counted from 1, as text: `joint 3`, `joints 1, 2 and 4`.
pub fn numbers(places: impl IntoIterator<Item = usize>) -> String {
    let list: Vec<String> = places.into_iter().map(|place| (place + 1).to_string()).collect();
    match list.split_last() {
        None => "no joint".to_owned(),
        Some((only, [])) => format!("joint {only}"),
        Some((last, rest)) => format!("joints {} and {last}", rest.join(", ")),
    }
}
