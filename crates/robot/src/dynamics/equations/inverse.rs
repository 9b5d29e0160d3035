//! Inverse dynamics: torques of a motion, of gravity, and as a matrix times what bodies weigh.

use nalgebra::{DMatrix, DVector};

use super::{Base, Equations, State, Workspace};
use crate::Result;
use crate::dynamics::exact::NUMBERS;
use crate::dynamics::recursions::Motion;
use crate::spatial::Wrench;

impl Equations {
    /// Inverse dynamics: the torques (of a floating base first its force and moment, in its own frame) that a motion asks for, friction and rotors
    /// included, less what acts from outside.
    ///
    /// # Errors
    /// [`BadValue`](crate::ErrorKind::BadValue) for a wrong count of numbers, one that is not finite, a quaternion whose length is not one within 1e-3, or a link that is not there.
    pub fn inverse<'r>(
        &self,
        room: &'r mut Workspace,
        state: State<'_>,
        acceleration: &[f64],
    ) -> Result<&'r DVector<f64>> {
        self.check(state, Some(("acceleration", acceleration)))?;
        self.prepare(room, state, Some(acceleration));
        self.newton_euler(room);
        self.add_drives(room);
        Ok(&room.forces)
    }

    /// What the torques are without any acceleration, `C q' + N + friction`, less what acts from outside.
    ///
    /// # Errors
    /// As [`Equations::inverse`].
    pub fn bias<'r>(&self, room: &'r mut Workspace, state: State<'_>) -> Result<&'r DVector<f64>> {
        self.check(state, None)?;
        self.prepare(room, state, None);
        self.newton_euler(room);
        self.add_drives(room);
        Ok(&room.forces)
    }

    /// The torques that hold the robot against gravity where it stands, `N`.
    ///
    /// # Errors
    /// As [`Equations::inverse`].
    pub fn gravity<'r>(&self, room: &'r mut Workspace, q: &[f64]) -> Result<&'r DVector<f64>> {
        self.check_place(q)?;
        self.prepare_still(room, q);
        self.newton_euler(room);
        Ok(&room.forces)
    }

    /// What the base feels of a motion: the force and the moment, about its origin and in its own frame, that move all bodies and hold them against gravity. Of a robot that
    /// stands on the ground it is what the ground gives.
    ///
    /// # Errors
    /// As [`Equations::inverse`].
    pub fn base_wrench(&self, room: &mut Workspace, state: State<'_>, acceleration: &[f64]) -> Result<Wrench> {
        self.check(state, Some(("acceleration", acceleration)))?;
        self.prepare(room, state, Some(acceleration));
        let Workspace { data, rates, accelerations, torques, base, outside, .. } = room;
        let motion = Motion { base: base[0], base_acceleration: base[1], rates, accelerations };
        let force = data.inverse(&self.tree, &motion, outside, torques);
        Ok(force.into())
    }

    /// The regressor `Y`: without rotors, friction and what acts from outside the torques are `Y` times what the bodies weigh. Rows are freedoms; each body, that of
    /// a floating base first, has ten columns: its mass, the mass times its centre (x, y, z), and its inertia tensor xx, xy, yy, xz, yz, zz about the origin, all in the
    /// frame of the link behind its joint, with what is fixed to that. [`Equations::parameters`] tells them.
    ///
    /// # Errors
    /// As [`Equations::inverse`].
    pub fn regressor<'r>(
        &self,
        room: &'r mut Workspace,
        state: State<'_>,
        acceleration: &[f64],
    ) -> Result<&'r DMatrix<f64>> {
        self.check(state, Some(("acceleration", acceleration)))?;
        self.prepare(room, state, Some(acceleration));
        let first = self.first();
        let Workspace { data, rates, accelerations, torques, base, links, full_regressor, regressor, .. } = room;
        let motion = Motion { base: base[0], base_acceleration: base[1], rates, accelerations };
        data.regressor(&self.tree, &motion, links, torques, first, full_regressor);
        regressor.fill(0.0);
        for (row, entries) in full_regressor.chunks_exact(regressor.ncols()).enumerate() {
            let (at, factor) = self.freedom(row);
            entries.iter().enumerate().for_each(|(column, entry)| regressor[(at, column)] += factor * entry);
        }
        Ok(&room.regressor)
    }

    /// What the bodies weigh, as the columns of the regressor ask for.
    pub fn parameters(&self) -> Vec<f64> {
        let bodies = self.tree.bodies.iter().map(|body| &body.mass);
        let base = (self.base == Base::Floating).then_some(&self.tree.base);
        let told_in = if base.is_some() { &self.told_in } else { &self.told_in[1..] };
        let told = |(mass, link): (&crate::dynamics::Mass<f64>, &usize)| mass.inward(&self.frames[*link].1).numbers();
        base.into_iter().chain(bodies).zip(told_in).flat_map(told).collect()
    }

    /// The names of what the bodies weigh: that of the link, and which of ten numbers.
    pub fn parameter_names(&self) -> Vec<String> {
        let told = if self.base == Base::Floating { &self.told_names } else { &self.told_names[1..] };
        told.iter().flat_map(|link| NUMBERS.map(|number| format!("{link}.{number}"))).collect()
    }

    /// Adds what rotors and friction ask for.
    fn add_drives(&self, room: &mut Workspace) {
        for (joint, drive) in self.drives.iter().enumerate() {
            let own = drive.armature * room.accelerations[joint] + drive.friction(room.rates[joint]);
            room.forces[self.first() + drive.freedom] += drive.factor * own;
        }
    }
}
