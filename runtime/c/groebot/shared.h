/* Declarations shared by a robot's file and groebot.c. */

#ifdef __FAST_MATH__
#error "this run time uses NaN and infinity: compile it without -ffast-math"
#endif
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif

#include <float.h>
#include <math.h>
#include <string.h>

#ifndef GB_LANES
#if defined(GB_FLOAT) || !defined(__GNUC__) || !__STDC_HOSTED__
#define GB_LANES 1
#elif defined(__AVX512F__)
#define GB_LANES 8
#elif defined(__AVX2__)
#define GB_LANES 4
#elif defined(__SSE2__) || defined(__aarch64__) || defined(__wasm_simd128__)
#define GB_LANES 2
#else
#define GB_LANES 1
#endif
#endif

/* Without a C library the compiler's headers of vector code are incomplete. */
#if !__STDC_HOSTED__
#elif defined(__AVX__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

#if defined(__GNUC__)
#define GB_UNUSED __attribute__((unused))
#define GB_COLD __attribute__((noinline, cold, unused))
#define GB_APART __attribute__((noinline, unused))
#define GB_SELDOM(truth) __builtin_expect(truth, 0)
#else
#define GB_UNUSED
#define GB_COLD
#define GB_APART
#define GB_SELDOM(truth) (truth)
#endif
#if defined(__GNUC__) && defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__)
#define GB_INLINE static inline __attribute__((always_inline, unused))
#else
#define GB_INLINE static inline GB_UNUSED
#endif
/* Placed before a loop over a table, so that its numbers become part of the code. */
#if defined(__GNUC__) && !defined(__clang__)
#define GB_UNROLL _Pragma("GCC unroll 64")
#else
#define GB_UNROLL
#endif

/* The linkage of groebot.c's functions: static where it is in one file with a robot's solver. */
#ifndef GB_LINKAGE
#define GB_LINKAGE GB_API
#endif

#define GB_JOINED(a, b, c) a##b##c
#define GB_JOIN(a, b, c) GB_JOINED(a, b, c)
#define GB_ASSERT(name, condition) typedef char gb_assert_##name[(condition) ? 1 : -1] GB_UNUSED

/* A literal, and a choice of two literals by precision. */
#ifdef GB_FLOAT
#define R(number) number##f
#define GB_EITHER(number, single) single##f
#define GB_LEAST_POSITIVE FLT_MIN
#define GB_GREATEST FLT_MAX
#define GB_EPSILON FLT_EPSILON
#else
#define R(number) number
#define GB_EITHER(number, single) number
#define GB_LEAST_POSITIVE DBL_MIN
#define GB_GREATEST DBL_MAX
#define GB_EPSILON DBL_EPSILON
#endif

/* Bounds of the buffers in groebot.c. */
#ifndef GB_MAX_JOINTS
#define GB_MAX_JOINTS 16
#endif
#ifndef GB_MAX_PLACES
#define GB_MAX_PLACES 40
#endif
#ifndef GB_MAX_EQUATIONS
#define GB_MAX_EQUATIONS 36
#endif
#ifndef GB_MAX_SIZES
#define GB_MAX_SIZES 8
#endif

/* Numbers and lengths of steps are those of groebot-runtime's effort.rs, where they are documented. */
#define GB_APPROACHES 3
#define GB_STEEP R(400.0)
#define GB_MILD R(4.0)
#define GB_TURN R(1e-2)
#define GB_CHORD GB_EITHER(1.0 / 67108864.0, 1e-4)
#define GB_TWIN R(10.0)
#define GB_TWIN_AT R(2.0)
#define GB_TWIN_WITHIN R(32.0)
#define GB_DOUBTFUL R(2.0)
#define GB_INVERSIONS 3

#define GB_PI R(3.141592653589793)
#define GB_TAU R(6.283185307179586)
/* tan(pi/8), and the difference between pi/4 and the nearest number. */
#define GB_EIGHTH R(0.41421356237309503)
#define GB_REST GB_EITHER(3.061616997868383e-17, -2.1855694e-8)

/* The place of a joint among the numbers that the equations read: its cosine and its sine, or a length's value. */
typedef struct {
    bool is_angle;
    unsigned char places[2];
} gb_joint;
#define GB_ANGLE(cosine, sine) {true, {cosine, sine}}
#define GB_LENGTH(place) {false, {place, place}}

