//! Numbers and lengths of steps. They bound work; errors are bounded by the tolerances in `tolerances.rs`.

/// Maximal number of polishing steps for a target, unless [`crate::Solve::solve_bounded`] specifies another. A step is one linear system of Newton's method, or
/// one evaluation of the equations at joint values. When they are used up, candidates are no longer polished, and solutions are not settled.
pub const MOST_STEPS: usize = 300_000;
/// Maximal number of Newton steps that polish a solution; a step that does not lower the residual is rejected.
pub const POLISH_STEPS: usize = 32;
/// Maximal number of least-squares steps that bring a described mechanism nearest to a target that only its ideal reaches.
pub const FITTING_STEPS: usize = 16;
/// Maximal number of Gauss-Newton steps to the solution nearest to a reference.
pub const DESCENTS: usize = 32;
/// Lengths of the leaps (rad, or relative to the length scale) that are tried where no step halves the residual; the first that helps is taken.
pub const LEAPS: [f64; 3] = [0.5, 0.1, 0.02];
/// A Newton step that multiplies the residual by no more than this may have passed one of two close roots.
pub const OVERSHOT: f64 = 100.0;
/// Maximal number of corrective steps after a leap or an overshot.
pub const RETURNS: usize = 4;
/// Polishing stops after this number of consecutive Newton steps that do not halve a residual above `ACCEPTANCE.rounding`.
pub const PATIENCE: usize = 3;
/// Displacement of a free joint (rad, or relative to the length scale) in the test whether a solution is on a self-motion.
pub const ASIDE: f64 = 0.1;
/// Number of trial displacements in the test for self-motions, each an eighth of the one before.
pub const NARROWS: usize = 5;
/// Number of stages of a displacement, each twice as long as the one before.
pub const DOUBLINGS: usize = 8;
/// Half of the maximal displacement (rad) of an angle with little influence on the equations, in the search for the two roots of a double one.
pub const APART: f64 = 0.7;
/// Factor for the distance of starts around a singular candidate when no nearer one leads to a solution. Along some directions, as next to two double roots at
/// once, the residual grows a thousand times more slowly than the square of the distance.
pub const FARTHER: f64 = 16.0;
/// Maximal factor of that distance.
pub const FARTHEST: f64 = 256.0;
/// If polishing moves a candidate by more than this share of the square root of its residual, another solution may be next to it.
pub const LEVER: f64 = 0.1;
/// A second solution is searched for where formulas of a nearby mechanism propose one. Condition: the equations change by less than this factor times the
/// square root of the residual, which is about the distance of the two.
pub const TWIN: f64 = 10.0;
/// Distance of the Newton step that estimates the position of a second solution, relative to that square root.
pub const TWIN_AT: f64 = 2.0;
/// Maximal distance of a second solution from the first one, relative to that square root.
pub const TWIN_WITHIN: f64 = 32.0;
/// Maximal number of plain Newton steps from a candidate of a nearby mechanism's formulas to within `ACCEPTANCE.rounding`, each followed by a second one with
/// equal derivatives. A candidate that needs more is polished with damping.
pub const APPROACHES: usize = 3;
/// Where the relative residual of a candidate is at most this, the first step usually leads to within `ACCEPTANCE.rounding`, and its end is measured. Elsewhere
/// only the end of the second step is measured. The square root of the machine precision: a Newton step squares the residual.
pub const CHORD: f64 = 1.0 / 67_108_864.0;
/// Where the normal equations of several candidates at once show that a second solution is farther than this factor times [`TWIN_WITHIN`], or the equations
/// change by more than this factor times [`TWIN`], the search for it is left out. The factor is for the difference between these estimates and exact ones.
pub const DOUBTFUL: f64 = 2.0;
/// A second solution is searched for where a pivot is less than this factor times the candidate's residual: four times the square of [`TWIN`].
pub const STEEP: f64 = 400.0;
/// The same factor where the formulas proposed other roots far from this one. Then each solution has a candidate, except for those that polishing moves far.
pub const MILD: f64 = 4.0;
/// Maximal rotation in a step for which a few terms of the Taylor series of cosine and sine are enough.
pub const TURN: f64 = 1e-2;
/// Number of inverse iterations for the direction in which the equations change least.
pub const INVERSIONS: usize = 3;
/// The shortest, the first and the longest step (rad, or relative to the length scale) of a free joint from one member of a self-motion to another. A gap
/// narrower than the shortest step is not detected.
pub const ALONG: [f64; 3] = [6e-3, 2.5e-2, 0.2];
/// Where a step moves other joints farther than this from the extrapolated line, it may lead to another self-motion: the step is shortened.
pub const LEAPT: f64 = 0.1;
/// Maximal number of steps from one member to another.
pub const PACES: usize = 100;
/// Step of a free joint in the search for a configuration within limits: rad, or relative to a length.
pub const STRIDE: f64 = 0.1;
/// Maximal number of such steps: one whole turn.
pub const STRIDES: usize = 63;
