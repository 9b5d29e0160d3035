//! Round targets, which users try first: joint values in multiples of 15 or 30 degrees, and axis-aligned orientations at positions on a grid.

use crate::tolerances::WITNESS;
use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Translation3, UnitQuaternion, Vector3};

use super::model::{Joints, Model};
use groebot_algebra::random::SplitMix64;
use groebot_robot::spatial::Pose;

/// The approximate width of the grid as a fraction of the reach. It is rounded to 1, 2 or 5 times a power of ten.
const FINENESS: f64 = 0.05;

/// The source of round targets for one chain.
pub(super) struct RoundTargets<'a> {
    model: &'a Model<'a>,
    random: SplitMix64,
}

impl<'a> RoundTargets<'a> {
    pub fn new(model: &'a Model<'a>, seed: u64) -> Self {
        RoundTargets { model, random: SplitMix64::new(seed ^ 0x0072_6f75_6e64) }
    }

    /// Joint values: angles in multiples of `degrees`, displacements on the grid and within their limits.
    pub fn joints(&mut self, degrees: u32) -> Vec<f64> {
        let half_turn = f64::from(180 / degrees);
        let mut q: Vec<f64> = (0..self.model.chain.joints().len())
            .map(|joint| {
                if self.model.turns(joint) {
                    self.random.between(-half_turn, half_turn).ceil() * PI / half_turn
                } else {
                    let (low, high) = self.model.slide(joint);
                    let grid = grid(high - low);
                    ((self.random.between(low, high) / grid).round() * grid).clamp(low, high)
                }
            })
            .collect();
        self.model.chain.follow(&mut q);
        q
    }

    /// The target's numbers for a pose parallel to the base frame, at a grid position next to a reachable one. In two of three cases y or x is zero.
    pub fn aligned(&mut self, number: usize) -> Vec<f64> {
        let q = self.joints(15);
        let grid = grid(self.model.length);
        let mut position = self.model.forward(&q).translation.vector.map(|value| (value / grid).round() * grid);
        if number % 3 < 2 {
            position[1 - number % 3] = 0.0;
        }
        let mut quarter = || self.random.between(-2.0, 2.0).ceil() * FRAC_PI_2;
        let turn = match self.model.chain.task().plane() {
            Some(plane) => {
                UnitQuaternion::from_scaled_axis(Vector3::ith(plane.normal(), quarter()))
                    * self.model.chain.base_from_tip().rotation
            }
            None => UnitQuaternion::from_euler_angles(quarter(), quarter(), quarter()),
        };
        let mut inputs = self.model.seen(&Pose::from_parts(Translation3::from(position), turn));
        let lengths = self.model.lengths();
        for (index, value) in inputs.iter_mut().enumerate() {
            let unit = if index < lengths { self.model.length } else { 1.0 };
            let is_round = (*value / unit - (*value / unit).round()).abs() <= WITNESS.rounding;
            *value = if is_round { (*value / unit).round() * unit } else { *value };
        }
        inputs.extend(self.model.chain.given_inputs().iter().map(|&joint| q[joint]));
        inputs
    }
}

/// The width of a grid for this length.
fn grid(length: f64) -> f64 {
    let fine = FINENESS * length;
    let power = 10.0_f64.powf(fine.log10().floor());
    let candidates = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power);
    let misses = |grid: f64| (grid / fine).ln().abs();
    candidates.into_iter().min_by(|a, b| misses(*a).total_cmp(&misses(*b))).unwrap_or(fine)
}
