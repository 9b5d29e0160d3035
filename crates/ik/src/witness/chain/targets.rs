//! The targets of a check: from random joints, from singular configurations and next to them, at and beyond the boundary of the workspace, arbitrary ones. A
//! singular configuration is where the Jacobian's determinant changes its sign while one joint moves.

use crate::tolerances::WITNESS;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Translation3, UnitQuaternion, Vector3};

use super::model::{Configuration, Joints, Model};
use super::round::RoundTargets;
use super::singular::null_vector;
use crate::witness::Draws;
use crate::witness::check::Target;
use crate::witness::report::Kind;
use groebot_algebra::random::SplitMix64;
use groebot_robot::spatial::Pose;

/// The maximum number of draws for a target of one kind.
const DRAWS: usize = 12;
/// The number of samples of the determinant over the range of a joint.
const PLACES: usize = 48;
/// The distance of an unreachable target, in reaches.
const FAR: f64 = 10.0;
/// The exponents k of the distances 10^-k from singular configurations.
const NEAR: [u32; 3] = [3, 6, 9];

/// The kinds of targets in every 24 rows.
const PLAN: [Slot; 24] = {
    use Slot::{Aligned, Anywhere, Edge, Far, Near, Random, Round, Singular, Special};
    [
        Random,
        Round(15),
        Aligned,
        Singular,
        Random,
        Near(0),
        Random,
        Near(1),
        Random,
        Near(2),
        Random,
        Special,
        Round(30),
        Aligned,
        Random,
        Singular,
        Random,
        Near(0),
        Edge,
        Near(1),
        Anywhere,
        Near(2),
        Singular,
        Far,
    ]
};

/// The kinds of round targets, in turn, if only round targets are requested.
const ROUND: [Slot; 3] = [Slot::Round(15), Slot::Round(30), Slot::Aligned];

#[derive(Clone, Copy)]
enum Slot {
    Random,
    Singular,
    Near(usize),
    Special,
    Round(u32),
    Aligned,
    Edge,
    Anywhere,
    Far,
}

/// The source of targets for one chain.
pub(super) struct Targets<'a> {
    model: &'a Model<'a>,
    random: SplitMix64,
    plan: &'static [Slot],
    round: RoundTargets<'a>,
    /// Values of single joints that make every configuration singular: joint and value.
    critical: Vec<(usize, f64)>,
    done: usize,
}

/// A singular configuration, and the joint that moves out of it.
struct Singularity {
    q: Vec<f64>,
    joint: usize,
}

impl<'a> Targets<'a> {
    pub fn new(model: &'a Model<'a>, draws: Draws, seed: u64) -> Self {
        let (random, round) = (SplitMix64::new(seed), RoundTargets::new(model, seed));
        let plan: &[Slot] = if draws == Draws::Round { &ROUND } else { &PLAN };
        let mut targets = Targets { model, random, plan, round, critical: Vec::new(), done: 0 };
        targets.critical = targets.critical_values();
        targets
    }

    /// The target of row `number`.
    pub fn draw(&mut self, number: usize) -> Target {
        let special = match self.plan[number % self.plan.len()] {
            Slot::Random => None,
            Slot::Singular => self.singular().map(|found| self.reached(Kind::Singular, found.q)),
            Slot::Near(index) => self.near(NEAR[index]),
            Slot::Special => Some(self.special()),
            Slot::Round(degrees) => {
                let q = self.round.joints(degrees);
                Some(self.reached(Kind::Round, q))
            }
            Slot::Aligned => {
                let inputs = self.round.aligned(number);
                Some(Target { kind: Kind::Aligned, inputs, joints: None })
            }
            Slot::Edge => self.edge(),
            Slot::Anywhere => Some(self.anywhere()),
            Slot::Far => self.far(),
        };
        special.unwrap_or_else(|| {
            let q = self.joints();
            self.reached(Kind::Random, q)
        })
    }

    fn reached(&self, kind: Kind, mut q: Vec<f64>) -> Target {
        self.model.chain.follow(&mut q);
        let q = self.model.wrapped(&q);
        Target { kind, inputs: self.model.target(&q), joints: Some(q) }
    }

    /// Random values of all joints.
    pub fn joints(&mut self) -> Vec<f64> {
        let mut q: Vec<f64> = (0..self.model.chain.joints().len()).map(|joint| self.joint(joint)).collect();
        self.model.chain.follow(&mut q);
        q
    }

