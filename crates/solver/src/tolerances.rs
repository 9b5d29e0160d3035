//! Numerical tolerances of the closest joint values. Those of the solution of targets are in `tolerances.rs` of the run time.

/// The closest joint values of targets out of reach.
pub(crate) struct Closest {
    /// The decrease of the error that a step of Newton's method predicts at a minimum, relative to the error: it is more than rounding of the gradient.
    pub flat: f64,
    /// A negative eigenvalue of the Hessian at a minimum, relative to its largest entry. Differences of gradients give it to a flat direction.
    pub curved: f64,
    /// The relative difference of two errors of one minimum.
    pub same: f64,
}

/// Tolerances of the closest joint values.
pub(crate) const CLOSEST: Closest = Closest { flat: 1e-9, curved: 1e-5, same: 1e-6 };
