//! How inverse dynamics changes with the configuration and the velocity. Main type: [`Derivatives`].
//!
//! S. Singh, R. P. Russell and P. M. Wensing, Efficient Analytical Derivatives of Rigid-Body Dynamics Using Spatial Vector Algebra, IEEE Robotics and
//! Automation Letters 7 (2022), here in the bodies' own frames.

use super::composite::Composite;
use super::data::{Data, Motion, unit};
use super::scalar::Scalar;
use super::six::{Frame, Six};
use super::tree::{Body, Tree};

/// What the torques of a motion change by: square matrices by rows, the base's six freedoms first where it moves, whose place changes along motions in its
/// own frame.
#[derive(Clone, Debug)]
pub struct Derivatives<S> {
    /// Rows and columns.
    pub size: usize,
    /// With the configuration.
    pub by_q: Vec<S>,
    /// With the velocity.
    pub by_velocity: Vec<S>,
    /// With the acceleration: the inertia matrix.
    pub by_acceleration: Vec<S>,
}

impl<S: Scalar> Derivatives<S> {
    /// Room for the derivatives of so many freedoms.
    pub fn new(size: usize) -> Self {
        let zeros = || vec![S::zero(); size * size];
        Derivatives { size, by_q: zeros(), by_velocity: zeros(), by_acceleration: zeros() }
    }

    fn enter(&mut self, row: usize, column: usize, [q, velocity, acceleration]: [S; 3]) {
        let at = row * self.size + column;
        (self.by_q[at], self.by_velocity[at], self.by_acceleration[at]) = (q, velocity, acceleration);
    }
}

/// What changes of the force on what a freedom carries as that freedom does, and what it feels of changes of others.
pub struct Changes<S> {
    /// The changes of the force: by the position, the velocity and the acceleration of the freedom.
    pub by: [Six<S>; 3],
    /// What a motion of what carries it changes: by twice the Coriolis matrix, transposed.
    pub felt: Six<S>,
}

impl<S: Scalar> Changes<S> {
    /// Of a freedom along `axis` that changes by `turning` and `bend`: `[B, turning]` is twice the Coriolis matrix and the sum of what turns the axis.
    pub fn new(carried: &Composite<S>, axis: &Six<S>, turning: &Six<S>, bend: &Six<S>, sum: &Six<S>) -> Self {
        let times = |motion: &Six<S>| carried.mass.times(motion);
        let by_q = carried.coriolis(turning).add(&times(bend));
        let by_velocity = carried.coriolis(axis).add(&times(sum));
        Changes { by: [by_q, by_velocity, times(axis)], felt: carried.coriolis_transposed(axis) }
    }

    /// The same in the parent's frame, in which the body's stands so.
    pub fn outward(&self, frame: &Frame<S>) -> Self {
        let by = self.by.each_ref().map(|change| frame.force_outward(change));
        Changes { by, felt: frame.force_outward(&self.felt) }
    }

    /// What the force on a joint that carries the freedom changes by.
    pub fn on_carrier(&self, carrier: &Body<S>) -> [S; 3] {
        self.by.each_ref().map(|change| carrier.along(change).clone())
    }

    /// What the freedom feels of changes of a joint that carries it, whose axis changes by `turning` and `bend`.
    pub fn of_carrier(&self, carrier: &Body<S>, turning: &Six<S>, bend: &Six<S>) -> [S; 3] {
        let [.., inertia] = &self.by;
        let by_q = self.felt.dot(turning) + inertia.dot(bend);
        let by_velocity = carrier.along(&self.felt).clone() + inertia.dot(&turning.add(turning));
        [by_q, by_velocity, carrier.along(inertia).clone()]
    }

    /// What the force on the base changes by along one of its freedoms, and what is felt of that: of a base that moves so and is pulled so.
    pub fn with_base(&self, freedom: usize, velocity: &Six<S>, pull: &Six<S>) -> [[S; 3]; 2] {
        let (axis, [.., inertia]) = (unit(freedom), &self.by);
        let by_q = inertia.dot(&pull.moving(&axis));
        let by_velocity = self.felt.at(freedom).clone() + inertia.dot(&velocity.moving(&axis));
        let on = self.by.each_ref().map(|change| change.at(freedom).clone());
        [on, [by_q, by_velocity, inertia.at(freedom).clone()]]
    }

