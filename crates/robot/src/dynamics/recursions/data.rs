//! Working memory of the recursions, and the simple recursions: velocities, inverse dynamics (RNEA), energy, momentum.
//! Main type: [`Data`].
//!
//! R. Featherstone, Rigid Body Dynamics Algorithms (2008): inverse dynamics by the recursive Newton-Euler algorithm,
//! table 5.1.

use super::composite::Composite;
use super::scalar::Scalar;
use super::six::{Frame, Mass, Six, dot};
use super::tree::{Body, Freedom, Place, Tree};

/// The motion of a robot: the twist of the base in its own frame, and the velocities and accelerations of the joints. A
/// fixed base under gravity `g` has the acceleration `-g`.
#[derive(Clone, Debug)]
pub struct Motion<'a, S> {
    /// The velocity of the base.
    pub base: Six<S>,
    /// The acceleration of the base minus gravity.
    pub base_acceleration: Six<S>,
    /// The joint velocities.
    pub rates: &'a [S],
    /// The joint accelerations.
    pub accelerations: &'a [S],
}

/// Working memory of the recursions for one tree. It is allocated once, and the recursions allocate nothing.
#[derive(Clone, Debug)]
pub struct Data<S> {
    /// For each joint, its body's frame in the parent's frame.
    pub(super) frames: Vec<Frame<S>>,
    pub(super) velocities: Vec<Six<S>>,
    pub(super) accelerations: Vec<Six<S>>,
    /// For each joint, the force that it transmits.
    pub(super) forces: Vec<Six<S>>,
    /// For each joint, the composite rigid body that it carries.
    pub(super) composites: Vec<Composite<S>>,
    pub(super) masses: Vec<Mass<S>>,
    /// For each joint, the time derivative of its axis, in its body's frame.
    pub(super) turnings: Vec<Six<S>>,
    /// For each joint, the derivative of its axis' contribution to the acceleration: parent's acceleration and second
    /// rotation term.
    pub(super) bends: Vec<Six<S>>,
}

/// The energy of a robot \[J\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Energy<S> {
    /// The kinetic energy.
    pub kinetic: S,
    /// The potential energy: weight times the height of the centre of mass above the origin of the base, or of the
    /// world for a floating base.
    pub potential: S,
}

impl<S: Scalar> Data<S> {
    /// Allocates the working memory for a tree.
    pub fn new(tree: &Tree<S>) -> Self {
        let count = tree.bodies.len();
        let sixes = || vec![Six::zero(); count];
        Data {
            frames: tree.bodies.iter().map(|body| body.frame.clone()).collect(),
            velocities: sixes(),
            accelerations: sixes(),
            forces: sixes(),
            composites: vec![Composite::zero(); count],
            masses: vec![Mass::zero(); count],
            turnings: sixes(),
            bends: sixes(),
        }
    }

    /// Sets the joint positions.
    pub fn place(&mut self, tree: &Tree<S>, places: impl IntoIterator<Item = Place<S>>) {
        for ((frame, body), place) in self.frames.iter_mut().zip(&tree.bodies).zip(places) {
            *frame = body.placed(&place);
        }
    }

    /// Computes the bodies' velocities.
    pub(super) fn move_bodies(&mut self, tree: &Tree<S>, base: &Six<S>, rates: &[S]) {
        for &joint in &tree.order {
            let body = &tree.bodies[joint];
            let velocity = body.parent.map_or(base, |parent| &self.velocities[parent]);
            let mut velocity = self.frames[joint].motion_inward(velocity);
            body.add_motion(&mut velocity, rates[joint].clone());
            self.velocities[joint] = velocity;
        }
    }

    /// Initialises each body's composite from its velocity, and computes the time derivatives of the joint axes.
    pub(super) fn compose(&mut self, tree: &Tree<S>) {
        for (joint, body) in tree.bodies.iter().enumerate() {
            let velocity = &self.velocities[joint];
            self.composites[joint] = Composite::of(&body.mass, velocity);
            self.turnings[joint] = body.turning(velocity, &S::one());
        }
    }

    /// Adds a joint's composite to that of its parent.
    pub(super) fn propagate(&mut self, tree: &Tree<S>, joint: usize, base: &mut Composite<S>) {
        let outward = self.composites[joint].outward(&self.frames[joint]);
        let below = tree.bodies[joint].parent.map_or(base, |parent| &mut self.composites[parent]);
        *below = below.plus(&outward);
    }

    /// Inverse dynamics (RNEA). Writes the joint torques and returns the force on the base. External wrenches are in
    /// the bodies' own frames, the base first; the list is empty when there are none.
    pub fn inverse(&mut self, tree: &Tree<S>, motion: &Motion<'_, S>, outside: &[Six<S>], torques: &mut [S]) -> Six<S> {
        for &joint in &tree.order {
            let (body, frame) = (&tree.bodies[joint], &self.frames[joint]);
            let (velocity, acceleration) = match body.parent {
                None => (&motion.base, &motion.base_acceleration),
                Some(parent) => (&self.velocities[parent], &self.accelerations[parent]),
            };
            let mut velocity = frame.motion_inward(velocity);
            let mut acceleration = frame.motion_inward(acceleration);
            let rate = &motion.rates[joint];
            body.add_motion(&mut velocity, rate.clone());
            acceleration = acceleration.add(&body.turning(&velocity, rate));
            body.add_motion(&mut acceleration, motion.accelerations[joint].clone());
            self.forces[joint] = net_force(&body.mass, &velocity, &acceleration, outside.get(joint + 1));
            (self.velocities[joint], self.accelerations[joint]) = (velocity, acceleration);
        }
        let mut base = net_force(&tree.base, &motion.base, &motion.base_acceleration, outside.first());
        for &joint in tree.order.iter().rev() {
            let body = &tree.bodies[joint];
            torques[joint] = body.along(&self.forces[joint]).clone();
            let force = self.frames[joint].force_outward(&self.forces[joint]);
            let below = body.parent.map_or(&mut base, |parent| &mut self.forces[parent]);
            *below = below.add(&force);
        }
        base
    }

