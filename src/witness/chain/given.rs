//! The screw solver for a chain with given joints: at each target a chain without them.
//!
//! `E_1 .. E_g .. E_n M = T` with `E_g` known is `E_1' .. E_(g-1)' E_(g+1) .. E_n M = E_g^-1 T`, where `E_g^-1` has moved the screws
//! of the joints before.

use nalgebra::{Matrix3, Point3, Rotation3, Translation3, UnitQuaternion};

use super::model::Model;
use crate::kinematics::screw::{ScrewSolver, Target};
use crate::kinematics::{Chain, ChainParts, ExactVector, Task};
use crate::number::BigRational;
use crate::solver::Solution;
use crate::spatial::{Pose, Screw};

/// The screw solver's answers, all joints of the chain in each; `None` where screw theory does not solve what is left.
pub(super) fn solve(model: &Model<'_>, target: &[f64]) -> Option<Vec<Solution>> {
    let (chain, back) = without_given(model, target)?;
    let wanted = match (chain.task(), target) {
        (Task::Position, &[x, y, z, ..]) => Target::Position(back * Point3::new(x, y, z)),
        (Task::Pose, &[x, y, z, ..]) => {
            let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_row_slice(&target[3..12]));
            let pose = Pose::from_parts(Translation3::new(x, y, z), UnitQuaternion::from_rotation_matrix(&rotation));
            Target::Pose(back * pose)
        }
        _ => return None,
    };
    let found = ScrewSolver::new(&chain).ok()?.solve(&wanted).ok()?;
    let answer = |(branch, answer): (usize, crate::kinematics::screw::Solution)| {
        let (residual, free) = (answer.position_residual, answer.free);
        model.completed(target, Solution { q: answer.q, residual, branch, free, chosen: false })
    };
    Some(found.into_iter().enumerate().map(answer).collect())
}

/// The chain of the unknown joints, and the motion that takes the target to its base.
fn without_given(model: &Model<'_>, target: &[f64]) -> Option<(Chain, Pose)> {
    let mut screws = model.chain.screws().to_vec();
    let mut back = Pose::identity();
    let values = &target[target.len() - model.given.len()..];
    for (&joint, &value) in model.given.iter().zip(values).rev() {
        let inverse = screws[joint].exp(-value);
        back = inverse * back;
        screws[..joint].iter_mut().for_each(|screw| *screw = screw.moved(&inverse));
    }
    let last = *model.given.last()?;
    let parts = model.chain.parts();
    let mut joints = Vec::with_capacity(model.unknown.len());
    for &place in &model.unknown {
        let mut joint = parts.joints[place].clone();
        if place < last {
            (joint.axis, joint.point) = exact_screw(&screws[place])?;
        }
        joints.push(joint);
    }
    let chain = Chain::new(ChainParts { joints, given: Vec::new(), ..parts.clone() }).ok()?;
    Some((chain, back))
}

/// The axis of a screw and a point on it, each double as the rational that it is.
fn exact_screw(screw: &Screw) -> Option<(ExactVector, ExactVector)> {
    let exact = |v: [f64; 3]| -> Option<ExactVector> {
        let [x, y, z] = v.map(BigRational::from_float);
        Some([x?, y?, z?])
    };
    match screw {
        Screw::Revolute(axis) => {
            Some((exact(axis.direction().into_inner().into())?, exact(axis.point().coords.into())?))
        }
        Screw::Prismatic(direction) => Some((exact(direction.into_inner().into())?, exact([0.0; 3])?)),
    }
}
