//! Forward dynamics: what torques change the velocity by.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::{Base, Equations, State, Workspace};
use crate::dynamics::recursions::{self, Cause, Massless, Six};
use crate::{Error, ErrorKind, Result};

/// What rounding leaves of no inertia along a freedom, as a share of that in all directions: a point mass on the axis of its joint.
const NO_INERTIA: f64 = 1e-13;

fn is_inertia(pivot: &f64, size: &f64) -> bool {
    *pivot > NO_INERTIA * size
}

/// The first freedom that moves no mass, by the factors of the inertia matrix.
fn massless_row(factors: &Cholesky<f64, Dyn>) -> Option<usize> {
    let lower = factors.l_dirty();
    let size = |row: usize| (0..=row).map(|column| lower[(row, column)].powi(2)).sum::<f64>();
    (0..lower.nrows()).find(|&row| !is_inertia(&lower[(row, row)].powi(2), &size(row)))
}

impl Equations {
    /// Forward dynamics: what torques (of a floating base first a force and a moment on it, in its own frame), and what acts from outside, change the velocity by.
    ///
    /// # Errors
    /// As [`Equations::inverse`], and where bodies without mass would have to move, with the names of the link and its joint.
    pub fn forward<'r>(&self, room: &'r mut Workspace, state: State<'_>, torques: &[f64]) -> Result<&'r DVector<f64>> {
        self.check(state, Some(("torques", torques)))?;
        if self.is_plain {
            self.forward_by_bodies(room, state, torques)?;
        } else {
            self.forward_by_inertia(room, state, torques)?;
        }
        Ok(&room.changes)
    }

    /// By articulated bodies, where each joint is on its own.
    fn forward_by_bodies(&self, room: &mut Workspace, state: State<'_>, torques: &[f64]) -> Result<()> {
        let first = self.first();
        self.prepare(room, state, None);
        let Workspace {
            data,
            articulation,
            rates,
            accelerations,
            torques: own,
            rotors,
            base,
            pull,
            outside,
            changes,
            ..
        } = room;
        for (joint, drive) in self.drives.iter().enumerate() {
            let left = torques[first + joint] - drive.friction(rates[joint]);
            (own[joint], rotors[joint]) = (left, drive.armature);
        }
        let base_cause = match self.base {
            Base::Fixed => Cause::Acceleration(*pull),
            Base::Floating => Cause::Force(Six::of(torques)),
        };
        let moving = recursions::Drive { base: base[0], base_cause, rates, torques: own, rotors, outside };
        let found = articulation.forward(&self.tree, data, &moving, is_inertia, accelerations);
        let of_base = found.map_err(|Massless(joint)| self.massless(joint))?;
        (0..first).for_each(|at| changes[at] = of_base.at(at) - pull.at(at));
        changes.rows_mut(first, accelerations.len()).copy_from_slice(accelerations);
        Ok(())
    }

    /// By the inertia matrix, where joints follow others.
    fn forward_by_inertia(&self, room: &mut Workspace, state: State<'_>, torques: &[f64]) -> Result<()> {
        self.bias(room, state)?;
        let missing = torques.iter().zip(&room.forces).map(|(torque, bias)| torque - bias);
        room.changes.iter_mut().zip(missing).for_each(|(change, missing)| *change = missing);
        self.inertia(room, state.q)?;
        // The factors take the matrix's place, so that nothing is allocated.
        let inertia = std::mem::replace(&mut room.inertia, DMatrix::zeros(0, 0));
        match Cholesky::<f64, Dyn>::new(inertia).filter(|factors| massless_row(factors).is_none()) {
            Some(factors) => {
                factors.solve_mut(&mut room.changes);
                room.inertia = factors.unpack_dirty();
                Ok(())
            }
            None => {
                room.inertia = DMatrix::zeros(self.freedoms(), self.freedoms());
                let inertia = self.inertia(room, state.q)?;
                let block = |at: usize| inertia.view((0, 0), (at + 1, at + 1)).into_owned();
                let is_massless =
                    |at: usize| block(at).cholesky().is_none_or(|factors| massless_row(&factors).is_some());
                let massless = (0..inertia.nrows()).find(|at| is_massless(*at));
                Err(self.massless(massless.and_then(|at| at.checked_sub(self.first()))))
            }
        }
    }

    fn massless(&self, joint: Option<usize>) -> Error {
        let text = match joint {
            Some(joint) => format!(
                "link `{}` behind joint `{}` and what it carries have no mass that the joint moves, and torques would move it without limit; give masses",
                self.links[joint], self.names[joint]
            ),
            None => "the base and what it carries have no mass that torques move; give masses".to_owned(),
        };
        Error::new(ErrorKind::BadValue, text)
    }
}
