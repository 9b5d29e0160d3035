//! The witnesses that know the chain: forward kinematics, and the screw solver of two parallel revolute joints.

use nalgebra::{Point3, Vector3};

use crate::Result;
use crate::kinematics::screw::two_link::{Solution as Angles, TwoLink};
use crate::kinematics::{Chain, JointKind, Plane, Task};
use crate::solver::Solution;
use crate::spatial::Screw;

/// By how much forward kinematics at `q` misses `target`, as a share of the lengths at hand; infinite where it fails.
pub(super) fn misplacement(chain: &Chain, q: &[f64], target: &[f64]) -> f64 {
    let Ok(base_from_tip) = chain.forward(q) else { return f64::INFINITY };
    let plane = chain.task().plane();
    let coordinates = plane.map_or(vec![0, 1, 2], |plane| plane.coordinates().to_vec());
    let tip = base_from_tip.translation.vector;
    let slides = chain.joints().iter().zip(q).filter(|(joint, _)| joint.kind == JointKind::Prismatic);
    let size = chain.reach() + slides.map(|(_, q)| q.abs()).sum::<f64>();
    let misses = coordinates.iter().zip(target).map(|(&axis, value)| (tip[axis] - value).abs() / (size + value.abs()));
    let turn = match chain.task() {
        Task::PlanarPose { plane } => {
            let normal = plane.normal();
            let (first, second) = ((normal + 1) % 3, (normal + 2) % 3);
            let turned = base_from_tip.rotation * chain.base_from_tip().rotation.inverse() * Vector3::ith(first, 1.0);
            (turned[first] - target[2].cos()).abs().max((turned[second] - target[2].sin()).abs())
        }
        _ => 0.0,
    };
    misses.fold(turn, |worst, miss| if miss.is_nan() { f64::INFINITY } else { miss.max(worst) })
}

/// A chain of two parallel revolute joints that places its tip in a plane.
pub(super) struct Screws {
    solver: TwoLink,
    chain: Chain,
    plane: Plane,
}

impl Screws {
    /// `None` for any other chain.
    pub fn new(chain: &Chain) -> Option<Self> {
        let Task::PlanarPosition { plane } = chain.task() else { return None };
        let [Screw::Revolute(first), Screw::Revolute(second)] = chain.screws() else { return None };
        let tip = Point3::from(chain.base_from_tip().translation.vector);
        let solver = TwoLink::new(*first, *second, tip).ok()?;
        Some(Screws { solver, chain: chain.clone(), plane })
    }

    /// The point of the tip's plane that `target` names.
    fn point(&self, target: &[f64]) -> Point3<f64> {
        let mut point = Point3::from(self.chain.base_from_tip().translation.vector);
        for (axis, value) in self.plane.coordinates().into_iter().zip(target) {
            point[axis] = *value;
        }
        point
    }

    /// The screw solver's answers, a free joint at zero.
    pub fn solve(&self, target: &[f64]) -> Result<Vec<Solution>> {
        let found = self.solver.solve(&self.point(target))?;
        let answer = |(branch, answer): (usize, &Angles)| Solution {
            q: answer.q.iter().map(|q| q.unwrap_or(0.0)).collect(),
            residual: answer.residual,
            branch,
            free: (0..2).filter(|&joint| answer.q[joint].is_none()).collect(),
            chosen: false,
        };
        Ok(found.iter().enumerate().map(answer).collect())
    }
}
