//! The ideal directions, from the base: each relative to the previous one.

use num_traits::{One, Signed, ToPrimitive, Zero};

use super::SAME;
use crate::kinematics::{ExactVector, Joint};
use crate::spatial::exact::vector::{cosine, cross, dot, is_zero, scale, sine, sub};
use groebot_algebra::number::BigRational;

/// From this grain on, directions are written in short numbers.
const COARSE: f64 = 1e-4;

/// The ideal directions within `tolerance`. A direction that is almost parallel or perpendicular to the previous one
/// becomes exactly so. Among these, the direction of an earlier joint or along coordinate axes is preferred. Otherwise
/// the direction is unchanged, except that it is moved to a coordinate plane if it is near one. Exact directions keep
/// their length. Others get integers that are as short as `grain`, a fraction of the tolerance, permits, because later
/// directions and points are products of these.
pub(super) fn directions(joints: &[Joint], tolerance: f64, grain: f64) -> Vec<ExactVector> {
    let mut ideal: Vec<ExactVector> = Vec::new();
    for joint in joints {
        let own = &joint.axis;
        let short = if grain < COARSE { own.clone() } else { shortened(own, grain * tolerance) };
        // A direction that is already perpendicular to the previous one is so in its own numbers.
        let is_lost = |before: &ExactVector| dot(own, before).is_zero() && !dot(&short, before).is_zero();
        let chosen = if ideal.last().is_some_and(is_lost) { own } else { &short };
        let straight = straightened(chosen, &ideal, tolerance).filter(|straight| !is_zero(&cross(straight, own)));
        ideal.push(straight.unwrap_or_else(|| own.clone()));
    }
    ideal
}

/// Approximates `direction` in integers, within `angle` \[rad\].
fn shortened(direction: &ExactVector, angle: f64) -> ExactVector {
    let greatest = direction.iter().map(Signed::abs).max().unwrap_or_else(BigRational::one);
    let size = BigRational::from_float((1.0 / angle).round()).unwrap_or_else(BigRational::one);
    direction.each_ref().map(|x| (x / &greatest * &size).round())
}

/// The ideal direction for `own` after the directions `earlier`; `None` if it is unchanged.
fn straightened(own: &ExactVector, earlier: &[ExactVector], tolerance: f64) -> Option<ExactVector> {
    let before = earlier.last();
    if let Some(before) = before.filter(|before| sine(own, before) <= tolerance) {
        return Some(along(before, own));
    }
    let upright_to = before.filter(|before| cosine(own, before) <= tolerance);
    let flat = flat(own, tolerance);
    let suits = |candidate: &ExactVector| {
        sine(own, candidate) <= tolerance && upright_to.is_none_or(|before| dot(candidate, before).is_zero())
    };
    let like = earlier.iter().map(|other| along(other, own));
    let normals = before.into_iter().flat_map(|before| earlier.iter().map(move |other| cross(before, other)));
    let normals = normals.filter(|normal| !is_zero(normal)).map(|normal| along(&normal, own));
    let mut candidates = like.chain(simple(own)).chain(normals.filter(|_| upright_to.is_some()));
    let upright = |before: &ExactVector| {
        // An exactly perpendicular direction that would not be perpendicular without its small entries keeps them.
        let keeps = dot(own, before).is_zero() && !dot(&flat, before).is_zero();
        if keeps { own.clone() } else { without(&flat, before) }
    };
    candidates.find(suits).or_else(|| Some(upright_to.map_or_else(|| flat.clone(), upright)))
}

/// `direction` or its negative, so that it points along `own`.
fn along(direction: &ExactVector, own: &ExactVector) -> ExactVector {
    if dot(direction, own).is_negative() { direction.each_ref().map(|x| -x) } else { direction.clone() }
}

/// The direction given by the signs of the greatest entries: `[0, 1, -1]` for `[1e-6, 0.7071, -0.7072]`. `None` for a
/// diagonal within rounding: a rotation that was made rational leads to a direction next to it, and its axes have
/// rational lengths.
fn simple(direction: &ExactVector) -> Option<ExactVector> {
    let greatest = direction.iter().map(Signed::abs).max()?;
    let half = greatest / BigRational::from_integer(2.into());
    let signs = direction.each_ref().map(|x| if x.abs() < half { BigRational::zero() } else { x.signum() });
    let is_diagonal = signs.iter().filter(|sign| !sign.is_zero()).count() > 1;
    (!is_diagonal || sine(direction, &signs) > SAME).then_some(signs)
}

/// `own` without entries that are small relative to its greatest entry.
fn flat(own: &ExactVector, tolerance: f64) -> ExactVector {
    let greatest = own.iter().map(Signed::abs).max().unwrap_or_default();
    let small = |x: &BigRational| (x / &greatest).to_f64().is_some_and(|share| share.abs() <= 0.5 * tolerance);
    own.each_ref().map(|x| if small(x) { BigRational::zero() } else { x.clone() })
}

/// The component of `own` perpendicular to `before`.
fn without(own: &ExactVector, before: &ExactVector) -> ExactVector {
    let share = dot(own, before) / dot(before, before);
    sub(own, &scale(before, &share))
}
