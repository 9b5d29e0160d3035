//! The recursive algorithms as loops over tables, for robots with long straight-line code. Main type: [`Recursive`].
//!
//! Each step is that of [`groebot_robot::dynamics`] on one body, with its parameters from a table. A row has the body's
//! frame in its parent's (a rotation by rows, and an origin), ten mass parameters, and the inertia of its rotor.

mod cells;
mod derivatives;
mod forward;
mod inverse;
mod matrices;

use super::function::Function;
use super::language::{Language, Table};
use super::loops::{Loops, Step};
use super::tape::Recorded;
use cells::{body, frame, write_frame};
use groebot_robot::dynamics::{Body, Formal, Frame, Freedom, Mass, Place, Scalar, Six, pull};

/// A robot for loops.
pub(super) struct Recursive {
    formal: Formal<f64>,
    freedoms: Vec<Freedom>,
    is_plain: bool,
}

impl Recursive {
    pub fn new(formal: Formal<f64>) -> Self {
        let met = |freedom: &Freedom| formal.tree.bodies.iter().any(|body| body.freedom == *freedom);
        let freedoms = [Freedom::Turn, Freedom::Slide].into_iter().filter(met).collect();
        Recursive { is_plain: formal.is_plain(), freedoms, formal }
    }

    /// Whether each joint is independent.
    pub fn is_plain(&self) -> bool {
        self.is_plain
    }

    fn floats(&self) -> bool {
        self.formal.first > 0
    }

    /// The tables of the robot: each body after its parent.
    pub fn tables(&self) -> Vec<Table> {
        let tree = &self.formal.tree;
        let number = |joint: usize| tree.order.iter().position(|other| *other == joint).map_or(0, |at| at + 1);
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
            Table::Places("PARENT", by_body(0, &|joint| tree.bodies[joint].parent.map_or(0, number))),
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

    /// The code of a function; results are in `out`, or in `by_q` and `by_v`, which are zero at first.
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

    /// The ratio of a joint's motion to its freedom.
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

    /// Computes the frame of a body.
    fn place(&self, loops: &mut Loops<'_>) {
        loops.by_freedom("i", |loops, freedom| {
            loops.step(|step| {
                let own = Body { frame: frame(step, "BODY[i]"), ..body(freedom) };
                let place = match freedom {
                    Freedom::Turn => Place::Turn(["c", "s"].map(|name| step.read(format!("{name}[PLACE[i]]")))),
                    Freedom::Slide => Place::Slide(step.read("displacement[PLACE[i]]")),
                };
                write_frame(step, "frame[i]", own.placed(&place));
            });
        });
    }

    /// Adds the term of two freedoms to the entry of a matrix.
    fn enter(&self, step: &mut Step, cell: String, of: &[&str], value: Recorded) {
        if self.is_plain {
            step.write(cell, value);
        } else {
            let value = of.iter().fold(value, |value, index| self.factor(step, index) * value);
            step.add(cell, value);
        }
    }
}
