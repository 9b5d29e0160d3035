//! The evaluation of relations with any [`Arithmetic`]: at known joints, or as polynomials in the unknown ones.
//!
//! Every letter is a motion x -> o2 + R (x - o1). A point has the image y' = o2 + R (y - o1), whose square is
//! |y'|^2 = |y|^2 - 2 o1.y + |o1|^2 + 2 o2.y' - |o2|^2. Squares of points and moments of lines are transformed without products of two images.
//! So the joint's cosine and sine occur only in the first degree.

use super::arithmetic::{Arithmetic, Factor, Multilinear};
use super::assignment::{Assignment, JointValue, TargetRotation};
use super::following::follow;
use super::mechanism::Mechanism;
use super::relation::{Letter, Measure, Object, Relation, Word};
use super::vector;
use crate::{Error, ErrorKind, Result};
use groebot_robot::kinematics::{ExactMatrix, ExactVector};

/// Coordinates as polynomials in the unknown joints.
pub type Vector<V> = [Multilinear<V>; 3];

/// An object with the additional data for its measure.
#[derive(Clone, Debug, PartialEq)]
pub enum Image<V> {
    /// A point.
    Point(Vector<V>),
    /// A point and the square of its distance from the origin.
    PointSquare(Vector<V>, Multilinear<V>),
    /// A direction.
    Direction(Vector<V>),
    /// The normal v of a plane, and v.x for the points x of the plane.
    Plane(Vector<V>, Multilinear<V>),
    /// The direction v of a line, and x cross v for its points x.
    Line(Vector<V>, Vector<V>),
}

/// The value of `relation`: a polynomial in the unknown joints of `assignment`, which is zero where the loop is closed.
///
/// # Errors
/// [`ErrorKind::BadValue`] if the objects do not fit the measure, a joint occurs twice in a word, or the assignment has another number of joints than the
/// mechanism.
pub fn evaluate<A: Arithmetic>(
    mechanism: &Mechanism,
    relation: &Relation,
    assignment: &Assignment<A::Value>,
    arithmetic: &mut A,
) -> Result<Multilinear<A::Value>> {
    if let Some(followed) = relation.followed() {
        return follow(mechanism, followed, assignment, arithmetic);
    }
    let mut evaluation = Evaluation { mechanism, assignment, arithmetic };
    let left = evaluation.side(relation, &relation.left)?;
    let right = evaluation.side(relation, &relation.right)?;
    Ok(left.sub(&right, arithmetic))
}

/// An evaluation in progress.
#[non_exhaustive]
pub struct Evaluation<'a, A: Arithmetic> {
    pub mechanism: &'a Mechanism,
    pub assignment: &'a Assignment<A::Value>,
    pub arithmetic: &'a mut A,
}

/// The motion x -> after + R (x - before).
struct Motion<'a, V> {
    before: Vector<V>,
    after: Vector<V>,
    rotation: Rotation<'a, V>,
}

