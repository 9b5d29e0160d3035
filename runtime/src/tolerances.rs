//! What is near, equal, or found.

/// An equation holds when its value is at most this share of the sum of its terms' magnitudes.
pub const ACCEPT: f64 = 1e-12;
/// Two answers whose joints all differ by no more than this (rad, or relative to the length scale) are one.
pub const MERGE: f64 = 1e-7;
/// Two answers within this distance are one too when the equations hold half-way between them, on a bent way, as well as at the worse of
/// the two, or within [`ROUNDING`]: at a singular configuration rounding moves the joints that far.
pub const BLUR: f64 = 5e-2;
/// What rounding leaves of an equation that holds, as a share of its scale.
pub const ROUNDING: f64 = 1e-14;
/// Real roots that differ by no more than this share of the unknown's typical size are close to one another: what rounding leaves of their
/// difference's square may make one of two, or two of one. Where it moves roots farther apart, the answers' misses tell.
pub const MEETING: f64 = 1e-5;
/// A critical point with `|p| <= TANGENT sum |a_i y^i|` counts as a root, `y` being the larger of `|x|` and the unknown's typical size.
pub const TANGENT: f64 = 1e-10;
/// [`TANGENT`] for `x^2 + c` in programs with polynomials of higher degree, whose roots are less exact: a miss of `c` by this
/// share of its size moves what follows from it by a thousandth, and polishing goes on from there.
pub const GRAZING: f64 = 1e-6;
/// A case for a stratum also runs where the stratum's factor is below this share of its scale.
pub const NEAR: f64 = 1e-3;
/// A candidate of a nearby mechanism's formulas that misses the equations by no more may have two answers next to it.
pub const OFF: f64 = 1e-2;
/// Where all candidates of the cases before have held where they were found, it runs below this share only: a stratum on which they would have
/// lost an answer is as near as rounding.
pub const BESIDE: f64 = 1e-7;
/// A case does not run where a denominator is below this share of its scale: a factor of degree two in the distance from its
/// stratum is as small as the square of what rounding leaves of that distance. Wrong candidates are measured and dropped.
pub const TINY: f64 = 1e-30;
/// Among polynomials for one unknown, the first whose leading coefficient exceeds this share of the largest one is used.
pub const PIVOT: f64 = 1e-9;
/// A leading coefficient below this share of the largest coefficient counts as zero.
pub const NEGLIGIBLE: f64 = 1e-290;
/// The most steps of polishing that a target may take, unless [other](crate::Solve::solve_bounded) is asked for. A step is a linear system of Newton's
/// method, or an evaluation of the equations at joint values. When they are spent, candidates are not polished any more, and answers are not settled.
pub const MOST_STEPS: usize = 300_000;
/// What solves the equations within this share of their sizes is an answer, not a settled one, where the steps of polishing are spent.
pub const UNSETTLED: f64 = 1e-6;
/// Newton steps that polish each answer; a step that does not lower the residual is not taken.
pub const POLISH_STEPS: usize = 32;
/// Least-squares steps that bring a described mechanism nearest to a target that only its ideal reaches.
pub const FITTING_STEPS: usize = 16;
/// The shares that what a target is missed by has in the steps to where a joint moves freely. Where it does is left open by at most their product with the miss
/// and themselves: rounding in the end.
pub const FREEING: [f64; 5] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-8];
/// How far (rad, or relative to the length scale) joints are moved to either side to see how derivatives change: what is left out is the square of that.
pub const BENT: f64 = 1e-4;
/// Shares of the squared Jacobian's size that are added to it where a plain Newton step fails, as at a singular configuration. The last is
/// for an answer that is singular twice: there one direction's derivative is rounding, which leads the plain step astray, and another's falls
/// with the square root of the miss, so that the other shares outweigh it while the miss is still more than an answer may have.
pub const DAMPINGS: [f64; 6] = [0.0, 1e-12, 1e-9, 1e-6, 1e-3, 1e-18];
/// Where no step halves the miss, the joints leap: by at most these ways (rad, or relative to the length scale), the first that helps.
pub const LEAPS: [f64; 3] = [0.5, 0.1, 0.02];
/// A Newton step that raises the residual by no more than this may have led beyond one of two roots next to each other.
pub const OVERSHOT: f64 = 100.0;
/// The most steps back behind a leap or an overshot.
pub const RETURNS: usize = 4;
/// The share of the squared Jacobian's size by which steps back are damped: a direction in which the equations hardly change stays.
pub const STIFF: f64 = 1e-6;
/// So many Newton steps in a row that do not halve a residual beyond [`ROUNDING`] are the last.
pub const PATIENCE: usize = 3;
/// An answer whose relative residual is this or less is not polished.
pub const POLISHED: f64 = 1e-15;
/// Where the equations hold within [`ROUNDING`], a Newton step that moves no joint by more than this (rad, or relative to the length scale)
/// is the last: what is left is rounding. Next to a double root steps are longer.
pub const SHORT: f64 = 1e-9;
/// A member of a self-motion that misses the equations by more than [`ROUNDING`] and no more than this share of their size, by rounding in the
/// blocks before, is polished with its free joints held: what stands beside it is told from it by rounding alone.
pub const ADRIFT: f64 = 1e-6;
/// So near a stratum, by what its candidates miss the equations by, rounding may hide an answer of the cases before where these come to the end of what
/// is within reach.
pub const DOUBTED: f64 = 1e-9;
/// How far (rad, or relative to the length scale) a free joint is moved to see whether an answer lies on a self-motion.
pub const ASIDE: f64 = 0.1;
/// A pivot of a Jacobian's triangle that is this share of the largest or less is but rounding.
pub const SINGULAR: f64 = 1e-13;
/// Where each pivot is more than this share of the largest, an answer is no member of a self-motion.
pub const REGULAR: f64 = 1e-6;
/// Where each pivot is more than this share of the largest, an answer that holds within [`ROUNDING`] is a root of its own: rounding moves its
/// joints by far less than the distance to another.
pub const DISTINCT: f64 = 1e-4;
/// How many ways aside are tried, each an eighth of the one before.
pub const NARROWS: usize = 5;
/// In how many stages, each twice as far as the one before.
pub const DOUBLINGS: usize = 8;
/// Half of the farthest (rad) that an angle is moved in search of the two roots of a double one, where it hardly matters to the
/// equations.
pub const APART: f64 = 0.7;
/// Where no start around a singular candidate leads to an answer, others are so much farther away: along some ways, as next to two double
/// roots at once, the miss grows a thousand times more slowly than the square of the way.
pub const FARTHER: f64 = 16.0;
/// The farthest of them.
pub const FARTHEST: f64 = 256.0;
/// An isolated answer that a candidate for a member of a self-motion has led to must hold within this share: all along what is next to a
/// self-motion the equations are missed by little.
pub const ALONE: f64 = 1e-13;
/// Where polishing moves a candidate by more than this share of the square root of its miss, another answer may be next to it.
pub const LEVER: f64 = 0.1;
/// Where formulas of a nearby mechanism propose one answer, another is looked for where the equations change by less than so many times the
/// square root of what it misses, which is about how far apart the two are.
pub const TWIN: f64 = 10.0;
/// How many times that square root from the one answer a Newton step tells how far away the other is.
pub const TWIN_AT: f64 = 2.0;
/// How many times that square root from the one answer the other may be.
pub const TWIN_WITHIN: f64 = 32.0;
/// Where a candidate misses the equations by no more than this share, a second step by the derivatives of the first leads to where they hold within
/// [`ROUNDING`].
pub const CHORD: f64 = 5e-6;
/// So many plain Newton steps, each with [a second one](CHORD) by the same derivatives behind it, lead a candidate of a nearby mechanism's formulas to
/// where the equations hold within [`ROUNDING`], or it is polished with more care.
pub const APPROACHES: usize = 3;
/// Such a step is taken where each pivot of the normal equations is more than this share of their size.
pub const PLAIN: f64 = 1e-6;
/// Where a pivot is less than so many times what the candidate missed, a second answer is looked for next to the first: four times the square of
/// [`TWIN`].
pub const STEEP: f64 = 400.0;
/// The same where the formulas proposed other roots far from this one: then each answer has a candidate, but for those that polishing moves far.
pub const MILD: f64 = 4.0;
/// Up to such a turn in a step a few terms of its cosine's and sine's series are enough.
pub const TURN: f64 = 1e-2;
/// Inverse iterations that tell in what direction the equations change least.
pub const INVERSIONS: usize = 3;
/// Half-way between two answers next to each other that are one the equations hold within this share, which is hardly more than rounding
/// leaves of an answer; between two that are not they need not miss by much more.
pub const ALIKE: f64 = 2.5e-15;
/// A self-motion that is followed to where another's member has its free joints is that other self-motion when the joints come this near.
pub const ARRIVED: f64 = 1e-3;
/// The shortest, the first and the longest step (rad, or relative to the length scale) of a free joint from one member of a self-motion to another.
/// One that is barred by less than the shortest is taken for one.
pub const ALONG: [f64; 3] = [6e-3, 2.5e-2, 0.2];
/// Where a step brings other joints farther than this from the line of the step before, it may lead to another self-motion: a shorter one is made.
pub const LEAPT: f64 = 0.1;
/// On the way along a self-motion the equations hold within this share; where they do not after a few Newton steps, the joints do not follow. Self-motions
/// next to each other are told apart where one misses the other's by more.
pub const ASTRAY: f64 = 1e-8;
/// The most steps from one member to another.
pub const PACES: usize = 100;
/// A target's rotation or unit vector may be this far from one.
pub const CONSISTENT: f64 = 1e-9;
/// How far (rad, or the unit of length) a joint may be beyond a limit: rounding makes that of a joint at its limit.
pub const SLACK: f64 = 1e-9;
/// How far a free joint is moved at once in search of a place within limits: rad, or a share of a length.
pub const STRIDE: f64 = 0.1;
/// How often: a whole turn in all.
pub const STRIDES: usize = 63;
