//! Room for the recursions, and the recursions that only add and multiply: inverse dynamics, inertia and Coriolis matrices. Main type: [`Data`].
//!
//! R. Featherstone, Rigid Body Dynamics Algorithms (2008): inverse dynamics by Newton and Euler (table 5.1), inertia by composite bodies (table 6.2). The
//! Coriolis matrix is that of Christoffel's symbols, by composite bodies too: S. Echeandia and P. M. Wensing, J. Mechanisms and Robotics 13 (2021), here
//! with what they sum by body, 36 numbers, as the rate of ten numbers and a momentum.

use super::scalar::Scalar;
use super::six::{Frame, Mass, Six, cross, dot};
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
    accelerations: Vec<Six<S>>,
    forces: Vec<Six<S>>,
    /// By joint, what it carries: the bodies as one, the rate of that, and the momentum.
    composites: Vec<Composite<S>>,
}

/// Bodies as one, in a frame of one of them.
#[derive(Clone, Debug)]
struct Composite<S> {
    mass: Mass<S>,
    rate: Mass<S>,
    momentum: Six<S>,
}

impl<S: Scalar> Composite<S> {
    fn zero() -> Self {
        Composite { mass: Mass::zero(), rate: Mass::zero(), momentum: Six::zero() }
    }

    /// That of one body at a velocity, in its own frame.
    fn of(mass: &Mass<S>, velocity: &Six<S>) -> Self {
        let momentum = mass.times(velocity);
        Composite { mass: mass.clone(), rate: rate(mass, velocity, &momentum), momentum }
    }

    fn plus(&self, other: &Self) -> Self {
        Composite {
            mass: self.mass.plus(&other.mass),
            rate: self.rate.plus(&other.rate),
            momentum: self.momentum.add(&other.momentum),
        }
    }

