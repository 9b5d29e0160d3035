//! Forward dynamics by the articulated-body algorithm (ABA). Main type: [`ArticulatedBodies`].
//!
//! R. Featherstone, Rigid Body Dynamics Algorithms (2008), table 7.1, and section 9.2 for a floating base.

use super::data::{Data, bias};
use super::scalar::{Divisible, Scalar};
use super::six::{Frame, Mass, Matrix, Six, Three, add, cross, dot, turned, turned_back};
use super::tree::{Body, Freedom, Tree};

/// Articulated-body inertia in the frame of a body. For a motion `(v, w)` the force is `(L v + H w, H' v + A w)`.
#[derive(Clone, Debug)]
pub struct ArticulatedInertia<S> {
    /// The matrix `L`.
    pub linear: Matrix<S>,
    /// The matrix `H`.
    pub coupling: Matrix<S>,
    /// The matrix `A`.
    pub angular: Matrix<S>,
}

/// The terms of a joint in the ABA: `U`, `D` and `u` of Featherstone's table 7.1.
#[derive(Clone, Debug)]
pub struct ArticulatedJoint<S> {
    /// `U`: the articulated-body inertia times the joint's axis.
    pub force: Six<S>,
    /// `D`: the component of `U` along the joint, plus the rotor inertia.
    pub inertia: S,
    /// `u`: the joint torque minus the component of the bias force along the joint.
    pub torque: S,
}

/// Working memory of the ABA for one tree. It is allocated once, and calls allocate nothing.
#[derive(Clone, Debug)]
pub struct ArticulatedBodies<S> {
    bodies: Vec<ArticulatedBody<S>>,
}

/// Intermediate results of a body.
#[derive(Clone, Debug)]
struct ArticulatedBody<S> {
    inertia: ArticulatedInertia<S>,
    /// The articulated-body bias force.
    bias: Six<S>,
    /// The velocity-product acceleration: velocity times joint motion.
    turning: Six<S>,
    joint: ArticulatedJoint<S>,
    acceleration: Six<S>,
}

/// Inputs of forward dynamics.
#[derive(Clone, Debug)]
pub struct Drive<'a, S> {
    /// The velocity of the base, in its own frame.
    pub base: Six<S>,
    /// Cause of the base's motion.
    pub base_cause: Cause<S>,
    /// The joint velocities.
    pub rates: &'a [S],
    /// The joint torques.
    pub torques: &'a [S],
    /// External wrenches on the bodies in their own frames, the base first; empty when there are none.
    pub outside: &'a [Six<S>],
    /// The rotor inertia of each joint.
    pub rotors: &'a [S],
}

/// Cause of the base's motion.
#[derive(Clone, Debug)]
pub enum Cause<S> {
    /// A prescribed acceleration minus gravity; for a fixed base, minus gravity.
    Acceleration(Six<S>),
    /// A floating base under this force. Gravity is added to the resulting acceleration.
    Force(Six<S>),
}

/// A joint that moves no mass; `None` for the base.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Massless(pub Option<usize>);

impl<S: Scalar> ArticulatedInertia<S> {
    /// The inertia of a rigid body.
    pub fn of(mass: &Mass<S>) -> Self {
        let [x, y, z] = mass.moment.clone();
        let [xx, xy, yy, xz, yz, zz] = mass.tensor.clone();
        let diagonal = |i: usize| std::array::from_fn(|j| if i == j { mass.mass.clone() } else { S::zero() });
        ArticulatedInertia {
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
        ArticulatedInertia {
            linear: sum(&self.linear, &other.linear),
            coupling: sum(&self.coupling, &other.coupling),
            angular: sum(&self.angular, &other.angular),
        }
    }

    /// The size of the rotational or translational inertia: the trace.
    fn size(&self, freedom: Freedom) -> S {
        let [x, y, z] = match freedom {
            Freedom::Turn => &self.angular,
            Freedom::Slide => &self.linear,
        };
        x[0].clone() + y[1].clone() + z[2].clone()
    }

    /// Transforms the inertia to the parent's frame. `frame` is the body's frame in the parent's.
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
        ArticulatedInertia { linear, coupling: moved, angular }
    }
}

impl<S: Divisible> ArticulatedInertia<S> {
    /// The inertia without the joint's degree of freedom: minus `U U' / D`.
    fn without_joint(&self, force: &Six<S>, inertia: &S) -> Self {
        let less = |x: &Matrix<S>, a: &Three<S>, b: &Three<S>| -> Matrix<S> {
            std::array::from_fn(|i| {
                let share = a[i].clone() / inertia.clone();
                std::array::from_fn(|j| x[i][j].clone() - share.clone() * b[j].clone())
            })
        };
        ArticulatedInertia {
            linear: less(&self.linear, &force.linear, &force.linear),
            coupling: less(&self.coupling, &force.linear, &force.angular),
            angular: less(&self.angular, &force.angular, &force.angular),
        }
    }

