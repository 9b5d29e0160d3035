//! Jacobians of bodies, their time derivatives, and the momentum matrix.

use super::data::{Data, unit};
use super::scalar::Scalar;
use super::six::{Frame, Six};
use super::tree::Tree;

impl<S: Scalar> Data<S> {
    /// Computes the Jacobian of a frame in a body (`None`: the base) and its time derivative for a motion, in this
    /// frame. There is one column for each degree of freedom, the base's six first if it is floating. Columns of joints
    /// that do not move the frame are not written.
    pub fn jacobian(
        &mut self,
        tree: &Tree<S>,
        (base, rates): (&Six<S>, &[S]),
        (body, link): (Option<usize>, &Frame<S>),
        first: usize,
        columns: &mut [[Six<S>; 2]],
    ) -> Six<S> {
        self.move_bodies(tree, base, rates);
        let velocity = body.map_or(base, |joint| &self.velocities[joint]);
        let own = link.motion_inward(velocity);
        // The velocity of a carrier's axis in the frame, which rotates itself.
        let velocity_of = |frame: &Frame<S>, axis: &Six<S>, velocity: &Six<S>| {
            let column = frame.motion_inward(axis);
            let change = frame.motion_inward(velocity).add(&own.negated()).moving(&column);
            [column, change]
        };
        let (mut frame, mut at) = (link.clone(), body);
        while let Some(joint) = at {
            columns[first + joint] = velocity_of(&frame, &tree.bodies[joint].axis(), &self.velocities[joint]);
            frame = self.frames[joint].then(&frame);
            at = tree.bodies[joint].parent;
        }
        (0..first).for_each(|freedom| columns[freedom] = velocity_of(&frame, &unit(freedom), base));
        own
    }

    /// The pose in the base of a frame in a body (`None`: the base).
    pub fn pose_in_base(&self, tree: &Tree<S>, body: Option<usize>, link: &Frame<S>) -> Frame<S> {
        let up = |joint: &usize| tree.bodies[*joint].parent;
        std::iter::successors(body, up).fold(link.clone(), |frame, joint| self.frames[joint].then(&frame))
    }

    /// Computes the momentum matrix: the momentum of all bodies for unit velocities, in the base frame about its
    /// origin. There is one column for each degree of freedom, the base's six first if it is floating.
    pub(crate) fn momenta(&mut self, tree: &Tree<S>, first: usize, columns: &mut [Six<S>]) {
        let base = self.whole(tree);
        (0..first).for_each(|freedom| columns[freedom] = base.times(&unit(freedom)));
        for (joint, body) in tree.bodies.iter().enumerate() {
            let mut momentum = body.momentum(&self.masses[joint]);
            let mut at = Some(joint);
            while let Some(carrier) = at {
                momentum = self.frames[carrier].force_outward(&momentum);
                at = tree.bodies[carrier].parent;
            }
            columns[first + joint] = momentum;
        }
    }
}
