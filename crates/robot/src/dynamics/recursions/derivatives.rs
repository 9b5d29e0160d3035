//! Analytical derivatives of inverse dynamics by configuration and velocity. Main type: [`Derivatives`].
//!
//! S. Singh, R. P. Russell and P. M. Wensing, Efficient Analytical Derivatives of Rigid-Body Dynamics Using Spatial
//! Vector Algebra, IEEE Robotics and Automation Letters 7 (2022), here in the bodies' own frames.

use super::composite::Composite;
use super::data::{Data, Motion, unit};
use super::scalar::Scalar;
use super::six::{Frame, Six};
use super::tree::{Body, Tree};

/// The derivatives of the torques: square matrices in row-major order. A floating base has the first six degrees of
/// freedom. Its pose is differentiated along twists in its own frame.
#[derive(Clone, Debug)]
pub struct Derivatives<S> {
    /// Number of rows and columns.
    pub size: usize,
    /// The derivatives by the configuration.
    pub by_q: Vec<S>,
    /// The derivatives by the velocity.
    pub by_velocity: Vec<S>,
    /// The derivatives by the acceleration: the inertia matrix.
    pub by_acceleration: Vec<S>,
}

impl<S: Scalar> Derivatives<S> {
    /// Allocates the derivatives for a number of degrees of freedom.
    pub fn new(size: usize) -> Self {
        let zeros = || vec![S::zero(); size * size];
        Derivatives { size, by_q: zeros(), by_velocity: zeros(), by_acceleration: zeros() }
    }

    fn enter(&mut self, row: usize, column: usize, [q, velocity, acceleration]: [S; 3]) {
        let at = row * self.size + column;
        (self.by_q[at], self.by_velocity[at], self.by_acceleration[at]) = (q, velocity, acceleration);
    }
}

/// Derivatives of the force that a joint transmits by its own degree of freedom, and its sensitivity to other degrees
/// of freedom.
pub struct ForceDerivatives<S> {
    /// Derivatives of the force by the position, the velocity and the acceleration of the degree of freedom.
    pub by: [Six<S>; 3],
    /// The transposed product for motions of the carriers: twice the transposed Coriolis matrix times the axis.
    pub sensitivity: Six<S>,
}

impl<S: Scalar> ForceDerivatives<S> {
    /// Computes the derivatives for a degree of freedom along `axis`, whose first and second rates are `turning` and
    /// `bend`. `[B, turning]` is twice the Coriolis matrix, and `sum` is the sum of the axis' rates.
    pub fn new(carried: &Composite<S>, axis: &Six<S>, turning: &Six<S>, bend: &Six<S>, sum: &Six<S>) -> Self {
        let times = |motion: &Six<S>| carried.mass.times(motion);
        let by_q = carried.coriolis(turning).add(&times(bend));
        let by_velocity = carried.coriolis(axis).add(&times(sum));
        ForceDerivatives { by: [by_q, by_velocity, times(axis)], sensitivity: carried.coriolis_transposed(axis) }
    }

    /// Transforms the derivatives to the parent's frame. `frame` is the body's frame in the parent's.
    pub fn outward(&self, frame: &Frame<S>) -> Self {
        let by = self.by.each_ref().map(|change| frame.force_outward(change));
        ForceDerivatives { by, sensitivity: frame.force_outward(&self.sensitivity) }
    }

    /// The derivatives of a carrying joint's torque by this degree of freedom.
    pub fn on_carrier(&self, carrier: &Body<S>) -> [S; 3] {
        self.by.each_ref().map(|change| carrier.along(change).clone())
    }

    /// The derivatives of this degree of freedom's torque by a carrying joint, whose axis has the rates `turning` and
    /// `bend`.
    pub fn of_carrier(&self, carrier: &Body<S>, turning: &Six<S>, bend: &Six<S>) -> [S; 3] {
        let [.., inertia] = &self.by;
        let by_q = self.sensitivity.dot(turning) + inertia.dot(bend);
        let by_velocity = carrier.along(&self.sensitivity).clone() + inertia.dot(&turning.add(turning));
        [by_q, by_velocity, carrier.along(inertia).clone()]
    }

    /// The derivatives between this degree of freedom and one of the base, in both directions. The base has this
    /// velocity, and its acceleration is `pull`.
    pub fn with_base(&self, freedom: usize, velocity: &Six<S>, pull: &Six<S>) -> [[S; 3]; 2] {
        let (axis, [.., inertia]) = (unit(freedom), &self.by);
        let by_q = inertia.dot(&pull.moving(&axis));
        let by_velocity = self.sensitivity.at(freedom).clone() + inertia.dot(&velocity.moving(&axis));
        let on = self.by.each_ref().map(|change| change.at(freedom).clone());
        [on, [by_q, by_velocity, inertia.at(freedom).clone()]]
    }

    /// The derivatives for a degree of freedom of the base itself.
    pub fn of_base(base: &Composite<S>, freedom: usize, velocity: &Six<S>, pull: &Six<S>) -> Self {
        let (axis, turning) = (unit(freedom), velocity.moving(&unit(freedom)));
        ForceDerivatives::new(base, &axis, &Six::zero(), &pull.moving(&axis), &turning)
    }
}

impl<S: Scalar> Data<S> {
    /// Computes the derivatives of the torques of a motion. For a floating base, `pull` is added to its acceleration:
    /// minus gravity.
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
            let mut changes =
                ForceDerivatives::new(&self.composites[joint], &axis, turning, bend, &turning.add(turning));
            changes.by[0] = changes.by[0].add(&body.force_rate(&self.forces[joint]));
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
            self.propagate(tree, joint, &mut base);
        }
        for column in 0..first {
            let changes = ForceDerivatives::of_base(&base, column, &motion.base, pull);
            (0..first)
                .for_each(|row| out.enter(row, column, changes.by.each_ref().map(|change| change.at(row).clone())));
        }
    }

    /// Computes the second rates of the joint axes from the acceleration and the velocity of the parents.
    fn bend(&mut self, tree: &Tree<S>, motion: &Motion<'_, S>) {
        for (joint, body) in tree.bodies.iter().enumerate() {
            let moving = (&self.velocities[joint], &self.accelerations[joint]);
            self.bends[joint] = body.bend(moving, &self.turnings[joint], &motion.rates[joint]);
        }
    }
}

impl<S: Scalar> Body<S> {
    /// The second rate of the joint's axis, from the acceleration and the velocity of the parent.
    pub fn bend(&self, (velocity, acceleration): (&Six<S>, &Six<S>), turning: &Six<S>, rate: &S) -> Six<S> {
        let acceleration = acceleration.add(&turning.scaled(rate).negated());
        let mut velocity = velocity.clone();
        self.add_motion(&mut velocity, -rate.clone());
        self.turning(&acceleration, &S::one()).add(&velocity.moving(turning))
    }
}

impl<S: Scalar> Derivatives<S> {
    /// Enters the coupling of a joint with the degrees of freedom of the base.
    fn enter_base(
        &mut self,
        count: usize,
        joint: usize,
        changes: &ForceDerivatives<S>,
        velocity: &Six<S>,
        pull: &Six<S>,
    ) {
        for freedom in 0..count {
            let [on, sensitivity] = changes.with_base(freedom, velocity, pull);
            self.enter(freedom, joint, on);
            self.enter(joint, freedom, sensitivity);
        }
    }
}
