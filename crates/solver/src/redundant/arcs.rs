//! All arcs of solutions within limits ([`Arcs`]).

use std::fmt;

use groebot_runtime::redundant as runtime;
use serde::Serialize;

use super::{ArmTarget, JointLimits, RedundantSolver};
use crate::Result;

/// The number of arcs for which memory is taken first. More memory is taken when a target has more.
const ROOM: usize = 64;

/// An end of an arc.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ArcEnd {
    /// Joint values, in rad or the length unit of the program.
    pub q: Vec<f64>,
    /// The index of the joint that is at its limit, the first of several. `None` for a closed curve, and for a curve that could not be followed.
    pub joint: Option<usize>,
    /// Whether it is at its upper limit.
    pub is_upper: bool,
}

/// A maximal connected curve of solutions within limits.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Arc {
    /// Where it begins; for a closed curve, a point on it.
    pub start: ArcEnd,
    /// Where it ends.
    pub end: ArcEnd,
    /// Its length in the space of joint values: rad, where lengths are relative to the scale of the program.
    pub length: f64,
    /// Whether the curve is closed and reaches no limit.
    pub is_closed: bool,
    /// Whether something was not decided, such as which curve continues where two cross.
    pub is_unsure: bool,
    #[serde(skip)]
    pub(super) traced: runtime::Arc,
}

/// The reason why no solution is within limits.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Absence {
    /// No solution was found, whatever the limits. A narrow curve of solutions may have been missed.
    Unreachable,
    /// All solutions that were found are beyond limits. In the one that exceeds limits least, the joints with these indices are beyond theirs.
    Beyond(Vec<usize>),
}

/// All arcs of solutions within limits.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Arcs {
    /// The arcs.
    pub arcs: Vec<Arc>,
    /// The reason why there is no arc; `None` with arcs.
    pub absence: Option<Absence>,
    /// Whether arcs may be missing, or an arc is unsure. Closed curves that the grid misses are not detected.
    pub is_unsure: bool,
    /// Whether the solutions are a surface. The only arc is then one solution within limits, if one was found.
    pub is_surface: bool,
    /// The number of closed curves.
    pub closed: usize,
    /// Whether closed curves that reach no limit were searched by a grid of values of the given joint of the program only. A closed curve that is narrower than
    /// the grid may then be missing. This holds for all targets at present, except where solutions are a surface.
    pub is_grid_only: bool,
}

impl RedundantSolver {
    /// All maximal arcs of solutions of `target` within `limits`. Angles are within their limits; a revolute joint whose range is at least one turn ends no arc.
    /// No solution within limits is not an error ([`Arcs::absence`]): the reason is that of [`RedundantSolver::any_within`]. A solution that only this search
    /// finds is an arc of length zero, and unsure.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Unsupported`] if the target is on a stratum that could not be derived; [`crate::ErrorKind::Budget`] if the solver's work was bounded.
    pub fn arcs(&self, target: &ArmTarget, limits: &JointLimits) -> Result<Arcs> {
        let mut room = vec![runtime::Arc::NONE; ROOM];
        loop {
            let outcome = runtime::arcs(self, &target.row, &limits.rows, &mut room)
                .map_err(|error| self.refused(target, error))?;
            if outcome.count == 0 {
                return self.without_arcs(target, limits, &outcome);
            }
            if outcome.count <= room.len() {
                room.truncate(outcome.count);
                return Ok(Arcs {
                    arcs: room.iter().map(|arc| self.arc(arc)).collect(),
                    absence: None,
                    is_unsure: outcome.is_unsure,
                    is_surface: outcome.is_surface,
                    closed: outcome.closed,
                    is_grid_only: outcome.is_grid_only,
                });
            }
            room.resize(outcome.count, runtime::Arc::NONE);
        }
    }

    /// The result where no arc was found: the decision of [`RedundantSolver::any_within`]. If that finds a solution, this is an arc of length zero, and unsure.
    fn without_arcs(&self, target: &ArmTarget, limits: &JointLimits, outcome: &runtime::Outcome) -> Result<Arcs> {
        let found = self.any_found(target, limits)?;
        let mut arc = runtime::Arc::NONE;
        if let runtime::Within::Solution(q) = found {
            arc.start = runtime::End { q, joint: None, is_upper: false };
            (arc.end, arc.is_unsure) = (arc.start, true);
        }
        let within = self.within(&found);
        let arcs: Vec<Arc> = within.q.iter().map(|_| self.arc(&arc)).collect();
        Ok(Arcs {
            is_unsure: outcome.is_unsure || within.is_unsure || !arcs.is_empty(),
            arcs,
            absence: within.absence,
            is_surface: outcome.is_surface,
            closed: outcome.closed,
            is_grid_only: outcome.is_grid_only,
        })
    }

