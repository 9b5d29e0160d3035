//! What answers are worth on forward kinematics: [`Census`].

use groebot::kinematics::Chain;
use groebot::spatial::Pose;

use crate::Joints;

/// An answer that misses its pose by more than this, as a share of the reach or in rad, is wrong.
pub const WRONG: f64 = 1e-6;

/// A solver's answers to many poses.
#[derive(Clone, Copy, Debug, Default)]
pub struct Census {
    /// Poses.
    pub poses: usize,
    /// Those without a right answer.
    pub lost: usize,
    /// Those with a wrong answer.
    pub wrong: usize,
    /// The farthest that a right answer misses the position, as a share of the reach.
    pub position: f64,
    /// The farthest that a right answer misses the rotation \[rad\].
    pub rotation: f64,
}

impl Census {
    /// Counts `solve`'s answers to `poses`, which `chain` reaches.
    pub fn of(chain: &Chain, poses: &[Pose], solve: impl Fn(&Pose) -> Vec<Joints>) -> Self {
        let mut census = Census { poses: poses.len(), ..Census::default() };
        for pose in poses {
            let misses: Vec<[f64; 2]> = solve(pose).iter().map(|q| miss(chain, q, pose)).collect();
            let is_right = |miss: &&[f64; 2]| miss.iter().all(|miss| *miss <= WRONG);
            census.lost += usize::from(!misses.iter().any(|miss| is_right(&miss)));
            census.wrong += usize::from(!misses.iter().all(|miss| is_right(&miss)));
            for [position, rotation] in misses.iter().filter(is_right) {
                census.position = census.position.max(*position);
                census.rotation = census.rotation.max(*rotation);
            }
        }
        census
    }
}

/// How far joint values miss a pose: the distance as a share of the reach, and the angle between the rotations, by the part of their
/// quotient that is not symmetric.
fn miss(chain: &Chain, q: &Joints, pose: &Pose) -> [f64; 2] {
    let Ok(reached) = chain.forward(q) else { return [f64::INFINITY; 2] };
    let position = (reached.translation.vector - pose.translation.vector).norm() / chain.reach();
    let rotation =
        (reached.rotation.to_rotation_matrix().into_inner() - pose.rotation.to_rotation_matrix().into_inner()).norm();
    [position, rotation / std::f64::consts::SQRT_2]
}
