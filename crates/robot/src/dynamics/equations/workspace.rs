//! Room for the equations of one robot, and what calls fill in first. Main type: [`Workspace`].

use nalgebra::{DMatrix, DVector, Matrix6xX, Quaternion, UnitQuaternion, Vector3};

use super::{Base, Drive, Equations, State};
use crate::dynamics::recursions::{Articulation, Body, Data, Derivatives, Frame, Matrices, Motion, Place, Six};

/// Room for the equations of one robot: it is made once, answers stand in it until the next call, and calls allocate nothing.
#[derive(Clone, Debug)]
pub struct Workspace {
    pub(super) data: Data<f64>,
    pub(super) articulation: Articulation<f64>,
    /// By joint, its rotor's inertia, its rate, what that changes by, and its torque.
    pub(super) rotors: Vec<f64>,
    pub(super) rates: Vec<f64>,
    pub(super) accelerations: Vec<f64>,
    pub(super) torques: Vec<f64>,
    /// The velocity of the base and its acceleration less gravity, and minus gravity, all in its own frame.
    pub(super) base: [Six<f64>; 2],
    pub(super) pull: Six<f64>,
    /// What acts from outside, by body, if anything does.
    pub(super) outside: Vec<Six<f64>>,
    /// By body, the frame that its ten numbers are told in.
    pub(super) links: Vec<Frame<f64>>,
    pub(super) full: Matrices<f64>,
    pub(super) full_derivatives: Derivatives<f64>,
    pub(super) full_regressor: Vec<f64>,
    pub(super) columns: Vec<[Six<f64>; 2]>,
    pub(super) momenta: Vec<Six<f64>>,
    /// The answers.
    pub(super) forces: DVector<f64>,
    pub(super) changes: DVector<f64>,
    pub(super) inertia: DMatrix<f64>,
    pub(super) coriolis: DMatrix<f64>,
    pub(super) regressor: DMatrix<f64>,
    pub(super) derivatives: [DMatrix<f64>; 3],
    pub(super) jacobian: [Matrix6xX<f64>; 2],
}

impl Equations {
    /// Room for calls.
    pub fn workspace(&self) -> Workspace {
        let (joints, freedoms) = (self.drives.len(), self.freedoms());
        let size = self.first() + joints;
        let bodies = joints + usize::from(self.base == Base::Floating);
        let square = || DMatrix::zeros(freedoms, freedoms);
        Workspace {
            data: Data::new(&self.tree),
            articulation: Articulation::new(&self.tree),
            rotors: vec![0.0; joints],
            rates: vec![0.0; joints],
            accelerations: vec![0.0; joints],
            torques: vec![0.0; joints],
            base: [Six::zero(); 2],
            pull: Six::zero(),
            outside: Vec::with_capacity(joints + 1),
            links: self.told_in.iter().map(|link| self.frames[*link].1).collect(),
            full: Matrices::new(size),
            full_derivatives: Derivatives::new(size),
            full_regressor: vec![0.0; size * 10 * bodies],
            columns: vec![[Six::zero(); 2]; size],
            momenta: vec![Six::zero(); size],
            forces: DVector::zeros(freedoms),
            changes: DVector::zeros(freedoms),
            inertia: square(),
            coriolis: square(),
            regressor: DMatrix::zeros(freedoms, 10 * bodies),
            derivatives: [square(), square(), square()],
            jacobian: [Matrix6xX::zeros(freedoms), Matrix6xX::zeros(freedoms)],
        }
    }

    /// Fills in where the joints are, how they and the base move, and what acts from outside; accelerations are nought where none are told.
    pub(super) fn prepare(&self, room: &mut Workspace, state: State<'_>, acceleration: Option<&[f64]>) {
        self.prepare_still(room, state.q);
        let first = self.first();
        for (joint, drive) in self.drives.iter().enumerate() {
            room.rates[joint] = drive.factor * state.velocity[first + drive.freedom];
            room.accelerations[joint] = acceleration.map_or(0.0, |told| drive.factor * told[first + drive.freedom]);
        }
        if self.base == Base::Floating {
            let acceleration = acceleration.map_or(room.pull, |told| room.pull.add(&Six::of(told)));
            room.base = [Six::of(state.velocity), acceleration];
        }
        if state.outside.is_empty() {
            return;
        }
        room.outside.resize(self.drives.len() + 1, Six::zero());
        for (link, wrench) in state.outside {
            let (joint, frame) = &self.frames[*link];
            let own = &mut room.outside[joint.map_or(0, |joint| joint + 1)];
            *own = own.add(&frame.force_outward(&Six::from(*wrench)));
        }
    }

