//! The equations of motion over any scalar type, for code generation. Main type: [`Formal`].

use super::{Base, Equations};
use crate::dynamics::recursions::{Data, Derivatives, Freedom, Matrices, Motion, Place, Scalar, Six, Tree};

/// Equations of motion over any scalar type, without friction and external wrenches. A joint position is given as the
/// cosine and the sine of its angle, or as its displacement. [`Equations::values`] describes how they follow from a
/// configuration.
#[derive(Clone, Debug)]
pub struct Formal<S> {
    /// The kinematic tree.
    pub tree: Tree<S>,
    /// Degrees of freedom of the base: six or none.
    pub first: usize,
    pub(crate) freedoms: usize,
    /// The acceleration of gravity \[m/s^2\].
    pub gravity: [S; 3],
    /// The drives of the joints.
    pub drives: Vec<FormalDrive<S>>,
}

/// The drive of a joint: its degree of freedom, and its rotor inertia reflected to that degree of freedom.
#[derive(Clone, Debug)]
pub struct FormalDrive<S> {
    pub freedom: usize,
    pub factor: S,
    pub armature: S,
}

/// The value of a joint as a function of the configuration: `factor * q[place] + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// Whether the value is an angle or a displacement.
    pub freedom: Freedom,
    /// The index in the configuration.
    pub place: usize,
    /// The factor of the configuration's entry.
    pub factor: f64,
    /// The offset \[rad or m\].
    pub offset: f64,
}

/// A state (configuration and velocity) over any scalar type.
#[derive(Clone, Debug)]
pub struct FormalState<S> {
    /// The positions of the joints.
    pub places: Vec<Place<S>>,
    /// The orientation of a floating base, a quaternion x, y, z, w.
    pub turn: Option<[S; 4]>,
    /// The velocity, one entry for each degree of freedom.
    pub velocity: Vec<S>,
}

impl Equations {
    /// Converts the equations to another scalar type. `number` converts constants. The inertial parameters are
    /// regrouped so that as few as possible are nonzero.
    #[doc(hidden)]
    pub fn formal<S: Scalar>(&self, number: impl Fn(f64) -> S + Copy) -> Formal<S> {
        let drive = |drive: &super::Drive| FormalDrive {
            freedom: drive.freedom,
            factor: number(drive.factor),
            armature: number(drive.armature * drive.factor * drive.factor),
        };
        Formal {
            tree: self.tree.regrouped(self.base == Base::Fixed).map(|x| number(*x)),
            first: self.first(),
            freedoms: self.freedoms(),
            gravity: [self.gravity.x, self.gravity.y, self.gravity.z].map(number),
            drives: self.drives.iter().map(drive).collect(),
        }
    }

    /// For each joint, its value as a function of the configuration.
    #[doc(hidden)]
    pub fn values(&self) -> Vec<Value> {
        let first = self.coordinates() - self.names.len();
        let drives = self.drives.iter().zip(&self.tree.bodies);
        let value = |(drive, body): (&super::Drive, &super::super::Body<f64>)| Value {
            freedom: body.freedom,
            place: first + drive.freedom,
            factor: drive.factor,
            offset: drive.offset,
        };
        drives.map(value).collect()
    }
}

/// The motion of the base and of the joints.
pub(super) struct Moving<S> {
    pub(super) base: Six<S>,
    pub(super) rates: Vec<S>,
}

impl<S: Scalar> Formal<S> {
    pub(super) fn data(&self, state: &FormalState<S>) -> Data<S> {
        let mut data = Data::new(&self.tree);
        data.place(&self.tree, state.places.iter().cloned());
        data
    }

    pub(super) fn moving(&self, list: &[S]) -> Moving<S> {
        let rate = |drive: &FormalDrive<S>| drive.factor.clone() * list[self.first + drive.freedom].clone();
        Moving {
            base: if self.first == 0 { Six::zero() } else { Six::of(list) },
            rates: self.drives.iter().map(rate).collect(),
        }
    }

    pub(super) fn newton_euler(&self, state: &FormalState<S>, acceleration: &[S]) -> Vec<S> {
        let mut data = self.data(state);
        let (moving, change) = (self.moving(&state.velocity), self.moving(acceleration));
        let motion = Motion {
            base: moving.base,
            base_acceleration: pull(&self.gravity, state.turn.as_ref()).add(&change.base),
            rates: &moving.rates,
            accelerations: &change.rates,
        };
        let mut torques = vec![S::zero(); self.drives.len()];
        let force = data.inverse(&self.tree, &motion, &[], &mut torques);
        let mut all: Vec<S> = (0..self.first).map(|at| force.at(at).clone()).collect();
        all.resize(self.freedoms, S::zero());
        for (drive, torque) in self.drives.iter().zip(torques) {
            let own = &mut all[self.first + drive.freedom];
            *own = own.clone() + drive.factor.clone() * torque;
        }
        all
    }

