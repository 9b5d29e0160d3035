//! Derivatives of inverse dynamics.

use nalgebra::DMatrix;

use super::{Equations, State, Workspace};
use crate::Result;
use crate::dynamics::recursions::Motion;

impl Equations {
    /// Computes the partial derivatives of the joint torques by the configuration, the velocity and the acceleration
    /// (the inertia matrix). Each matrix is n x n for n degrees of freedom. The pose of a floating base is
    /// differentiated along twists in its own frame. Coulomb friction has derivative zero, and external wrenches are
    /// not supported.
    ///
    /// # Errors
    /// Those of [`Equations::inverse`].
    pub fn derivatives<'r>(
        &self,
        workspace: &'r mut Workspace,
        state: State<'_>,
        acceleration: &[f64],
    ) -> Result<&'r [DMatrix<f64>; 3]> {
        self.check(state, Some(("acceleration", acceleration)))?;
        self.prepare(workspace, state, Some(acceleration));
        let Workspace { data, rates, accelerations, torques, base, pull, full_derivatives: full, derivatives, .. } =
            workspace;
        let motion = Motion { base: base[0], base_acceleration: base[1], rates, accelerations };
        data.derivatives(&self.tree, &motion, pull, torques, full);
        for (all, into) in
            [&full.by_q, &full.by_velocity, &full.by_acceleration].into_iter().zip(derivatives.iter_mut())
        {
            self.gather(all, full.size, into);
        }
        let [_, by_velocity, by_acceleration] = derivatives;
        self.add_rotors(by_acceleration);
        for drive in &self.drives {
            let at = self.first() + drive.freedom;
            by_velocity[(at, at)] += drive.factor * drive.factor * drive.damping;
        }
        Ok(&workspace.derivatives)
    }
}
