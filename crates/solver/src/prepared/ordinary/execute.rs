//! Execution of straight-line code on rows of lanes. Main type: [`Outcome`].

use std::cell::Cell;

use groebot_runtime::lanes::{Doubt, Lanes, Mask};
use groebot_runtime::registers::in_widest;
use groebot_runtime::{Guard, Number};

use super::super::code::{Kind, Line};
use super::plan::{Action, PlacedTest, Plan, Rows, Step};

/// The number of lanes of a row: those of the widest vector register.
pub(super) const WIDTH: usize = 8;
/// The maximal number of rows of a value, one for each candidate.
pub(super) const MOST: usize = 16;

/// A row in memory.
pub(super) type Row = Line<Number8>;

/// The numbers of a row.
pub(super) type Number8 = Lanes<WIDTH>;

/// What execution finds about lanes, beside values.
pub(super) struct Outcome {
    /// By row of the last root's operands, where roots do not exist or are close to each other.
    pub roots: [Doubt<WIDTH>; MOST],
    /// Where guards hold that do not at ordinary targets, or the reverse.
    pub doubt: Mask<WIDTH>,
}

impl Outcome {
    pub const NONE: Outcome = Outcome { roots: [Number8::SURE; MOST], doubt: Mask::NONE };
}

impl Plan {
    /// Makes room for a number of rows and writes the constants, which stay in memory.
    #[inline(always)]
    pub fn begin(&self, memory: &mut Vec<Row>, size: usize) {
        if memory.len() < size {
            memory.resize(size, Line(Lanes([0.0; WIDTH])));
        }
        for &(place, constant) in &self.constants {
            memory[place as usize].0 = Lanes([constant; WIDTH]);
        }
    }

    /// Writes the numbers of targets.
    #[inline(always)]
    pub fn load(&self, memory: &mut [Row], input: impl Fn(usize) -> Number8) {
        for &(place, index) in &self.inputs {
            memory[place as usize].0 = input(index);
        }
    }

    /// Runs the code in the widest registers of the processor.
    pub fn run(&self, memory: &mut [Row], outcome: &mut Outcome) {
        in_widest(
            #[inline(always)]
            || self.run_steps(memory, outcome),
        );
    }

    #[inline(always)]
    fn run_steps(&self, memory: &mut [Row], outcome: &mut Outcome) {
        (outcome.roots[0], outcome.doubt) = (Number8::SURE, Mask::NONE);
        for step in &self.steps {
            match step.action {
                Action::Compute(Kind::Add) => each(step, memory, |a, b| a + b),
                Action::Compute(Kind::Sub) => each(step, memory, |a, b| a - b),
                Action::Compute(Kind::Mul) => each(step, memory, |a, b| a * b),
                Action::Compute(Kind::Div) => each(step, memory, |a, b| a / b),
                Action::Compute(Kind::Abs) => each(step, memory, |a, _| a.abs()),
                Action::Compute(Kind::Sqrt) => each(step, memory, |a, _| a.root()),
                Action::Compute(Kind::Greater) => each(step, memory, |a, b| a.greater(b.abs())),
                Action::ProductPlus => products(step, memory, |a, b, c, _| a * b + c),
                Action::ProductMinus => products(step, memory, |a, b, c, _| a * b - c),
                Action::MinusProduct => products(step, memory, |a, b, c, _| c - a * b),
                Action::ProductsSum => products(step, memory, |a, b, c, d| a * b + c * d),
                Action::ProductsDifference => products(step, memory, |a, b, c, d| a * b - c * d),
                Action::Roots => both_roots(step, memory, outcome),
                Action::FirstRoot => first_root(step, memory, outcome),
                Action::OwnRoot { bit } => own_root(step, bit, memory, outcome),
                Action::Guard => {
                    let (tests, is_usual) = &self.guards[step.target as usize];
                    guard(step, tests, *is_usual, memory, outcome);
                }
            }
        }
    }
}

/// Computes each row of an operation with two operands.
#[inline(always)]
fn each(step: &Step, memory: &mut [Row], operation: impl Fn(Number8, Number8) -> Number8) {
    let ([a, b, ..], target, rows) = (step.operands, step.target as usize, step.rows as usize);
    if rows == 1 {
        memory[target] = Line(operation(memory[a.first as usize].0, memory[b.first as usize].0));
        return;
    }
    let memory = Cell::from_mut(memory).as_slice_of_cells();
    let (targets, of_a, of_b) = (&memory[target..][..rows], a.cells(memory, rows), b.cells(memory, rows));
    let set = |target: &Cell<Row>, a: &Cell<Row>, b: &Cell<Row>| target.set(Line(operation(a.get().0, b.get().0)));
    // Two rows at a time: the compiler would transpose single rows to vectorise the loop.
    let targets = targets.chunks_exact(2);
    if of_a.len() == rows && of_b.len() == rows {
        for ((target, a), b) in targets.zip(of_a.chunks_exact(2)).zip(of_b.chunks_exact(2)) {
            set(&target[0], &a[0], &b[0]);
            set(&target[1], &a[1], &b[1]);
        }
    } else if of_a.len() == 1 && of_b.len() == rows {
        for (target, b) in targets.zip(of_b.chunks_exact(2)) {
            set(&target[0], &of_a[0], &b[0]);
            set(&target[1], &of_a[0], &b[1]);
        }
    } else if of_a.len() == rows && of_b.len() == 1 {
        for (target, a) in targets.zip(of_a.chunks_exact(2)) {
            set(&target[0], &a[0], &of_b[0]);
            set(&target[1], &a[1], &of_b[0]);
        }
    } else {
        for (pair, target) in targets.enumerate() {
            let [first, second] = [2 * pair, 2 * pair + 1];
            set(&target[0], &of_a[first >> a.shift], &of_b[first >> b.shift]);
            set(&target[1], &of_a[second >> a.shift], &of_b[second >> b.shift]);
        }
    }
}

