//! Batches of generated solvers with C's calling convention, as Rust programs use them: `NAME_pieces` solves poses in pieces of [`TARGETS`] and reuses the memory
//! of their solutions, `NAME_all` keeps all solutions, as the Python package does.

use std::hint::black_box;

use groebot_runtime::Solve;

/// Number of targets of one call of a solver.
const TARGETS: usize = 256;
/// Number of solutions of an ordinary target.
const USUAL: usize = 8;

macro_rules! batches {
    ($($name:ident $pieces:ident $all:ident;)+) => {
        $(
            /// The number of solutions of `count` targets, each of twelve numbers.
            ///
            /// # Safety
            /// `targets` points at `12 * count` numbers.
            #[unsafe(no_mangle)]
            pub unsafe extern "C" fn $pieces(targets: *const [f64; 12], count: usize) -> usize {
                let mut out = vec![$name::EMPTY; TARGETS * USUAL + $name::CAPACITY];
                let mut counts = [Ok(0); TARGETS];
                let mut solutions = 0;
                // SAFETY: the caller's promise.
                let mut rest = unsafe { std::slice::from_raw_parts(targets, count) };
                while !rest.is_empty() {
                    let done = $name::Solver.solve_batch(black_box(&rest[..rest.len().min(TARGETS)]), &mut out, &mut counts);
                    black_box(&out);
                    solutions += counts[..done].iter().map(|count| count.unwrap_or(0)).sum::<usize>();
                    rest = &rest[done..];
                }
                solutions
            }

            /// Same as the function of pieces, but all solutions are in memory at the end.
            ///
            /// # Safety
            /// `targets` points at `12 * count` numbers.
            #[unsafe(no_mangle)]
            pub unsafe extern "C" fn $all(targets: *const [f64; 12], count: usize) -> usize {
                let mut out = vec![$name::EMPTY; count * USUAL + $name::CAPACITY];
                let mut counts = vec![Ok(0); count];
                let mut solutions = 0;
                // SAFETY: the caller's promise.
                let mut rest = unsafe { std::slice::from_raw_parts(targets, count) };
                while !rest.is_empty() {
                    let piece = &rest[..rest.len().min(TARGETS)];
                    let done = $name::Solver.solve_batch(black_box(piece), &mut out[solutions..], &mut counts);
                    solutions += counts[..done].iter().map(|count| count.unwrap_or(0)).sum::<usize>();
                    rest = &rest[done..];
                }
                black_box(&out);
                solutions
            }
        )+
    };
}

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

batches! {
    ur5 ur5_pieces ur5_all;
    puma560 puma560_pieces puma560_all;
    irb120 irb120_pieces irb120_all;
}
