/* What runs on a robot, in C99: the run time of inverse kinematics that groebot derives.
 *
 * A robot's own file holds its program as straight-line code, and includes this one. It stands there for three readers:
 *   - callers of a robot find the types and functions that GB_DECLARE declares;
 *   - a robot's file, which includes itself, finds what its program is written in, once for each type of number (GB_WIDTH is 1 for one number, or how many
 *     a register holds), and at last (GB_WIDTH is 0) the functions that it offers;
 *   - groebot.c, compiled once for all robots, holds what seldom runs: it refines answers at singular poses, and finds roots of polynomials.
 *
 * Nothing is allocated, there is no state, and the same target has the same answers, to the last bit, with every compiler: all is built of IEEE 754's
 * operations in the order in which they are written. Compile with -ffp-contract=off where products may be contracted (gcc without -std=c99), and never
 * with -ffast-math. Of the C library it takes sqrt, and fmod for angles beyond a million.
 *
 * GB_FLOAT makes every number a float. GB_LANES says how many numbers a register takes at once: 1 for plain C.
 *
 * All in one file: GB_LINKAGE defined as `static GB_UNUSED`, then this file, the robot's header, its source, which then includes that one file, and
 * groebot.c, without the lines that include one another. */
#ifndef GROEBOT_H
#define GROEBOT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifndef GB_API
#ifdef __cplusplus
#define GB_API extern "C"
#else
#define GB_API extern
#endif
#endif

#ifdef GB_FLOAT
typedef float gb_real;
#else
typedef double gb_real;
#endif

/* A number of the target is infinite or not a number. */
#define GB_NOT_FINITE (-1)
/* The target lies on a stratum that could not be derived. */
#define GB_OPEN_STRATUM (-2)
/* The rotation of the target is off by more than 1e-9 (1e-4 in single precision). */
#define GB_NOT_ROTATION (-3)
/* The direction of the target is not of length one within 1e-9 (1e-4 in single precision). */
#define GB_NOT_UNIT (-4)
/* The most turns that are counted. */
#define GB_MOST_TURNS 1000000

/* Declares what a robot offers. Targets have so many numbers in metres and radians, unless the robot's file says so: the pose of the tip in the base
 * frame as its position and its rotation by rows, or what else the task is. Angles of solutions lie in (-pi, pi].
 *
 * NAME_solution: an answer.
 *     q           joint values, in the order of the joints
 *     residual    the largest magnitude among the equations' values at q, in the equations' own unit
 *     relative    the largest share of an equation's value in its size
 *     branch      which cases and which roots gave it; it keeps its number from target to target
 *     chosen      whether the source of the mechanism would choose this one
 *     free        bit j is set where joint j may take any value here: this is one member of a self-motion
 * NAME_pairs: an answer by joint's cosine and sine; a length's value and zero.
 *
 * NAME_solve: writes all solutions to the front of out, which has room for NAME_CAPACITY, by branch; their number, 0 out of reach, or a code below 0.
 * NAME_solve_or_nearest: the same; where there is none, nearest is what missed the equations by the least share, or its residual is infinite.
 * NAME_solve_pairs: the same by cosines and sines; at ordinary targets no arc tangent is taken.
 * NAME_solve_batch: many targets, several at once in the lanes of registers. The solutions of a target stand in out behind those of the one before,
 *     counts says how many they are or why there are none. How many targets were solved: all, unless out has no room for those of the next one.
 *     Each solution is that of NAME_solve to the last bit.
 * NAME_residual: the largest magnitude of an equation's value at joint values q; not a number for a target that NAME_solve refuses, and where
 *     equations read what follows from no joint.
 * NAME_forward: the target that joint values reach; false for equations that do not compare the tip with the target.
 * NAME_target_of: the target at which the tool is at a pose, with the base at another pose and the tool at its own pose seen from the tip.
 * NAME_count_turns: limits are the least and the greatest value of each joint in turn. The number of joint values that differ from q by whole turns of
 *     angles and lie within limits, which hold within 1e-9; an angle that lacks a limit counts once.
 * NAME_turn: writes the one with this index to out. Turns of the last joint follow one another.
 * NAME_solve_within: as NAME_solve, moved into limits by as few turns as can be, members of a self-motion along it; those that cannot are left out.
 * NAME_nearest: the index of the solution that comes nearest to a reference by turns within limits, which are written to q; -1 when none does. The
 *     distance is the sum of the squared differences, each times its weight. */
#define GB_DECLARE(name, inputs, joints_, capacity)                                                                                \
    typedef struct {                                                                                                               \
        gb_real q[joints_];                                                                                                        \
        gb_real residual;                                                                                                          \
        gb_real relative;                                                                                                          \
        size_t branch;                                                                                                             \
        bool chosen;                                                                                                               \
        uint32_t free;                                                                                                             \
    } name##_solution;                                                                                                             \
    typedef struct {                                                                                                               \
        gb_real joints[joints_][2];                                                                                                \
        gb_real residual;                                                                                                          \
        size_t branch;                                                                                                             \
        uint32_t free;                                                                                                             \
    } name##_pairs;                                                                                                                \
    GB_API const char *const name##_input_names[inputs];                                                                           \
    GB_API const char *const name##_joint_names[joints_];                                                                          \
    GB_API const gb_real name##_limits[2 * (joints_)];                                                                             \
    GB_API int name##_solve(const gb_real *target, name##_solution *out);                                                          \
    GB_API int name##_solve_or_nearest(const gb_real *target, name##_solution *out, name##_solution *nearest);                     \
    GB_API int name##_solve_pairs(const gb_real *target, name##_pairs *out);                                                       \
    GB_API size_t name##_solve_batch(const gb_real *targets, size_t count, name##_solution *out, size_t room, int *counts);        \
    GB_API size_t name##_solve_pairs_batch(const gb_real *targets, size_t count, name##_pairs *out, size_t room, int *counts);     \
    GB_API gb_real name##_residual(const gb_real *target, const gb_real *q);                                                       \
    GB_API bool name##_forward(const gb_real *q, gb_real *target);                                                                 \
    GB_API void name##_target_of(const gb_real *base, const gb_real *tool, const gb_real *pose, gb_real *target);                  \
    GB_API size_t name##_count_turns(const gb_real *q, const gb_real *limits);                                                     \
    GB_API void name##_turn(const gb_real *q, const gb_real *limits, size_t index, gb_real *out);                                  \
    GB_API int name##_solve_within(const gb_real *target, const gb_real *limits, name##_solution *out);                            \
    GB_API int name##_nearest(const name##_solution *list, int count, const gb_real *reference, const gb_real *weights,            \
                              const gb_real *limits, gb_real *q)

#endif

#if (defined(GB_ROBOT) || defined(GB_RUNTIME)) && !defined(GB_SHARED)
#define GB_SHARED

/* ---- What a robot's file and groebot.c share ---- */

#ifdef __FAST_MATH__
#error "this run time tells NaN and infinity apart: compile it without -ffast-math"
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

/* Without a C library the compiler's headers of vector code are not whole. */
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
/* Before a loop over a table: its numbers become part of the code. */
#if defined(__GNUC__) && !defined(__clang__)
#define GB_UNROLL _Pragma("GCC unroll 64")
#else
#define GB_UNROLL
#endif

/* The linkage of groebot.c's functions: static where it stands in one file with a robot's. */
#ifndef GB_LINKAGE
#define GB_LINKAGE GB_API
#endif

#define GB_JOINED(a, b, c) a##b##c
#define GB_JOIN(a, b, c) GB_JOINED(a, b, c)
#define GB_ASSERT(name, condition) typedef char gb_assert_##name[(condition) ? 1 : -1] GB_UNUSED

/* A literal; one in double and one in single precision. */
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

/* The tolerances are those of groebot-runtime's tolerances.rs, which says what they are for. */
#define GB_ACCEPT GB_EITHER(1e-12, 3e-5)
#define GB_BLUR GB_EITHER(5e-2, 3e-2)
#define GB_ROUNDING GB_EITHER(1e-14, 5e-6)
#define GB_MEETING GB_EITHER(1e-5, 1e-2)
#define GB_TANGENT GB_EITHER(1e-10, 1e-4)
#define GB_GRAZING GB_EITHER(1e-6, 1e-4)
#define GB_NEAR GB_EITHER(1e-3, 1e-2)
#define GB_BESIDE GB_EITHER(1e-7, 1e-2)
#define GB_TINY R(1e-30)
#define GB_CONSISTENT GB_EITHER(1e-9, 1e-4)
#define GB_APPROACHES 3
#define GB_PLAIN R(1e-6)
#define GB_STEEP R(400.0)
#define GB_MILD R(4.0)
#define GB_TURN R(1e-2)

#define GB_PI R(3.141592653589793)
#define GB_TAU R(6.283185307179586)
/* tan(pi/8), and what the number nearest to pi/4 lacks. */
#define GB_EIGHTH R(0.41421356237309503)
#define GB_REST GB_EITHER(3.061616997868383e-17, -2.1855694e-8)

/* Where a joint stands among the numbers that the equations read: its cosine and its sine, or a length's value. */
typedef struct {
    bool is_angle;
    unsigned char places[2];
} gb_joint;
#define GB_ANGLE(cosine, sine) {true, {cosine, sine}}
#define GB_LENGTH(place) {false, {place, place}}

/* Where forward kinematics finds a number of the target: a value of the tip, an angle by two of them, or a joint. */
enum gb_kind { GB_AS_VALUE, GB_AS_ANGLE, GB_AS_JOINT };
typedef struct {
    enum gb_kind kind;
    unsigned char of[2];
} gb_reached;
#define GB_VALUE(i) {GB_AS_VALUE, {i, i}}
#define GB_ANGLE_OF(cosine, sine) {GB_AS_ANGLE, {cosine, sine}}
#define GB_JOINT(i) {GB_AS_JOINT, {i, i}}

/* What numbers of a target must fulfil, from this one on: nine are a rotation by rows, or three a unit vector. */
typedef struct {
    bool is_rotation;
    unsigned char first;
} gb_condition;
#define GB_ROTATION(first) {true, first}
#define GB_UNIT(first) {false, first}

/* How well joint values solve the equations: the largest magnitude of a value, the largest share of one in its size, and whether every equation holds. */
typedef struct {
    gb_real residual;
    gb_real relative;
    bool accepted;
} gb_fit;

/* How a candidate was found: which cases and roots gave it, where the branch numbers of the first block's case end, which joints are free, whether roots on
 * the way are so near one another that rounding moves them, and whether it stands for two, of which the second differs in signs alone. */
typedef struct {
    size_t branch;
    size_t last;
    uint32_t free;
    bool close;
    bool is_pair;
} gb_found_1;

typedef struct gb_problem gb_problem;

/* Where the short way from a nearby mechanism's candidate has led: joints that solve the equations within rounding, what the candidate missed, and the least
 * pivot there. */
typedef struct {
    gb_real end[GB_MAX_JOINTS];
    gb_fit fit;
    gb_real missed;
    gb_real pivot;
} gb_approach;

