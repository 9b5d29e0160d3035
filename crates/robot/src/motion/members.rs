//! Members of self-motions at the singular poses of a path. Main function: [`add_members`].

use super::path_request::PathRequest;
use crate::kinematics::{Chain, InverseKinematics, JointKind, Solution, Target};
use crate::spatial::angle;
use crate::{Result, Watch};

/// Members with joint values that differ by less are one \[rad or the chain's unit\].
const EQUAL: f64 = 1e-9;

/// Adds solutions at singular poses: the members of self-motions that are nearest to the solutions before and after these poses. The listed member of a
/// self-motion may be far from both.
///
/// # Errors
/// As [`InverseKinematics::nearest_to`], with the number of the pose; [`crate::ErrorKind::Cancelled`] and [`crate::ErrorKind::Budget`].
pub(super) fn add_members(
    chain: &Chain,
    solver: &dyn InverseKinematics,
    request: &PathRequest<'_>,
    found: &mut [Vec<Solution>],
    watch: &Watch,
) -> Result<()> {
    let is_singular = |list: &Vec<Solution>| list.iter().any(|solution| !solution.free.is_empty());
    let singular: Vec<bool> = found.iter().map(is_singular).collect();
    if !singular.contains(&true) {
        return Ok(());
    }
    let members = Members { chain, limits: limits(chain) };
    let mut added: Vec<Vec<Solution>> = vec![Vec::new(); found.len()];
    let forwards: Vec<usize> = (0..found.len()).collect();
    let backwards: Vec<usize> = forwards.iter().rev().copied().collect();
    for (order, start) in [(backwards, None), (forwards, request.start)] {
        let mut references: Vec<Vec<f64>> = start.map(<[f64]>::to_vec).into_iter().collect();
        for sample in order {
            if !singular[sample] || references.is_empty() {
                references = found[sample].iter().filter_map(|solution| members.turned(&solution.q)).collect();
                continue;
            }
            watch.check()?;
            let target = Target::Pose(request.poses[sample]);
            let mut next: Vec<Vec<f64>> = Vec::new();
            for q0 in &references {
                let nearest = solver.nearest_to(&target, &[], q0, &members.limits);
                let nearest = nearest.map_err(|error| error.with_context(format_args!("pose {}", sample + 1)))?;
                let Some(nearest) = nearest else { continue };
                if !next.iter().any(|q| members.are_equal(q, &nearest.q)) {
                    next.push(nearest.q.clone());
                }
                let known = found[sample].iter().chain(&added[sample]);
                if !known.into_iter().any(|known| members.are_equal(&known.q, &nearest.q)) {
                    added[sample].push(nearest);
                }
            }
            references = next;
        }
    }
    found.iter_mut().zip(added).for_each(|(found, added)| found.extend(added));
    Ok(())
}

/// The limits of each joint, infinite where there are none.
fn limits(chain: &Chain) -> Vec<[f64; 2]> {
    let of = |limits: Option<(f64, f64)>| limits.map_or([f64::NEG_INFINITY, f64::INFINITY], |(low, high)| [low, high]);
    chain.joints().iter().map(|joint| of(joint.limits)).collect()
}

/// A chain whose members are compared.
struct Members<'c> {
    chain: &'c Chain,
    limits: Vec<[f64; 2]>,
}

impl Members<'_> {
    /// Joint values after the least turns within limits. `None` when that is impossible.
    fn turned(&self, q: &[f64]) -> Option<Vec<f64>> {
        let joints = self.chain.joints().iter().zip(&self.limits).zip(q);
        joints
            .map(|((joint, [low, high]), value)| {
                let turns = if joint.kind == JointKind::Revolute { [0.0, -1.0, 1.0] } else { [0.0; 3] };
                let values = turns.map(|turn| value + turn * std::f64::consts::TAU);
                values.into_iter().find(|value| (low - EQUAL..=high + EQUAL).contains(value))
            })
            .collect()
    }

    /// Whether joint values are equal up to whole turns.
    fn are_equal(&self, a: &[f64], b: &[f64]) -> bool {
        self.chain.joints().iter().zip(a.iter().zip(b)).all(|(joint, (a, b))| {
            let delta = if joint.kind == JointKind::Revolute { angle::difference(*a, *b) } else { a - b };
            delta.abs() <= EQUAL
        })
    }
}
