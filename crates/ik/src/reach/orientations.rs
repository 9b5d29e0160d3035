//! Orientations that are evenly spread, and the rotations applied to them. Main type: [`Turn`].

use std::f64::consts::{SQRT_2, TAU};

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

use groebot_algebra::random::SplitMix64;
use groebot_robot::spatial::angle;

/// The positive solution of psi^4 = psi + 4.
const PSI: f64 = 1.533_751_168_755_204_3;

/// One of `count` rotations on the super-Fibonacci spiral (M. Alexa, Super-Fibonacci spirals: fast, low-discrepancy sampling of SO(3), CVPR 2022).
pub(super) fn rotation(number: usize, count: usize) -> Matrix3<f64> {
    let s = number as f64 + 0.5;
    of_shares(s / count as f64, TAU * s / SQRT_2, TAU * s / PSI)
}

/// One of `count` directions on the golden-section spiral (A. Gonzalez, Mathematical Geosciences 42, 2010).
pub(super) fn direction(number: usize, count: usize) -> Vector3<f64> {
    let golden = (1.0 + 5f64.sqrt()) / 2.0;
    let (height, around) = (1.0 - (2 * number + 1) as f64 / count as f64, TAU * number as f64 / golden);
    let radius = (1.0 - height * height).max(0.0).sqrt();
    Vector3::new(radius * around.cos(), radius * around.sin(), height)
}

/// The rotation applied to all orientations of a place.
#[derive(Clone, Debug)]
pub(super) struct Turn(Option<(Matrix3<f64>, f64)>);

impl Turn {
    /// The identity.
    pub(super) fn none() -> Self {
        Turn(None)
    }

    /// A random rotation that depends on a seed and an index.
    pub(super) fn by_chance(seed: u64, number: usize) -> Self {
        let mut random = SplitMix64::new(seed ^ (number as u64).wrapping_mul(0xd1b5_4a32_d192_ed03));
        let [share, a, b] = std::array::from_fn(|_| TAU * random.share());
        Turn(Some((of_shares(share / TAU, a, b), a)))
    }

    pub(super) fn rotation(&self, rotation: &Matrix3<f64>) -> Matrix3<f64> {
        self.0.map_or(*rotation, |(turn, _)| turn * rotation)
    }

    pub(super) fn direction(&self, direction: &Vector3<f64>) -> Vector3<f64> {
        self.0.map_or(*direction, |(turn, _)| turn * direction)
    }

    /// The direction before the rotation is applied.
    pub(super) fn back(&self, direction: &Vector3<f64>) -> Vector3<f64> {
        self.0.map_or(*direction, |(turn, _)| turn.tr_mul(direction))
    }

    pub(super) fn angle(&self, own: f64) -> f64 {
        self.0.map_or(own, |(_, turn)| angle::wrap(own + turn))
    }
}

/// The rotation with these torus coordinates of its unit quaternion (K. Shoemake, Uniform random rotations, Graphics Gems III, 1992). It is uniformly
/// distributed if the share and the angles are.
fn of_shares(share: f64, a: f64, b: f64) -> Matrix3<f64> {
    let (inner, outer) = (share.sqrt(), (1.0 - share).sqrt());
    let quaternion = Quaternion::new(outer * b.cos(), inner * a.sin(), inner * a.cos(), outer * b.sin());
    UnitQuaternion::from_quaternion(quaternion).to_rotation_matrix().into_inner()
}
