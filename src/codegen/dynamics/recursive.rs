//! The recursions as loops over tables, for robots of which straight-line code would be long. Main type: [`Recursive`].
//!
//! Steps are those of [`crate::dynamics`] on one body, whose figures come from a table. By body there are: where its frame stands in its parent's (a rotation by rows, and an
//! origin), ten numbers of what it weighs, and the inertia of its rotor.

use super::loops::{Loops, Step};
use super::tape::Recorded;
use super::{Function, Language};
use crate::dynamics::recursions::{Changes, Composite, Pushes, Resistance, Yielding, bias, pushed, unit};
use crate::dynamics::{Body, Formal, Frame, Freedom, Mass, Place, Scalar, Six, pull};

/// Where in a row of the table what a body weighs begins, and where the inertia of its rotor stands.
const WEIGHS: usize = 12;
const ROTOR: usize = 22;

/// A robot for loops.
pub(super) struct Recursive {
    formal: Formal<f64>,
    freedoms: Vec<Freedom>,
    /// Whether each joint is a freedom of its own.
    is_plain: bool,
}

/// A table of the robot: by body, the base first.
pub(super) enum Table {
    Places(&'static str, Vec<usize>),
    Numbers(&'static str, Vec<Vec<f64>>),
}

fn numbers(six: &Six<Recorded>) -> impl Iterator<Item = Recorded> + '_ {
    (0..6).map(|at| six.at(at).clone())
}

fn frame(step: &mut Step, row: &str) -> Frame<Recorded> {
    let list = step.list::<12>(row, 0);
    let entry = |at: usize| list[at].clone();
    Frame {
        rotation: std::array::from_fn(|i| std::array::from_fn(|j| entry(3 * i + j))),
        position: std::array::from_fn(|i| entry(9 + i)),
    }
}

fn write_frame(step: &mut Step, row: &str, frame: Frame<Recorded>) {
    step.write_list(row, 0, frame.rotation.into_iter().flatten().chain(frame.position));
}

fn mass(step: &mut Step, row: &str, from: usize) -> Mass<Recorded> {
    Mass::of(step.list::<10>(row, from))
}

/// A body whose joint moves so; where its frame and mass are not needed they are not read.
fn body(freedom: Freedom) -> Body<Recorded> {
    Body { parent: None, freedom, frame: Frame::identity(), mass: Mass::of(std::array::from_fn(|_| Recorded::zero())) }
}

/// The numbers of a composite: its mass, how that changes (the mass itself does not), its momentum.
const COMPOSITE: usize = 25;

fn composite(step: &mut Step, row: &str) -> Composite<Recorded> {
    let [rate @ ..] = step.list::<9>(row, 10);
    let mut all = vec![Recorded::zero()];
    all.extend(rate);
    let rate: [Recorded; 10] = all.try_into().unwrap_or_else(|_| unreachable!("one and nine are ten"));
    Composite { mass: mass(step, row, 0), rate: Mass::of(rate), momentum: step.six(row, 19) }
}

fn composite_numbers(composite: &Composite<Recorded>) -> Vec<Recorded> {
    let rate = composite.rate.numbers().into_iter().skip(1);
    composite.mass.numbers().into_iter().chain(rate).chain(numbers(&composite.momentum)).collect()
}

fn resistance(step: &mut Step, row: &str) -> Resistance<Recorded> {
    let mut matrix = |from: usize| {
        let list = step.list::<9>(row, from);
        std::array::from_fn(|i| std::array::from_fn(|j| list[3 * i + j].clone()))
    };
    Resistance { linear: matrix(0), coupling: matrix(9), angular: matrix(18) }
}

fn resistance_numbers(resistance: Resistance<Recorded>) -> impl Iterator<Item = Recorded> {
    [resistance.linear, resistance.coupling, resistance.angular].into_iter().flatten().flatten()
}

impl Recursive {
    pub fn new(formal: Formal<f64>) -> Self {
        let drives = formal.drives.iter().enumerate();
        let is_plain = drives.into_iter().all(|(at, drive)| drive.freedom == at && drive.factor == 1.0);
        let met = |freedom: &Freedom| formal.tree.bodies.iter().any(|body| body.freedom == *freedom);
        let freedoms = [Freedom::Turn, Freedom::Slide].into_iter().filter(met).collect();
        Recursive { is_plain, freedoms, formal }
    }

    fn floats(&self) -> bool {
        self.formal.first > 0
    }