    /// A random value: an angle in (-pi, pi], or a displacement within its limits, or within the reach in both directions.
    fn joint(&mut self, joint: usize) -> f64 {
        if self.model.turns(joint) {
            return self.random.between(-PI, PI);
        }
        let (low, high) = self.model.slide(joint);
        self.random.between(low, high)
    }

    /// Single joint values that are critical for all values of the other joints, determined from two configurations.
    fn critical_values(&mut self) -> Vec<(usize, f64)> {
        let (a, b) = (self.joints(), self.joints());
        let mut found = Vec::new();
        for &joint in &self.model.unknown {
            let others = self.sign_changes(&b, joint);
            let near =
                |x: f64, y: f64| self.model.difference(joint, x, y).abs() <= WITNESS.equal * self.model.unit(joint);
            let shared = self.sign_changes(&a, joint).into_iter().filter(|&x| others.iter().any(|&y| near(x, y)));
            found.extend(shared.map(|value| (joint, value)));
        }
        found
    }

    /// The values of one joint at which the determinant changes its sign while the others are as in `q`.
    fn sign_changes(&self, q: &[f64], joint: usize) -> Vec<f64> {
        let (low, high) = if self.model.turns(joint) { (-PI, PI) } else { self.model.slide(joint) };
        let place = |k: usize| low + (high - low) * (k as f64 + 0.37) / PLACES as f64;
        let count = if self.model.turns(joint) { PLACES } else { PLACES - 1 };
        (0..count).filter_map(|k| self.bisected(q, joint, place(k), place(k + 1))).collect()
    }

    fn determinant(&self, q: &[f64], joint: usize, value: f64) -> Option<f64> {
        let mut q = q.to_vec();
        q[joint] = value;
        let jacobian = self.model.jacobian(&q);
        jacobian.is_square().then(|| jacobian.determinant())
    }

    fn bisected(&self, q: &[f64], joint: usize, mut low: f64, mut high: f64) -> Option<f64> {
        let positive = |value: f64| Some(self.determinant(q, joint, value)? > 0.0);
        let sign = positive(low)?;
        if positive(high)? == sign {
            return None;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if positive(middle)? == sign { low = middle } else { high = middle }
        }
        let right = (low / FRAC_PI_2).round() * FRAC_PI_2;
        let snapped = if self.model.turns(joint) && (low - right).abs() <= WITNESS.critical { right } else { low };
        let mut at = q.to_vec();
        at[joint] = snapped;
        (self.model.sigma(&at) <= WITNESS.critical).then_some(snapped)
    }

    /// In turn: one critical joint, two critical joints, and a configuration that several joints together make singular.
    fn singular(&mut self) -> Option<Singularity> {
        self.done += 1;
        let critical = self.critical.clone();
        let turn = self.done % 5;
        let Some(&(joint, value)) = critical.get(self.done / 5 % critical.len().max(1)) else { return self.mixed() };
        match turn {
            0 | 4 => self.mixed().or_else(|| self.with(&[(joint, value)])),
            1 | 3 => self.with(&[critical[self.done % critical.len()]]),
            _ => {
                let other = critical[(self.done / 5 + self.done) % critical.len()];
                self.with(&[(joint, value), other])
            }
        }
    }

    fn with(&mut self, held: &[(usize, f64)]) -> Option<Singularity> {
        let mut q = self.joints();
        held.iter().for_each(|&(joint, value)| q[joint] = value);
        Some(Singularity { q, joint: held.first()?.0 })
    }

    /// A sign change of the determinant at a value that is not critical alone.
    fn mixed(&mut self) -> Option<Singularity> {
        (0..DRAWS).find_map(|draw| {
            let mut q = self.joints();
            let joint = self.model.unknown[(self.done + draw) % self.model.unknown.len()];
            let known = |value: f64| {
                let mut critical = self.critical.iter().filter(|(other, _)| *other == joint);
                critical.any(|(_, other)| self.model.difference(joint, value, *other).abs() <= WITNESS.near)
            };
            let value = self.sign_changes(&q, joint).into_iter().find(|&value| !known(value))?;
            q[joint] = value;
            Some(Singularity { q, joint })
        })
    }

    /// A target next to a singular configuration, whose joint that moves out of it has moved by 10^-k.
    fn near(&mut self, k: u32) -> Option<Target> {
        let distance = 10.0_f64.powi(-(k as i32));
        let q = (0..DRAWS).find_map(|_| {
            let Singularity { mut q, joint } = self.singular()?;
            let side = if self.done.is_multiple_of(2) { 1.0 } else { -1.0 };
            q[joint] += side * distance * self.model.unit(joint);
            // It may still be singular for another reason.
            (self.model.sigma(&q) >= 1e-3 * distance).then_some(q)
        })?;
        Some(self.reached(Kind::Near(k), q))
    }

