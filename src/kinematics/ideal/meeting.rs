//! Neighbouring axes that meet in one point, exactly or almost. Main type: [`Gathering`].

use std::ops::Range;

use super::line;
use crate::kinematics::exact_vector::{length, sine, sub};
use crate::kinematics::{ExactVector, Joint, JointKind};

/// Directions nearer than this are taken for parallel, so that no meeting point is looked for \[rad\].
const PARALLEL: f64 = 1e-3;

/// Two or more revolute joints in a row whose axes pass one point.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Gathering {
    /// The places of the joints.
    pub joints: Range<usize>,
    /// The point, on the first axis.
    pub point: ExactVector,
    /// The largest distance of an axis from the point; zero when they meet exactly.
    pub by: f64,
}

/// All gatherings of `joints` whose axes pass within `tolerance` of one point, from the base. Two of them share one joint at most.
pub(super) fn gatherings(joints: &[Joint], tolerance: f64) -> Vec<Gathering> {
    let mut found: Vec<Gathering> = Vec::new();
    for first in 0..joints.len().saturating_sub(1) {
        let Some(pair) = pair(first, joints, tolerance) else { continue };
        match found.last_mut().filter(|last| continues(last, &pair, tolerance)) {
            Some(last) => {
                last.joints.end = pair.joints.end;
                last.by = last.by.max(line(&joints[first + 1]).distance(&last.point));
            }
            None => found.push(pair),
        }
    }
    found
}

/// Two neighbours, if they meet.
fn pair(first: usize, joints: &[Joint], tolerance: f64) -> Option<Gathering> {
    let (a, b) = (&joints[first], &joints[first + 1]);
    let turn = [a, b].iter().all(|joint| joint.kind == JointKind::Revolute);
    if !turn || sine(&a.axis, &b.axis) <= PARALLEL.max(tolerance) {
        return None;
    }
    let by = line(a).gap(&line(b));
    (by <= tolerance).then(|| Gathering { joints: first..first + 2, point: line(a).nearest(&line(b)), by })
}

/// Whether the axes of `pair` pass the point of `last`, with which it shares a joint.
fn continues(last: &Gathering, pair: &Gathering, tolerance: f64) -> bool {
    last.joints.end == pair.joints.start + 1 && length(&sub(&pair.point, &last.point)) <= 2.0 * tolerance
}
