//! Forward dynamics: the accelerations that joint torques cause.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::{Base, Equations, State, Workspace};
use crate::dynamics::recursions::{self, Cause, Massless, Six};
use crate::{Error, ErrorKind, Result};

/// Threshold for an inertia along a degree of freedom that is zero up to rounding, relative to the inertia in all
/// directions. An example is a point mass on the axis of its joint.
const NO_INERTIA: f64 = 1e-13;

fn is_inertia(pivot: &f64, size: &f64) -> bool {
    *pivot > NO_INERTIA * size
}

/// The first degree of freedom that moves no mass, from the Cholesky factor of the inertia matrix.
fn massless_row(factors: &Cholesky<f64, Dyn>) -> Option<usize> {
    let lower = factors.l_dirty();
    let size = |row: usize| (0..=row).map(|column| lower[(row, column)].powi(2)).sum::<f64>();
    (0..lower.nrows()).find(|&row| !is_inertia(&lower[(row, row)].powi(2), &size(row)))
}

impl Equations {
    /// Forward dynamics: computes the accelerations for given joint torques and external wrenches. For a floating base,
    /// the first six torques are a force and a moment on it, in its own frame.
    ///
    /// # Errors
    /// Those of [`Equations::inverse`], and an error for a degree of freedom that moves no mass, with the names of the
    /// link and its joint.
    pub fn forward<'r>(
        &self,
        workspace: &'r mut Workspace,
        state: State<'_>,
        torques: &[f64],
    ) -> Result<&'r DVector<f64>> {
        self.check(state, Some(("torques", torques)))?;
        if self.is_plain {
            self.forward_by_bodies(workspace, state, torques)?;
        } else {
            self.forward_by_inertia(workspace, state, torques)?;
        }
        Ok(&workspace.changes)
    }

    /// Articulated-body algorithm (ABA), when no joint is a mimic joint.
    fn forward_by_bodies(&self, workspace: &mut Workspace, state: State<'_>, torques: &[f64]) -> Result<()> {
        let first = self.first();
        self.prepare(workspace, state, None);
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
        } = workspace;
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

    /// Solution with the inertia matrix, when there are mimic joints.
    fn forward_by_inertia(&self, workspace: &mut Workspace, state: State<'_>, torques: &[f64]) -> Result<()> {
        self.bias(workspace, state)?;
        let missing = torques.iter().zip(&workspace.forces).map(|(torque, bias)| torque - bias);
        workspace.changes.iter_mut().zip(missing).for_each(|(change, missing)| *change = missing);
        self.inertia(workspace, state.q)?;
        // The factors use the memory of the matrix, so nothing is allocated.
        let inertia = std::mem::replace(&mut workspace.inertia, DMatrix::zeros(0, 0));
        match Cholesky::<f64, Dyn>::new(inertia).filter(|factors| massless_row(factors).is_none()) {
            Some(factors) => {
                factors.solve_mut(&mut workspace.changes);
                workspace.inertia = factors.unpack_dirty();
                Ok(())
            }
            None => {
                workspace.inertia = DMatrix::zeros(self.freedoms(), self.freedoms());
                let inertia = self.inertia(workspace, state.q)?;
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
                "link `{}` of joint `{}` and the links that it carries have no mass that the joint moves, so the acceleration is infinite; give masses",
                self.links[joint], self.names[joint]
            ),
            None => "the base and the links that it carries have no mass; give masses".to_owned(),
        };
        Error::new(ErrorKind::BadValue, text)
    }
}
