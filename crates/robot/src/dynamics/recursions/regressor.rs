//! The regressor: inverse dynamics as a matrix times what the bodies weigh.
//!
//! C. G. Atkeson, C. H. An and J. M. Hollerbach, Estimation of Inertial Parameters of Manipulator Loads and Links, Int. J. Robotics Research 5 (1986).

use super::data::{Data, Motion, pushed};
use super::scalar::Scalar;
use super::six::{Frame, Mass, Six};
use super::tree::Tree;

/// How many numbers tell what a body weighs: the mass, the mass times its centre, and the inertia tensor xx, xy, yy, xz, yz, zz about the origin of a frame.
pub const PARAMETERS: usize = 10;

impl<S: Scalar> Mass<S> {
    /// One of the ten numbers is one, the others are nought.
    pub fn unit(parameter: usize) -> Self {
        let told = |at: usize| if at == parameter { S::one() } else { S::zero() };
        Mass {
            mass: told(0),
            moment: std::array::from_fn(|i| told(1 + i)),
            tensor: std::array::from_fn(|i| told(4 + i)),
        }
    }
}

impl<S: Scalar> Data<S> {
    /// The matrix that makes the torques of a motion of what the bodies weigh, by rows; columns are the ten numbers of each body, that of the base first where
    /// its freedoms count. `links` are the frames, in the bodies' own, in which the numbers are told, that of the base first.
    pub fn regressor(
        &mut self,
        tree: &Tree<S>,
        motion: &Motion<'_, S>,
        links: &[Frame<S>],
        torques: &mut [S],
        first: usize,
        out: &mut [S],
    ) {
        self.inverse(tree, motion, &[], torques);
        let counts = usize::from(first > 0);
        let columns = PARAMETERS * (tree.bodies.len() + counts);
        out.iter_mut().for_each(|entry| *entry = S::zero());
        for (joint, link) in links[1..].iter().enumerate() {
            let motions = [&self.velocities[joint], &self.accelerations[joint]].map(|x| link.motion_inward(x));
            for parameter in 0..PARAMETERS {
                let column = PARAMETERS * (joint + counts) + parameter;
                let mut force = link.force_outward(&unit_force(parameter, &motions));
                let mut at = Some(joint);
                while let Some(carrier) = at {
                    out[(first + carrier) * columns + column] = tree.bodies[carrier].along(&force).clone();
                    force = self.frames[carrier].force_outward(&force);
                    at = tree.bodies[carrier].parent;
                }
                (0..first).for_each(|row| out[row * columns + column] = force.at(row).clone());
            }
        }
        if first > 0 {
            let motions = [&motion.base, &motion.base_acceleration].map(|x| links[0].motion_inward(x));
            for parameter in 0..PARAMETERS {
                let force = links[0].force_outward(&unit_force(parameter, &motions));
                (0..first).for_each(|row| out[row * columns + parameter] = force.at(row).clone());
            }
        }
    }
}

/// The force that moves a body of which one number is one.
fn unit_force<S: Scalar>(parameter: usize, [velocity, acceleration]: &[Six<S>; 2]) -> Six<S> {
    pushed(&Mass::unit(parameter), velocity, acceleration, None)
}
