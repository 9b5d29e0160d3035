//! Bodies that move as one, and how what they weigh changes. Main type: [`Composite`].

use super::scalar::Scalar;
use super::six::{Frame, Mass, Six, cross, dot};

/// Bodies as one, in a frame of one of them.
#[derive(Clone, Debug)]
pub struct Composite<S> {
    /// Their mass, centre and moments.
    pub mass: Mass<S>,
    /// The time derivative of `mass`.
    pub rate: Mass<S>,
    /// Their momentum.
    pub momentum: Six<S>,
}

impl<S: Scalar> Composite<S> {
    pub(super) fn zero() -> Self {
        Composite { mass: Mass::zero(), rate: Mass::zero(), momentum: Six::zero() }
    }

    /// That of one body at a velocity, in its own frame.
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

    /// The same bodies in the parent's frame.
    pub fn outward(&self, frame: &Frame<S>) -> Self {
        Composite {
            mass: self.mass.outward(frame),
            rate: self.rate.outward(frame),
            momentum: frame.force_outward(&self.momentum),
        }
    }
}

/// How a body's ten numbers change in a frame that stands still where the body's own frame is. The second moments `P` of its mass change by `v h' + W P` and
/// what that is transposed, where `W` is the matrix of the angular velocity and `h` the mass times its centre.
fn rate<S: Scalar>(mass: &Mass<S>, velocity: &Six<S>, momentum: &Six<S>) -> Mass<S> {
    let [xx, xy, yy, xz, yz, zz] = mass.tensor.clone();
    let half = (xx.clone() + yy.clone() + zz.clone()).half();
    let [xy, xz, yz] = [-xy, -xz, -yz];
    let second =
        [[half.clone() - xx, xy.clone(), xz.clone()], [xy, half.clone() - yy, yz.clone()], [xz, yz, half - zz]];
    // Column j of W P is the angular velocity times column j of P, which is symmetric.
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
    /// Twice what a body's Coriolis matrix makes of a motion: `2 B x`, where `x . B x` is half the power that the rate of the inertia takes.
    pub(super) fn coriolis(&self, motion: &Six<S>) -> Six<S> {
        self.rate.times(motion).add(&motion.pushing(&self.momentum))
    }

    /// Twice what the transpose makes of it.
    pub(super) fn coriolis_transposed(&self, motion: &Six<S>) -> Six<S> {
        self.rate.times(motion).add(&motion.pushing(&self.momentum).negated())
    }
}
