//! Inertia, Coriolis matrix, energy, momentum and Jacobians at a state.

use nalgebra::{DMatrix, Isometry3, Matrix6xX, Point3, UnitQuaternion, Vector3};

use super::{Equations, State, Workspace};
use crate::dynamics::Momentum;
use crate::dynamics::recursions::{Energy, Frame, Six};
use crate::{Error, ErrorKind, Result};

impl Equations {
    /// The inertia matrix, rotors included.
    ///
    /// # Errors
    /// As [`Equations::inverse`].
    pub fn inertia<'r>(&self, room: &'r mut Workspace, q: &[f64]) -> Result<&'r DMatrix<f64>> {
        self.check_place(q)?;
        self.prepare_still(room, q);
        room.data.inertia(&self.tree, &mut room.full);
        self.gather_symmetric(&room.full.inertia, room.full.size, &mut room.inertia);
        self.add_rotors(&mut room.inertia);
        Ok(&room.inertia)
    }

    /// The Coriolis matrix of Christoffel's symbols, RH0 (2-42): `M' - 2 C` is skew.
    ///
    /// # Errors
    /// As [`Equations::inverse`].
    pub fn coriolis<'r>(&self, room: &'r mut Workspace, state: State<'_>) -> Result<&'r DMatrix<f64>> {
        self.matrices(room, state).map(|[_, coriolis]| coriolis)
    }

    /// The inertia and the Coriolis matrix.
    ///
    /// # Errors
    /// As [`Equations::inverse`].
    pub fn matrices<'r>(&self, room: &'r mut Workspace, state: State<'_>) -> Result<[&'r DMatrix<f64>; 2]> {
        self.check(state, None)?;
        self.prepare(room, state, None);
        room.data.matrices(&self.tree, &room.base[0], &room.rates, &mut room.full);
        self.gather_symmetric(&room.full.inertia, room.full.size, &mut room.inertia);
        self.gather(&room.full.coriolis, room.full.size, &mut room.coriolis);
        self.add_rotors(&mut room.inertia);
        Ok([&room.inertia, &room.coriolis])
    }

    /// The energy, that of turning rotors included; the potential one is nought where the centre of mass is as high as the origin of the fixed base, or of the world.
    ///
    /// # Errors
    /// As [`Equations::inverse`].
    pub fn energy(&self, room: &mut Workspace, state: State<'_>) -> Result<Energy<f64>> {
        self.check(state, None)?;
        self.prepare(room, state, None);
        let gravity = room.pull.linear.map(|x| -x);
        let Energy { mut kinetic, mut potential } = room.data.energy(&self.tree, &room.base[0], &room.rates, &gravity);
        let rotors = self.drives.iter().zip(&room.rates).map(|(drive, rate)| 0.5 * drive.armature * rate * rate);
        kinetic += rotors.sum::<f64>();
        potential -= room.data.whole(&self.tree).mass * self.gravity.dot(&self.root_position(state.q));
        Ok(Energy { kinetic, potential })
    }

    /// The centre of mass in the world (of a fixed base: in its frame).
    ///
    /// # Errors
    /// As [`Equations::inverse`], and for a robot without mass.
    pub fn centre_of_mass(&self, room: &mut Workspace, q: &[f64]) -> Result<Point3<f64>> {
        self.check_place(q)?;
        self.prepare_still(room, q);
        let whole = room.data.whole(&self.tree);
        if whole.mass <= 0.0 {
            return Err(Error::new(
                ErrorKind::BadValue,
                "the robot has no mass, and so no centre of mass; give masses",
            ));
        }
        let centre = Point3::from(Vector3::from(whole.moment) / whole.mass);
        Ok(self.world_from_root(q) * centre)
    }

    /// The momentum of all bodies in the world (of a fixed base: in its frame), about its origin; [`Momentum::about`] the centre of mass it is the centroidal one.
    ///
    /// # Errors
    /// As [`Equations::inverse`].
    pub fn momentum(&self, room: &mut Workspace, state: State<'_>) -> Result<Momentum> {
        self.check(state, None)?;
        self.prepare(room, state, None);
        let own = room.data.momentum(&self.tree, &room.base[0], &room.rates);
        let [linear, angular] = self.turned_to_world(state.q, &own);
        Ok(Momentum { linear, angular: angular + self.root_position(state.q).cross(&linear) })
    }

    /// The centroidal momentum matrix, 6 x freedoms: times the velocity it is the linear momentum in the world, and the angular one about the centre of mass (D. E. Orin,
    /// A. Goswami and S.-H. Lee, Autonomous Robots 35, 2013).
    ///
    /// # Errors
    /// As [`Equations::centre_of_mass`].
    pub fn centroidal<'r>(&self, room: &'r mut Workspace, q: &[f64]) -> Result<&'r Matrix6xX<f64>> {
        let centre = self.centre_of_mass(room, q)? - self.root_position(q);
        room.data.momenta(&self.tree, self.first(), &mut room.momenta);
        room.jacobian[0].fill(0.0);
        for (at, own) in room.momenta.iter().enumerate() {
            let (freedom, factor) = self.freedom(at);
            let [linear, angular] = self.turned_to_world(q, own);
            let about = angular - centre.coords.cross(&linear);
            for i in 0..3 {
                room.jacobian[0][(i, freedom)] += factor * linear[i];
                room.jacobian[0][(3 + i, freedom)] += factor * about[i];
            }
        }
        Ok(&room.jacobian[0])
    }

    /// The Jacobian of the link with this place in the robot, and how it changes, 6 x freedoms each: times the velocity it is that of the link's origin and the link's angular velocity, along the axes
    /// of the world (of a fixed base: of its frame). `J q'' + J' q'` is what both change by.
    ///
    /// # Errors
    /// As [`Equations::inverse`].
    pub fn jacobian<'r>(
        &self,
        room: &'r mut Workspace,
        state: State<'_>,
        link: usize,
    ) -> Result<[&'r Matrix6xX<f64>; 2]> {
        self.check(state, None)?;
        self.check_link(link)?;
        self.prepare(room, state, None);
        let (joint, frame) = &self.frames[link];
        room.columns.fill([Six::zero(); 2]);
        let moving = (&room.base[0], &room.rates[..]);
        let own = room.data.jacobian(&self.tree, moving, (*joint, frame), self.first(), &mut room.columns);
        let world_from_link =
            self.world_from_root(state.q).rotation * rotation(&room.data.stands(&self.tree, *joint, frame));
        let turning = Vector3::from(own.angular);
        room.jacobian.iter_mut().for_each(|matrix| matrix.fill(0.0));
        for (at, [column, change]) in room.columns.iter().enumerate() {
            let (freedom, factor) = self.freedom(at);
            for (part, start) in [(0, 0), (1, 3)] {
                let of = |six: &Six<f64>| Vector3::from(if part == 0 { six.linear } else { six.angular });
                let fixed = of(column);
                // Along the axes of the world what the frame sees changes by its turning as well.
                let rates = [fixed, of(change) + turning.cross(&fixed)];
                for (matrix, rate) in room.jacobian.iter_mut().zip(rates) {
                    let mut column = matrix.fixed_view_mut::<3, 1>(start, freedom);
                    column += factor * (world_from_link * rate);
                }
            }
        }
        let [jacobian, rate] = &room.jacobian;
        Ok([jacobian, rate])
    }

    /// Where the link with this place in the robot stands in the world (for a fixed base: in its frame).
    ///
    /// # Errors
    /// As [`Equations::inverse`].
    pub fn pose(&self, room: &mut Workspace, q: &[f64], link: usize) -> Result<Isometry3<f64>> {
        self.check_place(q)?;
        self.check_link(link)?;
        self.prepare_still(room, q);
        let (joint, frame) = &self.frames[link];
        let stands = room.data.stands(&self.tree, *joint, frame);
        let own = Isometry3::from_parts(Vector3::from(stands.position).into(), rotation(&stands));
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

    /// Adds what rotors have to do to the inertia.
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