    /// Joint values at a distance `s` from the start of an arc, in the unit of [`Arc::length`]. `s` is limited to the arc. The arc must be one of this target
    /// and these limits. An angle whose range is at least one turn may differ by whole turns between neighbouring points.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] for limits that are not in order.
    pub fn at(&self, target: &ArmTarget, limits: &JointLimits, arc: &Arc, s: f64) -> Result<Vec<f64>> {
        let q = runtime::at(&self.arm, &target.row, &limits.rows, &arc.traced, s);
        Ok(self.values(&q.map_err(|error| self.refused(target, error))?))
    }

    /// Joint values at equal distances along an arc of this target and these limits, the ends included: `count` rows. The distances are equal within 1e-3
    /// of them. One row is the start of the arc.
    ///
    /// # Errors
    /// As [`RedundantSolver::at`].
    pub fn samples(&self, target: &ArmTarget, limits: &JointLimits, arc: &Arc, count: usize) -> Result<Vec<Vec<f64>>> {
        let mut out = vec![[0.0; runtime::MOST_JOINTS]; count];
        runtime::sample(&self.arm, &target.row, &limits.rows, &arc.traced, &mut out)
            .map_err(|error| self.refused(target, error))?;
        Ok(out.iter().map(|q| self.values(q)).collect())
    }

    fn arc(&self, traced: &runtime::Arc) -> Arc {
        let end = |end: &runtime::End| ArcEnd { q: self.values(&end.q), joint: end.joint, is_upper: end.is_upper };
        Arc {
            start: end(&traced.start),
            end: end(&traced.end),
            length: traced.length,
            is_closed: traced.is_closed,
            is_unsure: traced.is_unsure,
            traced: *traced,
        }
    }

    /// The values of the joints that the arm has.
    pub(super) fn values(&self, q: &runtime::Q) -> Vec<f64> {
        q[..self.joints.len()].to_vec()
    }

    /// The reason with the joints that are beyond limits, given as bits.
    pub(super) fn beyond(&self, joints: u32) -> Absence {
        Absence::Beyond((0..self.joints.len()).filter(|joint| joints >> joint & 1 == 1).collect())
    }
}

impl ArcEnd {
    /// A text such as `A3 at its lower limit`; empty without a joint at a limit. `names` are those of the joints.
    pub fn limit_text(&self, names: &[&str]) -> String {
        let Some(joint) = self.joint else { return String::new() };
        let name = names.get(joint).map_or_else(|| format!("joint {}", joint + 1), |name| (*name).to_owned());
        format!("{name} at its {} limit", if self.is_upper { "upper" } else { "lower" })
    }
}

impl Absence {
    /// A text such as `reachable, but beyond the limits of A2`. `names` are those of the joints.
    pub fn text(&self, names: &[&str]) -> String {
        let name =
            |joint: &usize| names.get(*joint).map_or_else(|| format!("joint {}", joint + 1), |name| (*name).to_owned());
        match self {
            Absence::Unreachable => "unreachable".to_owned(),
            Absence::Beyond(joints) if joints.is_empty() => "reachable, but only beyond limits".to_owned(),
            Absence::Beyond(joints) => {
                let names: Vec<String> = joints.iter().map(name).collect();
                format!("reachable, but beyond the limits of {}", names.join(", "))
            }
        }
    }
}

impl fmt::Display for Absence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text(&[]))
    }
}

/// One line, such as `joint 2 at its upper limit to joint 7 at its upper limit, length 0.190003`.
impl fmt::Display for Arc {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.is_closed, self.start.joint, self.end.joint) {
            (true, ..) => f.write_str("closed")?,
            (false, None, None) => f.write_str("ends not known")?,
            _ => write!(f, "{} to {}", self.start.limit_text(&[]), self.end.limit_text(&[]))?,
        }
        write!(f, ", length {:.6}", self.length)?;
        if self.is_unsure { f.write_str(", unsure") } else { Ok(()) }
    }
}

/// One line for each arc, or the reason why there is none.
impl fmt::Display for Arcs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.arcs.iter().try_for_each(|arc| writeln!(f, "{arc}"))?;
        self.absence.as_ref().map_or(Ok(()), |absence| writeln!(f, "no solution within limits: {absence}"))
    }
}
