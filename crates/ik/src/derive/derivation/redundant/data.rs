//! The data of a redundant solver: axes, limits, and the other programs.

use super::sections::closed_search;
use super::{Part, RedundantChain};
use crate::derive::eigenvalue::line;
use crate::derive::{AnyView, ChainProblem, Derivation};
use crate::solver::{Redundancy, RedundantPart};

/// The data of `redundancy` with the main derivation `main`, for the chain of `problem` as described.
pub(in crate::derive) fn data(problem: &ChainProblem, main: &Derivation, redundancy: &RedundantChain) -> Redundancy {
    let chain = problem.measured();
    let pose = chain.base_from_tip();
    let rotation = pose.rotation.to_rotation_matrix();
    let part = |part: &Part| match part {
        Part::Main => RedundantPart::Main,
        Part::Derived(derivation) => RedundantPart::Program(Box::new(derivation.program().clone())),
        Part::Constant => RedundantPart::Constant,
        Part::Scanned => RedundantPart::Scanned,
        Part::Unsolved(reason) => RedundantPart::Unsolved(reason.clone()),
    };
    let is_slow = |joint: usize| {
        let derivation = if let Part::Derived(other) = &redundancy.parts[joint] { other } else { main };
        matches!(derivation.view(), AnyView::Eigenvalue(_))
    };
    Redundancy {
        closed: closed_search(&problem.chain, redundancy, is_slow),
        lines: (0..chain.joints().len()).map(|joint| line(chain, joint)).collect(),
        position: pose.translation.vector.into(),
        rotation: std::array::from_fn(|i| std::array::from_fn(|j| rotation[(i, j)])),
        limits: chain.joints().iter().map(|joint| joint.limits.map(|(low, high)| [low, high])).collect(),
        parts: redundancy.parts.iter().map(part).collect(),
    }
}
