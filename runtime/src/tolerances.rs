//! Numerical tolerances and limits on iterations.

/// An equation holds when its value is at most this, relative to the sum of its terms' magnitudes.
pub const ACCEPT: f64 = 1e-12;
/// Two solutions are one when no joint differs by more than this (rad, or relative to the length scale).
pub const MERGE: f64 = 1e-7;
/// Two solutions within this distance are also one if the residual half-way between them, on a curved path, is at most that of the worse one or [`ROUNDING`].
/// At a singular configuration rounding moves the joints that far.
pub const BLUR: f64 = 5e-2;
/// Rounding error of an equation that holds, relative to its size.
pub const ROUNDING: f64 = 1e-14;
/// Real roots are close to each other when they differ by at most this, relative to the unknown's typical size. Rounding of the squared difference may then
/// merge two roots or split one. Larger effects of rounding show in the residuals of the solutions.
pub const MEETING: f64 = 1e-5;
/// A critical point with `|p| <= TANGENT sum |a_i y^i|` counts as a root, `y` being the larger of `|x|` and the unknown's typical size.
pub const TANGENT: f64 = 1e-10;
/// [`TANGENT`] for `x^2 + c` in programs with polynomials of higher degree, whose roots are less accurate. An error of `c` by this relative amount moves the
/// results by a thousandth, and polishing corrects them.
pub const GRAZING: f64 = 1e-6;
/// A case for a stratum also runs where the stratum's factor is below this share of its scale.
pub const NEAR: f64 = 1e-3;
/// A candidate of a nearby mechanism's formulas with at most this relative residual may have two solutions next to it.
pub const OFF: f64 = 1e-2;
/// A case for a stratum runs only below this share when all candidates of the cases before were solutions without polishing. A stratum on which they would have
/// lost a solution is then within rounding.
pub const BESIDE: f64 = 1e-7;
/// A case does not run where a denominator is below this share of its scale. A factor of degree two in the distance from its stratum may be as small as the
/// square of that distance's rounding error. Wrong candidates are measured and dropped.
pub const TINY: f64 = 1e-30;
/// Among polynomials for one unknown, the first whose leading coefficient exceeds this share of the largest one is used.
pub const PIVOT: f64 = 1e-9;
/// A leading coefficient below this share of the largest coefficient counts as zero.
pub const NEGLIGIBLE: f64 = 1e-290;
/// Maximal number of polishing steps for a target, unless [`crate::Solve::solve_bounded`] specifies another. A step is one linear system of Newton's method, or
/// one evaluation of the equations at joint values. When they are used up, candidates are no longer polished, and solutions are not settled.
pub const MOST_STEPS: usize = 300_000;
/// When the polishing steps are used up, a candidate with at most this relative residual is a solution, but not a settled one.
pub const UNSETTLED: f64 = 1e-6;
/// Maximal number of Newton steps that polish a solution; a step that does not lower the residual is rejected.
pub const POLISH_STEPS: usize = 32;
/// Maximal number of least-squares steps that bring a described mechanism nearest to a target that only its ideal reaches.
pub const FITTING_STEPS: usize = 16;
/// Weights of the residual in the successive steps towards a configuration where a joint moves freely. The error of that configuration is at most the product
/// of the weights times the residual, which is within rounding in the end.
pub const FREEING: [f64; 5] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-8];
/// Displacement of the joints (rad, or relative to the length scale) for finite differences of the Jacobian. Their error is its square.
pub const BENT: f64 = 1e-4;
/// Damping added where a plain Newton step fails, as at a singular configuration, relative to the size of the squared Jacobian. The last value is for a
/// solution that is singular in two directions. In one of these the derivative is rounding, which misleads the plain step. In the other one it decreases with
/// the square root of the residual, so that larger damping would stop the steps too early.
pub const DAMPINGS: [f64; 6] = [0.0, 1e-12, 1e-9, 1e-6, 1e-3, 1e-18];
/// Lengths of the leaps (rad, or relative to the length scale) that are tried where no step halves the residual; the first that helps is taken.
pub const LEAPS: [f64; 3] = [0.5, 0.1, 0.02];
/// A Newton step that multiplies the residual by no more than this may have passed one of two close roots.
pub const OVERSHOT: f64 = 100.0;
/// Maximal number of corrective steps after a leap or an overshot.
pub const RETURNS: usize = 4;
/// Damping of corrective steps, relative to the size of the squared Jacobian: joints do not move in a direction in which the equations change little.
pub const STIFF: f64 = 1e-6;
/// Polishing stops after this number of consecutive Newton steps that do not halve a residual above [`ROUNDING`].
pub const PATIENCE: usize = 3;
/// A solution with at most this relative residual is not polished.
pub const POLISHED: f64 = 1e-15;
/// Where the residual is within [`ROUNDING`], a Newton step that moves no joint by more than this is the last (rad, or relative to the length scale). Next to a
/// double root steps are longer.
pub const SHORT: f64 = 1e-9;
/// A member of a self-motion with a relative residual between [`ROUNDING`] and this is polished with its free joints held. Its residual is due to rounding in
/// earlier blocks, and only rounding separates it from solutions next to it.
pub const ADRIFT: f64 = 1e-6;
/// Bound on the candidates' relative residual near a stratum. Below it, rounding may hide a solution of the cases before at the boundary of the workspace.
pub const DOUBTED: f64 = 1e-9;
/// Displacement of a free joint (rad, or relative to the length scale) in the test whether a solution is on a self-motion.
pub const ASIDE: f64 = 0.1;
/// A pivot of the Jacobian's triangular factor that is at most this share of the largest is rounding.
pub const SINGULAR: f64 = 1e-13;
/// Where each pivot is more than this share of the largest, a solution is not a member of a self-motion.
pub const REGULAR: f64 = 1e-6;
/// Where each pivot is more than this share of the largest, a solution that holds within [`ROUNDING`] is a root of its own. Rounding moves its joints by far
/// less than the distance to another one.
pub const DISTINCT: f64 = 1e-4;
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
/// Maximal relative residual of an isolated solution found from a candidate for a member of a self-motion. Next to a self-motion residuals are small
/// everywhere.
pub const ALONE: f64 = 1e-13;
/// If polishing moves a candidate by more than this share of the square root of its residual, another solution may be next to it.
pub const LEVER: f64 = 0.1;
/// A second solution is searched for where formulas of a nearby mechanism propose one. Condition: the equations change by less than this factor times the
/// square root of the residual, which is about the distance of the two.
pub const TWIN: f64 = 10.0;
/// Distance of the Newton step that estimates the position of a second solution, relative to that square root.
pub const TWIN_AT: f64 = 2.0;
/// Maximal distance of a second solution from the first one, relative to that square root.
pub const TWIN_WITHIN: f64 = 32.0;
/// Where the relative residual of a candidate is at most this, a second step with the derivatives of the first leads to within [`ROUNDING`].
pub const CHORD: f64 = 5e-6;
/// Maximal number of plain Newton steps from a candidate of a nearby mechanism's formulas to within [`ROUNDING`], each followed by [a second one](CHORD) with
/// equal derivatives. A candidate that needs more is polished with damping.
pub const APPROACHES: usize = 3;
/// Such a step is taken where each pivot of the normal equations is more than this share of their size.
pub const PLAIN: f64 = 1e-6;
/// A second solution is searched for where a pivot is less than this factor times the candidate's residual: four times the square of [`TWIN`].
pub const STEEP: f64 = 400.0;
/// The same factor where the formulas proposed other roots far from this one. Then each solution has a candidate, except for those that polishing moves far.
pub const MILD: f64 = 4.0;
/// Maximal rotation in a step for which a few terms of the Taylor series of cosine and sine are enough.
pub const TURN: f64 = 1e-2;
/// Number of inverse iterations for the direction in which the equations change least.
pub const INVERSIONS: usize = 3;
/// Two close solutions are one if the relative residual half-way between them is at most this, which is little more than a solution's rounding error. Between
/// two distinct solutions it may be only a little larger.
pub const ALIKE: f64 = 2.5e-15;
/// A self-motion that is followed to another member's free joints is the self-motion of that member if the other joints agree within this.
pub const ARRIVED: f64 = 1e-3;
/// The shortest, the first and the longest step (rad, or relative to the length scale) of a free joint from one member of a self-motion to another. A gap
/// narrower than the shortest step is not detected.
pub const ALONG: [f64; 3] = [6e-3, 2.5e-2, 0.2];
/// Where a step moves other joints farther than this from the extrapolated line, it may lead to another self-motion: the step is shortened.
pub const LEAPT: f64 = 0.1;
/// Maximal relative residual along a self-motion. Where it is larger after a few Newton steps, the joints do not follow. Close self-motions are distinguished
/// if the residual between them is larger.
pub const ASTRAY: f64 = 1e-8;
/// Maximal number of steps from one member to another.
pub const PACES: usize = 100;
/// Maximal deviation of a target's rotation or unit vector from an exact one.
pub const CONSISTENT: f64 = 1e-9;
/// Maximal distance of a joint beyond a limit (rad, or the unit of length), to allow for rounding.
pub const SLACK: f64 = 1e-9;
/// Step of a free joint in the search for a configuration within limits: rad, or relative to a length.
pub const STRIDE: f64 = 0.1;
/// Maximal number of such steps: one whole turn.
pub const STRIDES: usize = 63;
