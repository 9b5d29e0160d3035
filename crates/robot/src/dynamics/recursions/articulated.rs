//! Forward dynamics by articulated bodies. Main type: [`Articulation`].
//!
//! R. Featherstone, Rigid Body Dynamics Algorithms (2008), table 7.1, and section 9.2 for a base that moves freely.

use super::data::{Data, bias};
use super::scalar::{Divisible, Scalar};
use super::six::{Frame, Mass, Matrix, Six, Three, add, cross, dot, turned, turned_back};
use super::tree::{Body, Freedom, Tree};

/// What a body with all that it carries sets against a force: the momentum is `L v + H w` and `H' v + A w`.
#[derive(Clone, Debug)]
pub struct Resistance<S> {
    /// `L`.
    pub linear: Matrix<S>,
    /// `H`.
    pub coupling: Matrix<S>,
    /// `A`.
    pub angular: Matrix<S>,
}

/// What a joint yields to a force on what it carries.
#[derive(Clone, Debug)]
pub struct Yielding<S> {
    /// The force that a unit acceleration of the joint asks for.
    pub push: Six<S>,
    /// Its part along the joint, with the rotor's.
    pub pivot: S,
    /// What the torque exceeds the bias by.
    pub excess: S,
}

/// Room for forward dynamics on one tree: it is made once, and calls allocate nothing.
#[derive(Clone, Debug)]
pub struct Articulation<S> {
    bodies: Vec<Articulated<S>>,
}

/// What is found of a body on the way.
#[derive(Clone, Debug)]
struct Articulated<S> {
    resistance: Resistance<S>,
    /// The force that it asks for without any acceleration of its parent and its joint.
    bias: Six<S>,
    /// What the turning of the joint's axis adds to the acceleration.
    turning: Six<S>,
    yielding: Yielding<S>,
    acceleration: Six<S>,
}

/// What moves a tree.
#[derive(Clone, Debug)]
pub struct Drive<'a, S> {
    /// The velocity of the base, in its own frame.
    pub base: Six<S>,
    /// A base that stands still accelerates so, by minus gravity; one that moves freely is pushed by this force besides, and gravity comes with what is found.
    pub base_cause: Cause<S>,
    /// The joints' rates, and their torques.
    pub rates: &'a [S],
    /// As `rates` tells.
    pub torques: &'a [S],
    /// What acts from outside on the bodies, in their own frames, the base first; of nothing an empty list.
    pub outside: &'a [Six<S>],
    /// By joint, the inertia of its rotor.
    pub rotors: &'a [S],
}

/// Why a base moves.
#[derive(Clone, Debug)]
pub enum Cause<S> {
    /// It accelerates so, less gravity.
    Acceleration(Six<S>),
    /// It moves freely under this force.
    Force(Six<S>),
}

/// A joint of which the bodies that it moves have no mass, or the base.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Massless(pub Option<usize>);

impl<S: Scalar> Resistance<S> {
    /// That of a rigid body.
    pub fn of(mass: &Mass<S>) -> Self {
        let [x, y, z] = mass.moment.clone();
        let [xx, xy, yy, xz, yz, zz] = mass.tensor.clone();
        let diagonal = |i: usize| std::array::from_fn(|j| if i == j { mass.mass.clone() } else { S::zero() });
        Resistance {
            linear: std::array::from_fn(diagonal),
            coupling: [[S::zero(), z.clone(), -y.clone()], [-z, S::zero(), x.clone()], [y, -x, S::zero()]],
            angular: [[xx, xy.clone(), xz.clone()], [xy, yy, yz.clone()], [xz, yz, zz]],
        }
    }

    fn times(&self, motion: &Six<S>) -> Six<S> {
        Six {
            linear: add(&turned(&self.linear, &motion.linear), &turned(&self.coupling, &motion.angular)),
            angular: add(&turned_back(&self.coupling, &motion.linear), &turned(&self.angular, &motion.angular)),
        }
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        let sum = |a: &Matrix<S>, b: &Matrix<S>| std::array::from_fn(|i| add(&a[i], &b[i]));
        Resistance {
            linear: sum(&self.linear, &other.linear),
            coupling: sum(&self.coupling, &other.coupling),
            angular: sum(&self.angular, &other.angular),
        }
    }

