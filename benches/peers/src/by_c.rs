//! groebot's printed solvers in C, the files `5_solver.c` of `derivations/` with the run time in one translation unit, as `build.rs` compiles them.

use crate::Joints;
use crate::by_print::Target;

/// A printed solver as a compiler has compiled it.
pub struct Compiled {
    robot: &'static str,
    compiler: &'static str,
    pass: unsafe extern "C" fn(*const f64, usize) -> usize,
    batch: unsafe extern "C" fn(*const f64, usize) -> usize,
    solutions: unsafe extern "C" fn(*const f64, *mut f64) -> usize,
    forward: unsafe extern "C" fn(*const f64, usize),
}

include!(concat!(env!("OUT_DIR"), "/printed_c.rs"));

/// The most solutions of a target that [`Compiled::solutions`] has room for: more than the capacity of each printed solver.
const ROOM: usize = 64;

/// The solvers of the robot with this name, one a compiler.
pub fn solvers(robot: &str) -> impl Iterator<Item = &'static Compiled> {
    COMPILED.iter().filter(move |compiled| compiled.robot == robot)
}

impl Compiled {
    /// What a record calls it: one target at a time, and many.
    pub fn names(&self) -> [&'static str; 2] {
        if self.compiler == "gcc" {
            ["groebot-c-gcc", "groebot-c-gcc-batch"]
        } else {
            ["groebot-c-clang", "groebot-c-clang-batch"]
        }
    }

    /// Solves all targets one by one and returns the number of all answers.
    pub fn pass(&self, targets: &[Target]) -> usize {
        // SAFETY: the function reads twelve numbers a target.
        unsafe { (self.pass)(targets.as_ptr().cast(), targets.len()) }
    }

    /// Solves all targets as batches and returns the number of all answers.
    pub fn batch(&self, targets: &[Target]) -> usize {
        // SAFETY: the function reads twelve numbers a target.
        unsafe { (self.batch)(targets.as_ptr().cast(), targets.len()) }
    }

    /// All answers of one target.
    pub fn solutions(&self, target: &Target) -> Vec<Joints> {
        let mut q = vec![[0.0; 6]; ROOM];
        // SAFETY: the function reads twelve numbers, and writes six for each answer, of which there are fewer than `ROOM`.
        let count = unsafe { (self.solutions)(target.as_ptr(), q.as_mut_ptr().cast()) };
        q.truncate(count);
        q
    }

    /// Forward kinematics of all joint vectors.
    pub fn forward(&self, all: &[Joints]) {
        // SAFETY: the function reads six numbers a vector.
        unsafe { (self.forward)(all.as_ptr().cast(), all.len()) }
    }
}
