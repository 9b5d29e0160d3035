//! Sampled arcs, and their points nearest to given joint values: [`SampledArc`].

use groebot_runtime::redundant::{Given, Members, Redundant};

use super::{Arc, ArmTarget, JointLimits, RedundantSolver};
use crate::Unit;
use crate::{Error, ErrorKind, Result};

/// The distance of samples along an arc, in rad.
const SPACING: f64 = 0.1;
/// The maximum number of samples of an arc.
const MOST: usize = 96;

/// An arc as a list of points.
pub(super) struct SampledArc {
    /// Joint values at equal distances, the ends included.
    pub points: Vec<Vec<f64>>,
}

impl RedundantSolver {
    /// The names of the joints.
    pub fn names(&self) -> Vec<&str> {
        self.joints.iter().map(|joint| joint.name.as_str()).collect()
    }

    /// Checks joint values: one finite value for each joint.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] with the number of joints or the name of the joint.
    pub(super) fn joint_values<'q>(&self, q: &'q [f64]) -> Result<&'q [f64]> {
        let bad = |text: String| Err(Error::new(ErrorKind::BadValue, text));
        if q.len() != self.joints.len() {
            return bad(format!("{} joint values given; give one for each of {} joints", q.len(), self.joints.len()));
        }
        match q.iter().zip(&self.joints).find(|(value, _)| !value.is_finite()) {
            Some((value, joint)) => bad(format!("the value of `{}` is {value}; give a finite number", joint.name)),
            None => Ok(q),
        }
    }

    /// Samples of an arc at equal distances.
    pub(super) fn sampled(&self, target: &ArmTarget, limits: &JointLimits, arc: &Arc) -> Result<SampledArc> {
        let count = ((arc.length / SPACING).ceil() as usize + 1).clamp(2, MOST);
        Ok(SampledArc { points: self.samples(target, limits, arc, count)? })
    }
}

/// The point of an arc that is nearly the nearest to `q`, and the index of the sample before it. `near` moves its first argument by whole turns to the second.
///
/// Between two samples, the joint that moves most gets the interpolated value, and the solver with this joint given finds the others.
///
/// # Errors
/// As [`RedundantSolver::arcs`].
pub(super) fn nearest(
    solver: &RedundantSolver,
    target: &ArmTarget,
    arc: &SampledArc,
    q: &[f64],
    near: impl Fn(&[f64], &[f64]) -> Vec<f64>,
) -> Result<Option<(usize, Vec<f64>)>> {
    let points: Vec<Vec<f64>> = arc.points.iter().map(|point| near(point, q)).collect();
    let distance = |point: &[f64]| point.iter().zip(q).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
    let Some(place) = (0..points.len()).min_by(|a, b| distance(&points[*a]).total_cmp(&distance(&points[*b]))) else {
        return Ok(None);
    };
    let neighbours = [place.checked_sub(1), (place + 1 < points.len()).then_some(place + 1)];
    let mut best = (place, points[place].clone());
    for other in neighbours.into_iter().flatten() {
        let (a, b) = (&points[place], &points[other]);
        let step: Vec<f64> = b.iter().zip(a).map(|(b, a)| b - a).collect();
        let length = step.iter().map(|entry| entry * entry).sum::<f64>();
        let along = step.iter().zip(q.iter().zip(a)).map(|(step, (q, a))| step * (q - a)).sum::<f64>() / length;
        if !(0.0 < along && along < 1.0) {
            continue;
        }
        let between: Vec<f64> = a.iter().zip(&step).map(|(a, step)| a + along * step).collect();
        let Some(found) = solver.corrected(target, &between, &step)? else { continue };
        let found = near(&found, q);
        let off = found.iter().zip(&between).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
        if off < length && distance(&found) < distance(&best.1) {
            best = (place.min(other), found);
        }
    }
    Ok(Some(best))
}

impl RedundantSolver {
    /// The solution nearest to `q` whose joint that moves most along `step`, of those with a solver, has the value of `q`.
    fn corrected(&self, target: &ArmTarget, q: &[f64], step: &[f64]) -> Result<Option<Vec<f64>>> {
        let solved = (0..q.len()).filter(|joint| self.arm.given[*joint] == Given::Solved);
        let Some(joint) = solved.max_by(|a, b| step[*a].abs().total_cmp(&step[*b].abs())) else { return Ok(None) };
        let mut members = Members::NONE;
        self.solve_given(&target.row, joint, q[joint], &mut members).map_err(|error| self.refused(target, error))?;
        let part = |joint: usize, half: f64| if self.joints[joint].unit == Unit::Radian { half.sin() } else { half };
        let distance = |own: &[f64]| -> f64 {
            own.iter().zip(q).enumerate().map(|(joint, (a, b))| part(joint, (a - b) / 2.0).powi(2)).sum()
        };
        let found = members.as_slice().iter().map(|member| self.values(&member.q));
        Ok(found.min_by(|a, b| distance(a).total_cmp(&distance(b))))
    }
}
