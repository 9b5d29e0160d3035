//! Batches of generated solvers with C's calling convention: a function for each robot, which solves poses in pieces of [`TARGETS`] as a Rust program would.

use std::hint::black_box;

use groebot_runtime::Solve;

/// Number of targets of one call of a solver.
const TARGETS: usize = 256;

#[rustfmt::skip]
#[allow(dead_code)]
#[path = "../../../../derivations/ur5/5_solver.rs"]
mod ur5;
#[rustfmt::skip]
#[allow(dead_code)]
#[path = "../../../../derivations/puma560/5_solver.rs"]
mod puma560;
#[rustfmt::skip]
#[allow(dead_code)]
#[path = "../../../../derivations/irb120/5_solver.rs"]
mod irb120;

macro_rules! batches {
    ($($name:ident)+) => {
        $(
            /// The number of all solutions of `count` targets, each of twelve numbers.
            ///
            /// # Safety
            /// `targets` points at `12 * count` numbers.
            #[unsafe(no_mangle)]
            pub unsafe extern "C" fn $name(targets: *const [f64; 12], count: usize) -> usize {
                // SAFETY: the caller's promise.
                let mut rest = unsafe { std::slice::from_raw_parts(targets, count) };
                let mut out = vec![$name::EMPTY; TARGETS * $name::CAPACITY];
                let mut counts = [Ok(0); TARGETS];
                let mut solutions = 0;
                while !rest.is_empty() {
                    let done = $name::Solver.solve_batch(black_box(&rest[..rest.len().min(TARGETS)]), &mut out, &mut counts);
                    black_box(&out);
                    solutions += counts[..done].iter().map(|count| count.unwrap_or(0)).sum::<usize>();
                    rest = &rest[done..];
                }
                solutions
            }
        )+
    };
}

batches!(ur5 puma560 irb120);
