//! Targets by their indices. Main type: [`Poses`].

use std::f64::consts::TAU;
use std::ops::Range;

use nalgebra::{Matrix3, Vector3};

use super::grid::Grid;
use super::orientations::{Turn, direction, rotation};
use super::request::Request;
use crate::solver::{Program, TipTask};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits;
use groebot_robot::kinematics::{Ball, BaseAxis, TargetNumber, Task};

/// Maximal number of orientations at a place.
pub(super) const MOST: usize = limits::ORIENTATIONS;

/// Targets for a solver's tip at each place of a grid: the place, and orientations spread evenly over all that the task distinguishes.
#[derive(Clone, Debug)]
pub(super) struct Poses {
    /// Number of target numbers.
    inputs: usize,
    grid: Grid,
    /// The inputs of the position, by axis.
    position: [Option<usize>; 3],
    spread: Spread,
    /// Inputs with equal values in all targets.
    given: Vec<(usize, f64)>,
    seed: Option<u64>,
    /// A ball that a point of the tip cannot leave, and by orientation the vector from the tip to that point.
    wrist: Option<(Ball, Vec<Vector3<f64>>)>,
}

/// The orientations of a task, with the inputs that they set.
#[derive(Clone, Debug)]
enum Spread {
    Nothing,
    Angles(usize, Vec<f64>),
    /// Three numbers of a unit vector.
    Directions(usize, Vec<Vector3<f64>>),
    /// Pitch and roll, given by the direction of the base's z axis in the frame of the tip.
    Tilts([usize; 2], Vec<Vector3<f64>>),
    /// Nine numbers, by rows.
    Rotations(usize, Vec<Matrix3<f64>>),
}

