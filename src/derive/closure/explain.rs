//! Relations in words and formulas, as a student reads them.

use std::fmt;

use num_traits::ToPrimitive;

use super::feature::leaves;
use super::mechanism::Mechanism;
use super::relation::{Measure, Object, Relation, Word};
use crate::kinematics::ExactVector;
use crate::number::{BigRational, Rationals, Ring, Style};

/// `|E3 (0, 1, 0) - (0, 0, 0.29)|^2 = |G (0, 1, 0) - (0, 0, 0.29)|^2`, `(0, 0, 1) . E2 (1, 0, 0) = ...`.
impl fmt::Display for Relation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}", self.side(&self.left), self.side(&self.right))
    }
}

impl Relation {
    fn side(&self, word: &Word) -> String {
        let moved = |vector: &ExactVector| {
            let text = show(vector);
            if word.0.is_empty() { text } else { format!("{word} {text}") }
        };
        let (fixed, moved) = match (&self.fixed, &self.moved) {
            (Object::Line { point, direction }, Object::Line { point: through, direction: along }) => {
                return format!(
                    "moment({} + t {}, {} + t {})",
                    show(point),
                    show(direction),
                    moved(through),
                    moved(along)
                );
            }
            (Object::Point(a), Object::Line { point, direction }) => {
                return format!("({} - {}) . {}", show(a), moved(point), moved(direction));
            }
            (Object::Point(a) | Object::Direction(a), Object::Point(x) | Object::Direction(x)) => (show(a), moved(x)),
            _ => (self.fixed.noun().to_owned(), self.moved.noun().to_owned()),
        };
        match self.measure {
            Measure::Distance => format!("|{moved} - {fixed}|^2"),
            _ => format!("{fixed} . {moved}"),
        }
    }

    /// What it says, in words: which joints leave what in place.
    pub fn meaning(&self, mechanism: &Mechanism) -> String {
        let count = mechanism.joints().len();
        let idle = |object: &Object| -> Vec<usize> {
            let stays = |place: &usize| leaves(&mechanism.joints()[*place], object, self.measure);
            (0..count).filter(|place| !self.joints().contains(place)).filter(stays).collect()
        };
        let what = match self.measure {
            Measure::Angle => "angle between",
            Measure::Offset => "distance along the normal between",
            Measure::Distance => "distance between",
            Measure::Moment => "mutual moment of",
        };
        let name = |object: &Object| {
            let joints = idle(object);
            let noun = match (self.measure, object) {
                (Measure::Offset, Object::Direction(_) | Object::Line { .. }) => "plane normal to",
                _ => object.noun(),
            };
            let text = match object {
                Object::Line { direction, .. } => show(direction),
                Object::Point(vector) | Object::Direction(vector) => show(vector),
            };
            match joints.is_empty() {
                true => format!("the {noun} {text}"),
                false => format!("the {noun} {text}, which {} in place", leave(&joints)),
            }
        };
        format!("{what} {}, and {}", name(&self.fixed), name(&self.moved))
    }
}

impl Object {
    /// `point`, `direction` or `line along`.
    fn noun(&self) -> &'static str {
        match self {
            Object::Point(_) => "point",
            Object::Direction(_) => "direction",
            Object::Line { .. } => "line along",
        }
    }
}

/// `joint 3 leaves`, `joints 1, 2 leave`: joints are counted from 1.
fn leave(joints: &[usize]) -> String {
    let list: Vec<String> = joints.iter().map(|joint| (joint + 1).to_string()).collect();
    match joints {
        [_] => format!("joint {} leaves", list[0]),
        _ => format!("joints {} leave", list.join(", ")),
    }
}

/// `(0.1, 0, -1)`.
pub(crate) fn show(vector: &ExactVector) -> String {
    let [x, y, z] = vector.each_ref().map(number);
    format!("({x}, {y}, {z})")
}

/// A decimal where it is short, else a fraction, else a rounded decimal.
fn number(q: &BigRational) -> String {
    let exact = [Style::Decimal, Style::Text].map(|style| Rationals.format(q, style));
    match exact.into_iter().find(|text| text.len() <= 16) {
        Some(text) => text,
        None => q.to_f64().map_or_else(|| q.to_string(), |value| format!("{value:.9}")),
    }
}