    /// The tables of the robot: each body behind those that carry it.
    pub fn tables(&self) -> Vec<Table> {
        let tree = &self.formal.tree;
        let behind = |joint: usize| tree.order.iter().position(|other| *other == joint).map_or(0, |at| at + 1);
        let by_body = |of_base: usize, of_joint: &dyn Fn(usize) -> usize| -> Vec<usize> {
            std::iter::once(of_base).chain(tree.order.iter().map(|joint| of_joint(*joint))).collect()
        };
        let alike = |joint: usize| {
            let freedom = tree.bodies[joint].freedom;
            tree.bodies[..joint].iter().filter(|body| body.freedom == freedom).count()
        };
        let row = |frame: &Frame<f64>, mass: &Mass<f64>, rotor: f64| -> Vec<f64> {
            let frame = frame.rotation.iter().flatten().chain(&frame.position).copied();
            frame.chain(mass.numbers()).chain([rotor]).collect()
        };
        let of_joint = |joint: &usize| {
            let body = &tree.bodies[*joint];
            row(&body.frame, &body.mass, self.formal.drives[*joint].armature)
        };
        let base = row(&Frame::identity(), &tree.base, 0.0);
        let mut tables = vec![
            Table::Places("PARENT", by_body(0, &|joint| tree.bodies[joint].parent.map_or(0, behind))),
            Table::Places("AT", by_body(0, &|joint| self.formal.first + self.formal.drives[joint].freedom)),
            Table::Places("PLACE", by_body(0, &alike)),
            Table::Numbers("BODY", std::iter::once(base).chain(tree.order.iter().map(of_joint)).collect()),
        ];
        if self.freedoms.len() > 1 {
            let slides = |joint: usize| usize::from(tree.bodies[joint].freedom == Freedom::Slide);
            tables.push(Table::Places("SLIDES", by_body(0, &slides)));
        }
        if !self.is_plain {
            let factors = tree.order.iter().map(|joint| vec![self.formal.drives[*joint].factor]);
            tables.push(Table::Numbers("FACTOR", std::iter::once(vec![0.0]).chain(factors).collect()));
        }
        tables
    }

    /// The code of a function; results stand in `out`, or in `by_q` and `by_v`, which are nought at first.
    pub fn code(&self, function: Function, language: &dyn Language) -> Vec<String> {
        let mut loops = Loops::new(language, &self.freedoms);
        match function {
            Function::Inverse => self.inverse(&mut loops, true),
            Function::Gravity => self.inverse(&mut loops, false),
            Function::Inertia => self.inertia(&mut loops),
            Function::Coriolis => self.coriolis(&mut loops),
            Function::Forward => self.forward(&mut loops),
            Function::Derivatives => self.derivatives(&mut loops),
        }
        loops.lines()
    }

    /// How much a joint moves with its freedom.
    fn factor(&self, step: &mut Step, index: &str) -> Recorded {
        if self.is_plain { Recorded::one() } else { step.read(format!("FACTOR[{index}][0]")) }
    }

    fn of_joint(&self, step: &mut Step, list: &str) -> Recorded {
        self.factor(step, "i") * step.read(format!("{list}[AT[i]]"))
    }

    fn base(&self, step: &mut Step, list: &str) -> Six<Recorded> {
        if self.floats() { step.six(list, 0) } else { Six::zero() }
    }

    fn pull(&self, step: &mut Step) -> Six<Recorded> {
        let turn = self.floats().then(|| step.list::<4>("q", 3));
        pull(&self.formal.gravity.map(Recorded::constant), turn.as_ref())
    }

    /// Places the frame of a body.
    fn place(&self, loops: &mut Loops<'_>) {
        loops.by_freedom("i", |loops, freedom| {
            loops.step(|step| {
                let own = Body { frame: frame(step, "BODY[i]"), ..body(freedom) };
                let place = match freedom {
                    Freedom::Turn => Place::Turn(["c", "s"].map(|name| step.read(format!("{name}[PLACE[i]]")))),
                    Freedom::Slide => Place::Slide(step.read("way[PLACE[i]]")),
                };
                write_frame(step, "frame[i]", own.placed(&place));
            });
        });
    }

    /// Adds to the entry of a matrix what two freedoms have to do with one another.
    fn enter(&self, step: &mut Step, cell: String, of: &[&str], value: Recorded) {
        if self.is_plain {
            step.write(cell, value);
        } else {
            let value = of.iter().fold(value, |value, index| self.factor(step, index) * value);
            step.add(cell, value);
        }
    }

    /// The velocity of the base, and its acceleration less gravity's.
    fn start(&self, loops: &mut Loops<'_>, moves: bool) {
        loops.step(|step| {
            let pull = self.pull(step);
            let [velocity, acceleration] =
                if moves { ["v", "a"].map(|list| self.base(step, list)) } else { [Six::zero(), Six::zero()] };
            let acceleration = pull.add(&acceleration);
            if self.floats() {
                let force = pushed(&mass(step, "BODY[0]", WEIGHS), &velocity, &acceleration, None);
                step.write_list("force[0]", 0, numbers(&force));
            }
            if moves {
                step.write_list("velocity[0]", 0, numbers(&velocity));
            }
            step.write_list("acceleration[0]", 0, numbers(&acceleration));
        });
    }

