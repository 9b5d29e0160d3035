//! The loop equivalent to a chain's task, with a pose or a point as goal for the subproblems. Main type: [`Model`].
//!
//! A ray is a pose with one more joint that rotates about the ray. A rotation is a pose of the chain's spherical image,
//! in which all axes pass through the origin, and a direction is a point of it. A given joint is absorbed before the
//! first step.

use nalgebra::{Point3, Vector3};

use super::goal::whole;
use super::reduced::{Goal, Reduced};
use super::refine::MOST_JOINTS;
use crate::kinematics::{Chain, Target, Task};
use crate::spatial::{Half, Screw};
use crate::{Error, ErrorKind, Result};

/// The model of a chain for the screw solver.
#[derive(Clone, Debug)]
pub(super) struct Model {
    /// The joints' screws, followed by the screw of the ray.
    pub screws: Vec<Screw>,
    /// The point of the tip whose distance is measured.
    pub tip: Vector3<f64>,
    /// The reference length of distances; one if there are only directions.
    pub reach: f64,
    /// The indices of the given joints.
    pub given: Vec<usize>,
    /// The number of screws that are joints.
    pub joints: usize,
}

impl Model {
    /// Builds the model of `chain`.
    ///
    /// # Errors
    /// [`ErrorKind::PositiveDimensional`] when the task leaves joints undetermined; [`ErrorKind::Unsupported`] for more
    /// joints than the solver supports; those of [`Chain::check_leaders`].
    pub fn of(chain: &Chain) -> Result<Model> {
        chain.check_leaders()?;
        let (joints, given, task) = (chain.joints().len(), chain.given(), chain.task());
        if chain.independent().len() <= task.freedoms() && joints - given.len() > task.freedoms() {
            let text = format!(
                "screw theory supports at most {} unknown joints for the task `{}`, mimic joints included; use `groebot derive` for the {} independent joints, or a numeric search (`groebot ik --numeric`)",
                task.freedoms(),
                task.name(),
                chain.independent().len()
            );
            return Err(Error::new(ErrorKind::Unsupported, text));
        }
        if joints - given.len() > task.freedoms() {
            let text = format!(
                "{} joints for the task `{}`, which determines {} at most; give the values of the others (`given`)",
                joints - given.len(),
                task.name(),
                task.freedoms()
            );
            return Err(Error::new(ErrorKind::PositiveDimensional, text));
        }
        let image = matches!(task, Task::Rotation | Task::Direction);
        let mut screws = if image { spherical_image(chain)? } else { chain.screws().to_vec() };
        let tip = if image { Vector3::zeros() } else { chain.base_from_tip().translation.vector };
        if task == Task::Ray {
            let aimed = chain.base_from_tip().rotation * chain.aim().into_inner();
            screws.push(Screw::revolute(aimed, Point3::from(tip))?);
        }
        if screws.len() > MOST_JOINTS {
            let text = format!(
                "the screw solver supports {MOST_JOINTS} joints, including the rotation about a ray; there are {}",
                screws.len()
            );
            return Err(Error::new(ErrorKind::Unsupported, text));
        }
        Ok(Model { screws, tip, reach: if image { 1.0 } else { chain.reach() }, given, joints })
    }

    /// The loop for `goal`, with the given joints at `values`.
    pub fn start(&self, goal: Goal, values: impl Iterator<Item = Half>) -> Reduced {
        let mut reduced = whole(&self.screws, goal);
        for (&joint, value) in self.given.iter().zip(values) {
            if let Some(place) = reduced.place(joint) {
                reduced.absorb(place, value);
            }
        }
        reduced
    }

    /// The values of all screws at the joint values `q`, and the goal that `q` reaches: the joint values, then the
    /// rotation about the ray that remains for the goal's arbitrary rotation.
    pub fn values(&self, chain: &Chain, q: &[f64]) -> Result<(Vec<f64>, Goal)> {
        let goal = Target::reached(chain, q)?.goal(chain)?;
        let mut values = q.to_vec();
        if let (Goal::Pose(pose), true) = (goal, self.screws.len() > self.joints) {
            let turn = chain.forward(q)?.rotation.inverse() * (pose * chain.base_from_tip()).rotation;
            values.push(2.0 * turn.imag().dot(&chain.aim()).atan2(turn.scalar()));
        }
        Ok((values, goal))
    }
}

/// The axes moved to the origin. Their rotations are those of the chain.
fn spherical_image(chain: &Chain) -> Result<Vec<Screw>> {
    let image = |(screw, joint): (&Screw, &crate::kinematics::Joint)| match screw {
        Screw::Revolute(axis) => Screw::revolute(axis.direction().into_inner(), Point3::origin()),
        Screw::Prismatic(_) => {
            let text =
                format!("joint `{}` is prismatic: it has no effect on the task `{}`", joint.name, chain.task().name());
            Err(Error::new(ErrorKind::PositiveDimensional, text))
        }
    };
    chain.screws().iter().zip(chain.joints()).map(image).collect()
}
