//! The mass matrix (CRBA) and the Coriolis matrix in loops.

use super::Recursive;
use super::cells::{COMPOSITE, ROTOR, WEIGHS, body, composite, composite_numbers, frame, mass, numbers};
use crate::codegen::dynamics::loops::{Loops, Step};
use crate::codegen::dynamics::tape::Recorded;
use groebot_robot::dynamics::Scalar;
use groebot_robot::dynamics::recursions::{Composite, UnitForces, unit};

impl Recursive {
    pub(super) fn inertia(&self, loops: &mut Loops<'_>) {
        loops.arrays(&[("frame", 12), ("mass", 10)]);
        loops.row("push", 6);
        let weigh = |loops: &mut Loops<'_>, index: &str| {
            loops.step(|step| {
                let own = mass(step, &format!("BODY[{index}]"), WEIGHS);
                step.write_list(&format!("mass[{index}]"), 0, own.numbers());
            });
        };
        weigh(loops, "0");
        loops.outward(|loops| {
            self.place(loops);
            weigh(loops, "i");
        });
        loops.inward(|loops| {
            loops.by_freedom("i", |loops, freedom| {
                loops.step(|step| {
                    let push = body(freedom).momentum(&mass(step, "mass[i]", 0));
                    step.write_list("push", 0, numbers(&push));
                });
            });
            loops.climb(|loops| {
                let cells = [loops.entry("out", "AT[j]", "AT[i]"), loops.entry("out", "AT[i]", "AT[j]")];
                loops.by_freedom("j", |loops, freedom| {
                    let along = |step: &mut Step| body(freedom).along(&step.six("push", 0)).clone();
                    loops.step(|step| {
                        let entry = along(step);
                        self.enter(step, cells[0].clone(), &["i", "j"], entry);
                    });
                    loops.when("j != i", |loops| {
                        loops.step(|step| {
                            let entry = along(step);
                            self.enter(step, cells[1].clone(), &["i", "j"], entry);
                        });
                    });
                });
                loops.step(|step| {
                    let push = frame(step, "frame[j]").force_outward(&step.six("push", 0));
                    step.write_list("push", 0, numbers(&push));
                });
            });
            for freedom in 0..self.formal.first {
                let row = freedom.to_string();
                let cells = [loops.entry("out", &row, "AT[i]"), loops.entry("out", "AT[i]", &row)];
                loops.step(|step| {
                    let entry = step.read(format!("push[{freedom}]"));
                    cells.into_iter().for_each(|cell| self.enter(step, cell, &["i"], entry.clone()));
                });
            }
            let own = loops.entry("out", "AT[i]", "AT[i]");
            loops.step(|step| {
                let rotor = step.read(format!("BODY[i][{ROTOR}]"));
                step.add(own, rotor);
            });
            loops.step(|step| {
                let outward = mass(step, "mass[i]", 0).outward(&frame(step, "frame[i]"));
                step.add_list("mass[p]", 0, outward.numbers());
            });
        });
        for column in 0..self.formal.first {
            let cells: Vec<_> = (0..=column)
                .map(|row| {
                    [(row, column), (column, row)].map(|(i, j)| loops.entry("out", &i.to_string(), &j.to_string()))
                })
                .collect();
            loops.step(|step| {
                let push = mass(step, "mass[0]", 0).times(&unit(column));
                for (row, [above, below]) in cells.into_iter().enumerate() {
                    if row != column {
                        step.write(below, push.at(row).clone());
                    }
                    step.write(above, push.at(row).clone());
                }
            });
        }
    }

    /// The composite of a body alone, and the rate of its axis.
    pub(super) fn compose(&self, loops: &mut Loops<'_>) {
        loops.by_freedom("i", |loops, freedom| {
            loops.step(|step| {
                let velocity = step.six("velocity[i]", 0);
                let turning = body(freedom).turning(&velocity, &Recorded::one());
                step.write_list("turning[i]", 0, numbers(&turning));
            });
        });
        self.compose_body(loops, "i");
    }

    pub(super) fn compose_body(&self, loops: &mut Loops<'_>, index: &str) {
        loops.step(|step| {
            let velocity = step.six(&format!("velocity[{index}]"), 0);
            let own = Composite::of(&mass(step, &format!("BODY[{index}]"), WEIGHS), &velocity);
            step.write_list(&format!("composite[{index}]"), 0, composite_numbers(&own));
        });
    }

    /// The frame of a body and its velocity.
    pub(super) fn add_motion(&self, loops: &mut Loops<'_>) {
        self.place(loops);
        loops.by_freedom("i", |loops, freedom| {
            loops.step(|step| {
                let mut velocity = frame(step, "frame[i]").motion_inward(&step.six("velocity[p]", 0));
                let rate = self.of_joint(step, "v");
                body(freedom).add_motion(&mut velocity, rate);
                step.write_list("velocity[i]", 0, numbers(&velocity));
            });
        });
    }

    /// The velocity of the base.
    pub(super) fn start_velocity(&self, loops: &mut Loops<'_>) {
        if self.floats() {
            loops.step(|step| {
                let velocity = step.six("v", 0);
                step.write_list("velocity[0]", 0, numbers(&velocity));
            });
        }
    }

    /// Adds the composite of a body to that of its parent.
    pub(super) fn propagate(loops: &mut Loops<'_>) {
        loops.step(|step| {
            let outward = composite(step, "composite[i]").outward(&frame(step, "frame[i]"));
            step.add_list("composite[p]", 0, composite_numbers(&outward));
        });
    }

    pub(super) fn coriolis(&self, loops: &mut Loops<'_>) {
        loops.arrays(&[("frame", 12), ("velocity", 6), ("turning", 6), ("composite", COMPOSITE)]);
        loops.row("push", 18);
        self.start_velocity(loops);
        if self.floats() {
            self.compose_body(loops, "0");
        }
        loops.outward(|loops| {
            self.add_motion(loops);
            self.compose(loops);
        });
        let pushes = |step: &mut Step| {
            let [inertia, coriolis, transposed] = [0, 6, 12].map(|from| step.six("push", from));
            UnitForces { inertia, coriolis, transposed }
        };
        let write = |step: &mut Step, pushes: UnitForces<Recorded>| {
            let all = [pushes.inertia, pushes.coriolis, pushes.transposed];
            step.write_list("push", 0, all.iter().flat_map(numbers));
        };
        loops.inward(|loops| {
            loops.by_freedom("i", |loops, freedom| {
                loops.step(|step| {
                    let (carried, own) = (composite(step, "composite[i]"), body(freedom));
                    let turning = step.six("turning[i]", 0);
                    write(step, UnitForces::new(&carried, own.momentum(&carried.mass), &own.axis(), &turning));
                });
            });
            loops.climb(|loops| {
                let cells = [loops.entry("out", "AT[i]", "AT[j]"), loops.entry("out", "AT[j]", "AT[i]")];
                loops.by_freedom("j", |loops, freedom| {
                    loops.when("j != i", |loops| {
                        loops.step(|step| {
                            let entry = pushes(step).of_carrier(&body(freedom), &step.six("turning[j]", 0));
                            self.enter(step, cells[0].clone(), &["i", "j"], entry);
                        });
                    });
                    loops.step(|step| {
                        let entry = body(freedom).along(&pushes(step).coriolis).clone();
                        self.enter(step, cells[1].clone(), &["i", "j"], entry);
                    });
                });
                loops.step(|step| {
                    let outward = pushes(step).outward(&frame(step, "frame[j]"));
                    write(step, outward);
                });
            });
            for freedom in 0..self.formal.first {
                let row = freedom.to_string();
                let cells = [loops.entry("out", "AT[i]", &row), loops.entry("out", &row, "AT[i]")];
                loops.step(|step| {
                    let (pushes, velocity) = (pushes(step), step.six("velocity[0]", 0));
                    let entries = [pushes.of_base(freedom, &velocity), pushes.coriolis.at(freedom).clone()];
                    for (cell, entry) in cells.into_iter().zip(entries) {
                        self.enter(step, cell, &["i"], entry);
                    }
                });
            }
            Self::propagate(loops);
        });
        for column in 0..self.formal.first {
            let cell = |row: usize, column: usize| loops.entry("out", &row.to_string(), &column.to_string());
            let cells: Vec<_> = (0..=column).map(|row| [cell(column, row), cell(row, column)]).collect();
            loops.step(|step| {
                let (base, velocity) = (composite(step, "composite[0]"), step.six("velocity[0]", 0));
                let (axis, turning) = (unit(column), velocity.moving(&unit(column)));
                let pushes = UnitForces::new(&base, base.mass.times(&axis), &axis, &turning);
                for (row, [felt, on]) in cells.into_iter().enumerate() {
                    if row != column {
                        step.write(felt, pushes.of_base(row, &velocity));
                    }
                    step.write(on, pushes.coriolis.at(row).clone());
                }
            });
        }
    }
}
