//! Arcs and solutions that differ by whole turns: [`Turns`].

use groebot_runtime::redundant as runtime;

use super::{Arc, ArmTarget, JointLimits, RedundantSolver};
use crate::{Error, ErrorKind, Result};

/// The arcs, or the solutions, within limits that differ by whole turns of angles. Only a joint with a range of more than one turn has several turns.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Turns {
    /// The starts of the arcs: joint values, in rad or the length unit of the program.
    pub starts: Vec<Vec<f64>>,
    /// The least value of each joint along the first arc, continuous from its start.
    pub low: Vec<f64>,
    /// The greatest value of each joint along the first arc.
    pub high: Vec<f64>,
}

impl RedundantSolver {
    /// The maximum number of turns that are listed.
    const MOST_TURNS: usize = 10_000;

    /// All arcs within `limits` that differ from `arc` by whole turns, itself included. Along each of them, joint values are continuous and within limits. None
    /// if the arc passes the limits of a joint with a range of a turn or more: its values within limits then jump by a whole turn.
    ///
    /// # Errors
    /// As [`RedundantSolver::at`]; [`ErrorKind::Budget`] for more than 10,000 turns.
    pub fn arc_turns(&self, target: &ArmTarget, limits: &JointLimits, arc: &Arc) -> Result<Turns> {
        let span = runtime::Span::along(&self.arm, &target.row, &limits.rows, &arc.traced);
        self.turns_in(limits, &span.map_err(|error| self.refused(target, error))?)
    }

    /// All joint values within `limits` that differ from `q` by whole turns. None if no turn of a joint is within its limits.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a wrong number of values or NaN; [`ErrorKind::Budget`] for more than 10,000 turns.
    pub fn turns(&self, limits: &JointLimits, q: &[f64]) -> Result<Turns> {
        let mut row = [0.0; runtime::MOST_JOINTS];
        row[..self.joints.len()].copy_from_slice(self.joint_values(q)?);
        self.turns_in(limits, &runtime::Span::of(&row))
    }

    fn turns_in(&self, limits: &JointLimits, span: &runtime::Span) -> Result<Turns> {
        let count = span.count_turns(&self.arm, &limits.rows);
        if count > Self::MOST_TURNS {
            let text = format!(
                "{count} combinations of whole turns are within limits; at most {} are listed",
                Self::MOST_TURNS
            );
            return Err(Error::new(ErrorKind::Budget, text));
        }
        let starts: Vec<_> = (0..count).map(|index| self.values(&span.turn(&self.arm, &limits.rows, index))).collect();
        let first = starts.first().cloned().unwrap_or_else(|| self.values(&span.start));
        let moved = |values: &runtime::Q| -> Vec<f64> {
            (0..first.len()).map(|joint| values[joint] + (first[joint] - span.start[joint])).collect()
        };
        Ok(Turns { low: moved(&span.low), high: moved(&span.high), starts })
    }

    /// Same as [`RedundantSolver::samples`], but joint values are continuous along the arc from `start`, one of [`Turns::starts`].
    ///
    /// # Errors
    /// As [`RedundantSolver::at`]; [`ErrorKind::BadValue`] for a wrong number of values or NaN.
    pub fn samples_from(
        &self,
        target: &ArmTarget,
        limits: &JointLimits,
        (arc, start): (&Arc, &[f64]),
        count: usize,
    ) -> Result<Vec<Vec<f64>>> {
        let mut row = [0.0; runtime::MOST_JOINTS];
        row[..self.joints.len()].copy_from_slice(self.joint_values(start)?);
        let mut out = vec![[0.0; runtime::MOST_JOINTS]; count];
        runtime::sample_from(&self.arm, &target.row, &limits.rows, (&arc.traced, &row), &mut out)
            .map_err(|error| self.refused(target, error))?;
        Ok(out.iter().map(|q| self.values(q)).collect())
    }
}
