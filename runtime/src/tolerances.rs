//! Numerical tolerances, by phase of the solution. Each field bounds one error. Its last line names the test that fails
//! without it, in `runtime/tests/tolerances.rs` or `crates/ik/tests/tolerances.rs`. The run time in C has equal values in `groebot/tolerances.h`, with others
//! for single precision.
//!
//! Numbers and lengths of steps, which bound work and no error, are in `effort.rs`.

/// Real roots of polynomials of one unknown.
pub struct Roots {
    /// A critical point with `|p| <= tangent sum |a_i y^i|` counts as a root, `y` being the larger of `|x|` and the unknown's typical size. It bounds the
    /// rounding error of the coefficients.
    /// Test: `roots_tangent`.
    pub tangent: f64,
    /// Real roots are close to each other when they differ by at most this, relative to the unknown's typical size: the square of their difference is then
    /// within `tangent`, so that rounding may merge two roots or split one. For the same reason a Newton step as short as this halves the number of wrong
    /// digits.
    /// Test: `roots_close`.
    pub close: f64,
    /// Among polynomials for one unknown, or matrices for one pencil, the first whose leading coefficient or least pivot exceeds this share of the largest
    /// entry is used.
    /// Test: `roots_pivot`.
    pub pivot: f64,
    /// Coefficients, and squared lengths of columns, below this share of the largest are zero: their reciprocals may overflow.
    /// Test: `roots_zero`.
    pub zero: f64,
    /// Least relative distance of a quartic's roots, real or complex, at which Newton's method converges to the correct ones.
    /// Test: `roots_distinct`.
    pub distinct: f64,
}

/// Cases for strata, on which the formulas of ordinary targets divide by zero.
pub struct Strata {
    /// A case for a stratum also runs where the stratum's factor is below this share of its scale. A candidate with at most this relative residual may have
    /// a solution next to it.
    /// Test: `strata_near`.
    pub near: f64,
    /// A case for a stratum runs only below this share when all candidates of the cases before were solutions without polishing. A stratum on which they would
    /// have lost a solution is then within rounding.
    /// Test: `strata_beside`.
    pub beside: f64,
    /// A case does not run where a denominator is below this share of its scale. A factor of degree two in the distance from its stratum may be as small as
    /// the square of that distance's rounding error. Wrong candidates are measured and dropped.
    /// Test: `strata_denominator`.
    pub denominator: f64,
}

/// Residuals of solutions, and errors of targets.
pub struct Acceptance {
    /// An equation holds when its value is at most this, relative to the sum of its terms' magnitudes; six joints solved together reach their pose within this,
    /// relative to the length scale or in rad.
    /// Test: `acceptance_residual`.
    pub residual: f64,
    /// Rounding error of an equation that holds, relative to its size, and of the square of a difference of eigenvalues.
    /// Test: `acceptance_rounding`.
    pub rounding: f64,
    /// Relative residual that rounding in earlier steps leaves of a solution before it is polished: after polynomials of higher degree, near a stratum, on a
    /// self-motion, or when the polishing steps are used up. Joints then differ from the solution by a thousandth, which polishing corrects.
    /// Test: `acceptance_unsettled`.
    pub unsettled: f64,
    /// Maximal error of numbers that the caller gives: a target's rotation or unit vector, or a joint at its limit (rad, or the unit of length).
    /// Test: `acceptance_input`.
    pub input: f64,
}

/// Newton's method on the equations.
pub struct Polishing {
    /// A solution with at most this relative residual is not polished.
    /// Test: `polishing_done`.
    pub done: f64,
    /// A Newton step that moves no joint by more than this is the last: the next one would be within rounding (rad, or relative to the length scale).
    /// Test: `polishing_step`.
    pub step: f64,
    /// Damping added where a plain Newton step fails, as at a singular configuration, relative to the size of the squared Jacobian. The last value is for a
    /// solution that is singular in two directions. In one of these the derivative is rounding, which misleads the plain step. In the other one it decreases
    /// with the square root of the residual, so that larger damping would stop the steps too early.
    /// Test: `polishing_dampings`.
    pub dampings: [f64; 6],
    /// Weights of the residual in the successive steps towards a configuration where a joint moves freely. The error of that configuration is at most the
    /// product of the weights times the residual, which is within rounding in the end.
    /// Test: `polishing_freeing_of_self_motions`.
    pub freeing: [f64; 5],
    /// Displacement of the joints (rad, or relative to the length scale) for finite differences of the Jacobian. Their error is its square.
    /// Test: `polishing_freeing_of_self_motions`.
    pub difference: f64,
}

/// Pivots and lengths that determine the rank of a matrix, or of a direction.
pub struct Pivots {
    /// A pivot that is at most this share of the largest is rounding.
    /// Test: `pivots_singular`.
    pub singular: f64,
    /// A matrix is regular where each pivot is more than this share of the largest; a direction is known where its length is more than this. Corrective steps
    /// are damped by this share of the squared Jacobian: joints do not move in a direction in which the equations change little.
    /// Test: `pivots_regular`.
    pub regular: f64,
    /// Where each pivot is more than this share of the largest, a solution that holds within `ACCEPTANCE.rounding` is a root of its own. Rounding moves its
    /// joints by far less than the distance to another one.
    /// Test: `pivots_isolated`.
    pub isolated: f64,
    /// A pivot below this share of the largest loses too many digits where there is another choice, or means that the solution set has one more dimension.
    /// Test: `pivots_weak`.
    pub weak: f64,
}