    /// The size of its inertia against turning or sliding: the trace.
    fn size(&self, freedom: Freedom) -> S {
        let [x, y, z] = match freedom {
            Freedom::Turn => &self.angular,
            Freedom::Slide => &self.linear,
        };
        x[0].clone() + y[1].clone() + z[2].clone()
    }

    /// The same in the parent's frame, in which the body's stands so.
    fn outward(&self, frame: &Frame<S>) -> Self {
        let (r, p) = (&frame.rotation, &frame.position);
        let rotated = |x: &Matrix<S>| -> Matrix<S> {
            std::array::from_fn(|i| {
                let row: Three<S> = turned_back(x, &r[i]);
                std::array::from_fn(|j| dot(&row, &r[j]))
            })
        };
        let (linear, coupling, angular) = (rotated(&self.linear), rotated(&self.coupling), rotated(&self.angular));
        // With X the matrix of the cross product by p: H - L X, and A - H' X + X (H - L X).
        let moved: Matrix<S> = std::array::from_fn(|i| {
            let crossed = cross(&linear[i], p);
            std::array::from_fn(|j| coupling[i][j].clone() - crossed[j].clone())
        });
        let column = |x: &Matrix<S>, j: usize| -> Three<S> { std::array::from_fn(|i| x[i][j].clone()) };
        let above: [Three<S>; 3] = std::array::from_fn(|j| cross(p, &column(&moved, j)));
        let angular = std::array::from_fn(|i| {
            let crossed = cross(&column(&coupling, i), p);
            std::array::from_fn(|j| angular[i][j].clone() - crossed[j].clone() + above[j][i].clone())
        });
        Resistance { linear, coupling: moved, angular }
    }
}

impl<S: Divisible> Resistance<S> {
    /// Without what the joint yields to: less `U U' / pivot`.
    fn yielding(&self, push: &Six<S>, pivot: &S) -> Self {
        let less = |x: &Matrix<S>, a: &Three<S>, b: &Three<S>| -> Matrix<S> {
            std::array::from_fn(|i| {
                let share = a[i].clone() / pivot.clone();
                std::array::from_fn(|j| x[i][j].clone() - share.clone() * b[j].clone())
            })
        };
        Resistance {
            linear: less(&self.linear, &push.linear, &push.linear),
            coupling: less(&self.coupling, &push.linear, &push.angular),
            angular: less(&self.angular, &push.angular, &push.angular),
        }
    }

    /// The acceleration that a force gives, by elimination without pivoting: of what has mass the pivots are positive beside the size of the inertia.
    pub fn solve(&self, force: &Six<S>, is_positive: impl Fn(&S, &S) -> bool) -> Option<Six<S>> {
        let entry = |i: usize, j: usize| match (i / 3, j / 3) {
            (0, 0) => self.linear[i][j].clone(),
            (0, _) => self.coupling[i][j - 3].clone(),
            (_, 0) => self.coupling[j][i - 3].clone(),
            _ => self.angular[i - 3][j - 3].clone(),
        };
        let mut rows: [[S; 6]; 6] = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
        let mut right: [S; 6] = std::array::from_fn(|i| force.at(i).clone());
        for k in 0..6 {
            let size = self.size(if k < 3 { Freedom::Slide } else { Freedom::Turn });
            if !is_positive(&rows[k][k], &size) {
                return None;
            }
            let pivot = rows[k].clone();
            for i in k + 1..6 {
                let factor = rows[i][k].clone() / pivot[k].clone();
                for (entry, above) in rows[i].iter_mut().zip(&pivot).skip(k + 1) {
                    *entry = entry.clone() - factor.clone() * above.clone();
                }
                right[i] = right[i].clone() - factor * right[k].clone();
            }
        }
        let mut solution: Six<S> = Six::zero();
        for k in (0..6).rev() {
            let known = (k + 1..6).fold(S::zero(), |sum, j| sum + rows[k][j].clone() * solution.at(j).clone());
            *solution.at_mut(k) = (right[k].clone() - known) / rows[k][k].clone();
        }
        Some(solution)
    }
}

impl<S: Divisible> Yielding<S> {
    /// That of a joint with a rotor under a torque, whose bodies ask for a force without acceleration.
    pub fn of(carried: &Resistance<S>, body: &Body<S>, bias: &Six<S>, torque: &S, rotor: &S) -> Self {
        let push = carried.times(&body.axis());
        let pivot = body.along(&push).clone() + rotor.clone();
        Yielding { pivot, excess: torque.clone() - body.along(bias).clone(), push }
    }

