//! The derivatives of inverse dynamics (RNEA), in loops.

use super::Recursive;
use super::cells::{COMPOSITE, body, composite, frame, numbers};
use crate::codegen::dynamics::loops::{Loops, Step};
use crate::codegen::dynamics::tape::Recorded;
use groebot_robot::dynamics::recursions::ForceDerivatives;

fn changes(step: &mut Step) -> ForceDerivatives<Recorded> {
    let by = [0, 6, 12].map(|from| step.six("push", from));
    ForceDerivatives { by, sensitivity: step.six("push", 18) }
}

fn write(step: &mut Step, changes: &ForceDerivatives<Recorded>) {
    step.write_list("push", 0, changes.by.iter().chain([&changes.sensitivity]).flat_map(numbers));
}

fn cells(loops: &Loops<'_>, row: &str, column: &str) -> [String; 2] {
    ["by_q", "by_v"].map(|matrix| loops.entry(matrix, row, column))
}

impl Recursive {
    pub(super) fn derivatives(&self, loops: &mut Loops<'_>) {
        loops.arrays(&[("frame", 12), ("velocity", 6), ("acceleration", 6), ("force", 6)]);
        loops.arrays(&[("turning", 6), ("bend", 6), ("composite", COMPOSITE)]);
        loops.row("push", 24);
        self.start(loops, true);
        if self.floats() {
            self.compose_body(loops, "0");
        }
        loops.outward(|loops| {
            self.move_on(loops, true);
            self.compose(loops);
            loops.by_freedom("i", |loops, freedom| {
                loops.step(|step| {
                    let moving = (step.six("velocity[i]", 0), step.six("acceleration[i]", 0));
                    let (turning, rate) = (step.six("turning[i]", 0), self.of_joint(step, "v"));
                    let bend = body(freedom).bend((&moving.0, &moving.1), &turning, &rate);
                    step.write_list("bend[i]", 0, numbers(&bend));
                });
            });
        });
        loops.inward(|loops| {
            loops.by_freedom("i", |loops, freedom| {
                loops.step(|step| {
                    let (carried, own) = (composite(step, "composite[i]"), body(freedom));
                    let [turning, bend, force] = ["turning[i]", "bend[i]", "force[i]"].map(|row| step.six(row, 0));
                    let mut new = ForceDerivatives::new(&carried, &own.axis(), &turning, &bend, &turning.add(&turning));
                    new.by[0] = new.by[0].add(&own.force_rate(&force));
                    write(step, &new);
                });
            });
            self.changes_of_carriers(loops);
            self.changes_with_base(loops);
            Self::propagate(loops);
            loops.step(|step| {
                let force = frame(step, "frame[i]").force_outward(&step.six("force[i]", 0));
                step.add_list("force[p]", 0, numbers(&force));
            });
        });
        self.changes_of_base(loops);
    }

    /// The terms of a joint and its ancestors.
    fn changes_of_carriers(&self, loops: &mut Loops<'_>) {
        loops.climb(|loops| {
            let [on, felt] = [("AT[j]", "AT[i]"), ("AT[i]", "AT[j]")].map(|(i, j)| cells(loops, i, j));
            loops.by_freedom("j", |loops, freedom| {
                loops.step(|step| {
                    let entries = changes(step).on_carrier(&body(freedom));
                    self.enter_both(step, &on, &["i", "j"], entries);
                });
                loops.when("j != i", |loops| {
                    loops.step(|step| {
                        let [turning, bend] = ["turning[j]", "bend[j]"].map(|row| step.six(row, 0));
                        let entries = changes(step).of_carrier(&body(freedom), &turning, &bend);
                        self.enter_both(step, &felt, &["i", "j"], entries);
                    });
                });
            });
            loops.step(|step| {
                let outward = changes(step).outward(&frame(step, "frame[j]"));
                write(step, &outward);
            });
        });
    }

    /// The terms of a joint and the base.
    fn changes_with_base(&self, loops: &mut Loops<'_>) {
        for freedom in 0..self.formal.first {
            let row = freedom.to_string();
            let [on, felt] = [(row.as_str(), "AT[i]"), ("AT[i]", row.as_str())].map(|(i, j)| cells(loops, i, j));
            loops.step(|step| {
                let (velocity, pull) = (step.six("velocity[0]", 0), self.pull(step));
                let [of_base, own] = changes(step).with_base(freedom, &velocity, &pull);
                self.enter_both(step, &on, &["i"], of_base);
                self.enter_both(step, &felt, &["i"], own);
            });
        }
    }

    /// The terms of the base's freedoms with each other.
    fn changes_of_base(&self, loops: &mut Loops<'_>) {
        for column in 0..self.formal.first {
            let rows: Vec<_> = (0..6).map(|row| cells(loops, &row.to_string(), &column.to_string())).collect();
            loops.step(|step| {
                let (velocity, pull) = (step.six("velocity[0]", 0), self.pull(step));
                let changes = ForceDerivatives::of_base(&composite(step, "composite[0]"), column, &velocity, &pull);
                for (row, cells) in rows.iter().enumerate() {
                    self.enter_both(step, cells, &[], changes.by.each_ref().map(|change| change.at(row).clone()));
                }
            });
        }
    }

    /// Adds the derivatives by the configuration and by the velocity.
    fn enter_both(&self, step: &mut Step, cells: &[String; 2], of: &[&str], [q, v, _]: [Recorded; 3]) {
        for (cell, entry) in cells.iter().zip([q, v]) {
            self.enter(step, cell.clone(), of, entry);
        }
    }
}
