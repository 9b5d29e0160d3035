//! Room for the recursions, and those that go through the bodies once: velocities, inverse dynamics, energy, momentum. Main type: [`Data`].
//!
//! R. Featherstone, Rigid Body Dynamics Algorithms (2008): inverse dynamics by Newton and Euler, table 5.1.

use super::composite::Composite;
use super::scalar::Scalar;
use super::six::{Frame, Mass, Six, dot};
use super::tree::{Body, Freedom, Place, Tree};

/// How a robot moves: its base, whose motions stand in its own frame, and by joint its rate and what that changes by. A base that stands still under gravity
/// `g` accelerates by `-g`.
#[derive(Clone, Debug)]
pub struct Motion<'a, S> {
    /// The velocity of the base.
    pub base: Six<S>,
    /// Its acceleration, less that of gravity.
    pub base_acceleration: Six<S>,
    /// The joints' rates.
    pub rates: &'a [S],
    /// What the rates change by.
    pub accelerations: &'a [S],
}

/// Room for the recursions on one tree: it is made once, and they allocate nothing.
#[derive(Clone, Debug)]
pub struct Data<S> {
    /// By joint, where its body stands in its parent.
    pub(super) frames: Vec<Frame<S>>,
    pub(super) velocities: Vec<Six<S>>,
    pub(super) accelerations: Vec<Six<S>>,
    /// By joint, the force on what it carries.
    pub(super) forces: Vec<Six<S>>,
    /// By joint, what it carries as one body.
    pub(super) composites: Vec<Composite<S>>,
    pub(super) masses: Vec<Mass<S>>,
    /// By joint, how its unit motion changes, in its body's frame.
    pub(super) turnings: Vec<Six<S>>,
    /// By joint, how that of the parent's acceleration and the turning of the turning changes it.
    pub(super) bends: Vec<Six<S>>,
}

/// The energy of a robot \[J\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Energy<S> {
    /// Half the velocity times the momentum.
    pub kinetic: S,
    /// The height of the centre of mass over the origin of the base (of one that moves freely: of the world), times the weight.
    pub potential: S,
}

impl<S: Scalar> Data<S> {
    /// Room for the recursions on a tree.
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

    /// Puts the joints at their places.
    pub fn place(&mut self, tree: &Tree<S>, places: impl IntoIterator<Item = Place<S>>) {
        for ((frame, body), place) in self.frames.iter_mut().zip(&tree.bodies).zip(places) {
            *frame = body.placed(&place);
        }
    }

    /// The bodies' velocities.
    pub(super) fn move_bodies(&mut self, tree: &Tree<S>, base: &Six<S>, rates: &[S]) {
        for &joint in &tree.order {
            let body = &tree.bodies[joint];
            let velocity = body.parent.map_or(base, |parent| &self.velocities[parent]);
            let mut velocity = self.frames[joint].motion_inward(velocity);
            body.quicken(&mut velocity, rates[joint].clone());
            self.velocities[joint] = velocity;
        }
    }

    /// Tells each body's composite alone, once velocities are known, and how the joints' unit motions change.
    pub(super) fn compose(&mut self, tree: &Tree<S>) {
        for (joint, body) in tree.bodies.iter().enumerate() {
            let velocity = &self.velocities[joint];
            self.composites[joint] = Composite::of(&body.mass, velocity);
            self.turnings[joint] = body.turning(velocity, &S::one());
        }
    }

    /// Adds what a joint carries to what carries it.
    pub(super) fn hand_on(&mut self, tree: &Tree<S>, joint: usize, base: &mut Composite<S>) {
        let outward = self.composites[joint].outward(&self.frames[joint]);
        let below = tree.bodies[joint].parent.map_or(base, |parent| &mut self.composites[parent]);
        *below = below.plus(&outward);
    }