/* The source of a target number in forward kinematics: a value of the tip, an angle by two of them, or a joint. */
enum gb_kind { GB_AS_VALUE, GB_AS_ANGLE, GB_AS_JOINT };
typedef struct {
    enum gb_kind kind;
    unsigned char of[2];
} gb_reached;
#define GB_VALUE(i) {GB_AS_VALUE, {i, i}}
#define GB_ANGLE_OF(cosine, sine) {GB_AS_ANGLE, {cosine, sine}}
#define GB_JOINT(i) {GB_AS_JOINT, {i, i}}

/* A condition on target numbers, from this index on: nine are a rotation by rows, or three a unit vector. */
typedef struct {
    bool is_rotation;
    unsigned char first;
} gb_condition;
#define GB_ROTATION(first) {true, first}
#define GB_UNIT(first) {false, first}

/* Residuals of joint values: the largest magnitude of a value, the largest relative value, and whether every equation holds. */
typedef struct {
    gb_real residual;
    gb_real relative;
    bool accepted;
} gb_fit;

/* How a candidate was found: the number of the combination of cases and roots, the end of the branch numbers of the first block's case, the free joints,
 * whether roots of earlier steps are so close that rounding moves them, and whether it represents two candidates, of which the second differs only in signs. */
typedef struct {
    size_t branch;
    size_t last;
    uint32_t free;
    bool close;
    bool is_pair;
} gb_found_1;

typedef struct gb_problem gb_problem;

/* The end of the Newton steps from a nearby mechanism's candidate: joints that solve the equations within rounding, the candidate's relative residual, the
 * least pivot there, and whether a second solution may be near where that is small. */
typedef struct {
    gb_real end[GB_MAX_JOINTS];
    gb_fit fit;
    gb_real missed;
    gb_real pivot;
    bool is_doubled;
} gb_approach;

/* Description of a robot for groebot.c, like `Facts` and `Mechanism` of groebot-runtime. */
typedef struct {
    size_t joints, places, equations, sizes, capacity;
    const gb_joint *joint;
    const unsigned char *last_first;
    const unsigned char *size_of;
    const unsigned char *freed;
    size_t freed_count;
    gb_real scale;
    /* Maximal number of isolated solutions of a target, or SIZE_MAX. */
    size_t isolated;
    bool has_extras;
    bool is_nearby;
    /* The place of the number whose root the source selects, or -1, and whether it selects the greater one. */
    int preferred;
    bool prefers_greatest;
    /* Offsets of the members of a solution. */
    size_t solution, residual, relative, branch, chosen, free;
    void (*values)(const gb_real *p, const gb_real *at, gb_real *values);
    void (*measures)(const gb_real *p, const gb_real *at, gb_real *sizes);
    void (*jacobian)(const gb_real *p, const gb_real *at, gb_real *rows);
    bool (*approach)(const gb_problem *problem, const gb_real *at, const gb_real *q, gb_approach *approach);
} gb_mechanism;

/* A mechanism's equations at a target, and the remaining steps. `extras` are the numbers of a candidate, of which some follow from no joint, or null. */
struct gb_problem {
    const gb_mechanism *mechanism;
    const gb_real *p;
    const gb_real *extras;
    size_t *steps;
};

/* Candidates for members of self-motions that turn out to be none, by branch and free joints: their number, the largest relative residual, and whether they
 * are known not to be members. */
#define GB_KINDS 16
#define GB_KNOWN_ISOLATED 8
#define GB_MEMBERS 32
typedef struct {
    size_t branch;
    size_t count;
    gb_real missed;
    uint32_t free;
    bool is_rejected;
} gb_rejected_kind;
typedef struct {
    gb_rejected_kind kinds[GB_KINDS];
    size_t count;
    bool are_too_many;
} gb_rejected_kinds;

/* Starts of continuation along curves next to self-motions, up to a maximal number: how the candidates were found, and joints on the curves. */
#define GB_STARTS 32
#define GB_CROSSINGS 16
typedef struct {
    gb_found_1 found[GB_STARTS];
    gb_real q[GB_STARTS][GB_MAX_JOINTS];
    bool is_open[GB_STARTS];
    size_t count;
    /* Crossings of curves that have been searched for other curves, up to a maximal number. */
    gb_real crossings[GB_CROSSINGS][GB_MAX_JOINTS];
    size_t crossings_count;
} gb_starts;

