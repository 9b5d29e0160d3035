//! Vectors with three and six coordinates, frames and inertias. Main types: [`Six`], [`Frame`], [`Mass`].
//!
//! Motions and forces are expressed in the frame of a body, linear part first, as in RH0 (2-5).

use super::scalar::Scalar;
use crate::spatial::Wrench;

/// A vector of three coordinates.
pub type Three<S> = [S; 3];
/// A 3 x 3 matrix, row by row.
pub type Matrix<S> = [Three<S>; 3];

pub(in crate::dynamics) fn add<S: Scalar>(a: &Three<S>, b: &Three<S>) -> Three<S> {
    std::array::from_fn(|i| a[i].clone() + b[i].clone())
}

pub(in crate::dynamics) fn dot<S: Scalar>(a: &Three<S>, b: &Three<S>) -> S {
    a[0].clone() * b[0].clone() + a[1].clone() * b[1].clone() + a[2].clone() * b[2].clone()
}

pub(in crate::dynamics) fn scaled<S: Scalar>(a: &Three<S>, factor: &S) -> Three<S> {
    std::array::from_fn(|i| a[i].clone() * factor.clone())
}

pub(in crate::dynamics) fn cross<S: Scalar>(a: &Three<S>, b: &Three<S>) -> Three<S> {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j].clone() * b[k].clone() - a[k].clone() * b[j].clone()
    })
}

/// `R v`.
pub(in crate::dynamics) fn turned<S: Scalar>(r: &Matrix<S>, v: &Three<S>) -> Three<S> {
    std::array::from_fn(|i| dot(&r[i], v))
}

/// `R' v`.
pub(in crate::dynamics) fn turned_back<S: Scalar>(r: &Matrix<S>, v: &Three<S>) -> Three<S> {
    std::array::from_fn(|i| {
        r[0][i].clone() * v[0].clone() + r[1][i].clone() * v[1].clone() + r[2][i].clone() * v[2].clone()
    })
}

pub(in crate::dynamics) fn zeros<S: Scalar>() -> Three<S> {
    std::array::from_fn(|_| S::zero())
}

/// A spatial motion (velocity or acceleration of the frame's origin, and the angular one) or a spatial force (force,
/// and moment about the origin).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Six<S> {
    /// The first three coordinates.
    pub linear: Three<S>,
    /// The last three coordinates.
    pub angular: Three<S>,
}

impl<S: Scalar> Six<S> {
    /// The zero vector.
    pub fn zero() -> Self {
        Six { linear: zeros(), angular: zeros() }
    }

    /// The first six entries of a list.
    pub fn of(list: &[S]) -> Self {
        Six { linear: std::array::from_fn(|i| list[i].clone()), angular: std::array::from_fn(|i| list[3 + i].clone()) }
    }

    /// The sum.
    pub fn add(&self, other: &Self) -> Self {
        Six { linear: add(&self.linear, &other.linear), angular: add(&self.angular, &other.angular) }
    }

    pub(crate) fn scaled(&self, factor: &S) -> Self {
        Six { linear: scaled(&self.linear, factor), angular: scaled(&self.angular, factor) }
    }

    pub(in crate::dynamics) fn half(&self) -> Self {
        let halved = |a: &Three<S>| std::array::from_fn(|i| a[i].half());
        Six { linear: halved(&self.linear), angular: halved(&self.angular) }
    }

    /// The negative.
    pub fn negated(&self) -> Self {
        let turned = |a: &Three<S>| std::array::from_fn(|i| -a[i].clone());
        Six { linear: turned(&self.linear), angular: turned(&self.angular) }
    }

    /// The power of a force along a motion.
    pub(crate) fn dot(&self, other: &Self) -> S {
        dot(&self.linear, &other.linear) + dot(&self.angular, &other.angular)
    }

    /// The cross product of motions: the change of `motion`, fixed to a body that moves with this motion.
    pub fn moving(&self, motion: &Self) -> Self {
        Six {
            linear: add(&cross(&self.angular, &motion.linear), &cross(&self.linear, &motion.angular)),
            angular: cross(&self.angular, &motion.angular),
        }
    }

    /// The cross product with a force: the change of `force`, fixed to a body that moves with this motion.
    pub(crate) fn pushing(&self, force: &Self) -> Self {
        Six {
            linear: cross(&self.angular, &force.linear),
            angular: add(&cross(&self.angular, &force.angular), &cross(&self.linear, &force.linear)),
        }
    }

    /// The coordinate with this index, 0 to 5.
    pub fn at(&self, index: usize) -> &S {
        if index < 3 { &self.linear[index] } else { &self.angular[index - 3] }
    }

    pub(crate) fn at_mut(&mut self, index: usize) -> &mut S {
        if index < 3 { &mut self.linear[index] } else { &mut self.angular[index - 3] }
    }
}

impl From<Wrench> for Six<f64> {
    fn from(wrench: Wrench) -> Self {
        Six { linear: wrench.f.into(), angular: wrench.tau.into() }
    }
}

impl From<Six<f64>> for Wrench {
    fn from(six: Six<f64>) -> Self {
        Wrench { f: six.linear.into(), tau: six.angular.into() }
    }
}

/// A body's frame in its parent's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame<S> {
    /// The rotation from the body's to the parent's axes.
    pub rotation: Matrix<S>,
    /// The origin of the body's frame in the parent's frame.
    pub position: Three<S>,
}

impl<S: Scalar> Frame<S> {
    /// Transforms a motion from the parent's frame to the body's.
    pub fn motion_inward(&self, motion: &Six<S>) -> Six<S> {
        let linear = add(&motion.linear, &cross(&motion.angular, &self.position));
        Six { linear: turned_back(&self.rotation, &linear), angular: turned_back(&self.rotation, &motion.angular) }
    }

