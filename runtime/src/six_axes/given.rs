//! Joints with given values between the six of a chain ([`Given`], [`Chain::with_given`]).
//!
//! A given joint with the motion `E` between others is moved to the end of the loop: `.. E E5 E6 (tip) = .. (E E5 E^-1) (E E6 E^-1) (E tip)`. So the axes after
//! it, and the tip at zero, are moved by `E`, and six joints are left.

use super::answers::Answers;
use super::chain::Chain;
use super::rigid::Rigid;
use super::screw::Axis;
use super::vector::{Vector, scale, sub};

/// The axis of a joint with a given value between the six of a chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Given {
    /// The number of joints of the six before it, 1 to 5.
    pub before: usize,
    /// Direction of its axis at zero, of length one.
    pub direction: Vector,
    /// A point on its axis at zero, divided by the chain's `length`.
    pub point: Vector,
    /// Whether it is prismatic.
    pub slides: bool,
}

impl Given {
    /// Maximal number of given joints between the six.
    pub const ROOM: usize = 8;

    /// The motion of the joint, given the cosine and sine of its angle, or its displacement divided by the chain's `length`.
    fn motion(&self, [c, s]: [f64; 2]) -> Rigid {
        if self.slides {
            return Rigid { translation: scale(&self.direction, c), ..Rigid::NONE };
        }
        let axis = Axis { direction: self.direction, point: self.point, slides: false };
        let [x, y, z] = Rigid::NONE.rotation.map(|unit| axis.turned(&unit, [c, s]));
        let rotation = [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]];
        let turn = Rigid { rotation, translation: [0.0; 3] };
        Rigid { translation: sub(&self.point, &turn.turned(&self.point)), ..turn }
    }
}

impl Chain {
    /// The chain of the same six joints when those of `given`, from base to tip, have these values: for each its cosine and sine (of an angle in rad), or its
    /// displacement in the unit of the target and an unused number. At least two numbers per joint; further ones are unused.
    #[must_use]
    pub fn with_given(&self, given: &[Given], values: &[f64]) -> Chain {
        let mut chain = *self;
        let count = given.len().min(values.len() / 2);
        for (joint, value) in given[..count].iter().zip(values.chunks_exact(2)).rev() {
            chain.take(joint, [value[0], value[1]]);
        }
        chain
    }

    /// All joint values that reach a target when the joints of `given` have given values. `numbers` contains a position, a rotation matrix by rows, and the
    /// values as in [`Chain::with_given`]. None for fewer than twelve numbers.
    #[must_use]
    pub fn solve_given(&self, given: &[Given], numbers: &[f64]) -> Answers {
        let Some((target, values)) = numbers.split_first_chunk() else { return Answers::NONE };
        self.with_given(given, values).solve(target)
    }

    /// Moves the axes after a given joint by its motion. Joints closer to the tip have been taken already.
    fn take(&mut self, joint: &Given, [c, s]: [f64; 2]) {
        let share = 1.0 / self.length;
        let motion = joint.motion(if joint.slides { [c * share, 0.0] } else { [c, s] });
        let first = joint.before;
        let mut frame = self.steps[0];
        for step in &self.steps[1..first] {
            frame = frame.after(step);
        }
        self.steps[first] = frame.inverse().after(&motion.after(&frame.after(&self.steps[first])));
        for place in first..6 {
            self.directions[place] = motion.turned(&self.directions[place]);
            self.points[place] = motion.moved(&self.points[place]);
            self.across[place] = self.across[place].map(|side| motion.turned(&side));
        }
        self.last = motion.after(&self.last);
        let motion = Rigid { translation: scale(&motion.translation, self.length), ..motion };
        self.back = self.back.after(&motion.inverse());
    }
}