/* The solutions found so far. */
typedef struct {
    gb_problem problem;
    void *out;
    size_t room;
    size_t count;
    /* Number of candidates so far; that number at the last candidate that needed polishing, and at the last one of close roots. */
    size_t candidates;
    size_t unsound;
    size_t doubted;
    /* Whether, on each stratum so far, the cases before it have lost no solution. Always false with the formulas of a nearby mechanism. */
    bool suffices;
    /* Candidates for members of self-motions that were dropped for this reason. */
    gb_rejected_kinds rejected;
    /* Candidates known to be members of self-motions in the list. When their maximal number is exceeded, the first is removed. Strata repeat each other, and
     * the next candidate of a branch is usually near the last one. A tangent is present once it has been computed. `is_another` is whether the member that
     * is being kept is of another self-motion. */
    gb_found_1 members_of[GB_MEMBERS];
    gb_real members[GB_MEMBERS][GB_MAX_JOINTS];
    gb_real members_tangent[GB_MEMBERS][GB_MAX_JOINTS];
    bool members_have_tangent[GB_MEMBERS];
    size_t members_count;
    bool is_another;
    /* Branches and free joints of members with several free joints that are on a self-motion in the list, up to a maximal number. */
    gb_found_1 merged[GB_KINDS];
    size_t merged_count;
    /* Candidates next to which a curve is followed after all candidates are processed. */
    gb_starts starts;
    /* Isolated solutions known to be on no self-motion of these joints. When their maximal number is exceeded, the first is removed. */
    gb_real known_isolated[GB_KNOWN_ISOLATED][GB_MAX_JOINTS];
    uint32_t known_isolated_of[GB_KNOWN_ISOLATED];
    size_t known_isolated_count;
    /* Whether a stratum was met for which no derivation exists. */
    bool is_open;
    /* Whether there are joint values with the least relative residual that are no solution. */
    bool has_nearest;
    gb_real nearest[GB_MAX_JOINTS];
    gb_fit nearest_fit;
} gb_answers;

/* The solution nearest to reference joint values so far: joints that are not wrapped, its distance and residuals. */
typedef struct {
    gb_real q[GB_MAX_JOINTS];
    gb_real distance;
    gb_fit fit;
    bool is_found;
    /* Whether reference and weights allow a search. */
    bool can_search;
    /* The index of the listed solution on the same self-motion, or -1; that of the self-motion being followed. */
    int member;
    int follows;
} gb_nearest_end;

/* A polynomial's coefficients, constant term first. */
typedef struct {
    const gb_real *coefficients;
    size_t length;
} gb_polynomial_1;

/* The magnitudes at which a polynomial's terms are evaluated, to distinguish a double root from a miss: a factor times the greater of the unknown's typical
 * size and a root. */
typedef struct {
    gb_real typical;
    gb_real spread;
} gb_scale;