    /// The forces that a motion asks for: of each joint along its freedom, and that on the base. What acts from outside on the bodies stands in their own
    /// frames, the base first; of nothing an empty list.
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
            body.quicken(&mut velocity, rate.clone());
            acceleration = acceleration.add(&body.turning(&velocity, rate));
            body.quicken(&mut acceleration, motion.accelerations[joint].clone());
            self.forces[joint] = pushed(&body.mass, &velocity, &acceleration, outside.get(joint + 1));
            (self.velocities[joint], self.accelerations[joint]) = (velocity, acceleration);
        }
        let mut base = pushed(&tree.base, &motion.base, &motion.base_acceleration, outside.first());
        for &joint in tree.order.iter().rev() {
            let body = &tree.bodies[joint];
            torques[joint] = body.along(&self.forces[joint]).clone();
            let force = self.frames[joint].force_outward(&self.forces[joint]);
            let below = body.parent.map_or(&mut base, |parent| &mut self.forces[parent]);
            *below = below.add(&force);
        }
        base
    }

    /// All bodies as one, in the base's frame.
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

    /// The momentum of all bodies, in the base's frame and about its origin.
    pub fn momentum(&mut self, tree: &Tree<S>, base: &Six<S>, rates: &[S]) -> Six<S> {
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

    /// The energy of the bodies under a gravity that is told in the base's frame, as far as the origin of that is level.
    pub fn energy(&mut self, tree: &Tree<S>, base: &Six<S>, rates: &[S], gravity: &[S; 3]) -> Energy<S> {
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

/// The force that moves a body so, less what acts on it from outside.
pub fn pushed<S: Scalar>(mass: &Mass<S>, velocity: &Six<S>, acceleration: &Six<S>, outside: Option<&Six<S>>) -> Six<S> {
    mass.times(acceleration).add(&bias(mass, velocity, outside))
}

/// The force that a body asks for without any acceleration.
pub fn bias<S: Scalar>(mass: &Mass<S>, velocity: &Six<S>, outside: Option<&Six<S>>) -> Six<S> {
    let force = velocity.pushing(&mass.times(velocity));
    outside.map_or_else(|| force.clone(), |outside| force.add(&outside.negated()))
}

impl<S: Scalar> Body<S> {
    /// Which of six coordinates the joint moves along.
    fn coordinate(&self) -> usize {
        if self.freedom == Freedom::Turn { 5 } else { 2 }
    }

    /// The unit motion of the joint, in the body's frame.
    pub fn axis(&self) -> Six<S> {
        unit(self.coordinate())
    }

    /// Adds a motion of the joint.
    pub fn quicken(&self, motion: &mut Six<S>, rate: S) {
        let entry = motion.at_mut(self.coordinate());
        *entry = entry.clone() + rate;
    }

    /// The part of a force that the joint feels.
    pub fn along<'a>(&self, force: &'a Six<S>) -> &'a S {
        force.at(self.coordinate())
    }

    /// What turning the joint's axis adds to the acceleration: the velocity times the joint's motion.
    pub fn turning(&self, velocity: &Six<S>, rate: &S) -> Six<S> {
        let across = |v: &[S; 3]| [v[1].clone() * rate.clone(), -(v[0].clone() * rate.clone()), S::zero()];
        match self.freedom {
            Freedom::Turn => Six { linear: across(&velocity.linear), angular: across(&velocity.angular) },
            Freedom::Slide => Six { linear: across(&velocity.angular), angular: Six::zero().angular },
        }
    }

    /// How a force that is fixed to the body changes as the joint moves at unit rate.
    pub fn swung(&self, force: &Six<S>) -> Six<S> {
        let across = |f: &[S; 3]| [-f[1].clone(), f[0].clone(), S::zero()];
        match self.freedom {
            Freedom::Turn => Six { linear: across(&force.linear), angular: across(&force.angular) },
            Freedom::Slide => Six { linear: Six::zero().linear, angular: across(&force.linear) },
        }
    }

    /// The momentum of a mass that the joint moves at unit rate.
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