    /// Inverse dynamics (RNEA): the joint torques.
    pub fn inverse(&self, state: &FormalState<S>, acceleration: &[S]) -> Vec<S> {
        let mut all = self.newton_euler(state, acceleration);
        for drive in &self.drives {
            let at = self.first + drive.freedom;
            all[at] = all[at].clone() + drive.armature.clone() * acceleration[at].clone();
        }
        all
    }

    /// The gravity torques. The velocity is not used.
    pub fn gravity(&self, state: &FormalState<S>) -> Vec<S> {
        let still = vec![S::zero(); self.freedoms];
        self.newton_euler(&FormalState { velocity: still.clone(), ..state.clone() }, &still)
    }

    /// The inertia matrix by CRBA, in row-major order.
    pub fn inertia(&self, state: &FormalState<S>) -> Vec<S> {
        let mut matrices = Matrices::new(self.first + self.drives.len());
        self.data(state).inertia(&self.tree, &mut matrices);
        let mut gathered = self.gather(&matrices.inertia, matrices.size);
        for drive in &self.drives {
            let at = (self.first + drive.freedom) * (self.freedoms + 1);
            gathered[at] = gathered[at].clone() + drive.armature.clone();
        }
        gathered
    }

    /// The Coriolis matrix with Christoffel symbols, in row-major order.
    pub fn coriolis(&self, state: &FormalState<S>) -> Vec<S> {
        let (moving, mut matrices) = (self.moving(&state.velocity), Matrices::new(self.first + self.drives.len()));
        self.data(state).matrices(&self.tree, &moving.base, &moving.rates, &mut matrices);
        self.gather(&matrices.coriolis, matrices.size)
    }

    /// The derivatives of inverse dynamics by the configuration and by the velocity, in row-major order.
    pub fn derivatives(&self, state: &FormalState<S>, acceleration: &[S]) -> [Vec<S>; 2] {
        let (moving, change) = (self.moving(&state.velocity), self.moving(acceleration));
        let pull = pull(&self.gravity, state.turn.as_ref());
        let motion = Motion {
            base: moving.base,
            base_acceleration: pull.add(&change.base),
            rates: &moving.rates,
            accelerations: &change.rates,
        };
        let mut torques = vec![S::zero(); self.drives.len()];
        let mut all = Derivatives::new(self.first + self.drives.len());
        self.data(state).derivatives(&self.tree, &motion, &pull, &mut torques, &mut all);
        [&all.by_q, &all.by_velocity].map(|matrix| self.gather(matrix, all.size))
    }

    /// Reduces a matrix of all joints, in row-major order, to the independent ones.
    fn gather(&self, all: &[S], size: usize) -> Vec<S> {
        let freedom = |at: usize| match at.checked_sub(self.first) {
            Some(joint) => (self.first + self.drives[joint].freedom, self.drives[joint].factor.clone()),
            None => (at, S::one()),
        };
        let mut matrix = vec![S::zero(); self.freedoms * self.freedoms];
        for (at, entry) in all.iter().enumerate() {
            let ((row, above), (column, beside)) = (freedom(at / size), freedom(at % size));
            let sum = &mut matrix[row * self.freedoms + column];
            *sum = sum.clone() + above * beside * entry.clone();
        }
        matrix
    }
}

/// Minus gravity in the frame of the base, whose orientation is a quaternion x, y, z, w.
pub fn pull<S: Scalar>(gravity: &[S; 3], turn: Option<&[S; 4]>) -> Six<S> {
    let [gx, gy, gz] = gravity.clone().map(|entry| -entry);
    let linear = match turn {
        None => [gx, gy, gz],
        Some([x, y, z, w]) => {
            let twice = |a: &S, b: &S| {
                let product = a.clone() * b.clone();
                product.clone() + product
            };
            let diagonal = |a: &S, b: &S| S::one() - (twice(a, a) + twice(b, b));
            let columns = [
                [diagonal(y, z), twice(x, y) + twice(z, w), twice(x, z) - twice(y, w)],
                [twice(x, y) - twice(z, w), diagonal(x, z), twice(y, z) + twice(x, w)],
                [twice(x, z) + twice(y, w), twice(y, z) - twice(x, w), diagonal(x, y)],
            ];
            columns.map(|[a, b, c]| a * gx.clone() + b * gy.clone() + c * gz.clone())
        }
    };
    Six { linear, angular: Six::zero().angular }
}
