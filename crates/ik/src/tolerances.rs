//! Numerical tolerances of derived programs and of their check. Those of the solution of targets are in `tolerances.rs` of the run time.
//!
//! The last line of a field that solutions depend on names the test that fails without it, in `tests/tolerances.rs` or in that of the run time.

/// Cases for strata, as a derivation writes them into a program.
pub(crate) struct DerivedStrata {
    /// The guard of a stratum's case: each factor's symbols are below this fraction of their sizes.
    /// Test: `derived_strata_close`.
    pub close: f64,
    /// A case does not run if a denominator's symbols are below this fraction of their sizes. Then only rounding errors remain of them, and every value of the
    /// joint that they determine solves the equations equally well.
    /// Test: `derived_strata_lost`.
    pub lost: f64,
    /// The scale of a program whose equations contain no constants: a scale of zero is refused. Equations are compared with their terms, so that the
    /// parameters alone then determine their sizes. It bounds only displacements of joints that are lengths, where the joint's value is smaller.
    /// Test: `derived_strata_least_scale`.
    pub least_scale: f64,
}

/// Files with the interface of IKFast.
pub(crate) struct Ikfast {
    /// The rounding error of targets in single precision, relative to the sizes of the equations: several units in the last place.
    /// Test: `ikfast_single`.
    pub single: f64,
}

/// Maps of the workspace.
pub(crate) struct Reach {
    /// Margin of the radius of a ball that contains the workspace, relative to the chain's reach: it is more than rounding.
    pub beyond: f64,
}

/// The check of solvers. It is a second witness, so that it shares no tolerance with the solvers.
pub(crate) struct Witness {
    /// A solution satisfies an equation when its value is at most this, relative to the sum of its terms' sizes, or to the reach, or in rad.
    pub residual: f64,
    /// Joint values that satisfy the equations this well are certainly a solution, which no solver may miss.
    pub exact: f64,
    /// Rounding error of a pose or of a round number. Near a singular configuration, a target that differs by more may have other solutions.
    pub rounding: f64,
    /// Joint values are ordinary when the smallest singular value of the scaled Jacobian exceeds this.
    pub ordinary: f64,
    /// Residual of a member of a self-motion after correction, and least singular value there, relative to the largest. Smaller residuals in a record of
    /// measurements are equal.
    pub member: f64,
    /// Singular values below this share of the largest are zero when a member is corrected.
    pub rank: f64,
    /// Error of the numeric oracle's solutions (rad, or relative to the typical length), of the end of a path along a self-motion, and of recorded distances.
    pub near: f64,
    /// Two ordinary solutions, or critical values of a joint, within this distance are equal (rad, or relative to the typical length).
    pub equal: f64,
    /// Error of a critical value of a joint: a right angle within this is one.
    pub critical: f64,
    /// Two solutions within this distance are one solution given twice (rad, or relative to the typical length).
    pub duplicate: f64,
    /// A joint may be called free where the smallest singular value of the scaled Jacobian is at most this.
    pub free: f64,
    /// Solutions are counted where the smallest singular value exceeds this. Nearer to a singular configuration rounding decides whether two solutions are one
    /// or none.
    pub tie: f64,
    /// Displacement of the joints that moves a round target, and least distance of two solutions near a singular configuration that are different.
    pub moved: f64,
    /// The product of two orthogonal columns, relative to their lengths.
    pub zero: f64,
}

/// Tolerances of derived strata.
pub(crate) const DERIVED_STRATA: DerivedStrata = DerivedStrata { close: 1e-5, lost: 4e-15, least_scale: 1e-12 };
/// Tolerances of IKFast files.
pub(crate) const IKFAST: Ikfast = Ikfast { single: 1e-6 };
/// Tolerances of maps.
pub(crate) const REACH: Reach = Reach { beyond: 1e-6 };
/// Tolerances of the check.
pub(crate) const WITNESS: Witness = Witness {
    residual: 1e-11,
    exact: 1e-13,
    rounding: 1e-14,
    ordinary: 1e-3,
    member: 1e-12,
    rank: 1e-8,
    near: 1e-6,
    equal: 1e-9,
    critical: 1e-10,
    duplicate: 5e-8,
    free: 1e-5,
    tie: 1e-4,
    moved: 1e-7,
    zero: 1e-16,
};