    /// Converts to another scalar type.
    pub fn map<T>(&self, number: impl Fn(&S) -> T + Copy) -> Frame<T> {
        Frame {
            rotation: self.rotation.each_ref().map(|row| row.each_ref().map(number)),
            position: self.position.each_ref().map(number),
        }
    }

    /// The inverse: the parent's frame in the body's.
    pub(crate) fn inverse(&self) -> Self {
        let back = turned_back(&self.rotation, &self.position);
        Frame {
            rotation: std::array::from_fn(|i| std::array::from_fn(|j| self.rotation[j][i].clone())),
            position: std::array::from_fn(|i| -back[i].clone()),
        }
    }

    /// Composes with a frame in the body: the result is in the parent.
    pub(in crate::dynamics) fn then(&self, inner: &Frame<S>) -> Self {
        let column = |j: usize| turned(&self.rotation, &std::array::from_fn(|k| inner.rotation[k][j].clone()));
        let columns: Matrix<S> = std::array::from_fn(column);
        Frame {
            rotation: std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i].clone())),
            position: add(&self.position, &turned(&self.rotation, &inner.position)),
        }
    }

    /// The identity.
    pub fn identity() -> Self {
        let entry = |i: usize, j: usize| if i == j { S::one() } else { S::zero() };
        Frame { rotation: std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))), position: zeros() }
    }

    /// Transforms a force from the parent's frame to the body's.
    pub fn force_inward(&self, force: &Six<S>) -> Six<S> {
        self.inverse().force_outward(force)
    }

    /// Transforms a force from the body's frame to the parent's.
    pub fn force_outward(&self, force: &Six<S>) -> Six<S> {
        let (linear, angular) = (turned(&self.rotation, &force.linear), turned(&self.rotation, &force.angular));
        Six { angular: add(&angular, &cross(&self.position, &linear)), linear }
    }
}

/// Rigid-body inertia about the origin of the body's frame: ten inertial parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mass<S> {
    /// The mass.
    pub mass: S,
    /// The first moments: mass times centre of mass.
    pub moment: Three<S>,
    /// The inertia tensor about the origin: xx, xy, yy, xz, yz, zz.
    pub tensor: [S; 6],
}

impl<S: Scalar> Mass<S> {
    /// Builds the inertia from ten parameters: the mass, the first moments, the inertia tensor.
    pub fn of(numbers: [S; 10]) -> Self {
        let [mass, x, y, z, tensor @ ..] = numbers;
        Mass { mass, moment: [x, y, z], tensor }
    }

    pub(crate) fn zero() -> Self {
        Mass { mass: S::zero(), moment: zeros(), tensor: std::array::from_fn(|_| S::zero()) }
    }

    fn row(&self, i: usize) -> Three<S> {
        const PLACES: [[usize; 3]; 3] = [[0, 1, 3], [1, 2, 4], [3, 4, 5]];
        std::array::from_fn(|j| self.tensor[PLACES[i][j]].clone())
    }

    /// The momentum for a velocity, or the force for an acceleration.
    pub fn times(&self, motion: &Six<S>) -> Six<S> {
        let turned: Three<S> = std::array::from_fn(|i| dot(&self.row(i), &motion.angular));
        Six {
            linear: add(&scaled(&motion.linear, &self.mass), &cross(&motion.angular, &self.moment)),
            angular: add(&turned, &cross(&self.moment, &motion.linear)),
        }
    }

    /// Converts to another scalar type.
    pub fn map<T>(&self, number: impl Fn(&S) -> T + Copy) -> Mass<T> {
        Mass {
            mass: number(&self.mass),
            moment: self.moment.each_ref().map(number),
            tensor: self.tensor.each_ref().map(number),
        }
    }

    /// The ten parameters: the mass, the first moments, the inertia tensor.
    pub fn numbers(&self) -> [S; 10] {
        let [x, y, z] = self.moment.clone();
        let [xx, xy, yy, xz, yz, zz] = self.tensor.clone();
        [self.mass.clone(), x, y, z, xx, xy, yy, xz, yz, zz]
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        Mass {
            mass: self.mass.clone() + other.mass.clone(),
            moment: add(&self.moment, &other.moment),
            tensor: std::array::from_fn(|i| self.tensor[i].clone() + other.tensor[i].clone()),
        }
    }

    /// Transforms the inertia to a frame that is given in the body's frame.
    pub(in crate::dynamics) fn inward(&self, frame: &Frame<S>) -> Self {
        self.outward(&frame.inverse())
    }

    /// Transforms the inertia to the parent's frame. `frame` is the body's frame in the parent's.
    pub fn outward(&self, frame: &Frame<S>) -> Self {
        let (r, p) = (&frame.rotation, &frame.position);
        let moment = turned(r, &self.moment);
        let rows: Matrix<S> = std::array::from_fn(|i| {
            // Row i of R I.
            std::array::from_fn(|j| dot(&r[i], &std::array::from_fn(|k| self.row(k)[j].clone())))
        });
        let entry = |i: usize, j: usize| dot(&rows[i], &r[j]);
        // The moment and the mass at the other origin add `2 (p . h) 1 - p h' - h p' + m (p . p 1 - p p')`.
        let reach = add(&moment, &scaled(p, &self.mass));
        let along = dot(p, &moment) + dot(p, &reach);
        let added = |i: usize, j: usize| {
            let outer = p[i].clone() * reach[j].clone() + moment[i].clone() * p[j].clone();
            if i == j { along.clone() - outer } else { -outer }
        };
        let places = [(0, 0), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2)];
        let tensor = places.map(|(i, j)| entry(i, j) + added(i, j));
        Mass { mass: self.mass.clone(), moment: reach, tensor }
    }
}
