//! Quality of solutions by forward kinematics: [`Census`].

use groebot::kinematics::Chain;
use groebot::spatial::Pose;

use crate::Joints;

/// Residual of the pose above which a solution is wrong, as a fraction of the reach or in rad.
pub const WRONG: f64 = 1e-6;

/// Statistics of a solver's solutions for many poses.
#[derive(Clone, Copy, Debug, Default)]
pub struct Census {
    /// Poses.
    pub poses: usize,
    /// Poses without a correct solution.
    pub lost: usize,
    /// Poses with a wrong solution.
    pub wrong: usize,
    /// The largest position error of a correct solution, as a fraction of the reach.
    pub position: f64,
    /// The largest rotation error of a correct solution \[rad\].
    pub rotation: f64,
}

impl Census {
    /// Counts the solutions that `solve` returns for `poses`, which `chain` reaches.
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

/// The error of joint values for a pose: the distance as a fraction of the reach, and the angle between the rotations, from the antisymmetric part of their
/// quotient.
fn miss(chain: &Chain, q: &Joints, pose: &Pose) -> [f64; 2] {
    let Ok(reached) = chain.forward(q) else { return [f64::INFINITY; 2] };
    let position = (reached.translation.vector - pose.translation.vector).norm() / chain.reach();
    let rotation =
        (reached.rotation.to_rotation_matrix().into_inner() - pose.rotation.to_rotation_matrix().into_inner()).norm();
    [position, rotation / std::f64::consts::SQRT_2]
}