    /// The same where nothing moves and nothing acts from outside.
    pub(super) fn prepare_still(&self, room: &mut Workspace, q: &[f64]) {
        self.place(room, q);
        room.rates.fill(0.0);
        room.accelerations.fill(0.0);
        let pull = self.root_rotation(q).map_or(self.gravity, |turn| turn.inverse() * self.gravity);
        room.pull = Six { linear: (-pull).into(), angular: [0.0; 3] };
        room.base = [Six::zero(), room.pull];
        room.outside.clear();
    }

    fn place(&self, room: &mut Workspace, q: &[f64]) {
        let joints = &q[q.len() - self.names.len()..];
        let place = |(drive, body): (&Drive, &Body<f64>)| {
            Place::of(body.freedom, drive.factor * joints[drive.freedom] + drive.offset)
        };
        room.data.place(&self.tree, self.drives.iter().zip(&self.tree.bodies).map(place));
    }

    /// How a root that moves freely is turned in the world.
    pub(super) fn root_rotation(&self, q: &[f64]) -> Option<UnitQuaternion<f64>> {
        (self.base == Base::Floating).then(|| UnitQuaternion::from_quaternion(Quaternion::new(q[6], q[3], q[4], q[5])))
    }

    /// Where it is.
    pub(super) fn root_position(&self, q: &[f64]) -> Vector3<f64> {
        if self.base == Base::Floating { Vector3::new(q[0], q[1], q[2]) } else { Vector3::zeros() }
    }

    /// Newton's and Euler's recursion: the forces of the independent joints and of the base, before rotors and friction.
    pub(super) fn newton_euler(&self, room: &mut Workspace) {
        let Workspace { data, rates, accelerations, torques, base, outside, forces, .. } = room;
        let motion = Motion { base: base[0], base_acceleration: base[1], rates, accelerations };
        let force = data.inverse(&self.tree, &motion, outside, torques);
        let first = self.first();
        forces.fill(0.0);
        (0..first).for_each(|at| forces[at] = *force.at(at));
        for (drive, torque) in self.drives.iter().zip(torques) {
            forces[first + drive.freedom] += drive.factor * *torque;
        }
    }

    /// A matrix of all joints, by rows, for the independent ones.
    pub(super) fn gather(&self, all: &[f64], size: usize, into: &mut DMatrix<f64>) {
        if self.is_plain {
            for (mut row, entries) in into.row_iter_mut().zip(all.chunks_exact(size)) {
                row.iter_mut().zip(entries).for_each(|(own, entry)| *own = *entry);
            }
            return;
        }
        into.fill(0.0);
        for (i, row) in all.chunks_exact(size).enumerate() {
            let (at, above) = self.freedom(i);
            for (j, entry) in row.iter().enumerate() {
                let (beside, factor) = self.freedom(j);
                into[(at, beside)] += above * factor * entry;
            }
        }
    }

    /// The same for a matrix that is symmetric.
    pub(super) fn gather_symmetric(&self, all: &[f64], size: usize, into: &mut DMatrix<f64>) {
        if self.is_plain { into.as_mut_slice().copy_from_slice(all) } else { self.gather(all, size, into) }
    }

    /// The freedom that moves one of the base's or a joint, and by how much.
    pub(super) fn freedom(&self, at: usize) -> (usize, f64) {
        match at.checked_sub(self.first()) {
            Some(joint) => (self.first() + self.drives[joint].freedom, self.drives[joint].factor),
            None => (at, 1.0),
        }
    }
}
