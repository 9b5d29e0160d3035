//! Functions compiled for vector registers that the processor may have.

macro_rules! compiled_for {
    ($($(#[$doc:meta])* $name:ident $feature:tt)*) => {
        $(
            $(#[$doc])*
            ///
            /// # Errors
            /// Returns the work, not done, where the processor lacks the feature.
            #[inline(always)]
            #[allow(unsafe_code)]
            pub fn $name<A, F: FnOnce() -> A>(work: F) -> Result<A, F> {
                #[cfg(all(target_arch = "x86_64", feature = "std"))]
                if std::is_x86_feature_detected!($feature) {
                    #[target_feature(enable = $feature)]
                    fn compiled<A>(work: impl FnOnce() -> A) -> A {
                        work()
                    }
                    // SAFETY: the processor supports the target feature of the function.
                    return Ok(unsafe { compiled(work) });
                }
                Err(work)
            }
        )*
    };
}

compiled_for! {
    /// Runs a closure, and what is inlined into it, in registers of eight numbers.
    in_avx512 "avx512f"
    /// Runs a closure, and what is inlined into it, in registers of four numbers.
    in_avx2 "avx2"
}

/// Runs a closure in the widest registers that the processor has.
#[inline(always)]
pub fn in_widest<A>(work: impl FnOnce() -> A) -> A {
    match in_avx512(work) {
        Ok(done) => done,
        Err(work) => in_avx2(work).unwrap_or_else(|work| work()),
    }
}
