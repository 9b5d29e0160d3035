//! Jacobians of bodies and their rates, and how joints move the momentum.

use super::data::{Data, unit};
use super::scalar::Scalar;
use super::six::{Frame, Six};
use super::tree::Tree;

impl<S: Scalar> Data<S> {
    /// The velocity of a frame in a body (none: the base) for unit rates, in that frame, and how that changes at the rates of a motion: by freedom, the base's
    /// six first where they count. Freedoms that do not move it are left as they are.
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
        // Of what is fixed to a carrier the velocity is seen from the frame, which turns by itself.
        let seen = |frame: &Frame<S>, axis: &Six<S>, velocity: &Six<S>| {
            let column = frame.motion_inward(axis);
            let change = frame.motion_inward(velocity).add(&own.negated()).moving(&column);
            [column, change]
        };
        let (mut frame, mut at) = (link.clone(), body);
        while let Some(joint) = at {
            columns[first + joint] = seen(&frame, &tree.bodies[joint].axis(), &self.velocities[joint]);
            frame = self.frames[joint].then(&frame);
            at = tree.bodies[joint].parent;
        }
        (0..first).for_each(|freedom| columns[freedom] = seen(&frame, &unit(freedom), base));
        own
    }

    /// Where a frame in a body (none: the base) stands in the base.
    pub fn stands(&self, tree: &Tree<S>, body: Option<usize>, link: &Frame<S>) -> Frame<S> {
        let up = |joint: &usize| tree.bodies[*joint].parent;
        std::iter::successors(body, up).fold(link.clone(), |frame, joint| self.frames[joint].then(&frame))
    }

    /// The momentum of all bodies for unit rates, in the base's frame and about its origin: by freedom, the base's six first where they count.
    pub fn momenta(&mut self, tree: &Tree<S>, first: usize, columns: &mut [Six<S>]) {
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
