//! The ideal positions, from the base to the tip. Each axis is described by its offset from the previous one along the
//! common normal (Denavit and Hartenberg 1955). So axes that almost intersect become intersecting axes.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion};
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::directions::directions;
use super::{SAME, lengths, line};
use crate::Result;
use crate::kinematics::{Chain, ChainParts, ExactMatrix, ExactVector, Joint, JointKind, Tip};
use crate::spatial::exact::vector::{Line, add, cosine, cross, dot, is_zero, length, scale, sine, sub, unit};
use groebot_algebra::number::BigRational;

/// Angle below which directions have a distant common normal. Their offset is computed as for parallel axes \[rad\].
const PARALLEL: f64 = 1e-3;
/// Maximum number of decimal places of a rounded length.
const PLACES: usize = 18;

/// Makes almost exact relations of `chain` exact, and rounds lengths to decimals within `grain` of the tolerance.
pub(super) fn ideal(chain: &Chain, tolerance: f64, grain: f64) -> Result<Chain> {
    let directions = directions(chain.joints(), tolerance, grain);
    let length = lengths(chain, tolerance);
    let mut placing =
        Placing { tolerance: length, grain: grain * length, true_pivot: Default::default(), lines: Vec::new() };
    for (joint, direction) in chain.joints().iter().zip(directions) {
        placing.place(joint, chain, direction);
    }
    let tip = placing.tip(chain, tolerance);
    let joints = chain.joints().iter().zip(&placing.lines).map(|(joint, placed)| placed.joint(joint)).collect();
    let direction = aimed(chain, &tip, &placing, tolerance);
    Chain::new(ChainParts { joints, tip, direction, ..chain.parts().clone() })
}

/// A rotation whose entries have more bits is approximated by shorter numbers, if this angle is permitted \[rad\].
const LONG: u64 = 64;
const COARSEST: f64 = 1e-12;

/// An ideal axis with the point from which the next one is computed.
struct Placed {
    line: Line,
    pivot: ExactVector,
}

impl Placed {
    /// `joint` on this line. It is unchanged if its point is on the line.
    fn joint(&self, joint: &Joint) -> Joint {
        let Line { point, direction } = &self.line;
        let turns = joint.kind == JointKind::Revolute;
        let is_on_line = if turns { self.line.distance(&joint.point) == 0.0 } else { joint.point == *point };
        let point = if is_on_line { joint.point.clone() } else { point.clone() };
        Joint { axis: direction.clone(), point, ..joint.clone() }
    }
}

/// State of the placement of axes.
struct Placing {
    /// A length that counts as zero.
    tolerance: f64,
    /// A length by which coordinates may be rounded.
    grain: f64,
    /// The pivot of the previous joint, on its described axis.
    true_pivot: ExactVector,
    lines: Vec<Placed>,
}

impl Placing {
    /// Places the next joint.
    fn place(&mut self, joint: &Joint, chain: &Chain, direction: ExactVector) {
        let (pivot, ideal) = match self.lines.last() {
            // The position of the robot is not a relation of its axes.
            None => (joint.point.clone(), self.tidy(&straightened(&joint.point, lengths(chain, SAME)))),
            Some(_) if joint.kind == JointKind::Prismatic => (self.true_pivot.clone(), self.last_pivot()),
            Some(_) => self.turning(joint, &chain.joints()[self.lines.len() - 1], &direction),
        };
        // The joint's own point, at its offset along the axis.
        let offset = sub(&joint.point, &pivot);
        let point = match joint.kind {
            JointKind::Prismatic => add(&ideal, &offset),
            JointKind::Revolute => add(&ideal, &self.straightened_along(&offset, &direction)),
        };
        self.true_pivot = pivot;
        self.lines.push(Placed { line: Line { point, direction }, pivot: ideal });
    }

    fn last_pivot(&self) -> ExactVector {
        self.lines.last().map(|placed| placed.pivot.clone()).unwrap_or_default()
    }

