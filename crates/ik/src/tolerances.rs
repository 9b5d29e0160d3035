//! Numerical tolerances of derived programs and of their check. Those of the solution of targets are in `tolerances.rs` of the run time.

/// Cases for strata, as a derivation writes them into a program.
pub(crate) struct DerivedStrata {
    /// The guard of a stratum's case: each factor's symbols are below this fraction of their sizes.
    pub close: f64,
    /// A case does not run if a denominator's symbols are below this fraction of their sizes. Then only rounding errors remain of them, and every value of the
    /// joint that they determine solves the equations equally well.
    pub lost: f64,
    /// Same as `lost`, but for the leading coefficient of an angle's quartic, relative to the sum of all symbols' sizes. It is smaller, because an elimination
    /// multiplies symbols: near a singular configuration the correct coefficient is very small.
    pub faint: f64,
    /// The scale of a program whose equations contain no constants. Its parameters alone then determine the scale.
    pub least_scale: f64,
}

/// Files with the interface of IKFast.
pub(crate) struct Ikfast {
    /// The rounding error of targets in single precision, relative to the sizes of the equations: several units in the last place.
    pub single: f64,
}

/// Maps of the workspace.
pub(crate) struct Reach {
    /// Margin of the radius of a ball that contains the workspace, relative to the chain's reach: it is more than rounding.
    pub beyond: f64,
}

/// Tolerances of derived strata.
pub(crate) const DERIVED_STRATA: DerivedStrata =
    DerivedStrata { close: 1e-5, lost: 4e-15, faint: 1e-18, least_scale: 1e-12 };
/// Tolerances of IKFast files.
pub(crate) const IKFAST: Ikfast = Ikfast { single: 1e-6 };
/// Tolerances of maps.
pub(crate) const REACH: Reach = Reach { beyond: 1e-6 };
