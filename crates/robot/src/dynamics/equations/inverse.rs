//! Inverse dynamics (RNEA): torques of a motion, gravity torques, and the regressor.

use nalgebra::{DMatrix, DVector};

use super::{Base, Equations, State, Workspace};
use crate::Result;
use crate::dynamics::exact::NUMBERS;
use crate::dynamics::recursions::{Motion, Regressor};
use crate::spatial::Wrench;

impl Equations {
    /// Inverse dynamics by the recursive Newton-Euler algorithm (RNEA): computes the torques of a motion with friction
    /// and rotors, minus external wrenches. For a floating base, the first six entries are its force and moment in its
    /// own frame.
    ///
    /// # Errors
    /// [`BadValue`](crate::ErrorKind::BadValue) for a wrong number of entries, an entry that is not finite, a
    /// quaternion whose length differs from one by more than 1e-3, or a link that does not exist.
    pub fn inverse<'r>(
        &self,
        workspace: &'r mut Workspace,
        state: State<'_>,
        acceleration: &[f64],
    ) -> Result<&'r DVector<f64>> {
        self.check(state, Some(("acceleration", acceleration)))?;
        self.prepare(workspace, state, Some(acceleration));
        self.newton_euler(workspace);
        self.add_drives(workspace);
        Ok(&workspace.forces)
    }

    /// Computes the bias torques, without acceleration: `C q' + N + friction`, minus external wrenches.
    ///
    /// # Errors
    /// Those of [`Equations::inverse`].
    pub fn bias<'r>(&self, workspace: &'r mut Workspace, state: State<'_>) -> Result<&'r DVector<f64>> {
        self.check(state, None)?;
        self.prepare(workspace, state, None);
        self.newton_euler(workspace);
        self.add_drives(workspace);
        Ok(&workspace.forces)
    }

    /// Computes the gravity torques `N` at the configuration `q`.
    ///
    /// # Errors
    /// Those of [`Equations::inverse`].
    pub fn gravity<'r>(&self, workspace: &'r mut Workspace, q: &[f64]) -> Result<&'r DVector<f64>> {
        self.check_place(q)?;
        self.prepare_still(workspace, q);
        self.newton_euler(workspace);
        Ok(&workspace.forces)
    }

    /// Computes the wrench on the base for a motion: the force and the moment about its origin, in its own frame, that
    /// move all bodies against gravity. For a robot on the ground it is the ground reaction wrench.
    ///
    /// # Errors
    /// Those of [`Equations::inverse`].
    pub fn base_wrench(&self, workspace: &mut Workspace, state: State<'_>, acceleration: &[f64]) -> Result<Wrench> {
        self.check(state, Some(("acceleration", acceleration)))?;
        self.prepare(workspace, state, Some(acceleration));
        let Workspace { data, rates, accelerations, torques, base, outside, .. } = workspace;
        let motion = Motion { base: base[0], base_acceleration: base[1], rates, accelerations };
        let force = data.inverse(&self.tree, &motion, outside, torques);
        Ok(force.into())
    }

    /// Computes the regressor `Y`: without rotors, friction and external wrenches, the torques are `Y` times the
    /// inertial parameters. Rows are degrees of freedom. Each body, a floating base first, has ten columns: its mass,
    /// the first moments (x, y, z), and its inertia tensor xx, xy, yy, xz, yz, zz about the origin. They are in the
    /// frame of the joint's child link, and include links fixed to it. [`Equations::parameters`] returns them.
    ///
    /// # Errors
    /// Those of [`Equations::inverse`].
    pub fn regressor<'r>(
        &self,
        workspace: &'r mut Workspace,
        state: State<'_>,
        acceleration: &[f64],
    ) -> Result<&'r DMatrix<f64>> {
        self.check(state, Some(("acceleration", acceleration)))?;
        self.prepare(workspace, state, Some(acceleration));
        let first = self.first();
        let Workspace { data, rates, accelerations, torques, base, links, full_regressor, regressor, .. } = workspace;
        let motion = Motion { base: base[0], base_acceleration: base[1], rates, accelerations };
        data.regressor(&self.tree, &motion, links, Regressor { torques, first, rows: full_regressor });
        regressor.fill(0.0);
        for (row, entries) in full_regressor.chunks_exact(regressor.ncols()).enumerate() {
            let (at, factor) = self.freedom(row);
            entries.iter().enumerate().for_each(|(column, entry)| regressor[(at, column)] += factor * entry);
        }
        Ok(&workspace.regressor)
    }

    /// The inertial parameters of the bodies, in the order of the regressor's columns.
    pub fn parameters(&self) -> Vec<f64> {
        let bodies = self.tree.bodies.iter().map(|body| &body.mass);
        let base = (self.base == Base::Floating).then_some(&self.tree.base);
        let parameter_links = if base.is_some() { &self.parameter_links } else { &self.parameter_links[1..] };
        let numbers_of =
            |(mass, link): (&crate::dynamics::Mass<f64>, &usize)| mass.inward(&self.frames[*link].1).numbers();
        base.into_iter().chain(bodies).zip(parameter_links).flat_map(numbers_of).collect()
    }

    /// The names of the inertial parameters: the link, and which of ten parameters.
    pub fn parameter_names(&self) -> Vec<String> {
        let links =
            if self.base == Base::Floating { &self.parameter_link_names } else { &self.parameter_link_names[1..] };
        links.iter().flat_map(|link| NUMBERS.map(|number| format!("{link}.{number}"))).collect()
    }

    /// Adds the torques of rotors and friction.
    fn add_drives(&self, workspace: &mut Workspace) {
        for (joint, drive) in self.drives.iter().enumerate() {
            let own = drive.armature * workspace.accelerations[joint] + drive.friction(workspace.rates[joint]);
            workspace.forces[self.first() + drive.freedom] += drive.factor * own;
        }
    }
}