    fn outward(&self, frame: &Frame<S>) -> Self {
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

/// Square matrices by rows, that of the base's six freedoms first where it moves.
#[derive(Clone, Debug)]
pub struct Matrices<S> {
    /// Rows and columns.
    pub size: usize,
    /// The inertia matrix.
    pub inertia: Vec<S>,
    /// The Coriolis matrix.
    pub coriolis: Vec<S>,
}

impl<S: Scalar> Data<S> {
    /// Room for the recursions on a tree.
    pub fn new(tree: &Tree<S>) -> Self {
        let count = tree.bodies.len();
        Data {
            frames: tree.bodies.iter().map(|body| body.frame.clone()).collect(),
            velocities: vec![Six::zero(); count],
            accelerations: vec![Six::zero(); count],
            forces: vec![Six::zero(); count],
            composites: vec![Composite::zero(); count],
        }
    }

    /// Puts the joints at their places.
    pub fn place(&mut self, tree: &Tree<S>, places: impl IntoIterator<Item = Place<S>>) {
        for ((frame, body), place) in self.frames.iter_mut().zip(&tree.bodies).zip(places) {
            *frame = body.placed(&place);
        }
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

    /// The inertia and the Coriolis matrix at the velocity of a motion, whose accelerations do not matter; with the base's six freedoms, or those of joints alone.
    /// `M' - 2 C` is skew.
    pub fn matrices(&mut self, tree: &Tree<S>, motion: &Motion<'_, S>, out: &mut Matrices<S>) {
        let first = out.size - tree.bodies.len();
        out.inertia.iter_mut().chain(&mut out.coriolis).for_each(|entry| *entry = S::zero());
        for &joint in &tree.order {
            let body = &tree.bodies[joint];
            let velocity = body.parent.map_or(&motion.base, |parent| &self.velocities[parent]);
            let mut velocity = self.frames[joint].motion_inward(velocity);
            body.quicken(&mut velocity, motion.rates[joint].clone());
            self.composites[joint] = Composite::of(&body.mass, &velocity);
            self.velocities[joint] = velocity;
        }
        let mut base = Composite::of(&tree.base, &motion.base);
        for &joint in tree.order.iter().rev() {
            let body = &tree.bodies[joint];
            let (axis, turning) = (body.axis(), self.velocities[joint].moving(&body.axis()));
            let mut pushes = Pushes::new(&self.composites[joint], &axis, &turning);
            let mut at = Some(joint);
            while let Some(carrier) = at {
                let carrier_body = &tree.bodies[carrier];
                let (axis, turning) = (carrier_body.axis(), self.velocities[carrier].moving(&carrier_body.axis()));
                out.enter(first + carrier, first + joint, &pushes, &axis, &turning);
                pushes = pushes.outward(&self.frames[carrier]);
                at = carrier_body.parent;
            }
            for freedom in 0..first {
                let axis = unit(freedom);
                out.enter(freedom, first + joint, &pushes, &axis, &motion.base.moving(&axis));
            }
            let outward = self.composites[joint].outward(&self.frames[joint]);
            let below = body.parent.map_or(&mut base, |parent| &mut self.composites[parent]);
            *below = below.plus(&outward);
        }
        for column in 0..first {
            let axis = unit(column);
            let pushes = Pushes::new(&base, &axis, &motion.base.moving(&axis));
            for row in 0..=column {
                let axis = unit(row);
                out.enter(row, column, &pushes, &axis, &motion.base.moving(&axis));
            }
        }
    }
}

/// The unit motion along one of the six coordinates.
fn unit<S: Scalar>(freedom: usize) -> Six<S> {
    let mut axis = Six::zero();
    *axis.at_mut(freedom) = S::one();
    axis
}

/// What a joint's unit rate asks of the bodies that it carries: by inertia, and by the Coriolis matrix and its transpose.
struct Pushes<S> {
    inertia: Six<S>,
    coriolis: Six<S>,
    transposed: Six<S>,
}

impl<S: Scalar> Pushes<S> {
    fn new(carried: &Composite<S>, axis: &Six<S>, turning: &Six<S>) -> Self {
        let rate = carried.rate.times(axis).half();
        let aside = axis.pushing(&carried.momentum).half();
        let symmetric = carried.mass.times(turning).add(&rate);
        Pushes {
            inertia: carried.mass.times(axis),
            coriolis: symmetric.add(&aside),
            transposed: rate.add(&aside.negated()),
        }
    }

    fn outward(&self, frame: &Frame<S>) -> Self {
        let [inertia, coriolis, transposed] =
            [&self.inertia, &self.coriolis, &self.transposed].map(|push| frame.force_outward(push));
        Pushes { inertia, coriolis, transposed }
    }
}

impl<S: Scalar> Matrices<S> {
    /// Room for the matrices of so many freedoms.
    pub fn new(size: usize) -> Self {
        Matrices { size, inertia: vec![S::zero(); size * size], coriolis: vec![S::zero(); size * size] }
    }

    /// Enters what a freedom, whose axis is told, has to do for another one that it carries.
    fn enter(&mut self, carrier: usize, carried: usize, pushes: &Pushes<S>, axis: &Six<S>, turning: &Six<S>) {
        let (at, mirrored) = (carrier * self.size + carried, carried * self.size + carrier);
        let inertia = axis.dot(&pushes.inertia);
        self.inertia[at] = inertia.clone();
        self.inertia[mirrored] = inertia;
        if carrier != carried {
            self.coriolis[mirrored] = turning.dot(&pushes.inertia) + axis.dot(&pushes.transposed);
        }
        self.coriolis[at] = axis.dot(&pushes.coriolis);
    }
}

/// The force that moves a body so, less what acts on it from outside.
fn pushed<S: Scalar>(mass: &Mass<S>, velocity: &Six<S>, acceleration: &Six<S>, outside: Option<&Six<S>>) -> Six<S> {
    let force = mass.times(acceleration).add(&velocity.pushing(&mass.times(velocity)));
    outside.map_or_else(|| force.clone(), |outside| force.add(&outside.negated()))
}

impl<S: Scalar> Body<S> {
    /// The unit motion of the joint, in the body's frame.
    pub(super) fn axis(&self) -> Six<S> {
        unit(if self.freedom == Freedom::Turn { 5 } else { 2 })
    }

    /// Adds a motion of the joint.
    pub(super) fn quicken(&self, motion: &mut Six<S>, rate: S) {
        let entry = motion.at_mut(if self.freedom == Freedom::Turn { 5 } else { 2 });
        *entry = entry.clone() + rate;
    }

    /// The part of a force that the joint feels.
    pub(super) fn along<'a>(&self, force: &'a Six<S>) -> &'a S {
        force.at(if self.freedom == Freedom::Turn { 5 } else { 2 })
    }

    /// What turning the joint's axis adds to the acceleration: the velocity times the joint's motion.
    pub(super) fn turning(&self, velocity: &Six<S>, rate: &S) -> Six<S> {
        let across = |v: &[S; 3]| [v[1].clone() * rate.clone(), -(v[0].clone() * rate.clone()), S::zero()];
        match self.freedom {
            Freedom::Turn => Six { linear: across(&velocity.linear), angular: across(&velocity.angular) },
            Freedom::Slide => Six { linear: across(&velocity.angular), angular: Six::zero().angular },
        }
    }
}