    /// Solves for the acceleration that a force causes, by elimination without pivoting. For a positive mass, all
    /// pivots are positive relative to the size of the inertia.
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

impl<S: Divisible> ArticulatedJoint<S> {
    /// Computes the terms of a joint with its rotor, torque and bias force.
    pub fn of(carried: &ArticulatedInertia<S>, body: &Body<S>, bias: &Six<S>, torque: &S, rotor: &S) -> Self {
        let force = carried.times(&body.axis());
        let inertia = body.along(&force).clone() + rotor.clone();
        ArticulatedJoint { inertia, torque: torque.clone() - body.along(bias).clone(), force }
    }

    /// Propagates the articulated-body inertia and the bias force to the parent. `frame` is the body's frame in the
    /// parent's.
    pub fn propagate(
        &self,
        carried: &ArticulatedInertia<S>,
        bias: &Six<S>,
        turning: &Six<S>,
        frame: &Frame<S>,
    ) -> (ArticulatedInertia<S>, Six<S>) {
        let remaining = carried.without_joint(&self.force, &self.inertia);
        let share = self.torque.clone() / self.inertia.clone();
        let bias = bias.add(&remaining.times(turning)).add(&self.force.scaled(&share));
        (remaining.outward(frame), frame.force_outward(&bias))
    }

    /// The joint acceleration for the parent's acceleration `carried` in the body's frame.
    pub fn acceleration(&self, carried: &Six<S>) -> S {
        (self.torque.clone() - self.force.dot(carried)) / self.inertia.clone()
    }
}

impl<S: Divisible> ArticulatedBodies<S> {
    /// Allocates the working memory for a tree.
    pub fn new(tree: &Tree<S>) -> Self {
        let body = ArticulatedBody {
            inertia: ArticulatedInertia::of(&Mass::zero()),
            bias: Six::zero(),
            turning: Six::zero(),
            joint: ArticulatedJoint { force: Six::zero(), inertia: S::zero(), torque: S::zero() },
            acceleration: Six::zero(),
        };
        ArticulatedBodies { bodies: vec![body; tree.bodies.len()] }
    }

    /// Computes the joint accelerations, and returns the acceleration of the base minus gravity. The joint positions
    /// are those of `data`. `is_positive` decides whether an inertia along a degree of freedom is positive, relative to
    /// the inertia in all directions.
    ///
    /// # Errors
    /// The joint that moves no mass, or the base.
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
            own.inertia = ArticulatedInertia::of(&body.mass);
            own.bias = bias(&body.mass, velocity, drive.outside.get(joint + 1));
            own.turning = body.turning(velocity, &drive.rates[joint]);
        }
        let mut base = ArticulatedInertia::of(&tree.base);
        let mut base_bias = bias(&tree.base, &drive.base, drive.outside.first());
        for &joint in tree.order.iter().rev() {
            let (body, own) = (&tree.bodies[joint], &mut self.bodies[joint]);
            own.joint =
                ArticulatedJoint::of(&own.inertia, body, &own.bias, &drive.torques[joint], &drive.rotors[joint]);
            if !is_positive(&own.joint.inertia, &own.inertia.size(body.freedom)) {
                return Err(Massless(Some(joint)));
            }
            let (outward, bias) = own.joint.propagate(&own.inertia, &own.bias, &own.turning, &data.frames[joint]);
            let (inertia, below) = match body.parent {
                None => (&mut base, &mut base_bias),
                Some(parent) => {
                    let ArticulatedBody { inertia, bias, .. } = &mut self.bodies[parent];
                    (inertia, bias)
                }
            };
            (*inertia, *below) = (inertia.plus(&outward), below.add(&bias));
        }
        let base_acceleration = match &drive.base_cause {
            Cause::Acceleration(given) => given.clone(),
            Cause::Force(force) => base.solve(&force.add(&base_bias.negated()), is_positive).ok_or(Massless(None))?,
        };
        for &joint in &tree.order {
            let body = &tree.bodies[joint];
            let carrier = body.parent.map_or(&base_acceleration, |parent| &self.bodies[parent].acceleration);
            let carried = data.frames[joint].motion_inward(carrier).add(&self.bodies[joint].turning);
            let own = &mut self.bodies[joint];
            let change = own.joint.acceleration(&carried);
            own.acceleration = carried;
            body.add_motion(&mut own.acceleration, change.clone());
            accelerations[joint] = change;
        }
        Ok(base_acceleration)
    }
}