/// Computes each row of an operation with up to four operands.
#[inline(always)]
fn products(step: &Step, memory: &mut [Row], operation: impl Fn(Number8, Number8, Number8, Number8) -> Number8) {
    let ([a, b, c, d], target, rows) = (step.operands, step.target as usize, step.rows as usize);
    if rows == 1 {
        let number = |rows: Rows| memory[rows.first as usize].0;
        memory[target] = Line(operation(number(a), number(b), number(c), number(d)));
        return;
    }
    let memory = Cell::from_mut(memory).as_slice_of_cells();
    let (of_a, of_b) = (a.cells(memory, rows), b.cells(memory, rows));
    let (of_c, of_d) = (c.cells(memory, rows), d.cells(memory, rows));
    let targets = &memory[target..][..rows];
    if of_a.len() + of_b.len() + of_c.len() + of_d.len() == 4 * rows {
        let set = |target: &Cell<Row>, a: &Cell<Row>, b: &Cell<Row>, c: &Cell<Row>, d: &Cell<Row>| {
            target.set(Line(operation(a.get().0, b.get().0, c.get().0, d.get().0)));
        };
        let (targets, of_a, of_b) = (targets.chunks_exact(2), of_a.chunks_exact(2), of_b.chunks_exact(2));
        let (of_c, of_d) = (of_c.chunks_exact(2), of_d.chunks_exact(2));
        for ((((target, a), b), c), d) in targets.zip(of_a).zip(of_b).zip(of_c).zip(of_d) {
            set(&target[0], &a[0], &b[0], &c[0], &d[0]);
            set(&target[1], &a[1], &b[1], &c[1], &d[1]);
        }
        return;
    }
    let number = |rows: Rows, cells: &[Cell<Row>], row: usize| cells[row >> rows.shift].get().0;
    for (row, target) in targets.iter().enumerate() {
        let (a, b) = (number(a, of_a, row), number(b, of_b, row));
        target.set(Line(operation(a, b, number(c, of_c, row), number(d, of_d, row))));
    }
}

impl Rows {
    /// The rows of a value that is read for `rows` rows.
    #[inline(always)]
    fn cells(self, memory: &[Cell<Row>], rows: usize) -> &[Cell<Row>] {
        &memory[self.first as usize..][..rows >> self.shift]
    }
}

/// The roots of a row, ascending, and where they are in doubt.
#[inline(always)]
fn roots(step: &Step, row: usize, memory: &[Row]) -> ([Number8; 2], Doubt<WIDTH>) {
    let roots = Lanes::square_roots(memory[step.operands[0].at(row)].0, memory[step.operands[1].at(row)].0);
    ([roots.as_slice()[0], roots.as_slice()[1]], roots.doubt(0))
}

/// Both roots, for twice as many rows.
#[inline(always)]
fn both_roots(step: &Step, memory: &mut [Row], outcome: &mut Outcome) {
    let target = step.target as usize;
    // Rows of earlier roots are read before they are overwritten.
    for row in (0..step.rows as usize).rev() {
        let (values, doubt) = roots(step, row, memory);
        outcome.roots[row] = outcome.roots[row / 2] | doubt;
        [memory[target + 2 * row].0, memory[target + 2 * row + 1].0] = values;
    }
}

#[inline(always)]
fn first_root(step: &Step, memory: &mut [Row], outcome: &mut Outcome) {
    for row in (0..step.rows as usize).rev() {
        let (values, doubt) = roots(step, row, memory);
        outcome.roots[row] = outcome.roots[row / 2] | doubt;
        memory[step.target as usize + row].0 = values[0];
    }
}

/// Of each candidate the root that a bit of its index selects.
#[inline(always)]
fn own_root(step: &Step, bit: u32, memory: &mut [Row], outcome: &mut Outcome) {
    for row in 0..step.rows as usize {
        let ([low, high], doubt) = roots(step, row, memory);
        let is_high = |lane: usize| (row * WIDTH + lane) >> bit & 1 == 1;
        let is_high = Mask(std::array::from_fn(|lane| if is_high(lane) { !0 } else { 0 }));
        outcome.roots[row] = outcome.roots[row] | doubt;
        memory[step.target as usize + row].0 = high.or(low, is_high);
    }
}

#[inline(always)]
fn guard(step: &Step, tests: &[PlacedTest], is_usual: bool, memory: &[Row], outcome: &mut Outcome) {
    for row in 0..step.rows as usize {
        let here = |test: &PlacedTest| {
            let (value, scale) = (memory[test.value.at(row)].0, memory[test.scale.at(row)].0);
            let Guard { here, .. } = if test.near { value.near(scale) } else { value.away(scale) };
            here
        };
        let mut all = Mask([!0; WIDTH]);
        for test in tests {
            all = all & here(test);
        }
        outcome.doubt = outcome.doubt | if is_usual { all.inverted() } else { all };
    }
}
