//! Neighbouring axes that intersect in one point: [`gatherings`].

use std::ops::Range;

use super::{line, turn};
use crate::kinematics::{ExactVector, Joint};
use crate::spatial::exact::vector::sine;

/// Angle below which directions count as parallel and no point of intersection is computed \[rad\].
const PARALLEL: f64 = 1e-3;

/// Ranges of two or more consecutive revolute joints whose axes pass through one point, from the base. Two ranges share
/// at most one joint.
pub(super) fn gatherings(joints: &[Joint]) -> Vec<Range<usize>> {
    let mut found: Vec<(Range<usize>, ExactVector)> = Vec::new();
    for (first, pair) in joints.windows(2).enumerate() {
        let Some(point) = meeting(pair) else { continue };
        match found.last_mut().filter(|(last, common)| last.end == first + 1 && *common == point) {
            Some((last, _)) => last.end += 1,
            None => found.push((first..first + 2, point)),
        }
    }
    found.into_iter().map(|(places, _)| places).collect()
}

/// The point of intersection of two neighbours' axes, if there is one.
fn meeting(pair: &[Joint]) -> Option<ExactVector> {
    let (a, b) = (line(&pair[0]), line(&pair[1]));
    let meets = turn(pair) && sine(&a.direction, &b.direction) > PARALLEL && a.gap(&b) == 0.0;
    meets.then(|| a.nearest(&b))
}