    /// A target with one joint at a multiple of pi/2.
    fn special(&mut self) -> Target {
        self.done += 1;
        let mut q = self.joints();
        let joint = self.model.unknown[self.done % self.model.unknown.len()];
        let turns = self.done / self.model.unknown.len();
        q[joint] = if self.model.turns(joint) { FRAC_PI_2 * (turns % 4) as f64 } else { 0.0 };
        self.reached(Kind::Special, q)
    }

    /// A singular target moved by 10^-k (reaches, or rad) in the direction in which the tip cannot move. If it is on the boundary, this gives targets on both
    /// sides.
    fn edge(&mut self) -> Option<Target> {
        let found = (0..DRAWS).find_map(|_| self.mixed()).or_else(|| self.singular())?;
        self.done += 1;
        let outward = null_vector(self.model.jacobian(&found.q).transpose())?;
        let k = [3, 6, 9, 12][self.done % 4];
        let side = if (self.done / 4).is_multiple_of(2) { 1.0 } else { -1.0 };
        let shift = outward * side * 10.0_f64.powi(-k);
        let mut inputs = self.shifted(&found.q, shift.as_slice())?;
        inputs.extend(self.model.chain.given_inputs().iter().map(|&joint| found.q[joint]));
        let k = k.unsigned_abs();
        Some(Target { kind: Kind::Edge(k), inputs, joints: None })
    }

    /// The task's numbers after a small motion of the tip, which is given like a row of the Jacobian.
    fn shifted(&self, q: &[f64], rows: &[f64]) -> Option<Vec<f64>> {
        use groebot_robot::kinematics::Task;
        let pose = self.model.forward(q);
        let mut v = Vector3::zeros();
        let mut w = Vector3::zeros();
        match self.model.chain.task() {
            Task::Position => v.copy_from_slice(rows),
            Task::PlanarPosition { plane } => plane.coordinates().iter().zip(rows).for_each(|(&i, x)| v[i] = *x),
            Task::PlanarPose { plane } => {
                plane.coordinates().iter().zip(rows).for_each(|(&i, x)| v[i] = *x);
                w[plane.normal()] = rows[2];
            }
            Task::Pose => {
                v.copy_from_slice(&rows[..3]);
                w.copy_from_slice(&rows[3..]);
            }
            Task::PositionYaw { axis } => {
                v.copy_from_slice(&rows[..3]);
                w[axis.coordinate()] = rows[3];
            }
            Task::Rotation => w.copy_from_slice(rows),
            Task::Ray | Task::Direction | Task::PositionPitchRoll => return None,
        }
        let turn = UnitQuaternion::from_scaled_axis(w) * pose.rotation;
        let translation = Translation3::from(pose.translation.vector + v * self.model.length);
        Some(self.model.seen(&Pose::from_parts(translation, turn)))
    }

    /// A target with any position within two reaches and any orientation.
    fn anywhere(&mut self) -> Target {
        let size = 2.0 * self.model.length;
        let given: Vec<f64> = self.joints();
        let mut number = |limit: f64| self.random.between(-limit, limit);
        let translation = Vector3::from_fn(|_, _| number(size));
        let axis = Vector3::from_fn(|_, _| number(1.0)).normalize();
        let turn = match self.model.chain.task().plane() {
            Some(plane) => {
                UnitQuaternion::from_scaled_axis(Vector3::ith(plane.normal(), number(PI)))
                    * self.model.chain.base_from_tip().rotation
            }
            None => UnitQuaternion::from_scaled_axis(axis * number(TAU)),
        };
        let pose = Pose::from_parts(Translation3::from(translation), turn);
        let mut inputs = self.model.seen(&pose);
        inputs.extend(self.model.chain.given_inputs().iter().map(|&joint| given[joint]));
        Target { kind: Kind::Anywhere, inputs, joints: None }
    }

    /// A reachable target moved by many reaches; `None` if the task has no position.
    fn far(&mut self) -> Option<Target> {
        let q = self.joints();
        let mut inputs = self.model.target(&q);
        let lengths = self.model.lengths();
        inputs[..lengths].iter_mut().for_each(|value| *value += FAR * self.model.length);
        (lengths > 0).then_some(Target { kind: Kind::Far, inputs, joints: None })
    }
}