/// The rotation R of a motion.
enum Rotation<'a, V> {
    Identity,
    /// The rotation about an axis vector by the angle of a joint, in the opposite direction if inverse.
    Axis {
        axis: &'a ExactVector,
        dual: &'a ExactVector,
        joint: usize,
        value: &'a JointValue<V>,
        inverse: bool,
    },
    /// R_T R_M^T.
    Target(&'a TargetRotation<V>),
    /// R_M R_T^T.
    TargetInverse(&'a TargetRotation<V>),
}

impl<'a, A: Arithmetic> Evaluation<'a, A> {
    /// The evaluation of a mechanism's motions at these joint values and this target.
    pub fn new(mechanism: &'a Mechanism, assignment: &'a Assignment<A::Value>, arithmetic: &'a mut A) -> Self {
        Evaluation { mechanism, assignment, arithmetic }
    }

    fn side(&mut self, relation: &Relation, word: &Word) -> Result<Multilinear<A::Value>> {
        let image = self.carry(word, &relation.moved, relation.measure)?;
        self.measure(relation.measure, &relation.fixed, &image)
    }

    /// The image of `object` under `word`, with the additional data for `measure`.
    ///
    /// # Errors
    /// As [`evaluate`].
    pub fn carry(&mut self, word: &Word, object: &Object, measure: Measure) -> Result<Image<A::Value>> {
        self.check(word)?;
        let mut image = self.start(object, measure);
        for &letter in word.0.iter().rev() {
            let motion = self.motion(letter);
            image = self.apply(&motion, &image);
        }
        Ok(image)
    }

    fn check(&self, word: &Word) -> Result<()> {
        let count = self.mechanism.joints().len();
        let bad = |text: String| Err(Error::new(ErrorKind::BadValue, text));
        if self.assignment.joints.len() != count {
            return bad(format!(
                "{} joint values are given; the chain has {count} joints",
                self.assignment.joints.len()
            ));
        }
        for (at, letter) in word.0.iter().enumerate() {
            let Some(joint) = letter.joint() else { continue };
            if joint >= count || word.0[..at].iter().any(|other| other.joint() == Some(joint)) {
                return bad(format!("the word `{word}` must contain each of the {count} joints at most once"));
            }
        }
        Ok(())
    }

    /// The object itself, with the additional data for its measure.
    fn start(&mut self, object: &Object, measure: Measure) -> Image<A::Value> {
        match (object, measure) {
            (Object::Point(point), Measure::Distance) => {
                let place = self.numbers(point);
                let square = self.dot_number(point, &place);
                Image::PointSquare(place, square)
            }
            (Object::Point(point), _) => Image::Point(self.numbers(point)),
            (Object::Direction(direction), _) => Image::Direction(self.numbers(direction)),
            (Object::Line { point, direction }, Measure::Offset) => {
                let normal = self.numbers(direction);
                let offset = self.dot_number(point, &normal);
                Image::Plane(normal, offset)
            }
            (Object::Line { point, direction }, _) => {
                let (point, direction) = (self.numbers(point), self.numbers(direction));
                let moment = self.cross(&point, &direction);
                Image::Line(direction, moment)
            }
        }
    }

    /// The invariant of the fixed object and the image of the moved one.
    fn measure(&mut self, measure: Measure, fixed: &Object, image: &Image<A::Value>) -> Result<Multilinear<A::Value>> {
        match (measure, fixed, image) {
            (Measure::Angle, Object::Direction(a), Image::Direction(x))
            | (Measure::Offset, Object::Direction(a), Image::Point(x)) => Ok(self.dot_number(a, x)),
            (Measure::Offset, Object::Point(a), Image::Plane(normal, offset)) => {
                let along = self.dot_number(a, normal);
                Ok(along.sub(offset, self.arithmetic))
            }
            (Measure::Distance, Object::Point(a), Image::PointSquare(x, square)) => {
                // |x|^2 + a.a - 2 a.x = |x|^2 + a.(a - x) - a.x
                let place = self.numbers(a);
                let arm = self.minus(&place, x);
                let (far, near) = (self.dot_number(a, &arm), self.dot_number(a, x));
                Ok(square.add(&far, self.arithmetic).sub(&near, self.arithmetic))
            }
            (Measure::Moment, Object::Line { point, direction }, Image::Line(v, moment)) => {
                // (a - x).(v x w) = v.(w x a) - w.(x x v) with w the fixed direction.
                let (w, x) = (self.numbers(direction), self.numbers(point));
                let across = self.cross(&w, &x);
                let first = self.dot(&across, v);
                let second = self.dot_number(direction, moment);
                Ok(first.sub(&second, self.arithmetic))
            }
            _ => {
                let text = "a relation compares two directions (angle), a direction and a point or a point and a plane \
                            (offset), two points (distance) or two lines (moment)";
                Err(Error::new(ErrorKind::BadValue, text))
            }
        }
    }

    fn motion(&mut self, letter: Letter) -> Motion<'a, A::Value> {
        let (mechanism, assignment) = (self.mechanism, self.assignment);
        match letter {
            Letter::Joint(joint) | Letter::Inverse(joint) => {
                self.joint_motion(joint, matches!(letter, Letter::Inverse(_)))
            }
            Letter::Target => Motion {
                before: self.numbers(mechanism.tip_point()),
                after: self.values(&assignment.target.position),
                rotation: Rotation::Target(&assignment.target.rotation),
            },
            Letter::TargetInverse => Motion {
                before: self.values(&assignment.target.position),
                after: self.numbers(mechanism.tip_point()),
                rotation: Rotation::TargetInverse(&assignment.target.rotation),
            },
        }
    }

    fn joint_motion(&mut self, joint: usize, inverse: bool) -> Motion<'a, A::Value> {
        let (screw, value) = (&self.mechanism.joints()[joint], &self.assignment.joints[joint]);
        if screw.is_revolute() {
            let centre = self.numbers(&screw.point);
            let (axis, dual) = (&screw.axis, &screw.dual);
            let rotation = Rotation::Axis { axis, dual, joint, value, inverse };
            return Motion { before: centre.clone(), after: centre, rotation };
        }
        let axis = self.numbers(&screw.axis);
        let shift = axis.map(|entry| self.times_length(&entry, joint, value, inverse));
        Motion { before: self.numbers(&vector::zero()), after: shift, rotation: Rotation::Identity }
    }

    /// `entry` times d', or -d'.
    fn times_length(
        &mut self,
        entry: &Multilinear<A::Value>,
        joint: usize,
        value: &JointValue<A::Value>,
        inverse: bool,
    ) -> Multilinear<A::Value> {
        let product = match value {
            JointValue::Length(length) => self.times_value(entry, length),
            _ => entry.times_unknown(Factor::Length(joint), self.arithmetic),
        };
        if inverse { product.neg(self.arithmetic) } else { product }
    }

    fn apply(&mut self, motion: &Motion<'_, A::Value>, image: &Image<A::Value>) -> Image<A::Value> {
        let (before, after) = (&motion.before, &motion.after);
        match image {
            Image::Point(x) => Image::Point(self.move_point(motion, x)),
            Image::PointSquare(x, square) => {
                let moved = self.move_point(motion, x);
                // |x|^2 - 2 o1.x + |o1|^2 = |x - o1|^2 = |x' - o2|^2, and |x'|^2 = |x' - o2|^2 + 2 o2.x' - |o2|^2.
                let near = self.completed(square, before, x, false);
                let square = self.completed(&near, after, &moved, true);
                Image::PointSquare(moved, square)
            }
            Image::Direction(v) => Image::Direction(self.rotate(&motion.rotation, v)),
            Image::Plane(v, offset) => {
                let turned = self.rotate(&motion.rotation, v);
                let near = self.dot(before, v);
                let far = self.dot(after, &turned);
                let offset = offset.sub(&near, self.arithmetic).add(&far, self.arithmetic);
                Image::Plane(turned, offset)
            }
            Image::Line(v, moment) => {
                let turned = self.rotate(&motion.rotation, v);
                let near = self.cross(before, v);
                let arm = self.minus(moment, &near);
                let (arm, far) = (self.rotate(&motion.rotation, &arm), self.cross(after, &turned));
                let moment = self.plus(&far, &arm);
                Image::Line(turned, moment)
            }
        }
    }

    fn move_point(&mut self, motion: &Motion<'_, A::Value>, x: &Vector<A::Value>) -> Vector<A::Value> {
        let arm = self.minus(x, &motion.before);
        let turned = self.rotate(&motion.rotation, &arm);
        self.plus(&motion.after, &turned)
    }

    /// `square - 2 o.x + |o|^2`, or `square + 2 o.x - |o|^2`.
    fn completed(
        &mut self,
        square: &Multilinear<A::Value>,
        o: &Vector<A::Value>,
        x: &Vector<A::Value>,
        outward: bool,
    ) -> Multilinear<A::Value> {
        let once = self.dot(o, x);
        let (twice, own) = (once.add(&once, self.arithmetic), self.dot(o, o));
        let change = twice.sub(&own, self.arithmetic);
        if outward { square.add(&change, self.arithmetic) } else { square.sub(&change, self.arithmetic) }
    }

    fn rotate(&mut self, rotation: &Rotation<'_, A::Value>, v: &Vector<A::Value>) -> Vector<A::Value> {
        let mechanism = self.mechanism;
        match *rotation {
            Rotation::Identity => v.clone(),
            Rotation::Axis { axis, dual, joint, value, inverse } => {
                let [along, across, third] = self.split(axis, dual, v);
                let third = if inverse { third.map(|entry| entry.neg(self.arithmetic)) } else { third };
                let turned = self.combine(joint, value, &across, &third);
                self.plus(&along, &turned)
            }
            Rotation::Target(turn) => self.target_rotation(turn, v),
            Rotation::TargetInverse(TargetRotation::Matrix(rows)) => {
                let columns: [[A::Value; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| rows[j][i].clone()));
                let body = columns.each_ref().map(|row| self.dot_values(row, v));
                mechanism.tip_rotation().each_ref().map(|row| self.dot_number(row, &body))
            }
            // For other tasks the inverse is undefined, and their relations do not use it.
            Rotation::TargetInverse(_) => std::array::from_fn(|_| Multilinear::zero()),
        }
    }

    fn target_rotation(&mut self, rotation: &TargetRotation<A::Value>, v: &Vector<A::Value>) -> Vector<A::Value> {
        let mechanism = self.mechanism;
        match rotation {
            // Only the tip itself is transformed; its vector from the tip is zero.
            TargetRotation::Unspecified => std::array::from_fn(|_| Multilinear::zero()),
            TargetRotation::Direction(aim) => {
                // Only multiples of the direction are transformed: v = k a with k = a.v / a.a.
                let own = mechanism.aim();
                let factor = self.dot_number(&vector::scale(own, &vector::dot(own, own).recip()), v);
                aim.each_ref().map(|entry| self.times_value(&factor, entry))
            }
            TargetRotation::Matrix(rows) => {
                let back = transposed(mechanism.tip_rotation());
                let body = back.each_ref().map(|row| self.dot_number(row, v));
                rows.each_ref().map(|row| self.dot_values(row, &body))
            }
        }
    }

    /// The component of `v` along the axis, the component perpendicular to it, and w cross v.
    fn split(&mut self, axis: &ExactVector, dual: &ExactVector, v: &Vector<A::Value>) -> [Vector<A::Value>; 3] {
        let share = self.dot_number(dual, v);
        let along = axis.each_ref().map(|entry| share.scale(entry, self.arithmetic));
        let across = self.minus(v, &along);
        let third = std::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let (first, second) = (v[j].scale(&axis[i], self.arithmetic), v[i].scale(&axis[j], self.arithmetic));
            first.sub(&second, self.arithmetic)
        });
        [along, across, third]
    }

    /// `c across + s' third` with the cosine and sine of the joint.
    fn combine(
        &mut self,
        joint: usize,
        value: &JointValue<A::Value>,
        across: &Vector<A::Value>,
        third: &Vector<A::Value>,
    ) -> Vector<A::Value> {
        std::array::from_fn(|k| {
            let (first, second) = match value {
                JointValue::Angle { cosine, sine } => {
                    (self.times_value(&across[k], cosine), self.times_value(&third[k], sine))
                }
                _ => (
                    across[k].times_unknown(Factor::Cosine(joint), self.arithmetic),
                    third[k].times_unknown(Factor::Sine(joint), self.arithmetic),
                ),
            };
            first.add(&second, self.arithmetic)
        })
    }
}

fn transposed(matrix: &ExactMatrix) -> ExactMatrix {
    std::array::from_fn(|i| std::array::from_fn(|j| matrix[j][i].clone()))
}
