//! The equations that measure and polish each solution: forward kinematics minus the target, with derivatives by the joints.
//!
//! The frame of each joint is transformed along the chain (RH0 2-20). Column j of the Jacobian is the twist of joint j at the tip (RH0 2-43): `z x (p - o)` and
//! `z x R` for a revolute joint, `z` and 0 for a prismatic one.

use num_traits::{One, ToPrimitive};

use super::emit::{Emitted, Emitter};
use super::layout::Layout;
use crate::derive::closure::{Arithmetic, Mechanism, ScrewJoint};
use crate::derive::equations::assemble::{Assembler, of_least_work};
use crate::solver::{Checks, JointValue, Operand, Short};
use groebot_algebra::number::BigRational;
use groebot_robot::kinematics::{BaseAxis, ExactVector, Plane, Task};

type Vector = [Emitted; 3];

/// The checks of a mechanism, with unknowns and parameters at the indices of `layout`. Of several lengths of sums, the one that gives the shortest code for
/// measuring a candidate is used. `reach` is the size of the positions.
pub(super) fn checks(mechanism: &Mechanism, layout: &Layout, reach: f64) -> Checks {
    let short = Checks { short: Vec::new(), ..polishing(mechanism, layout, reach) };
    short.pruned()
}

/// Same as [`checks`], but with the short equations for fast polishing.
pub(super) fn polishing(mechanism: &Mechanism, layout: &Layout, reach: f64) -> Checks {
    let mechanism = mechanism.plain();
    let [usual, others @ ..] = Assembler::variants().map(|assembler| written(mechanism, layout, reach, assembler));
    of_least_work(usual, others, Checks::work)
}

fn written(mechanism: &Mechanism, layout: &Layout, reach: f64, mut assembler: Assembler) -> Checks {
    let mut forward = Forward::new(mechanism, layout, &mut assembler);
    mechanism.driven().iter().enumerate().for_each(|(index, joint)| forward.pass(index, joint));
    forward.compare(mechanism, reach);
    let mut checks = forward.checks;
    checks.code = assembler.take();
    checks.pruned()
}

/// Forward kinematics from the base to a joint of the chain, as code.
struct Forward<'a> {
    emitter: Emitter<'a>,
    layout: &'a Layout,
    /// The rotation, by columns.
    rotation: [Vector; 3],
    position: Vector,
    /// The twist of each joint so far: its unit axis and, for a revolute joint, a point of it.
    twists: Vec<(Vector, Option<Vector>)>,
    /// The sum of the magnitudes of all prismatic displacements.
    shifts: Operand,
    checks: Checks,
}

impl<'a> Forward<'a> {
    fn new(mechanism: &Mechanism, layout: &'a Layout, assembler: &'a mut Assembler) -> Self {
        let number = |here: bool| Emitted::integer(i32::from(here));
        Forward {
            emitter: Emitter(assembler),
            layout,
            rotation: std::array::from_fn(|column| std::array::from_fn(|row| number(row == column))),
            position: std::array::from_fn(|_| number(false)),
            twists: Vec::with_capacity(mechanism.driven().len()),
            shifts: Operand::Constant(0.0),
            checks: Checks::default(),
        }
    }

    /// Adds a joint.
    fn pass(&mut self, index: usize, joint: &ScrewJoint) {
        let unit = 1.0 / joint.square.to_f64().unwrap_or(1.0).sqrt();
        let along = self.turned(&joint.axis);
        let axis = along.clone().map(|entry| entry.times(unit));
        match self.layout.joints[index] {
            JointValue::Plain(unknown) => {
                let shift = Emitted::code(Operand::Unknown(unknown));
                let size = self.emitter.0.abs(Operand::Unknown(unknown));
                self.shifts = self.emitter.0.add(self.shifts, size);
                self.position = std::array::from_fn(|k| self.add_product(&self.position[k].clone(), &axis[k], &shift));
                self.twists.push((axis, None));
            }
            JointValue::Angle { cosine, sine } => {
                let centre = self.moved(&joint.point);
                self.rotation = self.turn(joint, Operand::Unknown(cosine), Operand::Unknown(sine), unit);
                let arm = self.turned(&joint.point);
                self.position = std::array::from_fn(|k| self.emitter.sub(&centre[k], &arm[k]));
                self.twists.push((axis, Some(centre)));
            }
        }
    }

