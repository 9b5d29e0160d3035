//! Tests of the run time: angles, roots, and a mechanism written by hand.

mod angles;
mod arm;
mod nearby;
mod nearest;
mod real_roots;
mod singular;
mod tolerances;

/// Random numbers in `[0, 1)`, equal in every run (xorshift, G. Marsaglia 2003).
fn random() -> impl FnMut() -> f64 {
    let mut state: u64 = 88_172_645_463_325_252;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}
