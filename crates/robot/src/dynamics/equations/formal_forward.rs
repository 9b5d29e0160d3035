//! Forward dynamics over any scalar type.

use super::formal::{Formal, FormalDrive, FormalState, pull};
use crate::dynamics::recursions::{ArticulatedBodies, Cause, Divisible, Drive, Six};
use crate::{Error, ErrorKind, Result};

impl<S: Divisible + PartialEq> Formal<S> {
    /// Whether each joint is a degree of freedom of its own: no mimic joints.
    pub fn is_plain(&self) -> bool {
        let leads = |(at, drive): (usize, &FormalDrive<S>)| drive.freedom == at && drive.factor == S::one();
        self.drives.iter().enumerate().all(leads)
    }

    /// Forward dynamics: by the articulated-body algorithm (ABA), or by the inertia matrix if there are mimic joints.
    /// Returns the accelerations.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a degree of freedom that moves no mass.
    pub fn forward(&self, state: &FormalState<S>, torques: &[S]) -> Result<Vec<S>> {
        if self.is_plain() { self.forward_by_bodies(state, torques) } else { self.forward_by_inertia(state, torques) }
    }

    fn forward_by_bodies(&self, state: &FormalState<S>, torques: &[S]) -> Result<Vec<S>> {
        let (mut data, moving) = (self.data(state), self.moving(&state.velocity));
        let pull = pull(&self.gravity, state.turn.as_ref());
        let base_cause = match self.first {
            0 => Cause::Acceleration(pull.clone()),
            _ => Cause::Force(Six::of(torques)),
        };
        let rotors: Vec<S> = self.drives.iter().map(|drive| drive.armature.clone()).collect();
        let drive = Drive {
            base: moving.base,
            base_cause,
            rates: &moving.rates,
            torques: &torques[self.first..],
            rotors: &rotors,
            outside: &[],
        };
        let mut changes = vec![S::zero(); self.drives.len()];
        let found = ArticulatedBodies::new(&self.tree)
            .forward(&self.tree, &mut data, &drive, |pivot, _| *pivot != S::zero(), &mut changes)
            .map_err(|_| massless())?;
        let base = (0..self.first).map(|at| found.at(at).clone() - pull.at(at).clone());
        Ok(base.chain(changes).collect())
    }

    /// Solves `M q'' = torques - C q' - N`.
    fn forward_by_inertia(&self, state: &FormalState<S>, torques: &[S]) -> Result<Vec<S>> {
        let bias = self.newton_euler(state, &vec![S::zero(); self.freedoms]);
        let missing = torques.iter().zip(bias).map(|(torque, bias)| torque.clone() - bias).collect();
        solve(self.inertia(state), missing).ok_or_else(massless)
    }
}

fn massless() -> Error {
    Error::new(ErrorKind::BadValue, "bodies without mass would have to move; give masses")
}

/// Solves a symmetric positive definite system by `L D L'` factorization without pivoting. The matrix is in row-major
/// order. `None` when a pivot is zero.
fn solve<S: Divisible + PartialEq>(mut matrix: Vec<S>, mut right: Vec<S>) -> Option<Vec<S>> {
    let count = right.len();
    for k in 0..count {
        let pivot = matrix[k * count + k].clone();
        if pivot == S::zero() {
            return None;
        }
        for i in k + 1..count {
            // The upper triangle becomes D L'.
            let factor = matrix[k * count + i].clone() / pivot.clone();
            for j in i..count {
                let less = factor.clone() * matrix[k * count + j].clone();
                matrix[i * count + j] = matrix[i * count + j].clone() - less;
            }
            right[i] = right[i].clone() - factor * right[k].clone();
        }
    }
    for k in (0..count).rev() {
        let known =
            (k + 1..count).fold(right[k].clone(), |sum, j| sum - matrix[k * count + j].clone() * right[j].clone());
        right[k] = known / matrix[k * count + k].clone();
    }
    Some(right)
}
