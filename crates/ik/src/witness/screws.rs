//! The witnesses of a chain: forward kinematics, and the screw solver.

use nalgebra::{Point3, Vector3};

use crate::Result;
use groebot_robot::kinematics::screw::ScrewSolver;
use groebot_robot::kinematics::screw::two_link::{Solution as Angles, TwoLink};
use groebot_robot::kinematics::{Chain, JointKind, Plane, Solution, Task};
use groebot_robot::spatial::Screw;

/// The error of forward kinematics at `q`, as a fraction of the lengths involved; infinite if it fails.
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

/// The screw solver of a chain.
pub(super) enum Screws {
    /// Two parallel revolute joints that position the tip in a plane.
    TwoLink(Box<(TwoLink, Chain, Plane)>),
    /// Any other chain that screw theory solves.
    Planned(Box<ScrewSolver>),
}

impl Screws {
    /// `None` for a chain that no sequence of the known subproblems solves.
    pub fn new(chain: &Chain) -> Option<Self> {
        two_link(chain).or_else(|| ScrewSolver::new(chain).ok().map(|solver| Screws::Planned(Box::new(solver))))
    }

    /// The screw solver's solutions, with a free joint at zero.
    pub fn solve(&self, target: &[f64]) -> Result<Vec<Solution>> {
        match self {
            Screws::TwoLink(parts) => {
                let (solver, chain, plane) = &**parts;
                let found = solver.solve(&point(chain, *plane, target))?;
                Ok(found.iter().enumerate().map(|(branch, answer)| bent(branch, answer)).collect())
            }
            Screws::Planned(solver) => {
                let chain = solver.chain();
                let (target, given) = target.split_at(target.len().saturating_sub(chain.given_inputs().len()));
                let found = solver.solve_given(&chain.task().layout().target(target)?, given)?;
                Ok(found.into_iter().enumerate().map(|(branch, answer)| Solution { branch, ..answer }).collect())
            }
        }
    }
}

fn two_link(chain: &Chain) -> Option<Screws> {
    let Task::PlanarPosition { plane } = chain.task() else { return None };
    let [Screw::Revolute(first), Screw::Revolute(second)] = chain.screws() else { return None };
    if !chain.given().is_empty() {
        return None;
    }
    let tip = Point3::from(chain.base_from_tip().translation.vector);
    let solver = TwoLink::new(*first, *second, tip).ok()?;
    Some(Screws::TwoLink(Box::new((solver, chain.clone(), plane))))
}

/// The point in the tip's plane with the coordinates `target`.
fn point(chain: &Chain, plane: Plane, target: &[f64]) -> Point3<f64> {
    let mut point = Point3::from(chain.base_from_tip().translation.vector);
    for (axis, value) in plane.coordinates().into_iter().zip(target) {
        point[axis] = *value;
    }
    point
}

fn bent(branch: usize, answer: &Angles) -> Solution {
    Solution {
        q: answer.q.iter().map(|q| q.unwrap_or(0.0)).collect(),
        residual: answer.residual,
        branch,
        free: (0..2).filter(|&joint| answer.q[joint].is_none()).collect(),
        ..Solution::default()
    }
}
