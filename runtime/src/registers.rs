//! Vector registers.

/// Does work that is compiled for the widest vector registers that the processor has: what is inlined into it, too.
#[inline(always)]
#[allow(unsafe_code)]
pub fn in_widest<A>(work: impl FnOnce() -> A) -> A {
    #[cfg(all(target_arch = "x86_64", feature = "std"))]
    {
        if std::is_x86_feature_detected!("avx512f") {
            // SAFETY: the processor has what the function is compiled for.
            return unsafe { by_8(work) };
        }
        if std::is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has what the function is compiled for.
            return unsafe { by_4(work) };
        }
    }
    work()
}

#[cfg(all(target_arch = "x86_64", feature = "std"))]
#[target_feature(enable = "avx512f")]
fn by_8<A>(work: impl FnOnce() -> A) -> A {
    work()
}

#[cfg(all(target_arch = "x86_64", feature = "std"))]
#[target_feature(enable = "avx2")]
fn by_4<A>(work: impl FnOnce() -> A) -> A {
    work()
}
