//! The target that a chain's tip reaches, as the inputs of its program.

use crate::Result;
use crate::derive::problem::ChainProblem;
use groebot_robot::kinematics::Task;
use groebot_robot::spatial::pitch_and_roll;

impl ChainProblem {
    /// The target that the joint values `q` reach, in the order of the program's inputs.
    ///
    /// # Errors
    /// As [`groebot_robot::kinematics::Chain::forward`].
    pub(crate) fn reached(&self, q: &[f64]) -> Result<Vec<f64>> {
        let chain = self.measured();
        let base_from_tip = chain.forward(q)?;
        let position = base_from_tip.translation.vector;
        let rotation = base_from_tip.rotation.to_rotation_matrix();
        let rows = (0..9).map(|index| rotation[(index / 3, index % 3)]);
        let aim = || base_from_tip.rotation * chain.aim().into_inner();
        let mut target = match chain.task() {
            Task::Pose => position.iter().copied().chain(rows).collect(),
            Task::Rotation => rows.collect(),
            Task::Position => position.iter().copied().collect(),
            Task::Ray => position.iter().chain(aim().iter()).copied().collect(),
            Task::Direction => aim().iter().copied().collect(),
            Task::PositionPitchRoll => {
                let (pitch, roll) = pitch_and_roll(&base_from_tip.rotation);
                position.iter().copied().chain([pitch, roll]).collect()
            }
            Task::PositionYaw { axis } => {
                let [a, b] = axis.across();
                position.iter().copied().chain([aim()[b].atan2(aim()[a])]).collect()
            }
            Task::PlanarPosition { plane } | Task::PlanarPose { plane } => {
                plane.coordinates().iter().map(|&k| position[k]).collect::<Vec<f64>>()
            }
        };
        if let Task::PlanarPose { plane } = chain.task() {
            let (a, b) = ((plane.normal() + 1) % 3, (plane.normal() + 2) % 3);
            let turn = (base_from_tip.rotation * chain.base_from_tip().rotation.inverse()).to_rotation_matrix();
            target.push(turn[(b, a)].atan2(turn[(a, a)]));
        }
        target.extend(chain.given_inputs().iter().map(|&joint| q[joint]));
        Ok(target)
    }
}
