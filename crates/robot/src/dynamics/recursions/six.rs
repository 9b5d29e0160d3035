//! Vectors of three and of six coordinates, and where one frame stands in another. Main types: [`Six`], [`Frame`], [`Mass`].
//!
//! Motions and forces stand in the frame of a body, linear part first, as in RH0 (2-5).

use super::scalar::Scalar;
use crate::spatial::Wrench;

/// Three coordinates.
pub type Three<S> = [S; 3];
/// A matrix by rows.
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

/// A motion (velocity or acceleration of the frame's origin, and the angular one) or a force (force, and moment about the origin).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Six<S> {
    /// The first three coordinates.
    pub linear: Three<S>,
    /// The last three.
    pub angular: Three<S>,
}

impl<S: Scalar> Six<S> {
    /// None at all.
    pub fn zero() -> Self {
        Six { linear: zeros(), angular: zeros() }
    }

    /// The six numbers at the front of a list.
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

    /// The opposite.
    pub fn negated(&self) -> Self {
        let turned = |a: &Three<S>| std::array::from_fn(|i| -a[i].clone());
        Six { linear: turned(&self.linear), angular: turned(&self.angular) }
    }

    /// The power of a force along a motion.
    pub(crate) fn dot(&self, other: &Self) -> S {
        dot(&self.linear, &other.linear) + dot(&self.angular, &other.angular)
    }

    /// How a motion that is fixed to what moves so changes.
    pub fn moving(&self, motion: &Self) -> Self {
        Six {
            linear: add(&cross(&self.angular, &motion.linear), &cross(&self.linear, &motion.angular)),
            angular: cross(&self.angular, &motion.angular),
        }
    }

    /// How a force that is fixed to what moves so changes.
    pub(crate) fn pushing(&self, force: &Self) -> Self {
        Six {
            linear: cross(&self.angular, &force.linear),
            angular: add(&cross(&self.angular, &force.angular), &cross(&self.linear, &force.linear)),
        }
    }

    /// The coordinate with this index of the six.
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

/// Where a body's frame stands in its parent's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame<S> {
    /// It takes directions of the body's frame to the parent's.
    pub rotation: Matrix<S>,
    /// The origin of the body's frame in the parent's.
    pub position: Three<S>,
}

impl<S: Scalar> Frame<S> {
    /// A motion in the parent's frame as seen in the body's.
    pub fn motion_inward(&self, motion: &Six<S>) -> Six<S> {
        let linear = add(&motion.linear, &cross(&motion.angular, &self.position));
        Six { linear: turned_back(&self.rotation, &linear), angular: turned_back(&self.rotation, &motion.angular) }
    }

    /// The same over other numbers.
    pub fn map<T>(&self, number: impl Fn(&S) -> T + Copy) -> Frame<T> {
        Frame {
            rotation: self.rotation.each_ref().map(|row| row.each_ref().map(number)),
            position: self.position.each_ref().map(number),
        }
    }

    /// Where the parent's frame stands in the body's.
    pub(crate) fn inverse(&self) -> Self {
        let back = turned_back(&self.rotation, &self.position);
        Frame {
            rotation: std::array::from_fn(|i| std::array::from_fn(|j| self.rotation[j][i].clone())),
            position: std::array::from_fn(|i| -back[i].clone()),
        }
    }

    /// Where a frame in the body stands in the parent.
    pub(in crate::dynamics) fn then(&self, inner: &Frame<S>) -> Self {
        let column = |j: usize| turned(&self.rotation, &std::array::from_fn(|k| inner.rotation[k][j].clone()));
        let columns: Matrix<S> = std::array::from_fn(column);
        Frame {
            rotation: std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i].clone())),
            position: add(&self.position, &turned(&self.rotation, &inner.position)),
        }
    }

    /// The parent's frame itself.
    pub fn identity() -> Self {
        let entry = |i: usize, j: usize| if i == j { S::one() } else { S::zero() };
        Frame { rotation: std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))), position: zeros() }
    }

    /// A force in the parent's frame as seen in the body's.
    pub fn force_inward(&self, force: &Six<S>) -> Six<S> {
        self.inverse().force_outward(force)
    }

    /// A force in the body's frame as seen in the parent's.
    pub fn force_outward(&self, force: &Six<S>) -> Six<S> {
        let (linear, angular) = (turned(&self.rotation, &force.linear), turned(&self.rotation, &force.angular));
        Six { angular: add(&angular, &cross(&self.position, &linear)), linear }
    }
}

/// What a body weighs, about the origin of its frame: ten numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mass<S> {
    /// The mass.
    pub mass: S,
    /// The mass times its centre.
    pub moment: Three<S>,
    /// The inertia tensor about the origin: xx, xy, yy, xz, yz, zz.
    pub tensor: [S; 6],
}

impl<S: Scalar> Mass<S> {
    /// That of ten numbers: the mass, the mass times its centre, the tensor.
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

    /// The momentum at a velocity.
    pub fn times(&self, motion: &Six<S>) -> Six<S> {
        let turned: Three<S> = std::array::from_fn(|i| dot(&self.row(i), &motion.angular));
        Six {
            linear: add(&scaled(&motion.linear, &self.mass), &cross(&motion.angular, &self.moment)),
            angular: add(&turned, &cross(&self.moment, &motion.linear)),
        }
    }

    /// The same over other numbers.
    pub fn map<T>(&self, number: impl Fn(&S) -> T + Copy) -> Mass<T> {
        Mass {
            mass: number(&self.mass),
            moment: self.moment.each_ref().map(number),
            tensor: self.tensor.each_ref().map(number),
        }
    }

    /// The ten numbers: the mass, the mass times its centre, the tensor.
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

    /// The same in a frame that stands so in the body's.
    pub(in crate::dynamics) fn inward(&self, frame: &Frame<S>) -> Self {
        self.outward(&frame.inverse())
    }

    /// The same about the origin of the parent's frame, in which the body's frame stands so.
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
