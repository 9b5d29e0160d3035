//! The regressor: inverse dynamics as a matrix times the inertial parameters.
//!
//! C. G. Atkeson, C. H. An and J. M. Hollerbach, Estimation of Inertial Parameters of Manipulator Loads and Links, Int.
//! J. Robotics Research 5 (1986).

use super::data::{Data, Motion, net_force};
use super::scalar::Scalar;
use super::six::{Frame, Mass, Six};
use super::tree::Tree;

/// Number of inertial parameters of a body: the mass, the first moments (mass times centre), and the inertia tensor xx,
/// xy, yy, xz, yz, zz about the origin of a frame.
pub const PARAMETERS: usize = 10;

impl<S: Scalar> Mass<S> {
    /// A mass with one of the ten parameters equal to one and the others zero.
    pub fn unit(parameter: usize) -> Self {
        let entry = |at: usize| if at == parameter { S::one() } else { S::zero() };
        Mass {
            mass: entry(0),
            moment: std::array::from_fn(|i| entry(1 + i)),
            tensor: std::array::from_fn(|i| entry(4 + i)),
        }
    }
}

/// The memory of a regressor.
#[derive(Debug)]
pub struct Regressor<'a, S> {
    /// The generalised forces, which are an intermediate result.
    pub torques: &'a mut [S],
    /// The number of rows of a floating base.
    pub first: usize,
    /// The regressor in row-major order.
    pub rows: &'a mut [S],
}

impl<S: Scalar> Data<S> {
    /// Computes the regressor in row-major order. Columns are the ten inertial parameters of each body, a floating base
    /// first. `links` are the frames, relative to the bodies' own, in which the parameters are given, the base first.
    pub(crate) fn regressor(
        &mut self,
        tree: &Tree<S>,
        motion: &Motion<'_, S>,
        links: &[Frame<S>],
        into: Regressor<'_, S>,
    ) {
        let Regressor { torques, first, rows: out } = into;
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

/// The force on a body with a unit value of one inertial parameter.
fn unit_force<S: Scalar>(parameter: usize, [velocity, acceleration]: &[Six<S>; 2]) -> Six<S> {
    net_force(&Mass::unit(parameter), velocity, acceleration, None)
}