    /// The rotation after a joint: the columns of `R (c + s' [w] + (1 - c) w w^T / n)`.
    fn turn(&mut self, joint: &ScrewJoint, cosine: Operand, sine: Operand, unit: f64) -> [Vector; 3] {
        let cosine = Emitted::code(cosine);
        let sine = Emitted::code(sine).times(unit);
        let versine = self.emitter.sub(&Emitted::integer(1), &cosine);
        let w = &joint.axis;
        let columns: [Vector; 3] = std::array::from_fn(|column| {
            std::array::from_fn(|row| {
                let square = Emitted::number(&w[row] * &w[column] / &joint.square);
                let straight = self.emitter.mul(&versine, &square);
                let turned = if row == column {
                    cosine.clone()
                } else {
                    let other = 3 - row - column;
                    let sign = if (row + 1) % 3 == column { -BigRational::one() } else { BigRational::one() };
                    self.emitter.mul(&sine, &Emitted::number(&w[other] * sign))
                };
                self.emitter.add(&turned, &straight)
            })
        });
        columns.map(|column| self.combination(&column))
    }

    /// `R v` for a vector with emitted coordinates.
    fn combination(&mut self, v: &Vector) -> Vector {
        let rotation = self.rotation.clone();
        std::array::from_fn(|row| {
            (0..3).fold(Emitted::integer(0), |sum, column| self.add_product(&sum, &rotation[column][row], &v[column]))
        })
    }

    fn turned(&mut self, v: &ExactVector) -> Vector {
        self.combination(&v.each_ref().map(|entry| Emitted::number(entry.clone())))
    }

    fn moved(&mut self, point: &ExactVector) -> Vector {
        let turned = self.turned(point);
        std::array::from_fn(|k| self.emitter.add(&self.position[k], &turned[k]))
    }

    fn add_product(&mut self, sum: &Emitted, a: &Emitted, b: &Emitted) -> Emitted {
        let product = self.emitter.mul(a, b);
        self.emitter.add(sum, &product)
    }

