//! groebot's generated solvers, many targets at a time.

use groebot_runtime::Solve;

use crate::by_print::{self as printed, Target};
use crate::{Joints, Pairs};

/// Number of targets that one call solves.
const TARGETS: usize = 256;
/// Number of solutions that fit: eight for each target.
const ANSWERS: usize = 8 * TARGETS;

/// A generated solver of batches as function pointers.
#[derive(Clone, Copy)]
pub struct Batches {
    /// Solves all targets and returns the number of all solutions.
    pub pass: fn(&[Target]) -> usize,
    /// Same as `pass`, but with cosines and sines instead of angles.
    pub pass_by_pairs: fn(&[Target]) -> usize,
    /// Returns all solutions of one target.
    pub solutions: fn(&Target) -> Vec<Joints>,
    /// Same as `solutions`, but with cosines and sines.
    pub pairs: fn(&Target) -> Vec<Pairs>,
}

/// Solves all targets with a function of a generated solver.
macro_rules! pass {
    ($name:ident, $answer:ident, $solve:ident, $targets:ident) => {{
        let mut out = vec![printed::$name::$answer::empty(&printed::$name::Solver); ANSWERS];
        let mut counts = [Ok(0); TARGETS];
        let (mut count, mut rest) = (0, $targets);
        while !rest.is_empty() {
            let done = printed::$name::Solver.$solve(std::hint::black_box(rest), &mut out, &mut counts);
            std::hint::black_box(&out);
            count += counts[..done].iter().map(|count| count.unwrap_or(0)).sum::<usize>();
            rest = &rest[done..];
        }
        count
    }};
}

/// Declares the selection of generated solvers by name.
macro_rules! batches {
    ($($name:ident),* $(,)?) => {
        /// The solver of the robot with this name.
        pub fn solver(name: &str) -> Option<Batches> {
            match name {
                $(
                    stringify!($name) => Some(Batches {
                        pass: |targets| pass!($name, Solution, solve_batch, targets),
                        pass_by_pairs: |targets| pass!($name, Pairs, solve_pairs_batch, targets),
                        solutions: |target| {
                            use printed::$name::{CAPACITY, EMPTY, Solver};
                            let mut out = [EMPTY; CAPACITY];
                            let mut counts = [Ok(0)];
                            assert_eq!(Solver.solve_batch(&[*target], &mut out, &mut counts), 1);
                            out[..counts[0].unwrap_or(0)].iter().map(|answer| answer.q).collect()
                        },
                        pairs: |target| {
                            use printed::$name::{CAPACITY, Pairs, Solver};
                            let mut out = [Pairs::empty(&Solver); CAPACITY];
                            let mut counts = [Ok(0)];
                            assert_eq!(Solver.solve_pairs_batch(&[*target], &mut out, &mut counts), 1);
                            out[..counts[0].unwrap_or(0)].iter().map(|answer| answer.joints).collect()
                        },
                    }),
                )*
                _ => None,
            }
        }
    };
}

batches!(irb120, nao_left_leg, nao_right_leg, puma, rh0_left_leg, rh0_right_leg, stanford, teo_leg, ur5);