impl Poses {
    /// The targets for a solver.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a task without a position, or with inputs that are neither that, an orientation, nor given joints.
    /// [`ErrorKind::BadValue`]:
    /// - there are no orientations, or more than 10^6
    /// - the number of given values is not that of the given joints
    /// - there are several places on an axis without a coordinate in the task
    pub(super) fn new(program: &Program, request: &Request) -> Result<Self> {
        let Request { orientations, ref given, .. } = *request;
        if !(1..=MOST).contains(&orientations) {
            let text = format!("{orientations} orientations at a place; 1 to {MOST} are allowed");
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let targets = request.grid.places().saturating_mul(orientations);
        limits::check_count("targets, places times orientations,", targets, limits::REACH_TARGETS)?;
        let tip = program.tip();
        let position = BaseAxis::ALL.map(|axis| tip.and_then(|tip| tip.input(TargetNumber::Position(axis))));
        let spread = tip.and_then(|tip| Spread::of(tip, orientations));
        let Some(spread) = spread.filter(|_| position.iter().any(Option::is_some)) else {
            let names: Vec<&str> = program.inputs.iter().map(|input| input.name.as_str()).collect();
            let text = format!(
                "a map is of the positions of one tip; targets of {} are {}: derive the pose, the position or the ray of a chain",
                program.name,
                names.join(", ")
            );
            return Err(Error::new(ErrorKind::Unsupported, text));
        };
        let is_free = request.lacks_given(program);
        let names = if is_free { Vec::new() } else { program.given_names() };
        if names.len() != given.len() || !given.iter().all(|value| value.is_finite()) {
            let required = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
            let text = format!(
                "{} finite values of given joints are required ({required}); {given:?} are specified",
                names.len()
            );
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let idle = position.iter().zip(request.grid.axes()).zip(["x", "y", "z"]);
        if let Some(((_, axis), name)) = idle.into_iter().find(|((input, axis), _)| input.is_none() && axis.count > 1) {
            let text = format!("the task has no {name}; use 1 place instead of {} on that axis", axis.count);
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let given = program.given_joints.iter().map(|joint| joint.input).zip(given.iter().copied()).collect();
        Ok(Poses {
            inputs: program.inputs.len() - if is_free { program.given_joints.len() } else { 0 },
            grid: request.grid,
            position,
            spread,
            given,
            seed: request.seed,
            wrist: None,
        })
    }

    /// Number of orientations at each place.
    pub(super) fn orientations(&self) -> usize {
        match &self.spread {
            Spread::Nothing => 1,
            Spread::Angles(_, all) => all.len(),
            Spread::Directions(_, all) | Spread::Tilts(_, all) => all.len(),
            Spread::Rotations(_, all) => all.len(),
        }
    }

    /// Whether the task has all three coordinates of a position.
    pub(super) fn are_in_space(&self) -> bool {
        self.position.iter().all(Option::is_some)
    }

    /// Number of target numbers.
    pub(super) fn inputs(&self) -> usize {
        self.inputs
    }

    /// Omits targets that would move a point of the tip out of its ball, if targets are complete poses of the tip.
    pub(super) fn within(mut self, ball: Ball) -> Self {
        if let (Spread::Rotations(_, all), true) = (&self.spread, self.are_in_space()) {
            self.wrist = Some((ball, all.iter().map(|rotation| rotation * ball.point.coords).collect()));
        }
        self
    }

    /// Writes the targets with these indices, and the indices of those that are not omitted. The orientations of the first place come first, then those of the
    /// next one.
    pub(super) fn write(&self, numbers: Range<usize>, targets: &mut Vec<f64>, kept: &mut Vec<usize>) {
        targets.clear();
        targets.resize(numbers.len() * self.inputs, 0.0);
        kept.clear();
        let orientations = self.orientations();
        let (mut here, mut at, mut turn) = (None, [0.0; 3], Turn::none());
        let (mut offset, mut room) = (Vector3::zeros(), f64::INFINITY);
        for number in numbers {
            let (place, orientation) = (number / orientations, number % orientations);
            if here != Some(place) {
                (here, at) = (Some(place), self.grid.at(place));
                turn = self.seed.map_or(Turn::none(), |seed| Turn::by_chance(seed, place));
                if let Some((ball, _)) = &self.wrist {
                    // |w + o|^2 <= r^2, with w from the ball's centre to the tip, and o from there to the point.
                    offset = turn.back(&(Vector3::from(at) - ball.middle.coords));
                    room = (ball.radius.powi(2) - offset.norm_squared() - ball.point.coords.norm_squared()) / 2.0;
                }
            }
            if self.wrist.as_ref().is_some_and(|(_, offsets)| offset.dot(&offsets[orientation]) > room) {
                continue;
            }
            let target = &mut targets[kept.len() * self.inputs..][..self.inputs];
            kept.push(number);
            self.position.iter().zip(at).for_each(|(input, value)| {
                if let Some(input) = input {
                    target[*input] = value;
                }
            });
            self.given.iter().for_each(|(input, value)| target[*input] = *value);
            self.spread.write(orientation, &turn, target);
        }
        targets.truncate(kept.len() * self.inputs);
    }
}

impl Spread {
    /// The orientations of the task of a tip; `None` for a task with a yaw.
    fn of(tip: &TipTask, count: usize) -> Option<Self> {
        let layout = tip.layout();
        let input = |number: TargetNumber| tip.input(number);
        let directions = || (0..count).map(|number| direction(number, count)).collect();
        let rotations = || (0..count).map(|number| rotation(number, count)).collect();
        let angle = |number: usize| TAU * ((number as f64 + 0.5) / count as f64 - 0.5);
        match tip.task {
            Task::Pose | Task::Rotation => Some(Spread::Rotations(tip.first_input + layout.rotation()?, rotations())),
            Task::Ray | Task::Direction => {
                Some(Spread::Directions(tip.first_input + layout.direction()?, directions()))
            }
            Task::PlanarPose { plane } => {
                Some(Spread::Angles(input(TargetNumber::PlaneAngle(plane))?, (0..count).map(angle).collect()))
            }
            Task::PositionPitchRoll => {
                let inputs = [input(TargetNumber::Pitch)?, input(TargetNumber::Roll)?];
                Some(Spread::Tilts(inputs, directions()))
            }
            Task::Position | Task::PlanarPosition { .. } => Some(Spread::Nothing),
            Task::PositionYaw { .. } => None,
        }
    }

    /// Writes the rotated orientation with this index.
    fn write(&self, number: usize, turn: &Turn, target: &mut [f64]) {
        match self {
            Spread::Nothing => {}
            Spread::Angles(input, all) => target[*input] = turn.angle(all[number]),
            Spread::Directions(first, all) => {
                target[*first..first + 3].copy_from_slice(turn.direction(&all[number]).as_slice());
            }
            Spread::Tilts([pitch, roll], all) => {
                // R = Rz(yaw) Ry(pitch) Rx(roll): the last row of R.
                let up = turn.direction(&all[number]);
                (target[*pitch], target[*roll]) = (-up.x.clamp(-1.0, 1.0).asin(), up.y.atan2(up.z));
            }
            Spread::Rotations(first, all) => {
                let rotation = turn.rotation(&all[number]);
                // By rows.
                target[*first..first + 9].copy_from_slice(rotation.transpose().as_slice());
            }
        }
    }
}
