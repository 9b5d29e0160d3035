//! Inertia matrix, Coriolis matrix, energy, momentum and Jacobians of a state.

use nalgebra::{DMatrix, Isometry3, Matrix6xX, Point3, UnitQuaternion, Vector3};

use super::{Equations, State, Workspace};
use crate::dynamics::Momentum;
use crate::dynamics::recursions::{Energy, Frame, Six};
use crate::{Error, ErrorKind, Result};

impl Equations {
    /// Computes the inertia matrix with rotors, n x n, by the composite-rigid-body algorithm (CRBA).
    ///
    /// # Errors
    /// Those of [`Equations::inverse`].
    pub fn inertia<'r>(&self, workspace: &'r mut Workspace, q: &[f64]) -> Result<&'r DMatrix<f64>> {
        self.check_place(q)?;
        self.prepare_still(workspace, q);
        workspace.data.inertia(&self.tree, &mut workspace.full);
        self.gather_symmetric(&workspace.full.inertia, workspace.full.size, &mut workspace.inertia);
        self.add_rotors(&mut workspace.inertia);
        Ok(&workspace.inertia)
    }

    /// Computes the Coriolis matrix with Christoffel symbols, n x n, RH0 (2-42): `M' - 2 C` is skew-symmetric.
    ///
    /// # Errors
    /// Those of [`Equations::inverse`].
    pub fn coriolis<'r>(&self, workspace: &'r mut Workspace, state: State<'_>) -> Result<&'r DMatrix<f64>> {
        self.matrices(workspace, state).map(|[_, coriolis]| coriolis)
    }

    /// Computes the inertia and the Coriolis matrix together.
    ///
    /// # Errors
    /// Those of [`Equations::inverse`].
    pub fn matrices<'r>(&self, workspace: &'r mut Workspace, state: State<'_>) -> Result<[&'r DMatrix<f64>; 2]> {
        self.check(state, None)?;
        self.prepare(workspace, state, None);
        workspace.data.matrices(&self.tree, &workspace.base[0], &workspace.rates, &mut workspace.full);
        self.gather_symmetric(&workspace.full.inertia, workspace.full.size, &mut workspace.inertia);
        self.gather(&workspace.full.coriolis, workspace.full.size, &mut workspace.coriolis);
        self.add_rotors(&mut workspace.inertia);
        Ok([&workspace.inertia, &workspace.coriolis])
    }

    /// Computes the energy \[J\], including the kinetic energy of rotors. The potential energy is zero where the centre
    /// of mass is as high as the origin of the fixed base, or of the world.
    ///
    /// # Errors
    /// Those of [`Equations::inverse`].
    pub fn energy(&self, workspace: &mut Workspace, state: State<'_>) -> Result<Energy<f64>> {
        self.check(state, None)?;
        self.prepare(workspace, state, None);
        let gravity = workspace.pull.linear.map(|x| -x);
        let Energy { mut kinetic, mut potential } =
            workspace.data.energy(&self.tree, &workspace.base[0], &workspace.rates, &gravity);
        let rotors = self.drives.iter().zip(&workspace.rates).map(|(drive, rate)| 0.5 * drive.armature * rate * rate);
        kinetic += rotors.sum::<f64>();
        potential -= workspace.data.whole(&self.tree).mass * self.gravity.dot(&self.root_position(state.q));
        Ok(Energy { kinetic, potential })
    }

    /// Computes the centre of mass in the world frame \[m\]; for a fixed base, in its frame.
    ///
    /// # Errors
    /// Those of [`Equations::inverse`], and an error for a robot without mass.
    pub fn centre_of_mass(&self, workspace: &mut Workspace, q: &[f64]) -> Result<Point3<f64>> {
        self.check_place(q)?;
        self.prepare_still(workspace, q);
        let whole = workspace.data.whole(&self.tree);
        if whole.mass <= 0.0 {
            return Err(Error::new(
                ErrorKind::BadValue,
                "the robot has no mass, and so no centre of mass; give masses",
            ));
        }
        let centre = Point3::from(Vector3::from(whole.moment) / whole.mass);
        Ok(self.world_from_root(q) * centre)
    }

    /// Computes the momentum of all bodies in the world frame about its origin; for a fixed base, in its frame.
    /// [`Momentum::about`] the centre of mass gives the centroidal momentum.
    ///
    /// # Errors
    /// Those of [`Equations::inverse`].
    pub fn momentum(&self, workspace: &mut Workspace, state: State<'_>) -> Result<Momentum> {
        self.check(state, None)?;
        self.prepare(workspace, state, None);
        let own = workspace.data.momentum(&self.tree, &workspace.base[0], &workspace.rates);
        let [linear, angular] = self.turned_to_world(state.q, &own);
        Ok(Momentum { linear, angular: angular + self.root_position(state.q).cross(&linear) })
    }

    /// Computes the centroidal momentum matrix, 6 x n. Multiplied by the velocity, it gives the linear momentum in the
    /// world frame and the angular momentum about the centre of mass (D. E. Orin, A. Goswami and S.-H. Lee, Autonomous
    /// Robots 35, 2013).
    ///
    /// # Errors
    /// Those of [`Equations::centre_of_mass`].
    pub fn centroidal<'r>(&self, workspace: &'r mut Workspace, q: &[f64]) -> Result<&'r Matrix6xX<f64>> {
        let centre = self.centre_of_mass(workspace, q)? - self.root_position(q);
        workspace.data.momenta(&self.tree, self.first(), &mut workspace.momenta);
        workspace.jacobian[0].fill(0.0);
        for (at, own) in workspace.momenta.iter().enumerate() {
            let (freedom, factor) = self.freedom(at);
            let [linear, angular] = self.turned_to_world(q, own);
            let about = angular - centre.coords.cross(&linear);
            for i in 0..3 {
                workspace.jacobian[0][(i, freedom)] += factor * linear[i];
                workspace.jacobian[0][(3 + i, freedom)] += factor * about[i];
            }
        }
        Ok(&workspace.jacobian[0])
    }

    /// Computes the Jacobian `J` of a link and its time derivative `J'`, 6 x n each. `link` is its index in the robot.
    /// `J` times the velocity is the velocity of the link's origin and its angular velocity, along the axes of the
    /// world frame; for a fixed base, of its frame. Their derivatives are `J q'' + J' q'`.
    ///
    /// # Errors
    /// Those of [`Equations::inverse`].
    pub fn jacobian<'r>(
        &self,
        workspace: &'r mut Workspace,
        state: State<'_>,
        link: usize,
    ) -> Result<[&'r Matrix6xX<f64>; 2]> {
        self.check(state, None)?;
        self.check_link(link)?;
        self.prepare(workspace, state, None);
        let (joint, frame) = &self.frames[link];
        workspace.columns.fill([Six::zero(); 2]);
        let moving = (&workspace.base[0], &workspace.rates[..]);
        let own = workspace.data.jacobian(&self.tree, moving, (*joint, frame), self.first(), &mut workspace.columns);
        let world_from_link =
            self.world_from_root(state.q).rotation * rotation(&workspace.data.pose_in_base(&self.tree, *joint, frame));
        let turning = Vector3::from(own.angular);
        workspace.jacobian.iter_mut().for_each(|matrix| matrix.fill(0.0));
        for (at, [column, change]) in workspace.columns.iter().enumerate() {
            let (freedom, factor) = self.freedom(at);
            for (part, start) in [(0, 0), (1, 3)] {
                let of = |six: &Six<f64>| Vector3::from(if part == 0 { six.linear } else { six.angular });
                let fixed = of(column);
                // Conversion to the axes of the world frame adds the rotation of the link's frame.
                let rates = [fixed, of(change) + turning.cross(&fixed)];
                for (matrix, rate) in workspace.jacobian.iter_mut().zip(rates) {
                    let mut column = matrix.fixed_view_mut::<3, 1>(start, freedom);
                    column += factor * (world_from_link * rate);
                }
            }
        }
        let [jacobian, rate] = &workspace.jacobian;
        Ok([jacobian, rate])
    }

    /// Computes the pose of a link in the world frame; for a fixed base, in its frame. `link` is its index in the
    /// robot.
    ///
    /// # Errors
    /// Those of [`Equations::inverse`].
    pub fn pose(&self, workspace: &mut Workspace, q: &[f64], link: usize) -> Result<Isometry3<f64>> {
        self.check_place(q)?;
        self.check_link(link)?;
        self.prepare_still(workspace, q);
        let (joint, frame) = &self.frames[link];
        let pose = workspace.data.pose_in_base(&self.tree, *joint, frame);
        let own = Isometry3::from_parts(Vector3::from(pose.position).into(), rotation(&pose));
        Ok(self.world_from_root(q) * own)
    }

    fn world_from_root(&self, q: &[f64]) -> Isometry3<f64> {
        let turn = self.root_rotation(q).unwrap_or_default();
        Isometry3::from_parts(self.root_position(q).into(), turn)
    }

    fn turned_to_world(&self, q: &[f64], own: &Six<f64>) -> [Vector3<f64>; 2] {
        let turn = self.root_rotation(q).unwrap_or_default();
        [turn * Vector3::from(own.linear), turn * Vector3::from(own.angular)]
    }

    /// Adds the rotors' inertia to the inertia matrix.
    pub(super) fn add_rotors(&self, inertia: &mut DMatrix<f64>) {
        for drive in &self.drives {
            let at = self.first() + drive.freedom;
            inertia[(at, at)] += drive.factor * drive.factor * drive.armature;
        }
    }
}

fn rotation(frame: &Frame<f64>) -> UnitQuaternion<f64> {
    let matrix = nalgebra::Matrix3::from_fn(|i, j| frame.rotation[i][j]);
    UnitQuaternion::from_rotation_matrix(&nalgebra::Rotation3::from_matrix_unchecked(matrix))
}
