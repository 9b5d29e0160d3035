//! groebot's library: the programs `5_program.json` of `derivations/`, run without compilation.

use std::cell::RefCell;

use groebot::solver::{Batch, Program, Solver};

use crate::Joints;
use crate::by_print::Target;

/// A program that is ready to run, with the memory of its batches.
pub struct Read {
    solver: Solver,
    batch: RefCell<Batch>,
}

impl Read {
    /// Reads the program of the folder with this name.
    pub fn new(name: &str) -> Self {
        let file = format!("{}/../../derivations/{name}/5_program.json", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&file).unwrap_or_else(|error| panic!("{file}: {error}"));
        let program = Program::from_json(&text).expect("a program");
        Read { solver: program.solver(), batch: RefCell::default() }
    }

    /// Solves all targets one by one and returns the number of all solutions.
    pub fn pass(&self, targets: &[Target]) -> usize {
        targets.iter().map(|target| self.solver.solve_numbers(target).map_or(0, |answers| answers.len())).sum()
    }

    /// Solves all targets as a batch and returns the number of all solutions.
    pub fn batch(&self, targets: &[Target]) -> usize {
        let mut batch = self.batch.borrow_mut();
        self.solver.solve_batch_into(targets.as_flattened(), &mut batch).expect("twelve numbers a target");
        batch.answers()
    }

    /// Returns all solutions of one target.
    pub fn solutions(&self, target: &Target) -> Vec<Joints> {
        let answers = self.solver.solve_numbers(target).unwrap_or_default();
        answers.iter().map(|answer| std::array::from_fn(|joint| answer.q[joint])).collect()
    }

    /// Forward kinematics of all joint vectors.
    pub fn forward(&self, all: &[Joints]) {
        for q in all {
            std::hint::black_box(self.solver.reached(std::hint::black_box(q)));
        }
    }
}
