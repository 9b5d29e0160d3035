//! Forward dynamics in loops.

use super::Recursive;
use super::cells::{ROTOR, WEIGHS, body, frame, mass, numbers, resistance, resistance_numbers};
use crate::codegen::dynamics::loops::{Loops, Step};
use crate::codegen::dynamics::tape::Recorded;
use groebot_robot::dynamics::Six;
use groebot_robot::dynamics::recursions::{Resistance, Yielding, bias};

impl Recursive {
    pub(super) fn forward(&self, loops: &mut Loops<'_>) {
        loops.arrays(&[("frame", 12), ("velocity", 6), ("resistance", 27), ("bias", 6), ("turning", 6)]);
        loops.arrays(&[("push", 6), ("pivot", 1), ("excess", 1), ("acceleration", 6)]);
        let resist = |loops: &mut Loops<'_>, index: &str| {
            loops.step(|step| {
                let own = mass(step, &format!("BODY[{index}]"), WEIGHS);
                let velocity = step.six(&format!("velocity[{index}]"), 0);
                step.write_list(&format!("resistance[{index}]"), 0, resistance_numbers(Resistance::of(&own)));
                step.write_list(&format!("bias[{index}]"), 0, numbers(&bias(&own, &velocity, None)));
            });
        };
        self.start_velocity(loops);
        if self.floats() {
            resist(loops, "0");
        }
        loops.outward(|loops| {
            self.quicken(loops);
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
                    let (carried, bias) = (resistance(step, "resistance[i]"), step.six("bias[i]", 0));
                    let [torque, rotor] = [self.of_joint(step, "tau"), step.read(format!("BODY[i][{ROTOR}]"))];
                    let yields = Yielding::of(&carried, &body(freedom), &bias, &torque, &rotor);
                    step.write_list("push[i]", 0, numbers(&yields.push));
                    step.write("pivot[i][0]", yields.pivot);
                    step.write("excess[i][0]", yields.excess);
                });
            });
            loops.step(|step| {
                let (carried, bias) = (resistance(step, "resistance[i]"), step.six("bias[i]", 0));
                let (turning, frame) = (step.six("turning[i]", 0), frame(step, "frame[i]"));
                let (resistance, bias) = yielding(step).hand_on(&carried, &bias, &turning, &frame);
                step.add_list("resistance[p]", 0, resistance_numbers(resistance));
                step.add_list("bias[p]", 0, numbers(&bias));
            });
        });
        loops.step(|step| {
            let found = if self.floats() {
                let (torque, bias) = (step.six("tau", 0), step.six("bias[0]", 0));
                let base = resistance(step, "resistance[0]");
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
                    let change = yielding(step).change(&carried);
                    body(freedom).quicken(&mut carried, change.clone());
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

fn yielding(step: &mut Step) -> Yielding<Recorded> {
    Yielding { push: step.six("push[i]", 0), pivot: step.read("pivot[i][0]"), excess: step.read("excess[i][0]") }
}