    /// The pivot of a revolute joint, on its described axis and on the ideal one: the foot of the common normal with
    /// the previous axis.
    fn turning(&self, joint: &Joint, before: &Joint, direction: &ExactVector) -> (ExactVector, ExactVector) {
        let (own, other) = (line(joint), Line { point: self.true_pivot.clone(), direction: before.axis.clone() });
        let along = self.lines.last().map(|placed| placed.line.direction.clone()).unwrap_or_default();
        let is_parallel = is_zero(&cross(&along, direction));
        if is_parallel || sine(&own.direction, &other.direction) <= PARALLEL {
            let pivot = own.foot(&self.true_pivot);
            let step = sub(&pivot, &self.true_pivot);
            let step = if is_parallel { self.straightened_across(&step, direction) } else { self.nearly_zero(step) };
            return (pivot, add(&self.last_pivot(), &step));
        }
        let (foot, pivot) = (other.nearest(&own), own.nearest(&other));
        let shift = self.straightened_along(&sub(&foot, &self.true_pivot), &along);
        let gap = self.straightened_along(&sub(&pivot, &foot), &cross(&along, direction));
        (pivot, add(&self.last_pivot(), &add(&shift, &gap)))
    }

    /// The component of `step` along `direction`; zero when it is short.
    fn straightened_along(&self, step: &ExactVector, direction: &ExactVector) -> ExactVector {
        let along = scale(direction, &(dot(step, direction) / dot(direction, direction)));
        let tidy = self.tidy(&along);
        self.nearly_zero(if is_zero(&cross(&tidy, direction)) { tidy } else { self.short(step, direction) })
    }

    /// The component of `step` along `direction`, as a multiple of `direction` by a decimal that is as short as the
    /// grain permits.
    fn short(&self, step: &ExactVector, direction: &ExactVector) -> ExactVector {
        let share = dot(step, direction) / dot(direction, direction);
        // Relative to the greatest entry, which may be a long integer.
        let size = direction.iter().map(Signed::abs).max().unwrap_or_else(BigRational::one);
        let most = size.to_f64().unwrap_or(1.0) / length(direction);
        scale(direction, &(shortest_decimal(&(share * &size), self.grain * most) / size))
    }

    /// The component of `step` perpendicular to `direction`, without short parts along coordinate axes; zero when it is
    /// short.
    fn straightened_across(&self, step: &ExactVector, direction: &ExactVector) -> ExactVector {
        let across = sub(step, &scale(direction, &(dot(step, direction) / dot(direction, direction))));
        let straight = self.tidy(&straightened(&across, self.tolerance));
        let short = || {
            let first = upright(direction);
            add(&self.short(step, &first), &self.short(step, &cross(direction, &first)))
        };
        let straight = if dot(&straight, direction).is_zero() { straight } else { short() };
        self.nearly_zero(straight)
    }

    /// `step` with its coordinates rounded to decimals that are as short as the grain permits.
    fn tidy(&self, step: &ExactVector) -> ExactVector {
        step.each_ref().map(|x| shortest_decimal(x, self.grain))
    }

    /// `step`, or zero when it is short.
    fn nearly_zero(&self, step: ExactVector) -> ExactVector {
        if length(&step) <= self.tolerance { ExactVector::default() } else { step }
    }

    /// The tip at its offset from the last axis, or on the axis if it almost is.
    fn tip(&self, chain: &Chain, tolerance: f64) -> Tip {
        let tip = chain.tip();
        let Some(last) = self.lines.last() else { return tip.clone() };
        let step = sub(&tip.point, &self.true_pivot);
        let direction = &last.line.direction;
        let (along, across) = match chain.joints().last().map(|joint| joint.kind) {
            Some(JointKind::Revolute) => {
                (self.straightened_along(&step, direction), self.straightened_across(&step, direction))
            }
            _ => (ExactVector::default(), straightened(&step, self.tolerance)),
        };
        let point = add(&last.pivot, &add(&along, &across));
        let rotation = straight(&tip.rotation, tolerance);
        let is_long = rotation.iter().flatten().any(|entry| entry.denom().bits() > LONG);
        let angle = self.grain / lengths(chain, 1.0);
        Tip { point, rotation: if is_long && angle >= COARSEST { shortened(&rotation, angle) } else { rotation } }
    }
}

