//! Inverse dynamics (RNEA) and gravity in loops.

use super::Recursive;
use super::cells::{ROTOR, WEIGHS, body, frame, mass, numbers};
use crate::codegen::dynamics::loops::Loops;
use groebot_robot::dynamics::Six;
use groebot_robot::dynamics::recursions::net_force;

impl Recursive {
    /// The velocity of the base, and its acceleration minus gravity.
    pub(super) fn start(&self, loops: &mut Loops<'_>, moves: bool) {
        loops.step(|step| {
            let pull = self.pull(step);
            let [velocity, acceleration] =
                if moves { ["v", "a"].map(|list| self.base(step, list)) } else { [Six::zero(), Six::zero()] };
            let acceleration = pull.add(&acceleration);
            if self.floats() {
                let force = net_force(&mass(step, "BODY[0]", WEIGHS), &velocity, &acceleration, None);
                step.write_list("force[0]", 0, numbers(&force));
            }
            if moves {
                step.write_list("velocity[0]", 0, numbers(&velocity));
            }
            step.write_list("acceleration[0]", 0, numbers(&acceleration));
        });
    }

    /// The forward pass of RNEA for a body: its frame, its motion, and the force that the motion needs.
    pub(super) fn move_on(&self, loops: &mut Loops<'_>, moves: bool) {
        self.place(loops);
        loops.by_freedom("i", |loops, freedom| {
            loops.step(|step| {
                let (frame, own) = (frame(step, "frame[i]"), body(freedom));
                let mut acceleration = frame.motion_inward(&step.six("acceleration[p]", 0));
                let mut velocity = Six::zero();
                if moves {
                    velocity = frame.motion_inward(&step.six("velocity[p]", 0));
                    let [rate, change] = ["v", "a"].map(|list| self.of_joint(step, list));
                    own.add_motion(&mut velocity, rate.clone());
                    acceleration = acceleration.add(&own.turning(&velocity, &rate));
                    own.add_motion(&mut acceleration, change);
                    step.write_list("velocity[i]", 0, numbers(&velocity));
                }
                let force = net_force(&mass(step, "BODY[i]", WEIGHS), &velocity, &acceleration, None);
                step.write_list("acceleration[i]", 0, numbers(&acceleration));
                step.write_list("force[i]", 0, numbers(&force));
            });
        });
    }

    pub(super) fn inverse(&self, loops: &mut Loops<'_>, moves: bool) {
        loops.arrays(&[("frame", 12), ("acceleration", 6), ("force", 6)]);
        if moves {
            loops.arrays(&[("velocity", 6)]);
        }
        self.start(loops, moves);
        loops.outward(|loops| self.move_on(loops, moves));
        loops.inward(|loops| {
            loops.by_freedom("i", |loops, freedom| {
                loops.step(|step| {
                    let along = body(freedom).along(&step.six("force[i]", 0)).clone();
                    let mut torque = self.factor(step, "i") * along;
                    if moves {
                        torque = torque + step.read(format!("BODY[i][{ROTOR}]")) * step.read("a[AT[i]]");
                    }
                    step.add("out[AT[i]]", torque);
                });
            });
            loops.step(|step| {
                let force = frame(step, "frame[i]").force_outward(&step.six("force[i]", 0));
                step.add_list("force[p]", 0, numbers(&force));
            });
        });
        self.finish(loops, "force[0]");
    }

    /// The wrench on the base.
    pub(super) fn finish(&self, loops: &mut Loops<'_>, row: &str) {
        if self.floats() {
            loops.step(|step| {
                let force = step.six(row, 0);
                step.write_list("out", 0, numbers(&force));
            });
        }
    }
}
