//! Relations as text and formulas, written for students.

use std::fmt;

use num_traits::{One, ToPrimitive};

use super::arithmetic::Polynomials;
use super::feature::leaves;
use super::mechanism::Mechanism;
use super::relation::{Letter, Measure, Object, Relation, Word};
use groebot_algebra::number::{BigRational, Rationals, Ring, Style};
use groebot_algebra::poly::{Order, PolynomialRing};
use groebot_robot::kinematics::ExactVector;

/// Text such as `|E3 (0, 1, 0) - (0, 0, 0.29)|^2 = |G (0, 1, 0) - (0, 0, 0.29)|^2` or `(0, 0, 1) . E2 (1, 0, 0) = ...`. For a joint that follows another one:
/// `c4 by c2, s2`.
impl fmt::Display for Relation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some([follower, leader, unknown]) = self.followed() {
            let (own, other) = (["c", "s", "d"][unknown], if unknown < 2 { "angle" } else { "length" });
            return write!(f, "{own} of joint {} by the {other} of joint {}", follower + 1, leader + 1);
        }
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

    /// The law of a joint that follows another one, as an equation such as `c3 = c2^2 - s2^2`. `None` for other relations.
    pub fn law(&self, mechanism: &Mechanism) -> Option<String> {
        let [follower, leader, unknown] = self.followed()?;
        let coupling = mechanism.joints().get(follower)?.coupling.as_ref()?;
        let letters: &[&str] = if unknown < 2 { &["c", "s"] } else { &["d"] };
        let names = |joint: usize| {
            let screw = &mechanism.joints()[joint];
            let prime = |letter: &&str| if *letter != "c" && !screw.square.is_one() { "'" } else { "" };
            letters.iter().map(|letter| format!("{letter}{}{}", screw.symbol, prime(letter))).collect::<Vec<String>>()
        };
        let plain: Vec<String> = (0..letters.len()).map(|k| format!("x{k}")).collect();
        let ring = PolynomialRing::new(Rationals, &plain, Order::GrevLex).ok()?;
        let unknowns: Vec<_> = (0..letters.len()).map(|k| ring.variable(k)).collect();
        let law = coupling.follow(&unknowns, &mut Polynomials(&ring));
        let text = ring.format(law.get(unknown % 2)?, Style::Decimal);
        let text = plain.iter().zip(names(leader)).fold(text, |text, (plain, name)| text.replace(plain, &name));
        Some(format!("{} = {text}", names(follower)[unknown % 2]))
    }

    /// The geometric statement as text, with the joints under which each object is invariant.
    pub fn meaning(&self, mechanism: &Mechanism) -> String {
        if let Some([follower, leader, _]) = self.followed() {
            let [name, other] = [follower, leader].map(|joint| &mechanism.joints()[joint].name);
            return format!("the joint `{name}` follows `{other}`");
        }
        let [run, tail] = self.cancelled(mechanism);
        let what = match self.measure {
            Measure::Angle => "angle between",
            Measure::Offset => "distance along the normal between",
            Measure::Distance => "distance between",
            Measure::Moment => "mutual moment of",
            Measure::Follow => "values of",
        };
        let name = |object: &Object, joints: &[usize]| {
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
                false => format!("the {noun} {text}, which {} in place", leave(joints)),
            }
        };
        format!("{what} {}, and {}", name(&self.fixed, &run), name(&self.moved, &tail))
    }

    /// The joints that do not occur: those of the run, under which the fixed object is invariant, and those of the tail for the moved object.
    pub(crate) fn cancelled(&self, mechanism: &Mechanism) -> [Vec<usize>; 2] {
        let stays = |place: &usize, object: &Object| leaves(&mechanism.joints()[*place], object, self.measure);
        let places = |word: &[Letter]| word.iter().filter_map(|letter| letter.joint()).collect::<Vec<_>>();
        let target = self.right.0.iter().position(|letter| letter.joint().is_none()).unwrap_or(self.right.0.len());
        let (before, after) = self.right.0.split_at(target);
        let start = places(before).into_iter().max().map_or(0, |place| place + 1);
        let end = places(after).into_iter().min().unwrap_or(mechanism.joints().len());
        let between = places(&self.left.0);
        let first = between.iter().copied().min();
        let cut = first.or_else(|| (start..end).find(|place| !stays(place, &self.fixed))).unwrap_or(end);
        let resume = between.iter().copied().max().map_or(cut, |place| place + 1);
        let row = |from: usize, to: usize, object: &Object| (from..to).filter(|place| stays(place, object)).collect();
        [row(start, cut, &self.fixed), row(resume, end, &self.moved)]
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

/// A vector as text, such as `(0.1, 0, -1)`.
pub(crate) fn show(vector: &ExactVector) -> String {
    let [x, y, z] = vector.each_ref().map(number);
    format!("({x}, {y}, {z})")
}

/// A decimal if it is short, else a fraction if it is short, else a rounded decimal.
fn number(q: &BigRational) -> String {
    let exact = [Style::Decimal, Style::Text].map(|style| Rationals.format(q, style));
    match exact.into_iter().find(|text| text.len() <= 16) {
        Some(text) => text,
        None => q.to_f64().map_or_else(|| q.to_string(), |value| format!("{value:.9}")),
    }
}
