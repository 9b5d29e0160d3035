//! Composite rigid bodies and the rate of their inertia. Main type: [`Composite`].

use super::scalar::Scalar;
use super::six::{Frame, Mass, Six, cross, dot};

/// A composite rigid body, in the frame of one of its bodies.
#[derive(Clone, Debug)]
pub struct Composite<S> {
    /// Its inertia: mass, first moments and inertia tensor.
    pub mass: Mass<S>,
    /// The time derivative of its inertia.
    pub rate: Mass<S>,
    /// Its momentum.
    pub momentum: Six<S>,
}

impl<S: Scalar> Composite<S> {
    pub(super) fn zero() -> Self {
        Composite { mass: Mass::zero(), rate: Mass::zero(), momentum: Six::zero() }
    }

    /// The composite of one body at a velocity, in its own frame.
    pub fn of(mass: &Mass<S>, velocity: &Six<S>) -> Self {
        let momentum = mass.times(velocity);
        Composite { mass: mass.clone(), rate: rate(mass, velocity, &momentum), momentum }
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        Composite {
            mass: self.mass.plus(&other.mass),
            rate: self.rate.plus(&other.rate),
            momentum: self.momentum.add(&other.momentum),
        }
    }

    /// Transforms the composite to the parent's frame.
    pub fn outward(&self, frame: &Frame<S>) -> Self {
        Composite {
            mass: self.mass.outward(frame),
            rate: self.rate.outward(frame),
            momentum: frame.force_outward(&self.momentum),
        }
    }
}

/// The time derivative of a body's ten inertial parameters in a fixed frame that coincides with the body's frame. The
/// second moments `P` of the mass change by `v h' + W P` plus its transpose. `W` is the matrix of the angular velocity
/// and `h` the first moments.
fn rate<S: Scalar>(mass: &Mass<S>, velocity: &Six<S>, momentum: &Six<S>) -> Mass<S> {
    let [xx, xy, yy, xz, yz, zz] = mass.tensor.clone();
    let half = (xx.clone() + yy.clone() + zz.clone()).half();
    let [xy, xz, yz] = [-xy, -xz, -yz];
    let second =
        [[half.clone() - xx, xy.clone(), xz.clone()], [xy, half.clone() - yy, yz.clone()], [xz, yz, half - zz]];
    // Column j of W P is the angular velocity times column j of the symmetric matrix P.
    let turned: [_; 3] = std::array::from_fn(|j| cross(&velocity.angular, &second[j]));
    let pulled = |i: usize, j: usize| velocity.linear[i].clone() * mass.moment[j].clone() + turned[j][i].clone();
    let along = dot(&velocity.linear, &mass.moment);
    let twice = along.clone() + along;
    let entry = |i: usize, j: usize| {
        let change = pulled(i, j) + pulled(j, i);
        if i == j { twice.clone() - change } else { -change }
    };
    let places = [(0, 0), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2)];
    Mass { mass: S::zero(), moment: momentum.linear.clone(), tensor: places.map(|(i, j)| entry(i, j)) }
}

impl<S: Scalar> Composite<S> {
    /// Twice the body-level Coriolis matrix times a motion: `2 B x`. The power `x . B x` is half of that of the
    /// inertia's rate.
    pub(super) fn coriolis(&self, motion: &Six<S>) -> Six<S> {
        self.rate.times(motion).add(&motion.pushing(&self.momentum))
    }

    /// Twice the transposed body-level Coriolis matrix times a motion.
    pub(super) fn coriolis_transposed(&self, motion: &Six<S>) -> Six<S> {
        self.rate.times(motion).add(&motion.pushing(&self.momentum).negated())
    }
}
