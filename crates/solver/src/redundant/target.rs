//! A target of a redundant arm: [`ArmTarget`].

use groebot_runtime::Error as Refusal;
use groebot_runtime::redundant::{Members, Redundant, Target as Row};

use super::RedundantSolver;
use crate::MOST_SCANNED;
use crate::{Error, ErrorKind, Result};
use groebot_robot::kinematics::Target;

/// A target of a redundant arm, checked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArmTarget {
    pub(super) row: Row,
    /// The number of its numbers.
    count: usize,
}

impl ArmTarget {
    /// Its numbers in the order and the units of the inputs of the program, without the value of the given joint.
    pub fn numbers(&self) -> &[f64] {
        &self.row[..self.count]
    }
}

impl RedundantSolver {
    /// Checks a target of the task, in the base frame. Lengths are in the unit of the program.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a target of another task, for NaN and infinity, and for a rotation or a direction that is not one.
    pub fn target(&self, target: impl Into<Target>) -> Result<ArmTarget> {
        let given = [0.0; 1 + MOST_SCANNED];
        let numbers = self.main().numbers_of(&target.into(), &given[..=self.held.len()])?;
        self.target_of_numbers(&numbers[..self.numbers])
    }

    /// Checks a target with these numbers, in the order and the units of the inputs of the program. The value of the given joint is omitted, so that
    /// a pose has 12 numbers.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another number of values, for NaN and infinity, and for a rotation or a direction that is not one.
    pub fn target_of_numbers(&self, numbers: &[f64]) -> Result<ArmTarget> {
        if numbers.len() != self.numbers {
            let text = format!("{} numbers given, {} expected", numbers.len(), self.numbers);
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let mut row = [0.0; 12];
        row[..numbers.len()].copy_from_slice(numbers);
        let target = ArmTarget { row, count: numbers.len() };
        let mut members = Members::NONE;
        match self.solve_given(&row, self.arm.scanned, 0.0, &mut members) {
            Err(error @ (Refusal::NotFinite | Refusal::NotRotation | Refusal::NotUnit)) => {
                Err(self.refused(&target, error))
            }
            _ => Ok(target),
        }
    }

    /// The error for a target that the run time refuses.
    pub(super) fn refused(&self, target: &ArmTarget, error: Refusal) -> Error {
        let (inputs, count) = self.inputs(&target.row, 0.0);
        self.main().refused(&inputs[..count], error)
    }
}
