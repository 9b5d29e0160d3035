//! What inverse dynamics changes by.

use nalgebra::DMatrix;

use super::{Equations, State, Workspace};
use crate::Result;
use crate::dynamics::recursions::Motion;

impl Equations {
    /// What the torques of a motion change by: with the configuration, the velocity and the acceleration (the inertia matrix), each freedoms x freedoms. The place of
    /// a floating base changes along motions in its own frame. Of Coulomb friction, whose sign alone changes, nothing is counted; nothing acts from outside.
    ///
    /// # Errors
    /// As [`Equations::inverse`].
    pub fn derivatives<'r>(
        &self,
        room: &'r mut Workspace,
        state: State<'_>,
        acceleration: &[f64],
    ) -> Result<&'r [DMatrix<f64>; 3]> {
        self.check(state, Some(("acceleration", acceleration)))?;
        self.prepare(room, state, Some(acceleration));
        let Workspace { data, rates, accelerations, torques, base, pull, full_derivatives: full, derivatives, .. } =
            room;
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
        Ok(&room.derivatives)
    }
}