/* What groebot.c knows of a robot: as `Facts` and `Mechanism` of groebot-runtime. */
typedef struct {
    size_t joints, places, equations, sizes, capacity;
    const gb_joint *joint;
    const unsigned char *last_first;
    const unsigned char *size_of;
    const unsigned char *freed;
    size_t freed_count;
    gb_real scale;
    /* The most isolated solutions that a target can have, or SIZE_MAX. */
    size_t isolated;
    bool has_extras;
    bool is_nearby;
    /* The place of the number whose root the source chooses, or -1; whether the greater one. */
    int preferred;
    bool prefers_greatest;
    /* Where the members of a solution stand. */
    size_t solution, residual, relative, branch, chosen, free;
    void (*values)(const gb_real *p, const gb_real *at, gb_real *values);
    void (*measures)(const gb_real *p, const gb_real *at, gb_real *sizes);
    void (*jacobian)(const gb_real *p, const gb_real *at, gb_real *rows);
    bool (*approach)(const gb_problem *problem, const gb_real *at, const gb_real *q, gb_approach *approach);
} gb_mechanism;

/* A mechanism's equations at a target; `extras` are the numbers of a candidate that follow from no joint, among others, or null. */
struct gb_problem {
    const gb_mechanism *mechanism;
    const gb_real *p;
    const gb_real *extras;
};

/* The answers so far. */
typedef struct {
    gb_problem problem;
    void *out;
    size_t room;
    size_t count;
    /* How many candidates there have been, and had with the last one that did not hold where it was found. */
    size_t candidates;
    size_t unsound;
    /* Whether a stratum was met that could not be derived. */
    bool is_open;
    /* What missed the equations by the least share of their size. */
    bool has_nearest;
    gb_real nearest[GB_MAX_JOINTS];
    gb_fit nearest_fit;
} gb_answers;

/* A polynomial's coefficients, constant term first. */
typedef struct {
    const gb_real *coefficients;
    size_t length;
} gb_polynomial_1;

GB_LINKAGE gb_real gb_cosine(gb_real angle);
GB_LINKAGE gb_real gb_sine(gb_real angle);
GB_LINKAGE gb_real gb_wrap(gb_real angle);
GB_LINKAGE gb_real gb_round(gb_real x);
GB_LINKAGE gb_real gb_angle(gb_real cosine, gb_real sine);
#ifdef GROEBOT_SIX_AXES_H
GB_LINKAGE size_t gb_six_axes(const gb_chain *chain, const gb_real *target, gb_six_answer *out);
#endif
GB_LINKAGE size_t gb_real_roots(const gb_polynomial_1 *list, size_t count, gb_real scale, gb_real *values, size_t room, bool *close);
GB_LINKAGE void gb_place(const gb_problem *problem, const gb_real *q, gb_real *at);
GB_LINKAGE gb_fit gb_measure_at(const gb_problem *problem, const gb_real *at, const gb_real *q);
GB_LINKAGE void gb_keep(gb_answers *all, const gb_found_1 *found, const gb_real *q, const gb_fit *fit);
GB_LINKAGE void gb_refine(gb_answers *all, size_t number, const gb_found_1 *found, const gb_real *q);
GB_LINKAGE void gb_arrive(gb_answers *all, size_t number, const gb_found_1 *found, const gb_approach *approach);
GB_LINKAGE void gb_settle(gb_answers *all);
GB_LINKAGE size_t gb_count_turns(const gb_mechanism *mechanism, const gb_real *q, const gb_real *limits);
GB_LINKAGE void gb_turn(const gb_mechanism *mechanism, const gb_real *q, const gb_real *limits, size_t index, gb_real *out);
GB_LINKAGE size_t gb_keep_within(const gb_answers *all, const gb_real *limits);
GB_LINKAGE int gb_nearest(const gb_answers *all, const gb_real *reference, const gb_real *weights, const gb_real *limits, gb_real *q);
GB_LINKAGE void gb_target_of(const gb_real *base, const gb_real *tool, const gb_real *pose, gb_real *target);

/* The greater of two numbers; the first where the second is none. */
GB_INLINE gb_real gb_larger(gb_real a, gb_real b)
{
    return b > a ? b : a;
}

/* The lesser of two numbers; the first where the second is none. */
GB_INLINE gb_real gb_smaller(gb_real a, gb_real b)
{
    return b < a ? b : a;
}

