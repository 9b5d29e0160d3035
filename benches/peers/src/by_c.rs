//! groebot's generated C solvers: the files `5_solver.c` of `derivations/`, with the run time in one translation unit, compiled by `build.rs`.

use crate::Joints;
use crate::by_print::Target;

/// A generated solver, compiled by one compiler.
pub struct Compiled {
    robot: &'static str,
    compiler: &'static str,
    pass: unsafe extern "C" fn(*const f64, usize) -> usize,
    batch: unsafe extern "C" fn(*const f64, usize) -> usize,
    solutions: unsafe extern "C" fn(*const f64, *mut f64) -> usize,
    forward: unsafe extern "C" fn(*const f64, usize),
}

include!(concat!(env!("OUT_DIR"), "/printed_c.rs"));

/// Maximum number of solutions in [`Compiled::solutions`], which is above the capacity of each generated solver.
const ROOM: usize = 64;

/// The solvers of the robot with this name, one for each compiler.
pub fn solvers(robot: &str) -> impl Iterator<Item = &'static Compiled> {
    COMPILED.iter().filter(move |compiled| compiled.robot == robot)
}

impl Compiled {
    /// Its names in a record: one target at a time, and many.
    pub fn names(&self) -> [&'static str; 2] {
        if self.compiler == "gcc" {
            ["groebot-c-gcc", "groebot-c-gcc-batch"]
        } else {
            ["groebot-c-clang", "groebot-c-clang-batch"]
        }
    }

    /// Solves all targets one by one and returns the number of all solutions.
    pub fn pass(&self, targets: &[Target]) -> usize {
        // SAFETY: the function reads twelve numbers for each target.
        unsafe { (self.pass)(targets.as_ptr().cast(), targets.len()) }
    }

    /// Solves all targets as batches and returns the number of all solutions.
    pub fn batch(&self, targets: &[Target]) -> usize {
        // SAFETY: the function reads twelve numbers for each target.
        unsafe { (self.batch)(targets.as_ptr().cast(), targets.len()) }
    }

    /// Returns all solutions of one target.
    pub fn solutions(&self, target: &Target) -> Vec<Joints> {
        let mut q = vec![[0.0; 6]; ROOM];
        // SAFETY: the function reads twelve numbers, and writes six for each solution. There are fewer than `ROOM` solutions.
        let count = unsafe { (self.solutions)(target.as_ptr(), q.as_mut_ptr().cast()) };
        q.truncate(count);
        q
    }

    /// Forward kinematics of all joint vectors.
    pub fn forward(&self, all: &[Joints]) {
        // SAFETY: the function reads six numbers for each vector.
        unsafe { (self.forward)(all.as_ptr().cast(), all.len()) }
    }
}
