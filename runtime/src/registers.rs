//! Work compiled for vector registers that the processor may have.

macro_rules! compiled_for {
    ($($(#[$doc:meta])* $name:ident $feature:tt)*) => {
        $(
            $(#[$doc])*
            ///
            /// # Errors
            /// The work itself, not done, where the processor has none.
            #[inline(always)]
            #[allow(unsafe_code)]
            pub fn $name<A, F: FnOnce() -> A>(work: F) -> Result<A, F> {
                #[cfg(all(target_arch = "x86_64", feature = "std"))]
                if std::is_x86_feature_detected!($feature) {
                    #[target_feature(enable = $feature)]
                    fn compiled<A>(work: impl FnOnce() -> A) -> A {
                        work()
                    }
                    // SAFETY: the processor has what the function is compiled for.
                    return Ok(unsafe { compiled(work) });
                }
                Err(work)
            }
        )*
    };
}

compiled_for! {
    /// Does work in registers of eight numbers, and so what is inlined into it.
    in_avx512 "avx512f"
    /// Does work in registers of four numbers, and so what is inlined into it.
    in_avx2 "avx2"
}

/// Does work in the widest registers that the processor has.
#[inline(always)]
pub fn in_widest<A>(work: impl FnOnce() -> A) -> A {
    match in_avx512(work) {
        Ok(done) => done,
        Err(work) => in_avx2(work).unwrap_or_else(|work| work()),
    }
}
