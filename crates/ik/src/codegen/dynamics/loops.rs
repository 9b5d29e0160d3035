//! Code in loops over the bodies of a robot. Main type: [`Loops`].
//!
//! Bodies are numbered from 1, each after its parent; 0 is the base. Results of each body are in arrays, in cells such
//! as `force[i][2]`. `i` is a body, `p` its parent, `j` runs from the body over its ancestors to the base. A [`Step`]
//! is straight-line code that reads cells and writes others.

use super::language::Language;
use super::tape::{Recorded, Tape};
use crate::codegen::printer::{INDENT, Printer};

use crate::solver::Demand;
use groebot_robot::dynamics::Freedom;
use groebot_robot::dynamics::recursions::Six;

/// Prints the lines of loops.
pub(super) struct Loops<'a> {
    language: &'a dyn Language,
    /// The motions of the robot's joints: rotation, translation, or both kinds.
    freedoms: &'a [Freedom],
    lines: Vec<String>,
    depth: usize,
}

/// Straight-line code on cells; it reads all of them before it writes any.
#[derive(Default)]
pub(super) struct Step {
    tape: Tape,
    cells: Vec<String>,
    written: Vec<(String, Recorded)>,
}

impl<'a> Loops<'a> {
    pub fn new(language: &'a dyn Language, freedoms: &'a [Freedom]) -> Self {
        Loops { language, freedoms, lines: Vec::new(), depth: 0 }
    }

    pub fn lines(self) -> Vec<String> {
        self.lines
    }

    fn line(&mut self, text: &str) {
        self.lines.push(format!("{}{text}", INDENT.repeat(self.depth)));
    }

    fn block(&mut self, head: &str, inner: impl FnOnce(&mut Self)) {
        self.line(head);
        self.depth += 1;
        inner(self);
        self.depth -= 1;
        self.line("}");
    }

    /// New arrays, zero at first: their names, and the number of values of each body.
    pub fn arrays(&mut self, arrays: &[(&str, usize)]) {
        for (name, count) in arrays {
            self.line(&self.language.zeros(name, *count));
        }
    }

    /// A new array, zero at first.
    pub fn row(&mut self, name: &str, count: usize) {
        self.line(&self.language.zero_row(name, count));
    }

    /// A loop over the bodies, from the base outward.
    pub fn outward(&mut self, inner: impl FnOnce(&mut Self)) {
        self.bodies(false, inner);
    }

    /// A loop over the bodies, inward to the base.
    pub fn inward(&mut self, inner: impl FnOnce(&mut Self)) {
        self.bodies(true, inner);
    }

    fn bodies(&mut self, inward: bool, inner: impl FnOnce(&mut Self)) {
        let head = self.language.bodies(inward);
        self.block(head, |loops| {
            let first = loops.lines.len();
            inner(loops);
            if loops.lines[first..].iter().any(|line| line.contains("[p]")) {
                let parent = format!("{}{}", INDENT.repeat(loops.depth), loops.language.index("p", "PARENT[i]"));
                loops.lines.insert(first, parent);
            }
        });
    }

    /// A loop from the body itself over its ancestors; the base is excluded.
    pub fn climb(&mut self, inner: impl FnOnce(&mut Self)) {
        let [start, head] = self.language.climb();
        self.line(start);
        self.block(head, |loops| {
            inner(loops);
            loops.line("j = PARENT[j];");
        });
    }

    /// A case distinction by the joint type of the body with this index.
    pub fn by_freedom(&mut self, index: &str, inner: impl Fn(&mut Self, Freedom)) {
        if let [one] = self.freedoms {
            return inner(self, *one);
        }
        self.when(&format!("SLIDES[{index}] != 0"), |loops| inner(loops, Freedom::Slide));
        self.when(&format!("SLIDES[{index}] == 0"), |loops| inner(loops, Freedom::Turn));
    }

    /// A conditional block.
    pub fn when(&mut self, condition: &str, inner: impl FnOnce(&mut Self)) {
        let head = self.language.when(condition);
        self.block(&head, inner);
    }

    /// A step.
    pub fn step(&mut self, inner: impl FnOnce(&mut Step)) {
        let mut step = Step::default();
        inner(&mut step);
        let Step { tape, cells, written } = step;
        let (places, results): (Vec<String>, Vec<Recorded>) = written.into_iter().unzip();
        let (code, results) = tape.code(&results);
        let mut printer = Printer::of(self.language.expressions(), &cells, Demand::of_code(&code, &results));
        let mut lines = printer.code(&code);
        lines.extend(printer.settle());
        let is_short = lines.is_empty();
        let writes = places.into_iter().zip(results);
        lines.extend(writes.map(|(place, result)| format!("{place} = {};", printer.operand(result))));
        if is_short {
            lines.iter().for_each(|line| self.line(line));
        } else {
            self.block("{", |loops| lines.iter().for_each(|line| loops.line(line)));
        }
    }

    /// The entry of a matrix.
    pub fn entry(&self, matrix: &str, row: &str, column: &str) -> String {
        self.language.entry(matrix, row, column)
    }
}

impl Step {
    /// Reads a cell.
    pub fn read(&mut self, cell: impl Into<String>) -> Recorded {
        let cell = cell.into();
        let known = self.cells.iter().position(|other| *other == cell);
        let place = known.unwrap_or_else(|| {
            self.cells.push(cell);
            self.cells.len() - 1
        });
        self.tape.input(place)
    }

    /// Reads consecutive cells.
    pub fn list<const N: usize>(&mut self, row: &str, from: usize) -> [Recorded; N] {
        std::array::from_fn(|at| self.read(format!("{row}[{}]", from + at)))
    }

    /// Reads six consecutive cells.
    pub fn six(&mut self, row: &str, from: usize) -> Six<Recorded> {
        Six::of(&self.list::<6>(row, from))
    }

    /// Writes a cell.
    pub fn write(&mut self, cell: impl Into<String>, value: Recorded) {
        self.written.push((cell.into(), value));
    }

    /// Writes consecutive cells.
    pub fn write_list(&mut self, row: &str, from: usize, values: impl IntoIterator<Item = Recorded>) {
        for (at, value) in (from..).zip(values) {
            self.write(format!("{row}[{at}]"), value);
        }
    }

    /// Adds to a cell.
    pub fn add(&mut self, cell: impl Into<String>, value: Recorded) {
        let cell = cell.into();
        let sum = self.read(cell.clone()) + value;
        self.write(cell, sum);
    }

    /// Adds to consecutive cells.
    pub fn add_list(&mut self, row: &str, from: usize, values: impl IntoIterator<Item = Recorded>) {
        for (at, value) in (from..).zip(values) {
            self.add(format!("{row}[{at}]"), value);
        }
    }
}