    /// Places a body, moves it and tells the force that it asks for.
    fn move_on(&self, loops: &mut Loops<'_>, moves: bool) {
        self.place(loops);
        loops.by_freedom("i", |loops, freedom| {
            loops.step(|step| {
                let (frame, own) = (frame(step, "frame[i]"), body(freedom));
                let mut acceleration = frame.motion_inward(&step.six("acceleration[p]", 0));
                let mut velocity = Six::zero();
                if moves {
                    velocity = frame.motion_inward(&step.six("velocity[p]", 0));
                    let [rate, change] = ["v", "a"].map(|list| self.of_joint(step, list));
                    own.quicken(&mut velocity, rate.clone());
                    acceleration = acceleration.add(&own.turning(&velocity, &rate));
                    own.quicken(&mut acceleration, change);
                    step.write_list("velocity[i]", 0, numbers(&velocity));
                }
                let force = pushed(&mass(step, "BODY[i]", WEIGHS), &velocity, &acceleration, None);
                step.write_list("acceleration[i]", 0, numbers(&acceleration));
                step.write_list("force[i]", 0, numbers(&force));
            });
        });
    }

    fn inverse(&self, loops: &mut Loops<'_>, moves: bool) {
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

    /// Tells what the base feels.
    fn finish(&self, loops: &mut Loops<'_>, row: &str) {
        if self.floats() {
            loops.step(|step| {
                let force = step.six(row, 0);
                step.write_list("out", 0, numbers(&force));
            });
        }
    }

    fn inertia(&self, loops: &mut Loops<'_>) {
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

    /// Tells the composite of a body alone, and how its axis turns.
    fn compose(&self, loops: &mut Loops<'_>) {
        loops.by_freedom("i", |loops, freedom| {
            loops.step(|step| {
                let velocity = step.six("velocity[i]", 0);
                let turning = body(freedom).turning(&velocity, &Recorded::one());
                step.write_list("turning[i]", 0, numbers(&turning));
            });
        });
        self.compose_body(loops, "i");
    }

    fn compose_body(&self, loops: &mut Loops<'_>, index: &str) {
        loops.step(|step| {
            let velocity = step.six(&format!("velocity[{index}]"), 0);
            let own = Composite::of(&mass(step, &format!("BODY[{index}]"), WEIGHS), &velocity);
            step.write_list(&format!("composite[{index}]"), 0, composite_numbers(&own));
        });
    }

    /// Places a body and tells its velocity.
    fn quicken(&self, loops: &mut Loops<'_>) {
        self.place(loops);
        loops.by_freedom("i", |loops, freedom| {
            loops.step(|step| {
                let mut velocity = frame(step, "frame[i]").motion_inward(&step.six("velocity[p]", 0));
                let rate = self.of_joint(step, "v");
                body(freedom).quicken(&mut velocity, rate);
                step.write_list("velocity[i]", 0, numbers(&velocity));
            });
        });
    }

    /// The velocity of the base.
    fn start_velocity(&self, loops: &mut Loops<'_>) {
        if self.floats() {
            loops.step(|step| {
                let velocity = step.six("v", 0);
                step.write_list("velocity[0]", 0, numbers(&velocity));
            });
        }
    }

    /// Adds the composite of a body to that of its parent.
    fn hand_on(loops: &mut Loops<'_>) {
        loops.step(|step| {
            let outward = composite(step, "composite[i]").outward(&frame(step, "frame[i]"));
            step.add_list("composite[p]", 0, composite_numbers(&outward));
        });
    }

    fn coriolis(&self, loops: &mut Loops<'_>) {
        loops.arrays(&[("frame", 12), ("velocity", 6), ("turning", 6), ("composite", COMPOSITE)]);
        loops.row("push", 18);
        self.start_velocity(loops);
        if self.floats() {
            self.compose_body(loops, "0");
        }
        loops.outward(|loops| {
            self.quicken(loops);
            self.compose(loops);
        });
        let pushes = |step: &mut Step| {
            let [inertia, coriolis, transposed] = [0, 6, 12].map(|from| step.six("push", from));
            Pushes { inertia, coriolis, transposed }
        };
        let write = |step: &mut Step, pushes: Pushes<Recorded>| {
            let all = [pushes.inertia, pushes.coriolis, pushes.transposed];
            step.write_list("push", 0, all.iter().flat_map(numbers));
        };
        loops.inward(|loops| {
            loops.by_freedom("i", |loops, freedom| {
                loops.step(|step| {
                    let (carried, own) = (composite(step, "composite[i]"), body(freedom));
                    let turning = step.six("turning[i]", 0);
                    write(step, Pushes::new(&carried, own.momentum(&carried.mass), &own.axis(), &turning));
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
            Self::hand_on(loops);
        });
        for column in 0..self.formal.first {
            let cell = |row: usize, column: usize| loops.entry("out", &row.to_string(), &column.to_string());
            let cells: Vec<_> = (0..=column).map(|row| [cell(column, row), cell(row, column)]).collect();
            loops.step(|step| {
                let (base, velocity) = (composite(step, "composite[0]"), step.six("velocity[0]", 0));
                let (axis, turning) = (unit(column), velocity.moving(&unit(column)));
                let pushes = Pushes::new(&base, base.mass.times(&axis), &axis, &turning);
                for (row, [felt, on]) in cells.into_iter().enumerate() {
                    if row != column {
                        step.write(felt, pushes.of_base(row, &velocity));
                    }
                    step.write(on, pushes.coriolis.at(row).clone());
                }
            });
        }
    }

    fn derivatives(&self, loops: &mut Loops<'_>) {
        let arrays = [("frame", 12), ("velocity", 6), ("acceleration", 6), ("force", 6)];
        loops.arrays(&arrays);
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
        let changes = |step: &mut Step| {
            let by = [0, 6, 12].map(|from| step.six("push", from));
            Changes { by, felt: step.six("push", 18) }
        };
        let write = |step: &mut Step, changes: Changes<Recorded>| {
            step.write_list("push", 0, changes.by.iter().chain([&changes.felt]).flat_map(numbers));
        };
        let cells = |loops: &Loops<'_>, row: &str, column: &str| {
            ["by_q", "by_v"].map(|matrix| loops.entry(matrix, row, column))
        };
        let enter = |step: &mut Step, cells: &[String; 2], of: &[&str], [q, v, _]: [Recorded; 3]| {
            [q, v].into_iter().zip(cells).for_each(|(entry, cell)| self.enter(step, cell.clone(), of, entry));
        };
        loops.inward(|loops| {
            loops.by_freedom("i", |loops, freedom| {
                loops.step(|step| {
                    let (carried, own) = (composite(step, "composite[i]"), body(freedom));
                    let [turning, bend, force] = ["turning[i]", "bend[i]", "force[i]"].map(|row| step.six(row, 0));
                    let mut new = Changes::new(&carried, &own.axis(), &turning, &bend, &turning.add(&turning));
                    new.by[0] = new.by[0].add(&own.swung(&force));
                    write(step, new);
                });
            });
            loops.climb(|loops| {
                let [on, felt] = [("AT[j]", "AT[i]"), ("AT[i]", "AT[j]")].map(|(i, j)| cells(loops, i, j));
                loops.by_freedom("j", |loops, freedom| {
                    loops.step(|step| {
                        let entries = changes(step).on_carrier(&body(freedom));
                        enter(step, &on, &["i", "j"], entries);
                    });
                    loops.when("j != i", |loops| {
                        loops.step(|step| {
                            let [turning, bend] = ["turning[j]", "bend[j]"].map(|row| step.six(row, 0));
                            let entries = changes(step).of_carrier(&body(freedom), &turning, &bend);
                            enter(step, &felt, &["i", "j"], entries);
                        });
                    });
                });
                loops.step(|step| {
                    let outward = changes(step).outward(&frame(step, "frame[j]"));
                    write(step, outward);
                });
            });
            for freedom in 0..self.formal.first {
                let row = freedom.to_string();
                let [on, felt] = [(row.as_str(), "AT[i]"), ("AT[i]", row.as_str())].map(|(i, j)| cells(loops, i, j));
                loops.step(|step| {
                    let (velocity, pull) = (step.six("velocity[0]", 0), self.pull(step));
                    let [of_base, own] = changes(step).with_base(freedom, &velocity, &pull);
                    enter(step, &on, &["i"], of_base);
                    enter(step, &felt, &["i"], own);
                });
            }
            Self::hand_on(loops);
            loops.step(|step| {
                let force = frame(step, "frame[i]").force_outward(&step.six("force[i]", 0));
                step.add_list("force[p]", 0, numbers(&force));
            });
        });
        for column in 0..self.formal.first {
            let rows: Vec<_> = (0..6).map(|row| cells(loops, &row.to_string(), &column.to_string())).collect();
            loops.step(|step| {
                let (velocity, pull) = (step.six("velocity[0]", 0), self.pull(step));
                let changes = Changes::of_base(&composite(step, "composite[0]"), column, &velocity, &pull);
                for (row, cells) in rows.iter().enumerate() {
                    enter(step, cells, &[], changes.by.each_ref().map(|change| change.at(row).clone()));
                }
            });
        }
    }

    fn forward(&self, loops: &mut Loops<'_>) {
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
                base.solve(&torque.add(&bias.negated()), |_| true).unwrap_or_else(Six::zero)
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
