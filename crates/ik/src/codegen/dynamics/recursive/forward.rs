//! Forward dynamics (ABA) in loops.

use super::Recursive;
use super::cells::{ROTOR, WEIGHS, articulated_inertia, body, frame, inertia_numbers, mass, numbers};
use crate::codegen::dynamics::loops::{Loops, Step};
use crate::codegen::dynamics::tape::Recorded;
use groebot_robot::dynamics::Six;
use groebot_robot::dynamics::recursions::{ArticulatedInertia, ArticulatedJoint, bias};

impl Recursive {
    pub(super) fn forward(&self, loops: &mut Loops<'_>) {
        loops.arrays(&[("frame", 12), ("velocity", 6), ("articulated", 27), ("bias", 6), ("turning", 6)]);
        loops.arrays(&[("push", 6), ("pivot", 1), ("excess", 1), ("acceleration", 6)]);
        let resist = |loops: &mut Loops<'_>, index: &str| {
            loops.step(|step| {
                let own = mass(step, &format!("BODY[{index}]"), WEIGHS);
                let velocity = step.six(&format!("velocity[{index}]"), 0);
                step.write_list(&format!("articulated[{index}]"), 0, inertia_numbers(ArticulatedInertia::of(&own)));
                step.write_list(&format!("bias[{index}]"), 0, numbers(&bias(&own, &velocity, None)));
            });
        };
        self.start_velocity(loops);
        if self.floats() {
            resist(loops, "0");
        }
        loops.outward(|loops| {
            self.add_motion(loops);
            resist(loops, "i");
            loops.by_freedom("i", |loops, freedom| {
                loops.step(|step| {
                    let (velocity, rate) = (step.six("velocity[i]", 0), self.of_joint(step, "v"));
                    step.write_list("turning[i]", 0, numbers(&body(freedom).turning(&velocity, &rate)));
                });
            });
        });
        loops.inward(|loops| {
            loops.by_freedom("i", |loops, freedom| {
                loops.step(|step| {
                    let (carried, bias) = (articulated_inertia(step, "articulated[i]"), step.six("bias[i]", 0));
                    let [torque, rotor] = [self.of_joint(step, "tau"), step.read(format!("BODY[i][{ROTOR}]"))];
                    let joint = ArticulatedJoint::of(&carried, &body(freedom), &bias, &torque, &rotor);
                    step.write_list("push[i]", 0, numbers(&joint.force));
                    step.write("pivot[i][0]", joint.inertia);
                    step.write("excess[i][0]", joint.torque);
                });
            });
            loops.step(|step| {
                let (carried, bias) = (articulated_inertia(step, "articulated[i]"), step.six("bias[i]", 0));
                let (turning, frame) = (step.six("turning[i]", 0), frame(step, "frame[i]"));
                let (inertia, bias) = articulated_joint(step).propagate(&carried, &bias, &turning, &frame);
                step.add_list("articulated[p]", 0, inertia_numbers(inertia));
                step.add_list("bias[p]", 0, numbers(&bias));
            });
        });
        loops.step(|step| {
            let found = if self.floats() {
                let (torque, bias) = (step.six("tau", 0), step.six("bias[0]", 0));
                let base = articulated_inertia(step, "articulated[0]");
                base.solve(&torque.add(&bias.negated()), |_, _| true).unwrap_or_else(Six::zero)
            } else {
                self.pull(step)
            };
            step.write_list("acceleration[0]", 0, numbers(&found));
        });
        loops.outward(|loops| {
            loops.by_freedom("i", |loops, freedom| {
                loops.step(|step| {
                    let carried = frame(step, "frame[i]").motion_inward(&step.six("acceleration[p]", 0));
                    let mut carried = carried.add(&step.six("turning[i]", 0));
                    let change = articulated_joint(step).acceleration(&carried);
                    body(freedom).add_motion(&mut carried, change.clone());
                    step.write_list("acceleration[i]", 0, numbers(&carried));
                    step.write("out[AT[i]]", change);
                });
            });
        });
        if self.floats() {
            loops.step(|step| {
                let found = step.six("acceleration[0]", 0).add(&self.pull(step).negated());
                step.write_list("out", 0, numbers(&found));
            });
        }
    }
}

fn articulated_joint(step: &mut Step) -> ArticulatedJoint<Recorded> {
    ArticulatedJoint {
        force: step.six("push[i]", 0),
        inertia: step.read("pivot[i][0]"),
        torque: step.read("excess[i][0]"),
    }
}