/// Self-motions, and curves along which the residual is small.
pub struct SelfMotions {
    /// Maximal relative residual of a solution next to a self-motion, and rounding error of the equations on it. Next to a self-motion residuals are small
    /// everywhere.
    /// Test: `self_motions_member`.
    pub member: f64,
    /// Maximal relative residual along a self-motion, and last step across a curve. Where it is larger after a few Newton steps, the joints do not follow.
    /// Close self-motions are distinguished if the residual between them is larger.
    /// Test: `self_motions_curve`.
    pub curve: f64,
    /// The largest value of the least singular value, approximately, at which a curve is assumed.
    /// Test: `self_motions_flat`.
    pub flat: f64,
}

/// Solutions that are one (rad, or relative to the length scale).
pub struct Merging {
    /// Two solutions are one when no joint differs by more than this.
    /// Test: `merging_joints`.
    pub joints: f64,
    /// Two solutions within this distance are also one if the residual half-way between them, on a curved path, is at most that of the worse one or
    /// `ACCEPTANCE.rounding`. At a singular configuration rounding moves the joints that far.
    /// Test: `merging_blur`.
    pub blur: f64,
    /// Two close solutions are one if the relative residual half-way between them is at most this, which is little more than a solution's rounding error.
    /// Between two distinct solutions it may be only a little larger.
    /// Test: `merging_halfway`.
    pub halfway: f64,
    /// Solutions on a curve, values of the doubled joint, or members of self-motions with equal free joints, that are nearer are not separate.
    /// Test: `merging_apart`.
    pub apart: f64,
    /// A start within this distance of a known one is not tried again.
    /// Test: `merging_known`.
    pub known: f64,
}

/// Robots that differ a little from the one whose formulas are used.
pub struct NearbyRobots {
    /// A candidate of a nearby robot's formulas with at most this relative residual may have two solutions next to it.
    /// Test: `nearby_robots_off`.
    pub off: f64,
}

/// The eigenvalue problem of six joints in any position.
pub struct Eigenvalues {
    /// Distance of an iteration's shift from the eigenvalue, relative to `1 + |x|`, so that the matrix is regular.
    /// Test: `eigenvalues_shift`.
    pub shift: f64,
    /// Error of the eigenvalues where the candidates show a smaller one.
    /// Test: `eigenvalues_accuracy`.
    pub accuracy: f64,
    /// A complex pair farther from the real axis is not a double root that rounding has split.
    /// Test: `eigenvalues_blurred`.
    pub blurred: f64,
    /// Displacements of the target by attempt. Where solutions share a hidden angle, or a self-motion has the same target, only next to it are the
    /// eigenvectors of isolated solutions found.
    /// Test: `eigenvalues_aside`.
    pub aside: [f64; 10],
}

/// Tolerances of real roots.
pub const ROOTS: Roots = Roots { tangent: 1e-10, close: 1e-5, pivot: 1e-9, zero: 1e-290, distinct: 2e-3 };
/// Tolerances of strata.
pub const STRATA: Strata = Strata { near: 1e-3, beside: 1e-7, denominator: 1e-30 };
/// Tolerances of acceptance.
pub const ACCEPTANCE: Acceptance = Acceptance { residual: 1e-12, rounding: 1e-14, unsettled: 1e-6, input: 1e-9 };
/// Tolerances of polishing.
pub const POLISHING: Polishing = Polishing {
    done: 1e-15,
    step: 1e-9,
    dampings: [0.0, 1e-12, 1e-9, 1e-6, 1e-3, 1e-18],
    freeing: [1e-2, 1e-4, 1e-6, 1e-8, 1e-8],
    difference: 1e-4,
};
/// Tolerances of pivots.
pub const PIVOTS: Pivots = Pivots { singular: 1e-13, regular: 1e-6, isolated: 1e-4, weak: 1e-3 };
/// Tolerances of self-motions.
pub const SELF_MOTIONS: SelfMotions = SelfMotions { member: 1e-13, curve: 1e-8, flat: 5e-2 };
/// Tolerances of merging.
pub const MERGING: Merging = Merging { joints: 1e-7, blur: 5e-2, halfway: 2.5e-15, apart: 1e-4, known: 1e-2 };
/// Tolerances of nearby robots.
pub const NEARBY_ROBOTS: NearbyRobots = NearbyRobots { off: 1e-2 };
/// Tolerances of the eigenvalue problem.
pub const EIGENVALUES: Eigenvalues = Eigenvalues {
    shift: 1e-9,
    accuracy: 1e-11,
    blurred: 1e-2,
    aside: [0.0, 0.0, 0.0, 0.0, 1e-4, 1e-4, 1e-3, 1e-3, 1e-2, 1e-2],
};