    /// All bodies as one composite, in the base frame.
    pub fn whole(&mut self, tree: &Tree<S>) -> Mass<S> {
        for (whole, body) in self.masses.iter_mut().zip(&tree.bodies) {
            *whole = body.mass.clone();
        }
        let mut base = tree.base.clone();
        for &joint in tree.order.iter().rev() {
            let outward = self.masses[joint].outward(&self.frames[joint]);
            let below = tree.bodies[joint].parent.map_or(&mut base, |parent| &mut self.masses[parent]);
            *below = below.plus(&outward);
        }
        base
    }

    /// The momentum of all bodies, in the base frame about its origin.
    pub(crate) fn momentum(&mut self, tree: &Tree<S>, base: &Six<S>, rates: &[S]) -> Six<S> {
        self.move_bodies(tree, base, rates);
        let mut whole = tree.base.times(base);
        for (joint, body) in tree.bodies.iter().enumerate() {
            self.forces[joint] = body.mass.times(&self.velocities[joint]);
        }
        for &joint in tree.order.iter().rev() {
            let outward = self.frames[joint].force_outward(&self.forces[joint]);
            let below = tree.bodies[joint].parent.map_or(&mut whole, |parent| &mut self.forces[parent]);
            *below = below.add(&outward);
        }
        whole
    }

    /// The energy of the bodies. Gravity is given in the base frame. The potential energy is zero at the height of its
    /// origin.
    pub(crate) fn energy(&mut self, tree: &Tree<S>, base: &Six<S>, rates: &[S], gravity: &[S; 3]) -> Energy<S> {
        self.move_bodies(tree, base, rates);
        let own = |mass: &Mass<S>, velocity: &Six<S>| velocity.dot(&mass.times(velocity));
        let bodies = tree.bodies.iter().zip(&self.velocities);
        let twice = bodies.fold(own(&tree.base, base), |sum, (body, velocity)| sum + own(&body.mass, velocity));
        Energy { kinetic: twice.half(), potential: -dot(&self.whole(tree).moment, gravity) }
    }
}

/// The unit motion along one of the six coordinates.
pub fn unit<S: Scalar>(freedom: usize) -> Six<S> {
    let mut axis = Six::zero();
    *axis.at_mut(freedom) = S::one();
    axis
}

/// The force on a body with this motion, minus the external wrench.
pub fn net_force<S: Scalar>(
    mass: &Mass<S>,
    velocity: &Six<S>,
    acceleration: &Six<S>,
    outside: Option<&Six<S>>,
) -> Six<S> {
    mass.times(acceleration).add(&bias(mass, velocity, outside))
}

/// The bias force of a body: the force without acceleration, minus the external wrench.
pub fn bias<S: Scalar>(mass: &Mass<S>, velocity: &Six<S>, outside: Option<&Six<S>>) -> Six<S> {
    let force = velocity.pushing(&mass.times(velocity));
    outside.map_or_else(|| force.clone(), |outside| force.add(&outside.negated()))
}

impl<S: Scalar> Body<S> {
    /// Index of the joint's axis among the six coordinates.
    fn coordinate(&self) -> usize {
        if self.freedom == Freedom::Turn { 5 } else { 2 }
    }

    /// The joint's axis: its unit motion in the body's frame.
    pub fn axis(&self) -> Six<S> {
        unit(self.coordinate())
    }

    /// Adds a velocity or acceleration along the joint's axis to a motion.
    pub fn add_motion(&self, motion: &mut Six<S>, rate: S) {
        let entry = motion.at_mut(self.coordinate());
        *entry = entry.clone() + rate;
    }

    /// The component of a force along the joint's axis.
    pub fn along<'a>(&self, force: &'a Six<S>) -> &'a S {
        force.at(self.coordinate())
    }

    /// The velocity-product acceleration: velocity times the joint's motion.
    pub fn turning(&self, velocity: &Six<S>, rate: &S) -> Six<S> {
        let across = |v: &[S; 3]| [v[1].clone() * rate.clone(), -(v[0].clone() * rate.clone()), S::zero()];
        match self.freedom {
            Freedom::Turn => Six { linear: across(&velocity.linear), angular: across(&velocity.angular) },
            Freedom::Slide => Six { linear: across(&velocity.angular), angular: Six::zero().angular },
        }
    }

    /// The change of a force that is fixed to the body, for a unit velocity of the joint.
    pub fn force_rate(&self, force: &Six<S>) -> Six<S> {
        let across = |f: &[S; 3]| [-f[1].clone(), f[0].clone(), S::zero()];
        match self.freedom {
            Freedom::Turn => Six { linear: across(&force.linear), angular: across(&force.angular) },
            Freedom::Slide => Six { linear: Six::zero().linear, angular: across(&force.linear) },
        }
    }

    /// The momentum of a mass that moves with unit velocity along the joint's axis.
    pub fn momentum(&self, mass: &Mass<S>) -> Six<S> {
        let [x, y, _] = mass.moment.clone();
        match self.freedom {
            Freedom::Turn => {
                let [_, _, _, xz, yz, zz] = mass.tensor.clone();
                Six { linear: [-y, x, S::zero()], angular: [xz, yz, zz] }
            }
            Freedom::Slide => Six { linear: [S::zero(), S::zero(), mass.mass.clone()], angular: [y, -x, S::zero()] },
        }
    }
}
