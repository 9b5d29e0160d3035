//! Joints between two links whose frames are given: [`assemble`].

use super::names::Names;
use super::{Joint, JointType, Link, RobotParts};
use crate::spatial::exact::{ExactVector, Placement, vector};

/// A joint with one degree of freedom between two links, in the frame of the child link.
pub struct Step {
    /// The joint without links and origin. Its axis is in the child's frame.
    pub joint: Joint,
    /// A point of its axis.
    pub anchor: ExactVector,
    /// The motion from the child's given frame to its frame at the value zero, in a frame at the anchor.
    pub zero: Placement,
}

/// Adds joints from the link `parent` to the link `child`, whose frame in the parent's is `at`. Between two joints is a
/// link without mass, and between a joint beside the child's origin and the child. Without joints, or for the last of these
/// links, there is a fixed joint.
pub fn assemble(
    parts: &mut RobotParts,
    names: &mut Names,
    [parent, child]: [&str; 2],
    at: Placement,
    steps: Vec<Step>,
) {
    let (mut above, mut at, mut anchor) = (parent.to_owned(), at, vector::zero());
    let last = steps.len();
    for (place, Step { joint, anchor: point, zero }) in steps.into_iter().enumerate() {
        let step = Placement { origin: vector::sub(&point, &anchor), ..Placement::identity() };
        anchor = point;
        let is_end = place + 1 == last && vector::is_zero(&anchor);
        let below = if is_end { child.to_owned() } else { names.link(&format!("{}_link", joint.name)) };
        let origin = at.then(&step).then(&zero).into();
        parts.joints.push(Joint { parent: above, child: below.clone(), origin, ..joint });
        if !is_end {
            parts.links.push(Link::new(&below));
        }
        (above, at) = (below, Placement::identity());
    }
    if above != child || last == 0 {
        let back = Placement { origin: anchor.map(|x| -x), ..Placement::identity() };
        attach(parts, names, [&above, child], at.then(&back));
    }
}

/// Adds a fixed joint with an unused name between two links.
pub fn attach(parts: &mut RobotParts, names: &mut Names, [parent, child]: [&str; 2], at: Placement) {
    let name = names.joint(&format!("{child}_joint"));
    parts.joints.push(Joint { origin: at.into(), ..Joint::new(&name, JointType::Fixed, parent, child) });
}