/// The direction of a task in the frame of `tip`: along the last axis or perpendicular to it, if it almost is.
fn aimed(chain: &Chain, tip: &Tip, placing: &Placing, tolerance: f64) -> ExactVector {
    let own = chain.direction();
    if let Some(axis) = chain.task().axis() {
        // Perpendicular to the axis of the task's angle, if it almost is.
        let normal = tip.rotation[axis.coordinate()].clone();
        let upright = cosine(own, &normal);
        let is_near = upright > 0.0 && upright <= tolerance;
        return if is_near { sub(own, &scale(&normal, &dot(own, &normal))) } else { own.clone() };
    }
    let Some(last) = placing.lines.last().filter(|_| chain.task().aims()) else { return own.clone() };
    let axis: ExactVector =
        std::array::from_fn(|i| (0..3).map(|k| &tip.rotation[k][i] * &last.line.direction[k]).sum());
    let (along, upright) = (sine(own, &axis), cosine(own, &axis));
    let flat = || sub(own, &scale(&axis, &(dot(own, &axis) / dot(&axis, &axis))));
    match (along > 0.0 && along <= tolerance, upright > 0.0 && upright <= tolerance) {
        (true, _) if dot(own, &axis).is_negative() => axis.map(|x| -x),
        (true, _) => axis,
        (_, true) => flat(),
        _ => own.clone(),
    }
}

/// A vector perpendicular to `direction` and to the coordinate axis that is most perpendicular to it.
fn upright(direction: &ExactVector) -> ExactVector {
    let least = (0..3).min_by_key(|&i| direction[i].abs()).unwrap_or(0);
    cross(direction, &unit(least))
}

/// `step` without components along coordinate axes of at most `tolerance`.
fn straightened(step: &ExactVector, tolerance: f64) -> ExactVector {
    step.each_ref().map(|x| if is_small(x, tolerance) { BigRational::zero() } else { x.clone() })
}

/// The decimal with the fewest places within `grain` of `x`, or `x` itself.
fn shortest_decimal(x: &BigRational, grain: f64) -> BigRational {
    let mut shift = BigRational::one();
    for _ in 0..PLACES {
        let rounded = (x * &shift).round() / &shift;
        if is_small(&(x - &rounded), grain) {
            return rounded;
        }
        shift *= BigRational::from_integer(10.into());
    }
    x.clone()
}

fn is_small(x: &BigRational, tolerance: f64) -> bool {
    x.to_f64().is_some_and(|x| x.abs() <= tolerance)
}

/// `rotation` with all entries rounded to -1, 0 or 1, if each is within `tolerance` of the rounded value.
fn straight(rotation: &ExactMatrix, tolerance: f64) -> ExactMatrix {
    let whole = rotation.each_ref().map(|row| row.each_ref().map(BigRational::round));
    let mut entries = rotation.iter().flatten().zip(whole.iter().flatten());
    if entries.all(|(x, whole)| is_small(&(x - whole), tolerance)) { whole } else { rotation.clone() }
}

/// An exactly orthogonal rotation from a quaternion of integers, within `angle` \[rad\] of `rotation`.
fn shortened(rotation: &ExactMatrix, angle: f64) -> ExactMatrix {
    let matrix = Matrix3::from_fn(|i, j| rotation[i][j].to_f64().unwrap_or(0.0));
    let quaternion = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(matrix));
    let whole = |x: f64| BigRational::from_float((x / angle).round()).unwrap_or_default();
    let [w, x, y, z] = [quaternion.w, quaternion.i, quaternion.j, quaternion.k].map(whole);
    let two = BigRational::from_integer(2.into());
    let (square, axis) = (&w * &w + &x * &x + &y * &y + &z * &z, [x, y, z]);
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let across = match (i + 3 - j) % 3 {
                0 => &w * &w * &two - &square,
                1 => &w * &axis[3 - i - j] * &two,
                _ => -(&w * &axis[3 - i - j] * &two),
            };
            (&axis[i] * &axis[j] * &two + across) / &square
        })
    })
}