GB_LINKAGE gb_real gb_cosine(gb_real angle);
GB_LINKAGE gb_real gb_sine(gb_real angle);
GB_LINKAGE void gb_cosine_and_sine(gb_real angle, gb_real *cosine, gb_real *sine);
GB_LINKAGE gb_real gb_wrap(gb_real angle);
GB_LINKAGE gb_real gb_round(gb_real x);
GB_LINKAGE gb_real gb_floor(gb_real x);
GB_LINKAGE gb_real gb_ceiling(gb_real x);
GB_LINKAGE gb_real gb_angle(gb_real cosine, gb_real sine);
#ifdef GROEBOT_SIX_AXES_H
GB_LINKAGE size_t gb_six_axes(const gb_chain *chain, const gb_real *target, gb_six_answer *out);
GB_LINKAGE size_t gb_six_axes_given(const gb_chain *chain, const gb_given *given, size_t count, const gb_real *numbers, gb_six_answer *out);
#endif
GB_LINKAGE size_t gb_real_roots(const gb_polynomial_1 *list, size_t count, gb_scale scale, gb_real *values, size_t room, bool *close);
GB_LINKAGE void gb_place(const gb_problem *problem, const gb_real *q, gb_real *at);
GB_LINKAGE gb_fit gb_measure_at(const gb_problem *problem, const gb_real *at, const gb_real *q);
GB_LINKAGE void gb_keep(gb_answers *all, const gb_found_1 *found, const gb_real *q, const gb_fit *fit);
GB_LINKAGE void gb_refine(gb_answers *all, size_t number, const gb_found_1 *found, const gb_real *q);
GB_LINKAGE void gb_walk_curves(gb_answers *all);
GB_LINKAGE bool gb_are_doubtful(const gb_rejected_kinds *rejected);
GB_LINKAGE bool gb_are_all(const gb_answers *all);
GB_LINKAGE void gb_arrive(gb_answers *all, size_t number, const gb_found_1 *found, const gb_approach *approach);
GB_LINKAGE gb_fit gb_fitted(const gb_problem *problem, gb_real *q, uint32_t held, gb_real most);
GB_LINKAGE bool gb_free_joints(const gb_problem *problem, gb_real *q, uint32_t free);
GB_LINKAGE bool gb_is_on_self_motion(const gb_problem *problem, const gb_real *q, uint32_t free, gb_real bound);
GB_LINKAGE gb_real gb_regularity(const gb_problem *problem, const gb_real *q);
GB_LINKAGE bool gb_has_member(const gb_problem *problem, const gb_real *q, uint32_t free);
GB_LINKAGE void gb_put_in_order(gb_answers *all);
GB_LINKAGE size_t gb_count_turns(const gb_mechanism *mechanism, const gb_real *q, const gb_real *limits);
GB_LINKAGE void gb_turn(const gb_mechanism *mechanism, const gb_real *q, const gb_real *limits, size_t index, gb_real *out);
GB_LINKAGE size_t gb_keep_within(const gb_answers *all, const gb_real *limits);
GB_LINKAGE int gb_nearest(const gb_answers *all, const gb_real *reference, const gb_real *weights, const gb_real *limits, gb_real *q);
GB_LINKAGE void gb_begin_nearest(const gb_answers *all, const gb_real *reference, const gb_real *weights, const gb_real *limits, gb_nearest_end *best);
GB_LINKAGE void gb_search_along(const gb_problem *problem, const gb_real *q, uint32_t free, const gb_real *const *aim, gb_nearest_end *best);
GB_LINKAGE void gb_move_nearest(const gb_mechanism *m, const gb_real *q, const gb_fit *fit, const gb_real *const *aim, gb_nearest_end *best);
GB_LINKAGE void gb_search_all(const gb_answers *all, const gb_real *const *aim, gb_nearest_end *best);
GB_LINKAGE void gb_target_of(const gb_real *base, const gb_real *tool, const gb_real *pose, gb_real *target);

/* At most `most` steps. They are used up with the next one, which shows that they did not suffice. */
GB_INLINE size_t gb_steps_at_most(size_t most)
{
    return most < SIZE_MAX ? most + 1 : most;
}

/* The greater of two numbers; the first where the second is NaN. */
GB_INLINE gb_real gb_larger(gb_real a, gb_real b)
{
    return b > a ? b : a;
}

/* The lesser of two numbers; the first where the second is NaN. */
GB_INLINE gb_real gb_smaller(gb_real a, gb_real b)
{
    return b < a ? b : a;
}

/* The magnitude, computed without a branch. */
GB_INLINE gb_real gb_magnitude(gb_real a)
{
#ifdef GB_FLOAT
    return fabsf(a);
#else
    return fabs(a);
#endif
}

/* The magnitude at which a polynomial's terms are evaluated near the root x. */
GB_INLINE gb_real gb_scale_at(gb_scale scale, gb_real x)
{
    return scale.spread * gb_larger(scale.typical, gb_magnitude(x));
}

/* The number with the sign of another. */
GB_INLINE gb_real gb_signed(gb_real a, gb_real sign)
{
#ifdef GB_FLOAT
    return copysignf(a, sign);
#else
    return copysign(a, sign);
#endif
}

/* The square root, by one instruction where there is one: that of the C library checks for errors. */
GB_INLINE gb_real gb_square_root(gb_real a)
{
#ifdef GB_FLOAT
    return sqrtf(a);
#elif defined(__SSE2__) && __STDC_HOSTED__
    const __m128d number = _mm_set_sd(a);
    return _mm_cvtsd_f64(_mm_sqrt_sd(number, number));
#else
    return sqrt(a);
#endif
}
