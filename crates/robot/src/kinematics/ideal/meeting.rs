//! Neighbouring axes that meet in one point: [`gatherings`].

use std::ops::Range;

use super::{line, turn};
use crate::kinematics::{ExactVector, Joint};
use crate::spatial::exact::vector::sine;

/// Directions nearer than this are taken for parallel, so that no meeting point is looked for \[rad\].
const PARALLEL: f64 = 1e-3;

/// The places of two or more revolute joints in a row whose axes pass one point, from the base. Two of them share one joint at most.
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

/// Where the axes of two neighbours meet, if they do.
fn meeting(pair: &[Joint]) -> Option<ExactVector> {
    let (a, b) = (line(&pair[0]), line(&pair[1]));
    let meets = turn(pair) && sine(&a.direction, &b.direction) > PARALLEL && a.gap(&b) == 0.0;
    meets.then(|| a.nearest(&b))
}
