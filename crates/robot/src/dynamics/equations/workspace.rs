//! Working memory for the equations of one robot. Main type: [`Workspace`].

use nalgebra::{DMatrix, DVector, Matrix6xX, Quaternion, UnitQuaternion, Vector3};

use super::{Base, Drive, Equations, State};
use crate::dynamics::recursions::{ArticulatedBodies, Body, Data, Derivatives, Frame, Matrices, Motion, Place, Six};

/// Working memory for the equations of one robot. It is allocated once; results are stored in it until the next call,
/// and calls allocate nothing.
#[derive(Clone, Debug)]
pub struct Workspace {
    pub(super) data: Data<f64>,
    pub(super) articulation: ArticulatedBodies<f64>,
    /// For each joint, its rotor inertia, velocity, acceleration and torque.
    pub(super) rotors: Vec<f64>,
    pub(super) rates: Vec<f64>,
    pub(super) accelerations: Vec<f64>,
    pub(super) torques: Vec<f64>,
    /// The velocity of the base, its acceleration minus gravity, and minus gravity, all in its own frame.
    pub(super) base: [Six<f64>; 2],
    pub(super) pull: Six<f64>,
    /// External wrenches for each body; empty when there are none.
    pub(super) outside: Vec<Six<f64>>,
    /// For each body, the frame in which its ten inertial parameters are given.
    pub(super) links: Vec<Frame<f64>>,
    pub(super) full: Matrices<f64>,
    pub(super) full_derivatives: Derivatives<f64>,
    pub(super) full_regressor: Vec<f64>,
    pub(super) columns: Vec<[Six<f64>; 2]>,
    pub(super) momenta: Vec<Six<f64>>,
    /// The results.
    pub(super) forces: DVector<f64>,
    pub(super) changes: DVector<f64>,
    pub(super) inertia: DMatrix<f64>,
    pub(super) coriolis: DMatrix<f64>,
    pub(super) regressor: DMatrix<f64>,
    pub(super) derivatives: [DMatrix<f64>; 3],
    pub(super) jacobian: [Matrix6xX<f64>; 2],
}

impl Equations {
    /// Allocates the working memory.
    pub fn workspace(&self) -> Workspace {
        let (joints, freedoms) = (self.drives.len(), self.freedoms());
        let size = self.first() + joints;
        let bodies = joints + usize::from(self.base == Base::Floating);
        let square = || DMatrix::zeros(freedoms, freedoms);
        Workspace {
            data: Data::new(&self.tree),
            articulation: ArticulatedBodies::new(&self.tree),
            rotors: vec![0.0; joints],
            rates: vec![0.0; joints],
            accelerations: vec![0.0; joints],
            torques: vec![0.0; joints],
            base: [Six::zero(); 2],
            pull: Six::zero(),
            outside: Vec::with_capacity(joints + 1),
            links: self.parameter_links.iter().map(|link| self.frames[*link].1).collect(),
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

    /// Enters the joint positions, the motion of base and joints, and the external wrenches. Accelerations are zero
    /// when none are given.
    pub(super) fn prepare(&self, workspace: &mut Workspace, state: State<'_>, acceleration: Option<&[f64]>) {
        self.prepare_still(workspace, state.q);
        let first = self.first();
        for (joint, drive) in self.drives.iter().enumerate() {
            workspace.rates[joint] = drive.factor * state.velocity[first + drive.freedom];
            workspace.accelerations[joint] =
                acceleration.map_or(0.0, |given| drive.factor * given[first + drive.freedom]);
        }
        if self.base == Base::Floating {
            let acceleration = acceleration.map_or(workspace.pull, |given| workspace.pull.add(&Six::of(given)));
            workspace.base = [Six::of(state.velocity), acceleration];
        }
        if state.outside.is_empty() {
            return;
        }
        workspace.outside.resize(self.drives.len() + 1, Six::zero());
        for (link, wrench) in state.outside {
            let (joint, frame) = &self.frames[*link];
            let own = &mut workspace.outside[joint.map_or(0, |joint| joint + 1)];
            *own = own.add(&frame.force_outward(&Six::from(*wrench)));
        }
    }

    /// Enters a configuration at rest, without external wrenches.
    pub(super) fn prepare_still(&self, workspace: &mut Workspace, q: &[f64]) {
        self.place(workspace, q);
        workspace.rates.fill(0.0);
        workspace.accelerations.fill(0.0);
        let pull = self.root_rotation(q).map_or(self.gravity, |turn| turn.inverse() * self.gravity);
        workspace.pull = Six { linear: (-pull).into(), angular: [0.0; 3] };
        workspace.base = [Six::zero(), workspace.pull];
        workspace.outside.clear();
    }

    fn place(&self, workspace: &mut Workspace, q: &[f64]) {
        let joints = &q[q.len() - self.names.len()..];
        let place = |(drive, body): (&Drive, &Body<f64>)| {
            Place::of(body.freedom, drive.factor * joints[drive.freedom] + drive.offset)
        };
        workspace.data.place(&self.tree, self.drives.iter().zip(&self.tree.bodies).map(place));
    }

    /// The orientation of a floating base in the world frame.
    pub(super) fn root_rotation(&self, q: &[f64]) -> Option<UnitQuaternion<f64>> {
        (self.base == Base::Floating).then(|| UnitQuaternion::from_quaternion(Quaternion::new(q[6], q[3], q[4], q[5])))
    }

    /// The position of a floating base in the world frame.
    pub(super) fn root_position(&self, q: &[f64]) -> Vector3<f64> {
        if self.base == Base::Floating { Vector3::new(q[0], q[1], q[2]) } else { Vector3::zeros() }
    }

    /// RNEA: the forces of the independent joints and of the base, before rotors and friction.
    pub(super) fn newton_euler(&self, workspace: &mut Workspace) {
        let Workspace { data, rates, accelerations, torques, base, outside, forces, .. } = workspace;
        let motion = Motion { base: base[0], base_acceleration: base[1], rates, accelerations };
        let force = data.inverse(&self.tree, &motion, outside, torques);
        let first = self.first();
        forces.fill(0.0);
        (0..first).for_each(|at| forces[at] = *force.at(at));
        for (drive, torque) in self.drives.iter().zip(torques) {
            forces[first + drive.freedom] += drive.factor * *torque;
        }
    }

    /// Reduces a matrix of all joints, in row-major order, to the independent ones.
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

    /// Same as `gather`, but for a symmetric matrix.
    pub(super) fn gather_symmetric(&self, all: &[f64], size: usize, into: &mut DMatrix<f64>) {
        if self.is_plain { into.as_mut_slice().copy_from_slice(all) } else { self.gather(all, size, into) }
    }

    /// The degree of freedom that moves a base coordinate or a joint, with its factor.
    pub(super) fn freedom(&self, at: usize) -> (usize, f64) {
        match at.checked_sub(self.first()) {
            Some(joint) => (self.first() + self.drives[joint].freedom, self.drives[joint].factor),
            None => (at, 1.0),
        }
    }
}