    fn cross(&mut self, a: &Vector, b: &Vector) -> Vector {
        std::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let (left, right) = (self.emitter.mul(&a[i], &b[j]), self.emitter.mul(&a[j], &b[i]));
            self.emitter.sub(&left, &right)
        })
    }

    /// The equations of the task, and of the joints that are given.
    fn compare(&mut self, mechanism: &Mechanism, reach: f64) {
        let task = mechanism.task();
        let tip = self.moved(mechanism.tip_point());
        let columns: [Vector; 3] = std::array::from_fn(|column| {
            self.turned(&mechanism.tip_rotation().each_ref().map(|row| row[column].clone()))
        });
        let size = self.emitter.0.add(Operand::Constant(reach), self.shifts);
        match task {
            Task::Pose | Task::Position | Task::Ray | Task::PositionPitchRoll | Task::PositionYaw { .. } => {
                self.at(&tip, &[0, 1, 2], 0, size);
            }
            Task::PlanarPosition { plane } | Task::PlanarPose { plane } => self.at(&tip, &plane.coordinates(), 0, size),
            Task::Direction | Task::Rotation => {}
        }
        match task {
            Task::Pose => self.oriented(&columns, 3),
            Task::Rotation => self.oriented(&columns, 0),
            Task::Ray => self.aimed(mechanism, 3),
            Task::Direction => self.aimed(mechanism, 0),
            Task::PlanarPose { plane } => self.tilted(&columns, plane),
            Task::PositionPitchRoll => self.upright(&columns),
            Task::PositionYaw { axis } => self.pointing(mechanism, axis),
            Task::Position | Task::PlanarPosition { .. } => {}
        }
        match task {
            Task::Pose => self.shortened(3, &columns),
            Task::Rotation => self.shortened(0, &columns),
            _ => self.shortened(self.checks.residuals.len(), &columns),
        }
        mechanism.given().iter().for_each(|&joint| self.given(joint));
        for (joint, screw) in mechanism.driven().iter().enumerate() {
            if let Some((leader, [factor, offset])) = screw.follows.filter(|_| !mechanism.given().contains(&joint)) {
                self.follows(joint, leader, factor, offset);
            }
        }
    }

    /// Sets the short equations: the first `count` equations and, if there are more, the rotation vector from the target to the frame with these columns. That
    /// vector is `1/2 sum t_k x r_k`, and its derivatives are the axes themselves.
    fn shortened(&mut self, count: usize, columns: &[Vector; 3]) {
        let checks = &self.checks;
        let rows = (0..count).map(|row| Short {
            residual: checks.residuals[row],
            scale: checks.scales[row],
            derivatives: checks.jacobian[row].clone(),
        });
        let mut short: Vec<Short> = rows.collect();
        if count < checks.residuals.len() {
            let target = |row: usize, column: usize| Emitted::code(Operand::Parameter(count + 3 * row + column));
            let crossed: Vec<Vector> =
                (0..3).map(|k| self.cross(&std::array::from_fn(|row| target(row, k)), &columns[k])).collect();
            for k in 0..3 {
                let sum = crossed[1..].iter().fold(crossed[0][k].clone(), |sum, one| self.emitter.add(&sum, &one[k]));
                let residual = self.emitter.operand(&sum.times(0.5));
                let twists = self.twists.clone();
                let derivative = |(axis, centre): &(Vector, Option<Vector>)| match centre {
                    Some(_) => self.emitter.operand(&axis[k]),
                    None => Operand::Constant(0.0),
                };
                let derivatives = twists.iter().map(derivative).collect();
                short.push(Short { residual, scale: Operand::Constant(1.0), derivatives });
            }
        }
        self.checks.short = short;
    }

    /// Adds `tip - p` in some coordinates. Their parameters start at index `first`.
    fn at(&mut self, tip: &Vector, coordinates: &[usize], first: usize, size: Operand) {
        let twists = self.twists.clone();
        let columns: Vec<Vector> = twists
            .iter()
            .map(|(axis, centre)| match centre {
                None => axis.clone(),
                Some(centre) => {
                    let arm = std::array::from_fn(|k| self.emitter.sub(&tip[k], &centre[k]));
                    self.cross(axis, &arm)
                }
            })
            .collect();
        for (index, &k) in coordinates.iter().enumerate() {
            let row = columns.iter().map(|column| self.emitter.operand(&column[k])).collect();
            self.equation(&tip[k], Operand::Parameter(first + index), size, row);
        }
    }

    /// Adds `R - T`, by rows. The parameters start at index `first`.
    fn oriented(&mut self, columns: &[Vector; 3], first: usize) {
        for (index, column) in columns.iter().enumerate() {
            let rates = self.rates(column);
            for k in 0..3 {
                let row = rates.iter().map(|rate| self.emitter.operand(&rate[k])).collect();
                self.equation(&column[k], Operand::Parameter(first + 3 * k + index), Operand::Constant(1.0), row);
            }
        }
    }

    /// Adds the difference of the tip's direction, as a unit vector, and the target direction.
    fn aimed(&mut self, mechanism: &Mechanism, first: usize) {
        let aim = self.aim(mechanism);
        let rates = self.rates(&aim);
        for k in 0..3 {
            let row = rates.iter().map(|rate| self.emitter.operand(&rate[k])).collect();
            self.equation(&aim[k], Operand::Parameter(first + k), Operand::Constant(1.0), row);
        }
    }

    /// The direction of the tip that the task orients, as a unit vector.
    fn aim(&mut self, mechanism: &Mechanism) -> Vector {
        let square: BigRational = mechanism.aim().iter().map(|entry| entry * entry).sum();
        let unit = 1.0 / square.to_f64().unwrap_or(1.0).sqrt();
        self.turned(mechanism.aim()).map(|entry| entry.times(unit))
    }

    /// Adds the cosine and the sine of the angle of the tip's direction about an axis.
    fn pointing(&mut self, mechanism: &Mechanism, axis: BaseAxis) {
        let aim = self.aim(mechanism);
        let rates = self.rates(&aim);
        for (index, k) in axis.across().into_iter().enumerate() {
            let row = rates.iter().map(|rate| self.emitter.operand(&rate[k])).collect();
            self.equation(&aim[k], Operand::Parameter(3 + index), Operand::Constant(1.0), row);
        }
    }

    /// Adds the third row of the rotation minus that of the target pitch and roll: -sin pitch, cos pitch sin roll, cos pitch cos roll.
    fn upright(&mut self, columns: &[Vector; 3]) {
        let Some([cr, sr, cp, sp]) = self.layout.pitch_roll else { return };
        let code = |parameter: usize| Emitted::code(Operand::Parameter(parameter));
        let [across, up] = [sr, cr].map(|roll| self.emitter.mul(&code(cp), &code(roll)));
        for (column, wanted) in columns.iter().zip([code(sp).times(-1.0), across, up]) {
            let rates = self.rates(column);
            let row = rates.iter().map(|rate| self.emitter.operand(&rate[2])).collect();
            let wanted = self.emitter.operand(&wanted);
            self.equation(&column[2], wanted, Operand::Constant(1.0), row);
        }
    }

    /// Adds the cosine and the sine of the rotation about a plane's normal.
    fn tilted(&mut self, columns: &[Vector; 3], plane: Plane) {
        let (a, b) = ((plane.normal() + 1) % 3, (plane.normal() + 2) % 3);
        let rates = self.rates(&columns[a]);
        for (index, k) in [a, b].into_iter().enumerate() {
            let row = rates.iter().map(|rate| self.emitter.operand(&rate[k])).collect();
            self.equation(&columns[a][k], Operand::Parameter(2 + index), Operand::Constant(1.0), row);
        }
    }

    /// The derivative of a direction by each joint.
    fn rates(&mut self, direction: &Vector) -> Vec<Vector> {
        let twists = self.twists.clone();
        let rate = |(axis, centre): &(Vector, Option<Vector>)| match centre {
            Some(_) => self.cross(axis, direction),
            None => std::array::from_fn(|_| Emitted::integer(0)),
        };
        twists.iter().map(rate).collect()
    }

    /// Adds the equations that fix a given joint at its input value.
    fn given(&mut self, joint: usize) {
        let count = self.twists.len();
        let (zero, one) = (Operand::Constant(0.0), Operand::Constant(1.0));
        let derivatives = (0..count).map(|other| if other == joint { one } else { zero }).collect();
        self.checks.short.push(Short { residual: zero, scale: one, derivatives });
        let row = |derivative: Operand| {
            let mut row = vec![Operand::Constant(0.0); count];
            row[joint] = derivative;
            row
        };
        let parameters = self.layout.given[joint].clone();
        match (self.layout.joints[joint], parameters.as_slice()) {
            (JointValue::Angle { cosine, sine }, &[c, s]) => {
                let fall = self.emitter.0.mul(Operand::Constant(-1.0), Operand::Unknown(sine));
                let (one, rise) = (Operand::Constant(1.0), Operand::Unknown(cosine));
                self.equation(&Emitted::code(rise), Operand::Parameter(c), one, row(fall));
                self.equation(&Emitted::code(Operand::Unknown(sine)), Operand::Parameter(s), one, row(rise));
            }
            (JointValue::Plain(unknown), &[d]) => {
                let value = Emitted::code(Operand::Unknown(unknown));
                self.equation(&value, Operand::Parameter(d), Operand::Magnitude, row(Operand::Constant(1.0)));
            }
            _ => {}
        }
    }

    /// Adds the equations of a joint that follows another one. The factor of an angle is an integer.
    fn follows(&mut self, joint: usize, leader: usize, factor: f64, offset: f64) {
        let count = self.twists.len();
        let row = |own: Operand, other: Operand| {
            let mut row = vec![Operand::Constant(0.0); count];
            (row[joint], row[leader]) = (own, other);
            row
        };
        let one = Operand::Constant(1.0);
        let known = |unknown: usize| Emitted::code(Operand::Unknown(unknown));
        match (self.layout.joints[joint], self.layout.joints[leader]) {
            (JointValue::Angle { cosine, sine }, JointValue::Angle { cosine: c, sine: s }) => {
                let [mut across, mut up] = [offset.cos(), offset.sin()].map(|x| Emitted::integer(1).times(x));
                let (c, s) = (known(c), known(s).times(factor.signum()));
                for _ in 0..factor.abs() as usize {
                    let products = [(&across, &c), (&up, &s), (&up, &c), (&across, &s)];
                    let [cc, ss, sc, cs] = products.map(|(a, b)| self.emitter.mul(a, b));
                    (across, up) = (self.emitter.sub(&cc, &ss), self.emitter.add(&sc, &cs));
                }
                let (fall, rise) = (known(sine).times(-1.0), known(cosine));
                for (value, target, own, other) in
                    [(known(cosine), &across, fall, up.times(factor)), (known(sine), &up, rise, across.times(-factor))]
                {
                    let [target, own, other] = [target, &own, &other].map(|x| self.emitter.operand(x));
                    self.equation(&value, target, one, row(own, other));
                }
            }
            (JointValue::Plain(own), JointValue::Plain(other)) => {
                let shift = self.emitter.add(&known(other).times(factor), &Emitted::integer(1).times(offset));
                let target = self.emitter.operand(&shift);
                self.equation(&known(own), target, Operand::Magnitude, row(one, Operand::Constant(-factor)));
            }
            _ => {}
        }
    }

    fn equation(&mut self, value: &Emitted, target: Operand, scale: Operand, row: Vec<Operand>) {
        let reached = self.emitter.operand(value);
        self.checks.residuals.push(self.emitter.0.sub(reached, target));
        self.checks.scales.push(scale);
        self.checks.jacobian.push(row);
    }
}