/* The magnitude, without a branch. */
GB_INLINE gb_real gb_magnitude(gb_real a)
{
#ifdef GB_FLOAT
    return fabsf(a);
#else
    return fabs(a);
#endif
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

/* The square root, by one instruction where there is one: the C library's would look for errors. */
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

#endif

#if defined(GB_ROBOT) && !(defined(GB_WIDTH) && GB_WIDTH == 0)

/* ---- The next type of number ---- */

#if !defined(GB_WIDTH)
#define GB_WIDTH 1
#elif GB_WIDTH == 1 && GB_LANES > 1
#undef GB_WIDTH
#define GB_WIDTH 2
#elif GB_WIDTH > 1 && GB_WIDTH < GB_LANES
#undef GB_WIDTH
#define GB_WIDTH GB_LANES
#else
#undef GB_WIDTH
#define GB_WIDTH 0
#endif

#ifndef GB_DEFAULTS
#define GB_DEFAULTS

/* The type or function with this name for the type of number of which it is the turn, and that type. */
#define GB_(name) GB_JOIN(gb_##name, _, GB_WIDTH)
#define T GB_(number)
/* A block where a rare case leads to it: it is not put in that place. */
#define GB_RARELY(block, parameters, ...) \
    static GB_COLD void GB_(rarely_##block) parameters { GB_(block)(__VA_ARGS__); }

/* What a robot's file does not define of its facts. */
#ifndef GB_DEGREE
#define GB_DEGREE 2
#endif
#ifndef GB_ISOLATED
#define GB_ISOLATED SIZE_MAX
#endif
#ifndef GB_EXTRAS
#define GB_EXTRAS false
#endif
#ifndef GB_PREFERRED
#define GB_PREFERRED (-1)
#define GB_PREFERS_GREATEST false
#endif
#ifndef GB_TWINS
#define GB_TWINS 1
#endif

GB_ASSERT(joints_have_room_in_groebot_c, GB_JOINTS <= GB_MAX_JOINTS && GB_JOINTS <= 32);
GB_ASSERT(places_have_room_in_groebot_c, GB_PLACES <= GB_MAX_PLACES);
GB_ASSERT(equations_have_room_in_groebot_c, GB_EQUATIONS <= GB_MAX_EQUATIONS);
GB_ASSERT(sizes_have_room_in_groebot_c, GB_SIZES <= GB_MAX_SIZES);
GB_ASSERT(candidates_are_even, GB_CANDIDATES % 2 == 0);

static const gb_joint gb_joints[GB_JOINTS] = {GB_JOINT_LIST};
static const unsigned char gb_last_first[GB_JOINTS] = {GB_LAST_FIRST};
static const unsigned char gb_size_of[GB_EQUATIONS] = {GB_SIZE_OF};
#ifdef GB_TURNED
static const unsigned char gb_turned[] = {GB_TURNED};
#endif
#ifdef GB_COMPARED
static const unsigned char gb_compared[GB_EQUATIONS] = {GB_COMPARED};
#endif
#ifdef GB_CONDITIONS
static const gb_condition gb_conditions[] = {GB_CONDITIONS};
#endif
#ifdef GB_RUNS
GB_UNUSED static const unsigned char gb_runs[GB_JOINTS] = {GB_RUNS};
#endif

#define GB_PUBLIC(name) GB_JOIN(GB_ROBOT, _, name)
typedef GB_PUBLIC(solution) gb_solution;
typedef GB_PUBLIC(pairs) gb_pairs;

/* Angles differ by more than GB_BLUR where their difference has a cosine below this. */
#define GB_FAR_APART (R(1.0) - R(0.52) * GB_BLUR * GB_BLUR)

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif
#endif

#if GB_WIDTH > 0

/* ---- What the program is written in ---- */

#if GB_WIDTH == 1
typedef gb_real gb_number_1;
/* Whether something is so. */
typedef int gb_truth_1;
#else
typedef double GB_(number) __attribute__((vector_size(8 * GB_WIDTH)));
/* Where something is so: all bits or none. */
typedef int64_t GB_(truth) __attribute__((vector_size(8 * GB_WIDTH)));
#endif

/* Nowhere. */
GB_INLINE GB_(truth) GB_(nowhere)(void)
{
    const GB_(truth) nowhere = {0};
    return nowhere;
}

/* The number, everywhere. */
GB_INLINE T GB_(of)(gb_real number)
{
#if GB_WIDTH == 1
    return number;
#else
    T all = {0};
    for (int lane = 0; lane < GB_WIDTH; lane++) {
        all[lane] = number;
    }
    return all;
#endif
}

/* Whether a number is at most a limit. */
GB_INLINE GB_(truth) GB_(at_most)(T a, T limit)
{
    return (GB_(truth))(a <= limit);
}

/* Whether a number is more than a limit. */
GB_INLINE GB_(truth) GB_(exceeds)(T a, T limit)
{
    return (GB_(truth))(a > limit);
}

/* Where something is not so. */
GB_INLINE GB_(truth) GB_(inverted)(GB_(truth) truth)
{
#if GB_WIDTH == 1
    return !truth;
#else
    return ~truth;
#endif
}

/* Whether something is so anywhere. */
GB_INLINE bool GB_(any)(GB_(truth) truth)
{
#if GB_WIDTH == 1
    return truth;
#else
    int64_t all = 0;
    for (int lane = 0; lane < GB_WIDTH; lane++) {
        all |= truth[lane];
    }
    return all != 0;
#endif
}

/* The number where something is so, and another elsewhere. */
GB_INLINE T GB_(pick)(T a, T b, GB_(truth) truth)
{
#if GB_WIDTH == 1
    return truth ? a : b;
#else
    return (T)(((GB_(truth))a & truth) | ((GB_(truth))b & ~truth));
#endif
}

/* The magnitude. */
GB_INLINE T GB_(abs)(T a)
{
#if GB_WIDTH == 1
    return gb_magnitude(a);
#else
    return (T)((GB_(truth))a & ~(GB_(truth))GB_(of)(-0.0));
#endif
}

/* The number with the sign of another. */
GB_INLINE T GB_(with_sign)(T a, T sign)
{
#if GB_WIDTH == 1
    return gb_signed(a, sign);
#else
    const GB_(truth) bit = (GB_(truth))GB_(of)(-0.0);
    return (T)(((GB_(truth))a & ~bit) | ((GB_(truth))sign & bit));
#endif
}

/* The square root. */
GB_INLINE T GB_(square_root)(T a)
{
#if GB_WIDTH == 1
    return gb_square_root(a);
#elif GB_WIDTH == 2 && defined(__SSE2__)
    return (T)_mm_sqrt_pd((__m128d)a);
#elif GB_WIDTH == 2 && defined(__aarch64__)
    return (T)vsqrtq_f64((float64x2_t)a);
#elif GB_WIDTH == 4 && defined(__AVX__)
    return (T)_mm256_sqrt_pd((__m256d)a);
#elif GB_WIDTH == 8 && defined(__AVX512F__)
    return (T)_mm512_sqrt_pd((__m512d)a);
#else
    for (int lane = 0; lane < GB_WIDTH; lane++) {
        a[lane] = sqrt(a[lane]);
    }
    return a;
#endif
}

/* By lane, a function of one number. */
GB_INLINE T GB_(each)(T a, gb_real (*value)(gb_real))
{
#if GB_WIDTH == 1
    return value(a);
#else
    for (int lane = 0; lane < GB_WIDTH; lane++) {
        a[lane] = value(a[lane]);
    }
    return a;
#endif
}

/* The cosine of an angle in rad. */
GB_INLINE T GB_(cos)(T angle)
{
    return GB_(each)(angle, gb_cosine);
}

/* The sine of an angle in rad. */
GB_INLINE T GB_(sin)(T angle)
{
    return GB_(each)(angle, gb_sine);
}

/* The greater of two numbers; the first where one is not a number. */
GB_INLINE T GB_(greater)(T a, T b)
{
    return GB_(pick)(b, a, GB_(exceeds)(b, a));
}

/* The lesser of two numbers; the first where one is not a number. */
GB_INLINE T GB_(lesser)(T a, T b)
{
    return GB_(pick)(b, a, GB_(exceeds)(a, b));
}

/* The number, or a floor where it is below that or not a number. */
GB_INLINE T GB_(above)(T a, T floor)
{
    return GB_(pick)(a, floor, GB_(exceeds)(a, floor));
}

/* The greatest among a positive number and magnitudes. */
GB_INLINE T GB_(largest)(gb_real least, const T *others, size_t count)
{
    T largest = GB_(of)(least);
    for (size_t i = 0; i < count; i++) {
        largest = GB_(greater)(largest, GB_(abs)(others[i]));
    }
    return largest;
}

/* The number where another is below a limit, and zero elsewhere. */
GB_INLINE T GB_(where_below)(T a, T other, gb_real limit)
{
    return GB_(pick)(a, GB_(of)(R(0.0)), GB_(exceeds)(GB_(of)(limit), other));
}

/* The square root, zero of a number below zero. */
GB_INLINE T GB_(root)(T a)
{
    return GB_(square_root)(GB_(above)(a, GB_(of)(R(0.0))));
}

/* The greater of two numbers; the other one of a number and what is none. */
GB_INLINE T GB_(max)(T a, T b)
{
    return GB_(pick)(b, a, GB_(exceeds)(b, a) | GB_(inverted)(GB_(at_most)(a, a)));
}

/* Where a case's guards hold: as near a stratum as it reaches, and the same where the cases before have lost nothing. */
typedef struct {
    GB_(truth) here;
    GB_(truth) beside;
} GB_(guard);

/* Where a factor is as near zero as a stratum reaches. */
GB_INLINE GB_(guard) GB_(near)(T a, T scale)
{
    const GB_(guard) guard = {GB_(at_most)(GB_(abs)(a), scale * GB_NEAR), GB_(at_most)(GB_(abs)(a), scale * GB_BESIDE)};
    return guard;
}

/* Where a factor is not zero. In lanes what is no number is not: it belongs to no candidate. */
GB_INLINE GB_(guard) GB_(away)(T a, T scale)
{
#if GB_WIDTH == 1
    const GB_(truth) here = gb_magnitude(a) > GB_TINY * scale;
#else
    const GB_(truth) here = GB_(inverted)(GB_(at_most)(GB_(abs)(a), GB_TINY * scale));
#endif
    const GB_(guard) guard = {here, here};
    return guard;
}

/* Where two guards hold. */
GB_INLINE GB_(guard) GB_(both)(GB_(guard) a, GB_(guard) b)
{
    const GB_(guard) guard = {a.here & b.here, a.beside & b.beside};
    return guard;
}

/* Everywhere. */
GB_INLINE GB_(guard) GB_(always)(void)
{
    const GB_(guard) guard = {GB_(inverted)(GB_(nowhere)()), GB_(inverted)(GB_(nowhere)())};
    return guard;
}

/* A claim to be the best conditioned of a group: the pivot's magnitude, or -1 elsewhere. */
GB_INLINE T GB_(claim)(GB_(guard) guard, T pivot)
{
    return GB_(pick)(GB_(abs)(pivot), GB_(of)(R(-1.0)), guard.here);
}

/* Real roots, ascending, and whether they are close to one another. In lanes each has its place, and is dead where there are fewer. */
typedef struct {
    T values[GB_DEGREE];
    size_t count;
#if GB_WIDTH == 1
    bool close;
#else
    GB_(truth) dead[GB_DEGREE];
    GB_(truth) close[GB_DEGREE];
#endif
} GB_(roots);

/* The real roots of x^2 + constant; a miss that counts as none is up to `tangent` of the square of the unknown's typical size. */
GB_INLINE GB_(roots) GB_(roots_of_square)(T constant, T scale, gb_real tangent)
{
    GB_(roots) roots;
    const T square = scale * scale;
#if GB_WIDTH == 1
    const gb_real size = square > constant ? square : constant == constant ? constant : square;
    roots.count = 0;
    roots.close = false;
    if (constant <= tangent * size) {
        if (constant >= R(0.0)) {
            roots.values[0] = R(0.0);
            roots.count = 1;
            roots.close = true;
            return roots;
        }
        const gb_real root = gb_square_root(-constant);
        roots.values[0] = -root;
        roots.values[1] = root;
        roots.count = root <= GB_GREATEST ? 2 : 0;
        roots.close = root <= GB_MEETING * scale;
    }
#else
    const GB_(truth) is_square = GB_(exceeds)(square, constant) | GB_(inverted)(GB_(at_most)(constant, constant));
    const GB_(truth) dead = GB_(inverted)(GB_(at_most)(constant, tangent * GB_(pick)(square, constant, is_square)));
    const T root = GB_(square_root)(-constant);
    const GB_(truth) close = GB_(inverted)(GB_(exceeds)(root, GB_MEETING * scale));
    roots.values[0] = -root;
    roots.values[1] = root;
    roots.count = 2;
    for (int i = 0; i < 2; i++) {
        roots.dead[i] = dead;
        roots.close[i] = close;
    }
#endif
    return roots;
}

/* The real roots of x^2 + constant. */
GB_INLINE GB_(roots) GB_(square_roots)(T constant, T scale)
{
    return GB_(roots_of_square)(constant, scale, GB_TANGENT);
}

/* The same behind roots of polynomials of higher degree, which are less exact. */
GB_INLINE GB_(roots) GB_(grazing_roots)(T constant, T scale)
{
    return GB_(roots_of_square)(constant, scale, GB_GRAZING);
}

/* The real roots of the first polynomial whose leading coefficient counts, or of the last one. */
#if GB_WIDTH == 1
GB_UNUSED static GB_(roots) GB_(polynomial_roots)(const GB_(polynomial) *list, size_t count, T scale)
{
    GB_(roots) roots;
    roots.count = gb_real_roots(list, count, scale, roots.values, GB_DEGREE, &roots.close);
    return roots;
}
#else
typedef struct {
    const T *coefficients;
    size_t length;
} GB_(polynomial);

#define GB_MOST_POLYNOMIALS 4
GB_UNUSED static GB_(roots) GB_(polynomial_roots)(const GB_(polynomial) *list, size_t count, T scale)
{
    GB_(roots) roots;
    roots.count = GB_DEGREE;
    for (int i = 0; i < GB_DEGREE; i++) {
        roots.values[i] = GB_(of)(NAN);
        roots.dead[i] = ~GB_(nowhere)();
        roots.close[i] = GB_(nowhere)();
    }
    for (int lane = 0; lane < GB_WIDTH; lane++) {
        gb_real numbers[GB_MOST_POLYNOMIALS][GB_DEGREE + 1], values[GB_DEGREE];
        gb_polynomial_1 own[GB_MOST_POLYNOMIALS];
        for (size_t k = 0; k < count; k++) {
            for (size_t i = 0; i < list[k].length; i++) {
                numbers[k][i] = list[k].coefficients[i][lane];
            }
            own[k].coefficients = numbers[k];
            own[k].length = list[k].length;
        }
        bool close;
        const size_t found = gb_real_roots(own, count, scale[lane], values, GB_DEGREE, &close);
        for (size_t i = 0; i < found; i++) {
            roots.values[i][lane] = values[i];
            roots.dead[i][lane] = 0;
            roots.close[i][lane] = close ? -1 : 0;
        }
    }
    return roots;
}
#endif

/* How a candidate was found; in lanes, where it is none too. */
#if GB_WIDTH > 1
typedef struct {
    size_t branch;
    GB_(truth) dead;
    GB_(truth) close;
    bool is_pair;
} GB_(found);
#endif

/* By a choice of the first block's case whose branch numbers end at `last`. */
GB_INLINE GB_(found) GB_(first)(size_t branch, size_t last)
{
#if GB_WIDTH == 1
    const gb_found_1 found = {branch, last, 0, false, false};
#else
    const GB_(found) found = {branch, {0}, {0}, false};
#endif
    return found;
}

/* By a choice among `radix` of a later block. */
GB_INLINE GB_(found) GB_(next)(GB_(found) found, size_t radix, size_t number)
{
    found.branch = radix * found.branch + number;
#if GB_WIDTH == 1
    found.last *= radix;
#endif
    return found;
}

/* By the root with this index. */
GB_INLINE GB_(found) GB_(by_root)(GB_(found) found, const GB_(roots) *roots, size_t index)
{
#if GB_WIDTH == 1
    found.close |= roots->close;
#else
    found.dead |= roots->dead[index] & ~found.close;
    found.close |= roots->close[index];
#endif
    return found;
}

/* By both roots. */
GB_INLINE GB_(found) GB_(by_pair)(GB_(found) found, const GB_(roots) *roots)
{
    found = GB_(by_root)(found, roots, 0);
    found.is_pair = roots->count == 2;
    return found;
}

/* On a stratum where these joints are free: bit j for joint j. */
GB_INLINE GB_(found) GB_(freeing)(GB_(found) found, uint32_t joints)
{
#if GB_WIDTH == 1
    found.free |= joints;
#endif
    return found;
}

/* P of the arc tangent z + z^3 P(z^2) for |z| <= tan(pi/8). */
GB_INLINE T GB_(series)(T u)
{
    const T square = u * u, fourth = u * u * (u * u);
    const T first = R(-0.3333333333333333) + R(0.1999999999999552) * u + (R(-0.14285714284666542) + R(0.11111111015256361) * u) * square;
    const T second = R(-0.09090904578123903) + R(0.07692183190826087) * u + (R(-0.06664511447381948) + R(0.0585814891280221) * u) * square;
    const T third = R(-0.05085449737940259) + R(0.03923165829558718) * u + R(-0.019176887119062243) * square;
    return first + (second + third * fourth) * fourth;
}

/* The angle in [0, pi/2] of a cosine and a sine that are not negative; not a number where both are zero. */
GB_INLINE T GB_(acute)(T across, T up)
{
    const GB_(truth) steep = GB_(exceeds)(up, across);
    const T low = GB_(pick)(across, up, steep), high = GB_(pick)(up, across, steep);
    const GB_(truth) far = GB_(exceeds)(low, GB_EIGHTH * high);
    const T none = GB_(of)(R(0.0)), quarter = GB_(pick)(GB_(of)(GB_PI / R(4.0)), none, far), rest = GB_(pick)(GB_(of)(GB_REST), none, far);
    const T z = (low - GB_(pick)(high, none, far)) / (high + GB_(pick)(low, none, far));
    const T small = z + z * (z * z) * GB_(series)(z * z);
    const T angle = quarter + (small + rest);
    return GB_(pick)(GB_PI / R(2.0) - (angle - R(2.0) * GB_REST), angle, steep);
}

/* The angle in (-pi, pi] of a cosine and a sine, given the one of their magnitudes; zero is not negative. */
GB_INLINE T GB_(unfold)(T acute, T cosine, T sine)
{
    const GB_(truth) is_back = GB_(exceeds)(GB_(of)(R(0.0)), cosine);
    const T angle = GB_(with_sign)(GB_(pick)(GB_PI - (acute - R(4.0) * GB_REST), acute, is_back), sine);
    return GB_(pick)(angle + GB_TAU, angle, GB_(at_most)(angle, GB_(of)(-GB_PI))) + R(0.0);
}

/* ---- What a target must fulfil ---- */

GB_INLINE T GB_(dot)(const T *a, const T *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* One Newton step towards the nearest rotation of a matrix by rows, R - (R R^T - 1) R / 2 (N. Higham, "Computing the polar decomposition - with
 * applications", 1986); false when that is far, or it is a reflection. */
GB_INLINE GB_(truth) GB_(make_rotation)(T *r)
{
    T excess[3][3], given[9], deviation = GB_(of)(R(0.0));
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            excess[i][j] = GB_(dot)(r + 3 * i, r + 3 * j) - (i == j ? R(1.0) : R(0.0));
            deviation = GB_(greater)(deviation, GB_(abs)(excess[i][j]));
        }
    }
    const T determinant = r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) + r[2] * (r[3] * r[7] - r[4] * r[6]);
    memcpy(given, r, sizeof given);
    for (int i = 0; i < 9; i++) {
        const T *row = excess[i / 3], *column = given + i % 3;
        r[i] = r[i] - R(0.5) * (row[0] * column[0] + row[1] * column[3] + row[2] * column[6]);
    }
    return (GB_(truth))(GB_(at_most)(GB_(of)(R(0.0)), determinant) & GB_(at_most)(deviation, GB_(of)(GB_CONSISTENT)));
}

/* One Newton step towards the nearest unit vector; false when that is far. */
GB_INLINE GB_(truth) GB_(make_unit)(T *v)
{
    const T excess = GB_(dot)(v, v) - R(1.0);
    for (int i = 0; i < 3; i++) {
        v[i] = v[i] - R(0.5) * (excess * v[i]);
    }
    return GB_(at_most)(GB_(abs)(excess), GB_(of)(GB_CONSISTENT));
}

/* Moves a target onto a condition, which it may miss by a little; false where it misses it by more. */
GB_INLINE GB_(truth) GB_(fulfil)(gb_condition condition, T *target)
{
    return condition.is_rotation ? GB_(make_rotation)(target + condition.first) : GB_(make_unit)(target + condition.first);
}

/* ---- What the program offers, below in the robot's file ---- */

typedef struct GB_(sink) GB_(sink);
GB_INLINE void GB_(parameters)(const T *target, T *p);
GB_UNUSED static void GB_(walk)(const T *p, GB_(sink) *c);
GB_INLINE void GB_(sizes)(const T *p, const T *at, T *sizes);
#ifdef GB_SHORTS
GB_INLINE void GB_(shorten)(const T *p, const T *at, T *value, T *size, T (*columns)[GB_SHORTS]);
#endif

/* The equations' values, zero at a solution. */
#ifdef GB_COMPARED
GB_INLINE void GB_(tip)(const T *at, T *tip);
GB_INLINE void GB_(values)(const T *p, const T *at, T *values)
{
    GB_(tip)(at, values);
    GB_UNROLL
    for (int i = 0; i < GB_EQUATIONS; i++) {
        values[i] = values[i] - p[gb_compared[i]];
    }
}
#else
GB_INLINE void GB_(values)(const T *p, const T *at, T *values);
#endif

#if GB_WIDTH > 1 || GB_LANES == 1
/* ---- Measuring several candidates at once ---- */

/* The first numbers of a row, and to the front of one. */
GB_INLINE T GB_(load)(const gb_real *row)
{
#if GB_WIDTH == 1
    return *row;
#else
    T numbers;
    memcpy(&numbers, row, sizeof numbers);
    return numbers;
#endif
}

/* One number, or one and another. */
GB_INLINE T GB_(lanes_of)(gb_real first, gb_real second)
{
#if GB_WIDTH == 1
    (void)second;
    return first;
#else
    T numbers = GB_(of)(second);
    numbers[0] = first;
    return numbers;
#endif
}

GB_INLINE void GB_(store)(gb_real *row, T numbers)
{
    memcpy(row, &numbers, sizeof numbers);
}

/* The largest magnitude of an equation's value, and its largest share of the equation's size. */
GB_INLINE void GB_(fit)(const T *p, const T *at, T *residual, T *relative)
{
    T values[GB_EQUATIONS], sizes[GB_SIZES], largest[GB_SIZES];
    GB_(values)(p, at, values);
    GB_(sizes)(p, at, sizes);
    GB_UNROLL
    for (int i = 0; i < GB_SIZES; i++) {
        largest[i] = GB_(of)(R(0.0));
    }
    GB_UNROLL
    for (int i = 0; i < GB_EQUATIONS; i++) {
        largest[gb_size_of[i]] = GB_(greater)(largest[gb_size_of[i]], GB_(abs)(values[i]));
    }
    *residual = *relative = GB_(of)(R(0.0));
    GB_UNROLL
    for (int i = 0; i < GB_SIZES; i++) {
        *residual = GB_(greater)(*residual, largest[i]);
        *relative = GB_(greater)(*relative, largest[i] / GB_(above)(sizes[i], GB_(of)(GB_LEAST_POSITIVE)));
    }
}

/* Whether candidates are of joints at all: 1, else 0. */
GB_INLINE T GB_(sound)(const T *at)
{
    T sound = GB_(of)(R(1.0));
    GB_UNROLL
    for (int i = 0; i < GB_JOINTS; i++) {
        const T first = at[gb_joints[i].places[0]], second = at[gb_joints[i].places[1]];
        sound = gb_joints[i].is_angle ? GB_(where_below)(sound, GB_(abs)(first * first + second * second - R(1.0)), GB_ROUNDING)
                                      : GB_(where_below)(sound, GB_(abs)(first), GB_GREATEST);
    }
    for (int i = 0; GB_EXTRAS && i < GB_PLACES; i++) {
        sound = GB_(where_below)(sound, GB_(abs)(at[i]), GB_GREATEST);
    }
    return sound;
}
#endif

#ifdef GB_SHORTS
/* ---- The short way from a candidate of a nearby mechanism's formulas to the answer next to it ---- */

/* A pair of a cosine and a sine turned back by a small way, nearer to the circle; the factor that led there. */
GB_INLINE T GB_(turn_back)(T way, T *cosine, T *sine)
{
    const T c = *cosine, s = *sine;
    const T norm = R(1.5) - R(0.5) * (c * c + s * s), square = way * way;
    const T across = norm * way * (R(1.0) - square * (R(1.0) - square * (R(1.0) / R(20.0))) * (R(1.0) / R(6.0)));
    const T along = norm * (R(1.0) - R(0.5) * square * (R(1.0) - square * (R(1.0) / R(12.0))));
    *cosine = along * c + across * s;
    *sine = along * s - across * c;
    return norm;
}

GB_INLINE T GB_(dot_short)(const T *a, const T *b)
{
    T sum = GB_(of)(R(0.0));
    GB_UNROLL
    for (int i = 0; i < GB_SHORTS; i++) {
        sum = sum + a[i] * b[i];
    }
    return sum;
}

/* The step (J^T J)^-1 J^T f by elimination without pivoting, the largest share of a value in its size, and the least pivot as a share of the size; not
 * sound where that is small. */
GB_INLINE void GB_(normal_step)(const T *p, const T *at, T *step, T *missed, T *pivot, T *sound)
{
    T value[GB_SHORTS], size_of[GB_SHORTS], columns[GB_JOINTS][GB_SHORTS], square[GB_JOINTS][GB_JOINTS], inverse[GB_JOINTS];
    T size = GB_(of)(R(0.0)), least = GB_(of)(INFINITY);
    GB_(shorten)(p, at, value, size_of, columns);
    *missed = size;
    for (int i = 0; i < GB_SHORTS; i++) {
        *missed = GB_(greater)(*missed, GB_(abs)(value[i]) / GB_(above)(size_of[i], GB_(of)(GB_LEAST_POSITIVE)));
    }
    for (int i = 0; i < GB_JOINTS; i++) {
        for (int j = 0; j <= i; j++) {
            square[i][j] = GB_(dot_short)(columns[i], columns[j]);
        }
        step[i] = GB_(dot_short)(columns[i], value);
        size = GB_(greater)(size, square[i][i]);
    }
    for (int k = 0; k < GB_JOINTS; k++) {
        *sound = GB_(where_below)(*sound, size * GB_PLAIN - square[k][k], R(0.0));
        least = GB_(lesser)(least, square[k][k]);
        inverse[k] = R(1.0) / square[k][k];
        for (int i = k + 1; i < GB_JOINTS; i++) {
            const T factor = square[i][k] * inverse[k];
            for (int j = k + 1; j <= i; j++) {
                square[i][j] = square[i][j] - factor * square[j][k];
            }
            step[i] = step[i] - factor * step[k];
        }
    }
    for (int k = GB_JOINTS; k-- > 0;) {
        for (int j = k + 1; j < GB_JOINTS; j++) {
            step[k] = step[k] - square[j][k] * step[j];
        }
        step[k] = step[k] * inverse[k];
    }
    *pivot = least / size;
}

/* Takes a step back; a long one, or a pair far from the circle, is not sound. */
GB_INLINE void GB_(step_back)(const T *step, T *at, T *sound)
{
    GB_UNROLL
    for (int i = 0; i < GB_JOINTS; i++) {
        T *first = &at[gb_joints[i].places[0]];
        if (gb_joints[i].is_angle) {
            const T norm = GB_(turn_back)(step[i], first, &at[gb_joints[i].places[1]]);
            *sound = GB_(where_below)(GB_(where_below)(*sound, GB_(abs)(step[i]), GB_TURN), GB_(abs)(norm - R(1.0)), GB_TURN);
        } else {
            *first = *first - step[i];
            *sound = GB_(where_below)(*sound, GB_(abs)(step[i]), GB_GREATEST);
        }
    }
}
#endif

/* ---- What takes candidates in ---- */

#if GB_WIDTH == 1

/* The answers to a target, and by place the numbers of candidates that wait to be measured together, and how each was found. */
struct gb_sink_1 {
    gb_answers all;
    gb_solution *out;
    /* Where pairs are written instead, or null, and whether all candidates so far can be. */
    gb_pairs *pairs;
    bool is_usual;
    /* Whether usual cases alone have run. */
    bool is_ordinary;
    size_t waiting;
    gb_real at[GB_PLACES][GB_CANDIDATES];
    gb_found_1 found[GB_CANDIDATES];
    gb_real extras[GB_PLACES];
};

static GB_APART void gb_flush(gb_sink_1 *c);

/* Whether there have been candidates behind so many, and each has held where it was found: then none is lost beside a stratum. */
static GB_COLD bool gb_suffice_since(gb_sink_1 *c, size_t candidates)
{
    gb_flush(c);
    return c->all.candidates > candidates && c->all.unsound <= candidates;
}

/* Takes in one candidate, or the second of a pair. */
GB_INLINE void gb_take_1(gb_sink_1 *c, const gb_found_1 *found, const gb_real *at)
{
    if (GB_SELDOM(c->waiting >= GB_CANDIDATES)) {
        gb_flush(c);
    }
    const size_t k = c->waiting;
    GB_UNROLL
    for (int i = 0; i < GB_PLACES; i++) {
        c->at[i][k] = at[i];
    }
    c->found[k] = *found;
    c->waiting = k + 1;
    c->all.candidates++;
}

#else

/* The candidates of several targets. */
struct GB_(sink) {
    T at[GB_CANDIDATES][GB_PLACES];
    T q[GB_CANDIDATES][GB_JOINTS];
    T residual[GB_CANDIDATES];
    T relative[GB_CANDIDATES];
    /* Which targets have no such candidate. */
    GB_(truth) dead[GB_CANDIDATES];
    /* Which targets are not ordinary: a case of a stratum may run, roots are close, a candidate misses the equations or is next to another. */
    GB_(truth) doubt;
    size_t branch[GB_CANDIDATES];
    size_t count;
};

/* Takes in one candidate, or the second of a pair. */
GB_INLINE void GB_(take)(GB_(sink) *c, const GB_(found) *found, const T *at)
{
    const size_t k = c->count % GB_CANDIDATES;
    GB_UNROLL
    for (int i = 0; i < GB_PLACES; i++) {
        c->at[k][i] = at[i];
    }
    c->dead[k] = found->dead;
    c->branch[k] = found->branch;
    c->doubt |= found->close & ~found->dead;
    c->count = k + 1;
}

#endif

#ifdef GROEBOT_SIX_AXES_H
/* All values of six joints that reach a target; none of several targets, whose programs take no such steps. */
GB_INLINE size_t GB_(six_axes)(const gb_chain *chain, const T *target, gb_six_answer *out)
{
#if GB_WIDTH == 1
    return gb_six_axes(chain, target, out);
#else
    (void)chain;
    (void)target;
    (void)out;
    return 0;
#endif
}

/* By an answer of six axes with these bits: those that it frees are free, and it is doubted where it is only near an answer. */
GB_INLINE GB_(found) GB_(by_answer)(GB_(found) found, const gb_six_answer *answer, uint32_t a, uint32_t b, uint32_t c, uint32_t d,
                                    uint32_t e, uint32_t f)
{
    const uint32_t bits[6] = {a, b, c, d, e, f};
    uint32_t free = 0;
    for (int joint = 0; joint < 6; joint++) {
        free |= answer->free[joint] ? bits[joint] : 0;
    }
    found = GB_(freeing)(found, free);
    if (answer->lost) {
        found.close |= GB_(at_most)(GB_(of)(R(0.0)), GB_(of)(R(1.0)));
    }
    return found;
}
#endif

/* Whether a case that hardly ever does not run runs. */
GB_INLINE bool GB_(is_usual)(GB_(sink) *c, GB_(guard) guard)
{
#if GB_WIDTH == 1
    if (GB_SELDOM(!guard.here)) {
        c->is_ordinary = false;
    }
    return guard.here;
#else
    c->doubt |= ~guard.here;
    return true;
#endif
}

/* Whether one that hardly ever runs does. */
GB_INLINE bool GB_(is_rare)(GB_(sink) *c, GB_(guard) guard)
{
#if GB_WIDTH == 1
    if (GB_SELDOM(guard.here)) {
        c->is_ordinary = false;
    }
    return GB_SELDOM(guard.here);
#else
    c->doubt |= guard.here;
    return false;
#endif
}

/* Whether the case of a stratum runs: near it, or beside it where the candidates behind the first `before` have sufficed. */
GB_INLINE bool GB_(is_due)(GB_(sink) *c, size_t before, GB_(guard) guard)
{
#if GB_WIDTH == 1
    return GB_(is_rare)(c, guard) && (guard.beside || !gb_suffice_since(c, before));
#else
    (void)before;
    return GB_(is_rare)(c, guard);
#endif
}

/* How many candidates there have been. */
GB_INLINE size_t GB_(count)(const GB_(sink) *c)
{
#if GB_WIDTH == 1
    return c->all.candidates;
#else
    (void)c;
    return 0;
#endif
}

/* Takes in that a stratum could not be derived, and whether the target lies on it. */
GB_INLINE void GB_(is_open)(GB_(sink) *c, GB_(guard) guard)
{
#if GB_WIDTH == 1
    c->all.is_open = c->all.is_open || guard.here;
#else
    c->doubt |= guard.here;
#endif
}

/* The place of the greatest number that is not negative, the first of equals; their number without one. In lanes all must agree. */
GB_INLINE size_t GB_(elect)(GB_(sink) *c, const T *claims, size_t count)
{
    size_t first = count;
    for (int lane = 0; lane < GB_WIDTH; lane++) {
        gb_real most = R(-1.0);
        size_t place = count;
        for (size_t i = 0; i < count; i++) {
#if GB_WIDTH == 1
            const gb_real claim = claims[i];
#else
            const gb_real claim = claims[i][lane];
#endif
            if (claim > most) {
                most = claim;
                place = i;
            }
        }
        first = lane == 0 ? place : first;
#if GB_WIDTH > 1
        c->doubt[lane] |= place == first ? 0 : -1;
#endif
    }
    (void)c;
    return first;
}

/* Takes in a candidate, or a pair. */
GB_INLINE void GB_(finish)(GB_(sink) *c, GB_(found) found, const T *at)
{
    GB_(take)(c, &found, at);
#ifdef GB_TURNED
    if (found.is_pair) {
        T turned[GB_PLACES];
        GB_UNROLL
        for (int i = 0; i < GB_PLACES; i++) {
            turned[i] = at[i];
        }
        GB_UNROLL
        for (size_t i = 0; i < sizeof gb_turned; i++) {
            turned[gb_turned[i]] = -turned[gb_turned[i]];
        }
        found.branch++;
        GB_(take)(c, &found, turned);
    }
#endif
}


#if GB_WIDTH > 1 && GB_WIDTH == GB_LANES && defined(GB_RUNS)
/* ---- Many targets, several at once ---- */

/* The numbers of up to so many targets, of which there is one at least; where one is infinite, not a number, or breaks a condition, all are doubtful. */
GB_INLINE GB_(truth) GB_(gather)(const gb_real *targets, size_t count, T *target)
{
    GB_(truth) fine = ~GB_(nowhere)();
    for (int i = 0; i < GB_INPUTS; i++) {
        T numbers = GB_(of)(targets[i]);
        for (size_t lane = 1; lane < GB_WIDTH; lane++) {
            numbers[lane] = targets[(size_t)((lane < count ? lane : count - 1) * GB_INPUTS + i)];
        }
        target[i] = numbers;
        fine &= GB_(at_most)(GB_(abs)(target[i]), GB_(of)(GB_GREATEST));
    }
#ifdef GB_CONDITIONS
    for (size_t i = 0; i < sizeof gb_conditions / sizeof gb_conditions[0]; i++) {
        fine &= GB_(fulfil)(gb_conditions[i], target);
    }
#endif
    return fine;
}

/* Doubts where a candidate misses the equations. */
GB_INLINE void GB_(measure)(GB_(sink) *c, const T *p)
{
    for (int k = 0; k < GB_CANDIDATES; k += GB_TWINS) {
        T residual, relative;
        GB_(fit)(p, c->at[k], &residual, &relative);
        for (int twin = 0; twin < GB_TWINS; twin++) {
            c->residual[k + twin] = residual;
            c->relative[k + twin] = relative;
        }
        c->doubt |= ~(GB_(exceeds)(GB_(of)(GB_ROUNDING), relative) | c->dead[k]);
    }
}

/* Whether two candidates are next to one another. */
GB_INLINE GB_(truth) GB_(are_near)(const T *a, const T *b)
{
    GB_(truth) near = ~GB_(nowhere)();
    for (int i = 0; i < GB_JOINTS; i++) {
        const gb_joint joint = gb_joints[gb_last_first[i]];
        const size_t cosine = joint.places[0], sine = joint.places[1];
        if (joint.is_angle) {
            near &= ~GB_(exceeds)(GB_(of)(GB_FAR_APART), a[cosine] * b[cosine] + a[sine] * b[sine]);
            if (!GB_(any)(near)) {
                break;
            }
        }
    }
    return near;
}

/* Doubts where two candidates are next to one another. Of those that are alike one is enough: the others are as far from one another. */
GB_INLINE void GB_(tell_apart)(GB_(sink) *c)
{
    for (int k = 0; k < GB_CANDIDATES; k += GB_TWINS) {
        for (int other = 0; other < k + GB_TWINS; other++) {
            const GB_(truth) alive = ~(c->dead[k] | c->dead[other]);
            if (other != k && GB_(any)(alive)) {
                c->doubt |= alive & GB_(are_near)(c->at[k], c->at[other]);
            }
        }
    }
}

/* Finds joint values, angles only if they are wanted; doubts where they are none. */
GB_INLINE void GB_(find_joints)(GB_(sink) *c, bool wants_angles)
{
    for (int i = 0; i < GB_JOINTS; i++) {
        const size_t first = gb_joints[i].places[0], second = gb_joints[i].places[1];
        GB_(truth) sound = {0};
        T acute = GB_(of)(R(0.0));
        for (int k = 0; k < GB_CANDIDATES; k++) {
            const T cosine = c->at[k][first], sine = c->at[k][second];
            if (!gb_joints[i].is_angle) {
                c->q[k][i] = cosine;
                sound = GB_(exceeds)(GB_(of)(GB_GREATEST), GB_(abs)(cosine));
            } else {
                if (k % gb_runs[i] == 0) {
                    sound = GB_(exceeds)(GB_(of)(GB_ROUNDING), GB_(abs)(cosine * cosine + sine * sine - R(1.0)));
                    acute = wants_angles ? GB_(acute)(GB_(abs)(cosine), GB_(abs)(sine)) : acute;
                }
                if (wants_angles) {
                    c->q[k][i] = GB_(unfold)(acute, cosine, sine);
                }
            }
            c->doubt |= ~(sound | c->dead[k]);
        }
    }
}

/* Finds the candidates of up to so many targets. */
GB_INLINE void GB_(find)(GB_(sink) *c, const gb_real *targets, size_t count, bool wants_angles)
{
    T target[GB_INPUTS], p[GB_PARAMETERS];
    c->doubt = ~GB_(gather)(targets, count, target);
    c->count = 0;
    GB_(parameters)(target, p);
    GB_(walk)(p, c);
    GB_(measure)(c, p);
    GB_(tell_apart)(c);
    GB_(find_joints)(c, wants_angles);
}

/* Writes the solutions of the target in a lane, with room for all candidates; how many there are. */
GB_INLINE size_t GB_(write_solutions)(const GB_(sink) *c, size_t lane, gb_solution *room)
{
    size_t count = 0;
    for (int k = 0; k < GB_CANDIDATES; k++) {
        gb_solution *out = &room[count];
        GB_UNROLL
        for (int i = 0; i < GB_JOINTS; i++) {
            out->q[i] = c->q[k][i][lane];
        }
        out->residual = c->residual[k][lane];
        out->relative = c->relative[k][lane];
        out->branch = c->branch[k];
        out->chosen = false;
        out->free = 0;
        count += c->dead[k][lane] == 0;
    }
    return count;
}

/* The same by cosines and sines. */
GB_INLINE size_t GB_(write_pairs)(const GB_(sink) *c, size_t lane, gb_pairs *room)
{
    size_t count = 0;
    for (int k = 0; k < GB_CANDIDATES; k++) {
        gb_pairs *out = &room[count];
        GB_UNROLL
        for (int i = 0; i < GB_JOINTS; i++) {
            const gb_joint joint = gb_joints[i];
            out->joints[i][0] = joint.is_angle ? c->at[k][joint.places[0]][lane] + R(0.0) : c->at[k][joint.places[0]][lane];
            out->joints[i][1] = joint.is_angle ? c->at[k][joint.places[1]][lane] + R(0.0) : R(0.0);
        }
        out->residual = c->residual[k][lane];
        out->branch = c->branch[k];
        out->free = 0;
        count += c->dead[k][lane] == 0;
    }
    return count;
}

static GB_COLD int gb_solve_into(const gb_real *target, gb_solution *solutions, gb_pairs *pairs, size_t room);

/* As GB_DECLARE says of NAME_solve_batch, or of NAME_solve_pairs_batch where there are no `solutions`. */
GB_INLINE size_t GB_(solve_many)(const gb_real *targets, size_t count, gb_solution *solutions, gb_pairs *pairs, size_t room, int *counts)
{
    GB_(sink) c;
    memset(&c, 0, sizeof c);
    size_t filled = 0;
    for (size_t done = 0; done < count; done++) {
        const size_t lane = done % GB_WIDTH;
        const gb_real *target = targets + done * GB_INPUTS;
        gb_solution *solution = solutions ? solutions + filled : NULL;
        gb_pairs *pair = pairs ? pairs + filled : NULL;
        if (lane == 0) {
            GB_(find)(&c, target, count - done, solutions != NULL);
        }
        if (c.doubt[lane] == 0 && room - filled >= GB_CANDIDATES) {
            counts[done] = (int)(solutions ? GB_(write_solutions)(&c, lane, solution) : GB_(write_pairs)(&c, lane, pair));
        } else {
            const int found = gb_solve_into(target, solution, pair, room - filled);
            if (found > 0 && (size_t)found > room - filled) {
                return done;
            }
            counts[done] = found;
        }
        filled += counts[done] > 0 ? (size_t)counts[done] : 0;
    }
    return count;
}
#endif

#else

/* ---- What a robot offers ---- */

#if GB_LANES > 1
#define GB_STEP 2
#define GB_PAIR(name) GB_JOIN(gb_, name, _2)
#else
#define GB_STEP 1
#define GB_PAIR(name) GB_JOIN(gb_, name, _1)
#endif

#ifdef GB_FREED
static const unsigned char gb_freed[] = {GB_FREED};
#endif

static void gb_values_of(const gb_real *p, const gb_real *at, gb_real *values)
{
    gb_values_1(p, at, values);
}

static void gb_sizes_of(const gb_real *p, const gb_real *at, gb_real *sizes)
{
    gb_sizes_1(p, at, sizes);
}

#ifndef GB_JACOBIAN
/* The derivative of each equation by each joint: the equations are affine in the numbers of each, and have the values at the numbers' derivatives less
   those at zeros. */
static void gb_jacobian(const gb_real *p, const gb_real *at, gb_real *rows)
{
    for (int j = 0; j < GB_JOINTS; j++) {
        const gb_joint joint = gb_joints[j];
        gb_real moved[GB_PLACES], along[GB_EQUATIONS], without[GB_EQUATIONS];
        memcpy(moved, at, sizeof moved);
        for (int i = 0; i < 2; i++) {
            moved[joint.places[i]] = R(0.0);
        }
        gb_values_1(p, moved, without);
        moved[joint.places[0]] = joint.is_angle ? -at[joint.places[1]] : R(1.0);
        moved[joint.places[1]] = joint.is_angle ? at[joint.places[0]] : R(1.0);
        gb_values_1(p, moved, along);
        for (int i = 0; i < GB_EQUATIONS; i++) {
            rows[i * GB_JOINTS + j] = along[i] - without[i];
        }
    }
}
#endif

#ifdef GB_SHORTS
/* Takes a step back from q, and what the equations read of it; false where a pair is far from the circle. */
static bool gb_step_back(const gb_real *step, gb_real *at, gb_real *q)
{
    for (int i = 0; i < GB_JOINTS; i++) {
        gb_real *first = &at[gb_joints[i].places[0]], *second = &at[gb_joints[i].places[1]];
        q[i] = q[i] - step[i];
        if (!gb_joints[i].is_angle) {
            *first = q[i];
            continue;
        }
        q[i] = gb_magnitude(q[i]) < GB_PI ? q[i] : gb_wrap(q[i]);
        const gb_real norm = gb_turn_back_1(step[i], first, second);
        if (!(gb_magnitude(norm - R(1.0)) <= GB_TURN)) {
            return false;
        }
        if (gb_magnitude(step[i]) > GB_TURN) {
            *first = gb_cosine(q[i]);
            *second = gb_sine(q[i]);
        }
    }
    return true;
}

/* Where plain Newton steps by the normal equations lead from q, if these hold there within rounding and are regular on the way. */
static bool gb_approach_from(const gb_problem *problem, const gb_real *from, const gb_real *q, gb_approach *approach)
{
    gb_real at[GB_PLACES], step[GB_JOINTS] = {0};
    memcpy(at, from, sizeof at);
    memcpy(approach->end, q, sizeof step);
    if (!gb_step_back(step, at, approach->end)) {
        return false;
    }
    for (int round = 0; round < GB_APPROACHES; round++) {
        gb_real missed, pivot, sound = R(1.0);
        gb_normal_step_1(problem->p, at, step, &missed, &pivot, &sound);
        if (round == 0) {
            approach->missed = missed;
            approach->pivot = pivot;
        }
        if (!(sound > R(0.0)) || !gb_step_back(step, at, approach->end)) {
            return false;
        }
        approach->fit = gb_measure_at(problem, at, approach->end);
        if (approach->fit.relative < GB_ROUNDING) {
            return approach->fit.accepted;
        }
    }
    return false;
}
#endif

static const gb_mechanism gb_this = {
    GB_JOINTS,
    GB_PLACES,
    GB_EQUATIONS,
    GB_SIZES,
    GB_CAPACITY,
    gb_joints,
    gb_last_first,
    gb_size_of,
#ifdef GB_FREED
    gb_freed,
    sizeof gb_freed,
#else
    NULL,
    0,
#endif
    GB_SCALE,
    GB_ISOLATED,
    GB_EXTRAS,
#ifdef GB_SHORTS
    true,
#else
    false,
#endif
    GB_PREFERRED,
    GB_PREFERS_GREATEST,
    sizeof(gb_solution),
    offsetof(gb_solution, residual),
    offsetof(gb_solution, relative),
    offsetof(gb_solution, branch),
    offsetof(gb_solution, chosen),
    offsetof(gb_solution, free),
    gb_values_of,
    gb_sizes_of,
    gb_jacobian,
#ifdef GB_SHORTS
    gb_approach_from,
#else
    NULL,
#endif
};

/* By candidate: how well it solves the equations, and whether it is of joints at all: 1, else 0. */
typedef struct {
    gb_real residual[GB_CANDIDATES];
    gb_real relative[GB_CANDIDATES];
    gb_real sound[GB_CANDIDATES];
} gb_fits;

/* The parameters in all lanes. */
GB_INLINE void gb_everywhere(const gb_real *p, GB_PAIR(number) *all)
{
    for (int i = 0; i < GB_PARAMETERS; i++) {
        all[i] = GB_PAIR(of)(p[i]);
    }
}

/* Whether those that wait are the candidates of an ordinary target. */
GB_INLINE bool gb_are_ordinary(const gb_sink_1 *c)
{
    return c->is_ordinary && c->waiting == GB_CANDIDATES && c->all.candidates == GB_CANDIDATES;
}

/* So many of the candidates that wait, in a row, miss the equations by the same. */
GB_INLINE size_t gb_twins(const gb_sink_1 *c)
{
    return GB_CANDIDATES % (GB_STEP * GB_TWINS) == 0 && gb_are_ordinary(c) ? GB_TWINS : 1;
}

/* Measures the candidates that wait, of which some in a row may be alike. */
static GB_APART void gb_measure_waiting(const gb_sink_1 *c, size_t alike, gb_fits *fits)
{
    GB_PAIR(number) p[GB_PARAMETERS], at[GB_PLACES], residual, relative;
    gb_everywhere(c->all.problem.p, p);
    for (size_t first = 0; first < c->waiting; first += GB_STEP * alike) {
        gb_real fit[3][GB_STEP];
        GB_UNROLL
        for (int i = 0; i < GB_PLACES; i++) {
            const gb_real *row = &c->at[i][first];
            at[i] = GB_TWINS == 1 ? GB_PAIR(load)(row) : GB_PAIR(lanes_of)(row[0], row[(GB_STEP - 1) * alike]);
        }
        GB_PAIR(fit)(p, at, &residual, &relative);
        GB_PAIR(store)(fit[0], residual);
        GB_PAIR(store)(fit[1], relative);
        GB_PAIR(store)(fit[2], GB_PAIR(sound)(at));
        for (size_t lane = 0; lane < GB_STEP; lane++) {
            for (size_t k = first + lane * alike; k < first + (lane + 1) * alike; k++) {
                fits->residual[k] = fit[0][lane];
                fits->relative[k] = fit[1][lane];
                fits->sound[k] = fit[2][lane];
            }
        }
    }
}

/* The binary logarithm of how many angles of a joint in a row are computed as one at an ordinary target. */
GB_INLINE int gb_run_of(int joint)
{
    int alike = 0;
#ifdef GB_RUNS
    while (((gb_runs[joint] | GB_CANDIDATES / GB_STEP) >> alike & 1) == 0) {
        alike++;
    }
#endif
    (void)joint;
    return alike;
}

/* By joint and candidate that waits, the joint values. Angles that differ in signs alone, as they do at an ordinary target, are computed once. */
static GB_APART void gb_find_joints(const gb_sink_1 *c, gb_real (*q)[GB_CANDIDATES])
{
    const bool is_ordinary = gb_are_ordinary(c);
    gb_real acute[GB_JOINTS * GB_CANDIDATES + 1], up[GB_JOINTS * GB_CANDIDATES + 1];
    size_t count = 0;
    for (int i = 0; i < GB_JOINTS; i++) {
        const gb_real *cosines = c->at[gb_joints[i].places[0]], *sines = c->at[gb_joints[i].places[1]];
        const size_t stride = (size_t)1 << (is_ordinary ? gb_run_of(i) : 0);
        for (size_t k = 0; gb_joints[i].is_angle && k < c->waiting; k += stride) {
            acute[count] = gb_magnitude(cosines[k]);
            up[count++] = gb_magnitude(sines[k]);
        }
    }
    acute[count] = up[count] = R(1.0);
    for (size_t first = 0; first < count; first += GB_STEP) {
        GB_PAIR(store)(&acute[first], GB_PAIR(acute)(GB_PAIR(load)(&acute[first]), GB_PAIR(load)(&up[first])));
    }
    const gb_real *own = acute;
    for (int i = 0; i < GB_JOINTS; i++) {
        const gb_real *cosines = c->at[gb_joints[i].places[0]], *sines = c->at[gb_joints[i].places[1]];
        const int alike = is_ordinary ? gb_run_of(i) : 0;
        if (!gb_joints[i].is_angle) {
            memcpy(q[i], cosines, sizeof q[i]);
            continue;
        }
        for (size_t k = 0; k < c->waiting; k += GB_STEP) {
            const GB_PAIR(number) pair = GB_PAIR(lanes_of)(own[k >> alike], own[(k + GB_STEP - 1) >> alike]);
            GB_PAIR(store)(&q[i][k], GB_PAIR(unfold)(pair, GB_PAIR(load)(&cosines[k]), GB_PAIR(load)(&sines[k])));
        }
        own += c->waiting >> alike;
    }
}

/* Whether an angle tells two candidates apart. */
GB_INLINE bool gb_are_apart(const gb_sink_1 *c, size_t k, size_t other)
{
    GB_UNROLL
    for (int i = 0; i < GB_JOINTS; i++) {
        const gb_joint joint = gb_joints[gb_last_first[i]];
        const gb_real *cosines = c->at[joint.places[0]], *sines = c->at[joint.places[1]];
        if (joint.is_angle && cosines[k] * cosines[other] + sines[k] * sines[other] < GB_FAR_APART) {
            return true;
        }
    }
    return false;
}

/* Writes a candidate that holds if there is room, and it is apart from others from the `nearest` on. */
GB_INLINE bool gb_write_apart(gb_sink_1 *c, size_t nearest, size_t k, const gb_real *q, gb_real residual, gb_real relative)
{
    for (size_t other = nearest; other < k; other++) {
        if (!gb_are_apart(c, k, other)) {
            return false;
        }
    }
    if (c->all.count == GB_CAPACITY) {
        return false;
    }
    gb_solution *out = &c->out[c->all.count];
    GB_UNROLL
    for (int i = 0; i < GB_JOINTS; i++) {
        out->q[i] = q[i];
    }
    out->residual = residual;
    out->relative = relative;
    out->branch = c->found[k].branch;
    out->chosen = false;
    out->free = c->found[k].free;
    c->all.count++;
    return true;
}

/* Lets the equations read what follows from no joint from a candidate that waits. */
static void gb_extras_of(gb_sink_1 *c, size_t k)
{
    if (GB_EXTRAS) {
        for (int i = 0; i < GB_PLACES; i++) {
            c->extras[i] = c->at[i][k];
        }
        c->all.problem.extras = c->extras;
    }
}

/* Keeps a candidate that does not simply stand for itself, or refines it. */
static GB_COLD void gb_look_closer(gb_sink_1 *c, size_t k, size_t waiting, const gb_real *q, const gb_fit *fit)
{
    const gb_found_1 found = c->found[k];
    gb_extras_of(c, k);
    if (fit) {
        gb_keep(&c->all, &found, q, fit);
    } else {
        gb_refine(&c->all, c->all.candidates + 1 + k - waiting, &found, q);
    }
}

GB_INLINE void gb_joints_of(gb_real (*joints)[GB_CANDIDATES], size_t k, gb_real *q)
{
    GB_UNROLL
    for (int i = 0; i < GB_JOINTS; i++) {
        q[i] = joints[i][k];
    }
}

#ifdef GB_SHORTS
/* By candidate, the short ways: the sums of their steps, how well the equations hold behind them, what they were missed by and the least pivot before, and
 * whether the equations are regular and near: 1, else 0. */
typedef struct {
    gb_real steps[GB_JOINTS][GB_CANDIDATES];
    gb_real residual[GB_CANDIDATES];
    gb_real relative[GB_CANDIDATES];
    gb_real missed[GB_CANDIDATES];
    gb_real pivot[GB_CANDIDATES];
    gb_real sound[GB_CANDIDATES];
} gb_ways;

/* What candidates next to each other have come to. */
typedef struct {
    GB_PAIR(number) at[GB_PLACES], steps[GB_JOINTS], sound;
} gb_walker;

/* A step of candidates next to each other. */
GB_INLINE void gb_step_ways(gb_ways *ways, const GB_PAIR(number) *p, gb_walker *walker, size_t first, bool is_first)
{
    GB_PAIR(number) step[GB_JOINTS], missed, pivot, residual, relative;
    GB_PAIR(normal_step)(p, walker->at, step, &missed, &pivot, &walker->sound);
    GB_PAIR(step_back)(step, walker->at, &walker->sound);
    for (int i = 0; i < GB_JOINTS; i++) {
        walker->steps[i] = walker->steps[i] + step[i];
        GB_PAIR(store)(&ways->steps[i][first], walker->steps[i]);
    }
    GB_PAIR(fit)(p, walker->at, &residual, &relative);
    if (is_first) {
        GB_PAIR(store)(&ways->missed[first], missed);
        GB_PAIR(store)(&ways->pivot[first], pivot);
    }
    GB_PAIR(store)(&ways->residual[first], residual);
    GB_PAIR(store)(&ways->relative[first], relative);
    GB_PAIR(store)(&ways->sound[first], walker->sound);
}

/* Where candidates next to each other start. */
GB_INLINE void gb_start_ways(const gb_sink_1 *c, gb_walker *walker, size_t first)
{
    for (int i = 0; i < GB_PLACES; i++) {
        walker->at[i] = GB_PAIR(load)(&c->at[i][first]);
    }
    for (int i = 0; i < GB_JOINTS; i++) {
        walker->steps[i] = GB_PAIR(of)(R(0.0));
    }
    walker->sound = GB_PAIR(of)(R(1.0));
    GB_PAIR(step_back)(walker->steps, walker->at, &walker->sound);
}

/* Whether a candidate need not go on: it has arrived, or cannot. */
GB_INLINE bool gb_is_done(const gb_sink_1 *c, const gb_ways *ways, size_t k)
{
    return k >= c->waiting || !(ways->sound[k] > R(0.0)) || ways->relative[k] < GB_ROUNDING;
}

/* The short ways of the candidates that wait. Two go together, whatever a register holds. */
static GB_APART void gb_find_ways(const gb_sink_1 *c, gb_ways *ways)
{
    GB_PAIR(number) p[GB_PARAMETERS];
    gb_everywhere(c->all.problem.p, p);
    for (size_t first = 0; first < c->waiting; first += 2) {
        gb_walker walkers[2 / GB_STEP];
        for (size_t i = 0; i < 2 / GB_STEP; i++) {
            gb_start_ways(c, &walkers[i], first + i);
        }
        for (int round = 0; round < GB_APPROACHES; round++) {
            for (size_t i = 0; i < 2 / GB_STEP; i++) {
                gb_step_ways(ways, p, &walkers[i], first + i, round == 0);
            }
            if (gb_is_done(c, ways, first) && gb_is_done(c, ways, first + 1)) {
                break;
            }
        }
    }
}

/* Where the short way of a candidate has led from q. */
static void gb_follow(const gb_ways *ways, size_t k, const gb_real *q, gb_approach *approach)
{
    for (int i = 0; i < GB_JOINTS; i++) {
        const gb_real value = q[i] - ways->steps[i][k];
        approach->end[i] = !gb_joints[i].is_angle || gb_magnitude(value) < GB_PI ? value : gb_wrap(value);
    }
    approach->fit.residual = ways->residual[k];
    approach->fit.relative = ways->relative[k];
    approach->fit.accepted = true;
    approach->missed = ways->missed[k];
    approach->pivot = ways->pivot[k];
}

/* Where a candidate is led; false where it must be refined. */
static bool gb_lead(gb_sink_1 *c, const gb_ways *ways, size_t k, const gb_real *q, gb_approach *approach)
{
    if (c->found[k].free != 0) {
        return false;
    }
    if (ways->sound[k] > R(0.0) && ways->relative[k] < GB_ROUNDING) {
        gb_follow(ways, k, q, approach);
        return true;
    }
    gb_real at[GB_PLACES];
    for (int i = 0; i < GB_PLACES; i++) {
        at[i] = c->at[i][k];
    }
    return gb_approach_from(&c->all.problem, at, q, approach);
}

/* Leads the candidates that wait to answers: those of a nearby mechanism's formulas. */
static void gb_keep_waiting(gb_sink_1 *c, gb_real (*joints)[GB_CANDIDATES])
{
    gb_ways ways;
    gb_find_ways(c, &ways);
    const size_t waiting = c->waiting;
    bool is_usual = c->all.count == 0;
    for (size_t k = 0; k < waiting; k++) {
        gb_approach approach;
        gb_real q[GB_JOINTS];
        gb_joints_of(joints, k, q);
        c->waiting = 0;
        if (!gb_lead(c, &ways, k, q, &approach)) {
            is_usual = false;
            gb_look_closer(c, k, waiting, q, NULL);
            continue;
        }
        const bool holds = approach.pivot >= approach.missed * (c->found[k].close ? GB_STEEP : GB_MILD);
        if (holds && is_usual && gb_write_apart(c, 0, k, approach.end, approach.fit.residual, approach.fit.relative)) {
            continue;
        }
        is_usual = false;
        gb_extras_of(c, k);
        gb_arrive(&c->all, c->all.candidates + 1 + k - waiting, &c->found[k], &approach);
    }
}

#else
/* Keeps, of the candidates that wait, those that solve the equations within rounding, and refines others. */
static void gb_keep_waiting(gb_sink_1 *c, gb_real (*joints)[GB_CANDIDATES])
{
    gb_fits fits;
    const size_t twins = gb_twins(c);
    gb_measure_waiting(c, twins, &fits);
    bool is_usual = c->all.count == 0;
    for (size_t k = 0; k < c->waiting; k++) {
        const gb_fit fit = {fits.residual[k], fits.relative[k], true};
        const bool holds = c->found[k].free == 0 && !c->found[k].close && fit.relative < GB_ROUNDING && fits.sound[k] > R(0.0);
        gb_real q[GB_JOINTS];
        gb_joints_of(joints, k, q);
        /* The second of two that are alike is as far from those before as the first. */
        const size_t nearest = k % twins == 0 ? 0 : k - 1;
        if (holds && is_usual && gb_write_apart(c, nearest, k, q, fit.residual, fit.relative)) {
            continue;
        }
        is_usual = false;
        gb_look_closer(c, k, c->waiting, q, holds ? &fit : NULL);
    }
}
#endif

/* Whether an angle tells two answers apart. */
static bool gb_tell_apart(const gb_pairs *a, const gb_pairs *b)
{
    GB_UNROLL
    for (int i = 0; i < GB_JOINTS; i++) {
        const size_t joint = gb_last_first[i];
        if (gb_joints[joint].is_angle && a->joints[joint][0] * b->joints[joint][0] + a->joints[joint][1] * b->joints[joint][1] < GB_FAR_APART) {
            return true;
        }
    }
    return false;
}

/* Writes a candidate as pairs if it is apart from all before it. */
static bool gb_write_pairs(gb_sink_1 *c, size_t k, gb_real residual)
{
    if (c->all.count == GB_CAPACITY) {
        return false;
    }
    gb_pairs *out = &c->pairs[c->all.count];
    GB_UNROLL
    for (int i = 0; i < GB_JOINTS; i++) {
        const gb_joint joint = gb_joints[i];
        out->joints[i][0] = joint.is_angle ? c->at[joint.places[0]][k] + R(0.0) : c->at[joint.places[0]][k];
        out->joints[i][1] = joint.is_angle ? c->at[joint.places[1]][k] + R(0.0) : R(0.0);
    }
    out->residual = residual;
    out->branch = c->found[k].branch;
    out->free = 0;
    for (size_t other = 0; other < c->all.count; other++) {
        if (c->pairs[other].branch == out->branch || !gb_tell_apart(out, &c->pairs[other])) {
            return false;
        }
    }
    c->all.count++;
    return true;
}

/* Writes the candidates that wait as pairs, as long as all solve the equations within rounding and are apart. */
static void gb_keep_pairs(gb_sink_1 *c)
{
    gb_fits fits;
    gb_measure_waiting(c, gb_twins(c), &fits);
    c->is_usual = c->is_usual && !gb_this.is_nearby;
    for (size_t k = 0; c->is_usual && k < c->waiting; k++) {
        const bool holds = c->found[k].free == 0 && !c->found[k].close && fits.relative[k] < GB_ROUNDING && fits.sound[k] > R(0.0);
        c->is_usual = holds && gb_write_pairs(c, k, fits.residual[k]);
    }
}

/* Keeps what is an answer of the candidates that wait. */
static GB_APART void gb_flush(gb_sink_1 *c)
{
    for (int i = 0; c->waiting % 2 == 1 && i < GB_PLACES; i++) {
        c->at[i][c->waiting] = c->at[i][c->waiting - 1];
    }
    if (c->pairs) {
        gb_keep_pairs(c);
    } else {
        gb_real joints[GB_JOINTS][GB_CANDIDATES];
        gb_find_joints(c, joints);
        gb_keep_waiting(c, joints);
    }
    c->waiting = 0;
}

/* Moves a target onto its conditions, which it may miss by a little; a code below zero where that is far. */
static int gb_conform(const gb_real *target, gb_real *conforming)
{
    for (int i = 0; i < GB_INPUTS; i++) {
        conforming[i] = target[i];
        if (!(gb_magnitude(target[i]) <= GB_GREATEST)) {
            return GB_NOT_FINITE;
        }
    }
#ifdef GB_CONDITIONS
    GB_UNROLL
    for (size_t i = 0; i < sizeof gb_conditions / sizeof gb_conditions[0]; i++) {
        if (!gb_fulfil_1(gb_conditions[i], conforming)) {
            return gb_conditions[i].is_rotation ? GB_NOT_ROTATION : GB_NOT_UNIT;
        }
    }
#endif
    return 0;
}

/* Walks through the program to the answers to a target with these parameters; 0, or a code below. */
static int gb_walk_through(gb_sink_1 *c, const gb_real *target, gb_real *p, gb_solution *out, gb_pairs *pairs)
{
    gb_real conforming[GB_INPUTS] = {0};
    const int code = gb_conform(target, conforming);
    if (code < 0) {
        return code;
    }
    gb_parameters_1(conforming, p);
    c->all.problem.mechanism = &gb_this;
    c->all.problem.p = p;
    c->all.problem.extras = NULL;
    c->all.out = c->out = out;
    c->all.room = GB_CAPACITY;
    c->all.count = c->all.candidates = c->all.unsound = c->waiting = 0;
    c->all.is_open = c->all.has_nearest = false;
    c->pairs = pairs;
    c->is_usual = c->is_ordinary = true;
    gb_walk_1(p, c);
    gb_flush(c);
    return c->all.is_open ? GB_OPEN_STRATUM : 0;
}

/* Whether answers are in order as they are. */
GB_INLINE bool gb_are_settled(const gb_sink_1 *c)
{
    bool are_sorted = GB_PREFERRED < 0 && c->all.count <= GB_ISOLATED;
    for (size_t i = 1; i < c->all.count; i++) {
        are_sorted &= c->out[i - 1].branch <= c->out[i].branch;
    }
    return are_sorted;
}

int GB_PUBLIC(solve)(const gb_real *target, gb_solution *out)
{
    gb_sink_1 c;
    gb_real p[GB_PARAMETERS];
    const int code = gb_walk_through(&c, target, p, out, NULL);
    if (code < 0) {
        return code;
    }
    if (!gb_are_settled(&c)) {
        gb_settle(&c.all);
    }
    return (int)c.all.count;
}

int GB_PUBLIC(solve_or_nearest)(const gb_real *target, gb_solution *out, gb_solution *nearest)
{
    gb_sink_1 c;
    gb_real p[GB_PARAMETERS];
    memset(nearest, 0, sizeof *nearest);
    nearest->residual = nearest->relative = INFINITY;
    const int code = gb_walk_through(&c, target, p, out, NULL);
    if (code < 0) {
        return code;
    }
    gb_settle(&c.all);
    if (c.all.count == 0 && c.all.has_nearest) {
        memcpy(nearest->q, c.all.nearest, sizeof nearest->q);
        nearest->residual = c.all.nearest_fit.residual;
        nearest->relative = c.all.nearest_fit.relative;
    }
    return (int)c.all.count;
}

/* A solution by cosines and sines. */
static void gb_pairs_of(const gb_solution *solution, gb_pairs *out)
{
    for (int i = 0; i < GB_JOINTS; i++) {
        out->joints[i][0] = gb_joints[i].is_angle ? gb_cosine(solution->q[i]) : solution->q[i];
        out->joints[i][1] = gb_joints[i].is_angle ? gb_sine(solution->q[i]) : R(0.0);
    }
    out->residual = solution->residual;
    out->branch = solution->branch;
    out->free = solution->free;
}

/* The pairs of what the robot's solve finds. */
static GB_COLD int gb_solve_by_angles(const gb_real *target, gb_pairs *out)
{
    gb_solution list[GB_CAPACITY];
    const int count = GB_PUBLIC(solve)(target, list);
    for (int i = 0; i < count; i++) {
        gb_pairs_of(&list[i], &out[i]);
    }
    return count;
}

int GB_PUBLIC(solve_pairs)(const gb_real *target, gb_pairs *out)
{
    gb_sink_1 c;
    gb_real p[GB_PARAMETERS];
    const int code = gb_walk_through(&c, target, p, NULL, out);
    if (code < 0) {
        return code;
    }
    if (!c.is_usual || c.all.count > GB_ISOLATED) {
        return gb_solve_by_angles(target, out);
    }
    for (size_t end = 1; end < c.all.count; end++) {
        for (size_t i = end; i > 0 && out[i - 1].branch > out[i].branch; i--) {
            const gb_pairs other = out[i];
            out[i] = out[i - 1];
            out[i - 1] = other;
        }
    }
    return (int)c.all.count;
}

/* All of one target, where there may be less room than solutions: then none is written. */
static GB_COLD int gb_solve_into(const gb_real *target, gb_solution *solutions, gb_pairs *pairs, size_t room)
{
    if (room >= GB_CAPACITY) {
        return solutions ? GB_PUBLIC(solve)(target, solutions) : GB_PUBLIC(solve_pairs)(target, pairs);
    }
    union {
        gb_solution solutions[GB_CAPACITY];
        gb_pairs pairs[GB_CAPACITY];
    } list;
    const int count = solutions ? GB_PUBLIC(solve)(target, list.solutions) : GB_PUBLIC(solve_pairs)(target, list.pairs);
    if (count > 0 && (size_t)count <= room && solutions) {
        memcpy(solutions, list.solutions, (size_t)count * sizeof *solutions);
    } else if (count > 0 && (size_t)count <= room) {
        memcpy(pairs, list.pairs, (size_t)count * sizeof *pairs);
    }
    return count;
}

#if GB_LANES > 1 && defined(GB_RUNS)
#define GB_SOLVE_MANY GB_JOIN(gb_solve_many, _, GB_LANES)
#else
#define GB_SOLVE_MANY gb_solve_singly
/* One after the other. */
static size_t gb_solve_singly(const gb_real *targets, size_t count, gb_solution *solutions, gb_pairs *pairs, size_t room, int *counts)
{
    size_t filled = 0;
    for (size_t done = 0; done < count; done++) {
        gb_solution *solution = solutions ? solutions + filled : NULL;
        gb_pairs *pair = pairs ? pairs + filled : NULL;
        const int found = gb_solve_into(targets + done * GB_INPUTS, solution, pair, room - filled);
        if (found > 0 && (size_t)found > room - filled) {
            return done;
        }
        counts[done] = found;
        filled += found > 0 ? (size_t)found : 0;
    }
    return count;
}
#endif

size_t GB_PUBLIC(solve_batch)(const gb_real *targets, size_t count, gb_solution *out, size_t room, int *counts)
{
    return GB_SOLVE_MANY(targets, count, out, NULL, room, counts);
}

size_t GB_PUBLIC(solve_pairs_batch)(const gb_real *targets, size_t count, gb_pairs *out, size_t room, int *counts)
{
    return GB_SOLVE_MANY(targets, count, NULL, out, room, counts);
}

gb_real GB_PUBLIC(residual)(const gb_real *target, const gb_real *q)
{
    gb_real conforming[GB_INPUTS] = {0}, p[GB_PARAMETERS], at[GB_PLACES], values[GB_EQUATIONS], largest = R(0.0);
    const gb_problem problem = {&gb_this, p, NULL};
    if (GB_EXTRAS || gb_conform(target, conforming) < 0) {
        return NAN;
    }
    gb_parameters_1(conforming, p);
    gb_place(&problem, q, at);
    gb_values_of(p, at, values);
    for (int i = 0; i < GB_EQUATIONS; i++) {
        if (isnan(values[i])) {
            return NAN;
        }
        largest = gb_larger(largest, gb_magnitude(values[i]));
    }
    return largest;
}

bool GB_PUBLIC(forward)(const gb_real *q, gb_real *target)
{
#ifdef GB_REACHED
    static const gb_reached reached[GB_INPUTS] = {GB_REACHED};
    const gb_problem problem = {&gb_this, NULL, NULL};
    gb_real at[GB_PLACES], tip[GB_EQUATIONS];
    gb_place(&problem, q, at);
    gb_tip_1(at, tip);
    for (int i = 0; i < GB_INPUTS; i++) {
        const size_t first = reached[i].of[0], second = reached[i].of[1];
        if (reached[i].kind == GB_AS_JOINT) {
            target[i] = q[first];
        } else if (reached[i].kind == GB_AS_VALUE) {
            target[i] = tip[first];
        } else {
            target[i] = gb_unfold_1(gb_acute_1(gb_magnitude(tip[first]), gb_magnitude(tip[second])), tip[first], tip[second]);
        }
    }
    return true;
#else
    (void)q;
    (void)target;
    return false;
#endif
}

void GB_PUBLIC(target_of)(const gb_real *base, const gb_real *tool, const gb_real *pose, gb_real *target)
{
    gb_target_of(base, tool, pose, target);
}

size_t GB_PUBLIC(count_turns)(const gb_real *q, const gb_real *limits)
{
    return gb_count_turns(&gb_this, q, limits);
}

void GB_PUBLIC(turn)(const gb_real *q, const gb_real *limits, size_t index, gb_real *out)
{
    gb_turn(&gb_this, q, limits, index, out);
}

int GB_PUBLIC(solve_within)(const gb_real *target, const gb_real *limits, gb_solution *out)
{
    gb_real conforming[GB_INPUTS] = {0}, p[GB_PARAMETERS];
    gb_answers all;
    const int count = GB_PUBLIC(solve)(target, out);
    if (count <= 0) {
        return count;
    }
    memset(&all, 0, sizeof all);
    gb_conform(target, conforming);
    gb_parameters_1(conforming, p);
    all.problem.mechanism = &gb_this;
    all.problem.p = p;
    all.out = out;
    all.count = (size_t)count;
    return (int)gb_keep_within(&all, limits);
}

int GB_PUBLIC(nearest)(const gb_solution *list, int count, const gb_real *reference, const gb_real *weights, const gb_real *limits, gb_real *q)
{
    gb_answers all;
    memset(&all, 0, sizeof all);
    all.problem.mechanism = &gb_this;
    all.out = (void *)list;
    all.count = count > 0 ? (size_t)count : 0;
    return gb_nearest(&all, reference, weights, limits, q);
}

#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#endif
#endif