    /// What is left of resistance and bias for the parent, in whose frame the body's stands so.
    pub fn hand_on(
        &self,
        carried: &Resistance<S>,
        bias: &Six<S>,
        turning: &Six<S>,
        frame: &Frame<S>,
    ) -> (Resistance<S>, Six<S>) {
        let left = carried.yielding(&self.push, &self.pivot);
        let share = self.excess.clone() / self.pivot.clone();
        let bias = bias.add(&left.times(turning)).add(&self.push.scaled(&share));
        (left.outward(frame), frame.force_outward(&bias))
    }

    /// What the joint's rate changes by where it is carried so.
    pub fn change(&self, carried: &Six<S>) -> S {
        (self.excess.clone() - self.push.dot(carried)) / self.pivot.clone()
    }
}

impl<S: Divisible> Articulation<S> {
    /// Room for forward dynamics on a tree.
    pub fn new(tree: &Tree<S>) -> Self {
        let body = Articulated {
            resistance: Resistance::of(&Mass::zero()),
            bias: Six::zero(),
            turning: Six::zero(),
            yielding: Yielding { push: Six::zero(), pivot: S::zero(), excess: S::zero() },
            acceleration: Six::zero(),
        };
        Articulation { bodies: vec![body; tree.bodies.len()] }
    }

    /// What the joints' rates change by, and the acceleration of the base less gravity; the joints stand where `data` has placed them. `is_positive` decides whether an inertia along a
    /// freedom is one, beside the size of the inertia in all directions.
    ///
    /// # Errors
    /// The joint, or the base, that moves no mass.
    pub fn forward(
        &mut self,
        tree: &Tree<S>,
        data: &mut Data<S>,
        drive: &Drive<'_, S>,
        is_positive: impl Fn(&S, &S) -> bool + Copy,
        accelerations: &mut [S],
    ) -> Result<Six<S>, Massless> {
        data.move_bodies(tree, &drive.base, drive.rates);
        for (joint, (body, own)) in tree.bodies.iter().zip(&mut self.bodies).enumerate() {
            let velocity = &data.velocities[joint];
            own.resistance = Resistance::of(&body.mass);
            own.bias = bias(&body.mass, velocity, drive.outside.get(joint + 1));
            own.turning = body.turning(velocity, &drive.rates[joint]);
        }
        let mut base = Resistance::of(&tree.base);
        let mut base_bias = bias(&tree.base, &drive.base, drive.outside.first());
        for &joint in tree.order.iter().rev() {
            let (body, own) = (&tree.bodies[joint], &mut self.bodies[joint]);
            own.yielding = Yielding::of(&own.resistance, body, &own.bias, &drive.torques[joint], &drive.rotors[joint]);
            if !is_positive(&own.yielding.pivot, &own.resistance.size(body.freedom)) {
                return Err(Massless(Some(joint)));
            }
            let (outward, bias) = own.yielding.hand_on(&own.resistance, &own.bias, &own.turning, &data.frames[joint]);
            let (resistance, below) = match body.parent {
                None => (&mut base, &mut base_bias),
                Some(parent) => {
                    let Articulated { resistance, bias, .. } = &mut self.bodies[parent];
                    (resistance, bias)
                }
            };
            (*resistance, *below) = (resistance.plus(&outward), below.add(&bias));
        }
        let base_acceleration = match &drive.base_cause {
            Cause::Acceleration(told) => told.clone(),
            Cause::Force(force) => base.solve(&force.add(&base_bias.negated()), is_positive).ok_or(Massless(None))?,
        };
        for &joint in &tree.order {
            let body = &tree.bodies[joint];
            let carrier = body.parent.map_or(&base_acceleration, |parent| &self.bodies[parent].acceleration);
            let carried = data.frames[joint].motion_inward(carrier).add(&self.bodies[joint].turning);
            let own = &mut self.bodies[joint];
            let change = own.yielding.change(&carried);
            own.acceleration = carried;
            body.quicken(&mut own.acceleration, change.clone());
            accelerations[joint] = change;
        }
        Ok(base_acceleration)
    }
}