    /// Of a freedom of the base itself.
    pub fn of_base(base: &Composite<S>, freedom: usize, velocity: &Six<S>, pull: &Six<S>) -> Self {
        let (axis, turning) = (unit(freedom), velocity.moving(&unit(freedom)));
        Changes::new(base, &axis, &Six::zero(), &pull.moving(&axis), &turning)
    }
}

impl<S: Scalar> Data<S> {
    /// The derivatives of the torques of a motion, whose base, where its freedoms count, is accelerated by `pull` besides its own acceleration: by minus
    /// gravity.
    pub fn derivatives(
        &mut self,
        tree: &Tree<S>,
        motion: &Motion<'_, S>,
        pull: &Six<S>,
        torques: &mut [S],
        out: &mut Derivatives<S>,
    ) {
        let first = out.size - tree.bodies.len();
        let all = out.by_q.iter_mut().chain(&mut out.by_velocity).chain(&mut out.by_acceleration);
        all.for_each(|entry| *entry = S::zero());
        self.inverse(tree, motion, &[], torques);
        self.compose(tree);
        self.bend(tree, motion);
        let mut base = Composite::of(&tree.base, &motion.base);
        for &joint in tree.order.iter().rev() {
            let body = &tree.bodies[joint];
            let (axis, turning, bend) = (body.axis(), &self.turnings[joint], &self.bends[joint]);
            let mut changes = Changes::new(&self.composites[joint], &axis, turning, bend, &turning.add(turning));
            changes.by[0] = changes.by[0].add(&body.swung(&self.forces[joint]));
            let mut at = Some(joint);
            while let Some(carrier) = at {
                let above = &tree.bodies[carrier];
                let [row, column] = [first + carrier, first + joint];
                out.enter(row, column, changes.on_carrier(above));
                if carrier != joint {
                    out.enter(column, row, changes.of_carrier(above, &self.turnings[carrier], &self.bends[carrier]));
                }
                changes = changes.outward(&self.frames[carrier]);
                at = above.parent;
            }
            out.enter_base(first, first + joint, &changes, &motion.base, pull);
            self.hand_on(tree, joint, &mut base);
        }
        for column in 0..first {
            let changes = Changes::of_base(&base, column, &motion.base, pull);
            (0..first)
                .for_each(|row| out.enter(row, column, changes.by.each_ref().map(|change| change.at(row).clone())));
        }
    }

    /// How what turns the joints' axes changes: by the acceleration and the velocity of the parent.
    fn bend(&mut self, tree: &Tree<S>, motion: &Motion<'_, S>) {
        for (joint, body) in tree.bodies.iter().enumerate() {
            let moving = (&self.velocities[joint], &self.accelerations[joint]);
            self.bends[joint] = body.bend(moving, &self.turnings[joint], &motion.rates[joint]);
        }
    }
}

impl<S: Scalar> Body<S> {
    /// How what turns the joint's axis changes: by the acceleration and the velocity of the parent.
    pub fn bend(&self, (velocity, acceleration): (&Six<S>, &Six<S>), turning: &Six<S>, rate: &S) -> Six<S> {
        let acceleration = acceleration.add(&turning.scaled(rate).negated());
        let mut velocity = velocity.clone();
        self.quicken(&mut velocity, -rate.clone());
        self.turning(&acceleration, &S::one()).add(&velocity.moving(turning))
    }
}

impl<S: Scalar> Derivatives<S> {
    /// Enters what the freedoms of the base have to do for a joint.
    fn enter_base(&mut self, count: usize, joint: usize, changes: &Changes<S>, velocity: &Six<S>, pull: &Six<S>) {
        for freedom in 0..count {
            let [on, felt] = changes.with_base(freedom, velocity, pull);
            self.enter(freedom, joint, on);
            self.enter(joint, freedom, felt);
        }
    }
}
