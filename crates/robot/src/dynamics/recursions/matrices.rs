//! The inertia matrix (CRBA) and the Coriolis matrix by composite rigid bodies. Main type: [`Matrices`].
//!
//! R. Featherstone, Rigid Body Dynamics Algorithms (2008), table 6.2. The Coriolis matrix has Christoffel symbols: S.
//! Echeandia and P. M. Wensing, J. Mechanisms and Robotics 13 (2021), here with their 36 numbers for each body replaced
//! by the rate of ten inertial parameters and a momentum.

use super::composite::Composite;
use super::data::{Data, unit};
use super::scalar::Scalar;
use super::six::{Frame, Six};
use super::tree::{Body, Tree};

/// Square matrices in row-major order. A floating base has the first six degrees of freedom.
#[derive(Clone, Debug)]
pub struct Matrices<S> {
    /// Number of rows and columns.
    pub size: usize,
    /// The inertia matrix.
    pub inertia: Vec<S>,
    /// The Coriolis matrix.
    pub coriolis: Vec<S>,
}

impl<S: Scalar> Matrices<S> {
    /// Allocates the matrices for a number of degrees of freedom.
    pub fn new(size: usize) -> Self {
        Matrices { size, inertia: vec![S::zero(); size * size], coriolis: vec![S::zero(); size * size] }
    }

    fn enter_inertia(&mut self, carrier: usize, carried: usize, entry: &S) {
        self.inertia[carrier * self.size + carried] = entry.clone();
        self.inertia[carried * self.size + carrier] = entry.clone();
    }
}

/// Forces on the composite body of a joint for a unit velocity: by the inertia, the Coriolis matrix and its transpose.
pub struct UnitForces<S> {
    /// Force by the inertia.
    pub inertia: Six<S>,
    /// Force by the Coriolis matrix.
    pub coriolis: Six<S>,
    /// Force by the transposed Coriolis matrix.
    pub transposed: Six<S>,
}

impl<S: Scalar> UnitForces<S> {
    /// Computes the forces for a joint with this axis that carries the composite `carried`.
    pub fn new(carried: &Composite<S>, inertia: Six<S>, axis: &Six<S>, turning: &Six<S>) -> Self {
        let coriolis = carried.mass.times(turning).add(&carried.coriolis(axis).half());
        UnitForces { inertia, coriolis, transposed: carried.coriolis_transposed(axis).half() }
    }

    /// Transforms the forces to the parent's frame.
    pub fn outward(&self, frame: &Frame<S>) -> Self {
        let [inertia, coriolis, transposed] =
            [&self.inertia, &self.coriolis, &self.transposed].map(|push| frame.force_outward(push));
        UnitForces { inertia, coriolis, transposed }
    }

    /// The Coriolis entry of this degree of freedom for a carrying joint, whose axis has the rate `turning`.
    pub fn of_carrier(&self, carrier: &Body<S>, turning: &Six<S>) -> S {
        turning.dot(&self.inertia) + carrier.along(&self.transposed).clone()
    }

    /// The Coriolis entry of this degree of freedom for one of the base.
    pub fn of_base(&self, freedom: usize, velocity: &Six<S>) -> S {
        velocity.moving(&unit(freedom)).dot(&self.inertia) + self.transposed.at(freedom).clone()
    }
}

impl<S: Scalar> Data<S> {
    /// Computes the inertia matrix (CRBA), with the base's six degrees of freedom or for the joints alone.
    pub fn inertia(&mut self, tree: &Tree<S>, out: &mut Matrices<S>) {
        let first = out.size - tree.bodies.len();
        out.inertia.iter_mut().for_each(|entry| *entry = S::zero());
        for (whole, body) in self.masses.iter_mut().zip(&tree.bodies) {
            *whole = body.mass.clone();
        }
        let mut base = tree.base.clone();
        for &joint in tree.order.iter().rev() {
            let body = &tree.bodies[joint];
            let mut push = body.momentum(&self.masses[joint]);
            out.enter_inertia(first + joint, first + joint, body.along(&push));
            let (mut at, mut carrier) = (joint, body.parent);
            while let Some(parent) = carrier {
                push = self.frames[at].force_outward(&push);
                out.enter_inertia(first + parent, first + joint, tree.bodies[parent].along(&push));
                (at, carrier) = (parent, tree.bodies[parent].parent);
            }
            if first > 0 {
                push = self.frames[at].force_outward(&push);
                (0..first).for_each(|freedom| out.enter_inertia(freedom, first + joint, push.at(freedom)));
            }
            if first > 0 || body.parent.is_some() {
                let outward = self.masses[joint].outward(&self.frames[joint]);
                let below = body.parent.map_or(&mut base, |parent| &mut self.masses[parent]);
                *below = below.plus(&outward);
            }
        }
        for column in 0..first {
            let push = base.times(&unit(column));
            (0..=column).for_each(|row| out.enter_inertia(row, column, push.at(row)));
        }
    }

    /// Computes the inertia and the Coriolis matrix for a velocity of base and joints. The base's six degrees of
    /// freedom are included if the base is floating. `M' - 2 C` is skew-symmetric.
    pub fn matrices(&mut self, tree: &Tree<S>, velocity: &Six<S>, rates: &[S], out: &mut Matrices<S>) {
        let first = out.size - tree.bodies.len();
        out.inertia.iter_mut().chain(&mut out.coriolis).for_each(|entry| *entry = S::zero());
        self.move_bodies(tree, velocity, rates);
        self.compose(tree);
        let mut base = Composite::of(&tree.base, velocity);
        for &joint in tree.order.iter().rev() {
            let body = &tree.bodies[joint];
            let carried = &self.composites[joint];
            let mut pushes =
                UnitForces::new(carried, body.momentum(&carried.mass), &body.axis(), &self.turnings[joint]);
            let mut at = Some(joint);
            while let Some(carrier) = at {
                let body = &tree.bodies[carrier];
                let along = |force: &Six<S>| body.along(force).clone();
                let [row, column] = [first + carrier, first + joint];
                out.enter_inertia(row, column, &along(&pushes.inertia));
                if carrier != joint {
                    out.coriolis[column * out.size + row] = pushes.of_carrier(body, &self.turnings[carrier]);
                }
                out.coriolis[row * out.size + column] = along(&pushes.coriolis);
                pushes = pushes.outward(&self.frames[carrier]);
                at = body.parent;
            }
            out.enter_base(first, first + joint, &pushes, velocity);
            self.propagate(tree, joint, &mut base);
        }
        for column in 0..first {
            let (axis, turning) = (unit(column), velocity.moving(&unit(column)));
            let pushes = UnitForces::new(&base, base.mass.times(&axis), &axis, &turning);
            out.enter_base(column + 1, column, &pushes, velocity);
        }
    }
}

impl<S: Scalar> Matrices<S> {
    /// Enters the coupling of a degree of freedom with the first ones of the base.
    fn enter_base(&mut self, count: usize, carried: usize, pushes: &UnitForces<S>, velocity: &Six<S>) {
        for row in 0..count {
            self.enter_inertia(row, carried, pushes.inertia.at(row));
            if row != carried {
                self.coriolis[carried * self.size + row] = pushes.of_base(row, velocity);
            }
            self.coriolis[row * self.size + carried] = pushes.coriolis.at(row).clone();
        }
    }
}
