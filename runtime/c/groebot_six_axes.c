/* Six joints in any place, found together: all real solutions, sixteen at most, by one eigenvalue problem. As groebot-runtime's six_axes, operation by
 * operation.
 *
 * The joint that is hidden moves E2 E3 (line 4) to G E6^-1 E5^-1 (line 4), joints counted from it and the axes behind the target moved to its other side.
 * Of a line, fourteen functions (M. Raghavan and B. Roth, J. Mechanical Design 115 (1993) 502-508) turn with each joint by matrices that are affine in the
 * cosine and sine of its angle. Seen from the hidden joint, four pairs of them turn as plane vectors do, and six stay as they are. Two vectors a, b with b
 * turned from a fulfil Rodrigues' equation b - a = x w x (a + b), x the tangent of half the angle: linear in x, so that the eigenvalue problem has as many
 * rows as the chain has solutions. */
#ifndef GROEBOT_SIX_AXES_C
#define GROEBOT_SIX_AXES_C

#ifndef GB_RUNTIME
#define GB_RUNTIME
#endif
#ifndef GB_SHARED
#include "groebot.h"
#endif
#include "groebot_six_axes.h"

/* Rows and columns of the pencil, the number of complex solutions of a general chain. */
#define GB_SIX_SIZE 16
/* Functions that the motion along the hidden axis leaves alone, and those that it moves; the products of one of 1, c, s of a first joint and one of 1, c, s
 * of a second one: the second changes fastest. */
#define GB_SIX_STILL 6
#define GB_SIX_MOVING 8
#define GB_SIX_PRODUCTS 9
/* Products of the joints on the far side, without 1; those on the near side and then those on the far side. */
#define GB_SIX_FAR 8
#define GB_SIX_COLUMNS 17
/* Monomials of the doubled joint times products of the other near one; columns before elimination: the near ones, then the far ones with the cosine and
 * with the sine of the half angle. */
#define GB_SIX_NEAR 12
#define GB_SIX_ALL 28
/* What was solved for in the pencil at most. */
#define GB_SIX_SOLVED 12
/* The most answers that are kept while formulations are united, and the most candidates that are remembered. */
#define GB_SIX_KEPT 32

/* A pivot of a still equation below this share of its largest coefficient is not taken while the far products alone are solved for. */
#define GB_SIX_WEAK GB_EITHER(1e-3, 1e-2)
/* Half angles (arc tangents of half a way) from which the hidden one is counted: the first whose matrix can be inverted well is taken. */
#define GB_SIX_ORIGINS 3
static const gb_real gb_six_origins[GB_SIX_ORIGINS] = {R(0.4), R(1.1), -R(0.5)};
/* The smallest share of a pivot in the largest entry of its matrix at which an origin is taken at once. */
#define GB_SIX_SOUND_ORIGIN GB_EITHER(1e-9, 1e-3)
/* Two real eigenvalues closer than this share of 1 + |x|^2 have eigenvectors that rounding mixes. */
#define GB_SIX_CROWDED GB_EITHER(1e-8, 1e-3)
/* QR steps for one deflation; every tenth has an exceptional shift. */
#define GB_SIX_QR_STEPS 60
/* The square of a column that is taken for zero. */
#define GB_SIX_FAINT GB_EITHER(1e-280, 1e-35)
/* Solutions of (H - x) y = b, each from the one before. Their number is odd: next to a double eigenvalue with one eigenvector the inverse is like that of a
 * Jordan block that rounding has disturbed, whose square is like the identity. */
#define GB_SIX_ROUNDS 3

/* Newton steps at most: at a singular pose each only halves the miss. */
#define GB_SIX_STEPS 40
/* A miss below which no further step is tried. */
#define GB_SIX_EXACT GB_EITHER(2e-15, 5e-7)
/* A miss below which a single step that does not halve it is the last. */
#define GB_SIX_ROUNDING GB_EITHER(1e-13, 1e-5)
/* How often a step may be shortened, over all steps. */
#define GB_SIX_SHORTENED 12
/* A step that moves a joint by more than this is shortened. */
#define GB_SIX_LONGEST R(0.5)
/* A column of the Jacobian of which no more than this share is across the columns behind it depends on them. */
#define GB_SIX_SINGULAR GB_EITHER(1e-6, 2e-3)

/* A fifth pivot of the Jacobian below this share of the first: there is more than a curve. */
#define GB_SIX_RANK R(1e-3)
/* The largest singular value, about, of what is taken for a curve. */
#define GB_SIX_STEEP R(1e-2)
/* Where joints change the sixth equation by more after so many steps across, no curve is near. */
#define GB_SIX_FLAT R(5e-2)
#define GB_SIX_EARLY 2
/* The most that may be missed on a curve, as a share of the length scale or in radians. */
#define GB_SIX_ADRIFT R(1e-3)
/* A last step across the curve. */
#define GB_SIX_SETTLED GB_EITHER(1e-9, 1e-4)
/* What rounding leaves of the equations on a self-motion. */
#define GB_SIX_LEVEL GB_EITHER(1e-13, 1e-5)
/* Steps across the curve at most, from where a walk may begin, and from the end of a step along it. */
#define GB_SIX_MANY 12
#define GB_SIX_FEW 5
/* The length of a step along the curve; the least one, as a share of it; the most steps of a walk in one direction. */
#define GB_SIX_STRIDE R(0.1)
#define GB_SIX_SHORT R(0.015)
#define GB_SIX_PACES 400
/* Rounds of the false position between two steps. */
#define GB_SIX_NARROWED 16

/* Answers whose joints all differ by no more than this (rad) are one. */
#define GB_SIX_MERGE GB_EITHER(1e-7, 2e-3)
/* The largest residual of an answer, as a share of the length scale or in radians. */
#define GB_SIX_ACCEPT GB_EITHER(1e-12, 2e-5)
/* Candidates that are no farther than this from one that is known are not remembered again. */
#define GB_SIX_ALIKE R(1e-2)
/* An answer on a curve that is no farther than this from one that is known is that one. */
#define GB_SIX_APART GB_EITHER(1e-4, 2e-2)
/* The share of a pivot below which another formulation is asked too. */
#define GB_SIX_SOUND GB_EITHER(1e-11, 1e-4)
/* The share of a pivot at which a target without real eigenvalues is out of reach. */
#define GB_SIX_CLEAR GB_EITHER(1e-6, 1e-3)
/* A candidate that misses the target by more before polishing shows that the eigenvalues are not accurate. */
#define GB_SIX_ACCURATE GB_EITHER(1e-6, 2e-2)
/* What stands in for the accuracy of the eigenvalues when it is better than that. */
#define GB_SIX_UNKNOWN GB_EITHER(1e-11, 1e-5)
/* The square of a complex eigenvalue's depth as a multiple of the eigenvalues' accuracy: below it, it may be a double root. */
#define GB_SIX_OFF GB_EITHER(1e3, 1e2)
/* Below it, it is tried. */
#define GB_SIX_FAR_OFF GB_EITHER(1e7, 1e3)
/* A complex pair that is farther off the real line is no double root that rounding has parted. */
#define GB_SIX_BLURRED GB_EITHER(1e-2, 1e-1)
/* More than any eigenvalue is off the real line. */
#define GB_SIX_DEEPEST R(1.0)
/* A way of so many length scales stands for an infinite one. */
#define GB_SIX_LONG GB_EITHER(1e4, 1e2)
/* Stages in which a candidate next to the target is led to it. */
#ifdef GB_FLOAT
#define GB_SIX_STAGES 8
#else
#define GB_SIX_STAGES 20
#endif
/* By attempt, how far aside the target is put: where solutions share a hidden angle, or a self-motion stands at the same target, the eigenvectors of isolated
 * ones are only found next to it. */
#define GB_SIX_ATTEMPTS 8
static const gb_real gb_six_disturbances[GB_SIX_ATTEMPTS] = {
    R(0.0), R(0.0), R(0.0), R(0.0), GB_EITHER(1e-4, 1e-2), GB_EITHER(1e-4, 1e-2), GB_EITHER(1e-3, 3e-2), GB_EITHER(1e-3, 3e-2),
};
/* The axis of the motions that put targets aside. */
static const gb_real gb_six_direction[3] = {R(0.48), R(0.6), R(0.64)};

/* ---- Several numbers at once, each as it would be alone ---- */

#if GB_LANES >= 4
#define GB_SIX_LANES 4
#elif GB_LANES >= 2
#define GB_SIX_LANES 2
#else
#define GB_SIX_LANES 1
#endif
/* Room for so many numbers in whole registers. */
#define GB_SIX_PADDED(count) (((count) + GB_SIX_LANES - 1) / GB_SIX_LANES * GB_SIX_LANES)

#if GB_SIX_LANES > 1
typedef gb_real gb_six_lanes __attribute__((vector_size(sizeof(gb_real) * GB_SIX_LANES)));
/* Their bits, or where something is so: all bits or none. */
typedef uint64_t gb_six_bits __attribute__((vector_size(sizeof(gb_real) * GB_SIX_LANES)));
#else
typedef gb_real gb_six_lanes;
#ifdef GB_FLOAT
typedef uint32_t gb_six_bits;
#else
typedef uint64_t gb_six_bits;
#endif
#endif
/* The place of the sign among a number's bits. */
#define GB_SIX_SIGN (8 * sizeof(gb_real) - 1)

GB_INLINE gb_six_lanes gb_six_load(const gb_real *from)
{
    gb_six_lanes lanes;
    memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

GB_INLINE void gb_six_store(gb_real *to, gb_six_lanes lanes)
{
    memcpy(to, &lanes, sizeof lanes);
}

/* The number, everywhere. */
GB_INLINE gb_six_lanes gb_six_of(gb_real number)
{
    gb_real all[GB_SIX_LANES];
    for (int lane = 0; lane < GB_SIX_LANES; lane++) {
        all[lane] = number;
    }
    return gb_six_load(all);
}

GB_INLINE gb_six_bits gb_six_bits_of(gb_six_lanes lanes)
{
    gb_six_bits bits;
    memcpy(&bits, &lanes, sizeof bits);
    return bits;
}

GB_INLINE gb_six_lanes gb_six_of_bits(gb_six_bits bits)
{
    gb_six_lanes lanes;
    memcpy(&lanes, &bits, sizeof lanes);
    return lanes;
}

/* Where a number is more than a limit. */
GB_INLINE gb_six_bits gb_six_exceeds(gb_six_lanes a, gb_six_lanes limit)
{
#if GB_SIX_LANES > 1
    return (gb_six_bits)(a > limit);
#else
    return (gb_six_bits)0 - (gb_six_bits)(a > limit);
#endif
}

/* The number where something is so, and another elsewhere. */
GB_INLINE gb_six_lanes gb_six_pick(gb_six_lanes a, gb_six_lanes b, gb_six_bits is_so)
{
#if GB_SIX_LANES > 1
    return gb_six_of_bits((gb_six_bits_of(a) & is_so) | (gb_six_bits_of(b) & ~is_so));
#else
    return is_so ? a : b;
#endif
}

GB_INLINE gb_six_lanes gb_six_abs(gb_six_lanes a)
{
#if GB_SIX_LANES > 1
    return gb_six_of_bits(gb_six_bits_of(a) & ~gb_six_bits_of(gb_six_of(-R(0.0))));
#else
    return gb_magnitude(a);
#endif
}

/* The greater of two numbers; the first where one is not a number. */
GB_INLINE gb_six_lanes gb_six_greater(gb_six_lanes a, gb_six_lanes b)
{
    return gb_six_pick(b, a, gb_six_exceeds(b, a));
}

/* Takes a multiple of another row from a row, in columns from `first` on, which begins a register. */
GB_INLINE void gb_six_subtract(gb_real *row, gb_real factor, const gb_real *over, size_t first, size_t end)
{
    const gb_six_lanes factors = gb_six_of(factor);
    for (size_t i = first; i < end; i += GB_SIX_LANES) {
        gb_six_store(row + i, gb_six_load(row + i) - factors * gb_six_load(over + i));
    }
}

/* The largest magnitude in `count` numbers, whole registers, that is greater than `least`; what is no number is passed over. */
GB_INLINE gb_real gb_six_largest(gb_real least, const gb_real *numbers, size_t count)
{
    gb_real lanes[GB_SIX_LANES], largest = least;
    gb_six_lanes most = gb_six_of(least);
    for (size_t i = 0; i < count; i += GB_SIX_LANES) {
        most = gb_six_greater(most, gb_six_abs(gb_six_load(numbers + i)));
    }
    gb_six_store(lanes, most);
    for (int lane = 0; lane < GB_SIX_LANES; lane++) {
        largest = gb_larger(largest, lanes[lane]);
    }
    return largest;
}

/* ---- Cosines and sines of several angles: vector.rs ---- */

/* A number to which others are added so that only whole ones are left, the last bits those of the whole number. */
#define GB_SIX_WHOLE GB_EITHER(6755399441055744.0, 12582912.0)

/* The cosines and the sines of angles up to a million rad, to the last bit but where an angle is in the middle between two quarter turns those of
 * gb_cosine and gb_sine. */
GB_INLINE void gb_six_turns_of(gb_six_lanes angles, gb_six_lanes *cosines, gb_six_lanes *sines)
{
    const gb_six_lanes shifted = angles * R(0.6366197723675814) + GB_SIX_WHOLE, quarters = shifted - GB_SIX_WHOLE;
    /* Products of the first two parts are exact, and so is the first difference. */
    const gb_six_lanes first = angles - quarters * GB_EITHER(1.5707963267341256, 1.5703125);
    const gb_six_lanes second = quarters * GB_EITHER(6.077100506303966e-11, 4.837512969970703e-4);
    const gb_six_lanes sum = first - second, lost = first - sum;
    const gb_six_lanes third = (first - (sum + lost)) + (lost - second) - quarters * GB_EITHER(2.0222662487959506e-21, 7.54978995489188e-8);
    const gb_six_lanes x = sum + third, rest = (sum - x) + third, u = x * x, half = R(0.5) * (x * x), less = R(1.0) - half;
    const gb_six_lanes up = R(0.008333333333330948)
        + u * (R(-0.00019841269836758574) + u * (R(2.755731610255244e-06) + u * (R(-2.5051131845003624e-08) + u * R(1.5918129294866608e-10))));
    const gb_six_lanes s = x + (x * u * (R(-0.16666666666666666) + u * up) + rest * less);
    const gb_six_lanes low = R(2.480158729876569e-05) + u * (R(-2.7557317271729793e-07) + u * (R(2.08761462684032e-09) + u * R(-1.1382632425521717e-11)));
    const gb_six_lanes across = R(0.041666666666666664) + u * (R(-0.0013888888888887398) + u * low);
    const gb_six_lanes c = less + (((R(1.0) - less) - half) + (u * u * across - x * rest));
    const gb_six_bits quarter = gb_six_bits_of(shifted), odd = 0 - (quarter & 1);
    const gb_six_bits of_c = gb_six_bits_of(c), of_s = gb_six_bits_of(s);
    *cosines = gb_six_of_bits(((of_c & ~odd) | (of_s & odd)) ^ (((quarter + 1) & 2) << (GB_SIX_SIGN - 1)));
    *sines = gb_six_of_bits(((of_s & ~odd) | (of_c & odd)) ^ ((quarter & 2) << (GB_SIX_SIGN - 1)));
}

/* The same of a list that fills whole registers. */
GB_INLINE void gb_six_turns(const gb_real *angles, size_t count, gb_real *cosines, gb_real *sines)
{
    GB_UNROLL
    for (size_t i = 0; i < count; i += GB_SIX_LANES) {
        gb_six_lanes c, s;
        gb_six_turns_of(gb_six_load(angles + i), &c, &s);
        gb_six_store(cosines + i, c);
        gb_six_store(sines + i, s);
    }
}

/* The angle of a cosine and a sine; nought where both are zero. */
static gb_real gb_six_turn(gb_real cosine, gb_real sine)
{
    return cosine == R(0.0) && sine == R(0.0) ? R(0.0) : gb_angle(cosine, sine);
}

/* ---- Vectors and rigid motions: vector.rs, rigid.rs ---- */

GB_INLINE gb_real gb_six_dot(const gb_real *a, const gb_real *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

GB_INLINE void gb_six_cross(const gb_real *a, const gb_real *b, gb_real *out)
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* The sum of the products of two lists, which are not empty. */
GB_INLINE gb_real gb_six_product(const gb_real *a, const gb_real *b, size_t count)
{
    gb_real sum = a[0] * b[0];
    for (size_t i = 1; i < count; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

GB_INLINE gb_real gb_six_norm(const gb_real *v)
{
    return gb_square_root(gb_six_product(v, v, 6));
}

/* The largest magnitude among six; not a number where one is none. */
GB_INLINE gb_real gb_six_size(const gb_real *v)
{
    gb_real most = R(0.0);
    GB_UNROLL
    for (int i = 0; i < 6; i++) {
        const gb_real entry = gb_magnitude(v[i]);
        most = entry > most || entry != entry ? entry : most;
    }
    return most;
}

GB_INLINE bool gb_six_is_finite(gb_real x)
{
    return gb_magnitude(x) <= GB_GREATEST;
}

static const gb_rigid gb_six_none = {{{R(1.0), R(0.0), R(0.0)}, {R(0.0), R(1.0), R(0.0)}, {R(0.0), R(0.0), R(1.0)}}, {R(0.0), R(0.0), R(0.0)}};

/* A direction turned. */
GB_INLINE void gb_six_turned(const gb_rigid *motion, const gb_real *v, gb_real *out)
{
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        out[i] = gb_six_dot(motion->rotation[i], v);
    }
}

/* A point moved. */
GB_INLINE void gb_six_moved(const gb_rigid *motion, const gb_real *p, gb_real *out)
{
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        out[i] = gb_six_dot(motion->rotation[i], p) + motion->translation[i];
    }
}

/* The motion back. */
GB_INLINE gb_rigid gb_six_inverse(const gb_rigid *motion)
{
    gb_rigid back;
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        GB_UNROLL
        for (int j = 0; j < 3; j++) {
            back.rotation[i][j] = motion->rotation[j][i];
        }
        back.translation[i] = -gb_six_dot(back.rotation[i], motion->translation);
    }
    return back;
}

/* The motion a after b. */
GB_INLINE gb_rigid gb_six_after(const gb_rigid *a, const gb_rigid *b)
{
    gb_rigid both;
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        const gb_real *row = a->rotation[i];
        GB_UNROLL
        for (int j = 0; j < 3; j++) {
            both.rotation[i][j] = row[0] * b->rotation[0][j] + row[1] * b->rotation[1][j] + row[2] * b->rotation[2][j];
        }
        both.translation[i] = gb_six_dot(row, b->translation) + a->translation[i];
    }
    return both;
}

/* Then a turn about the moved z axis, given its cosine and sine. */
GB_INLINE void gb_six_then_turn(gb_rigid *motion, gb_real c, gb_real s)
{
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        gb_real *row = motion->rotation[i];
        const gb_real x = row[0], y = row[1];
        row[0] = c * x + s * y;
        row[1] = c * y - s * x;
    }
}

/* Then a slide along the moved z axis. */
GB_INLINE void gb_six_then_slide(gb_rigid *motion, gb_real way)
{
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        motion->translation[i] = motion->translation[i] + motion->rotation[i][2] * way;
    }
}

/* A small motion by `size` (rad, and shares of the length scale), another for each attempt. */
static gb_rigid gb_six_aside(gb_real size, size_t attempt)
{
    const gb_real sign = attempt % 2 == 0 ? size : -size, c = gb_cosine(sign), s = gb_sine(sign), *w = gb_six_direction;
    gb_rigid motion = gb_six_none;
    for (int j = 0; j < 3; j++) {
        const gb_real *v = gb_six_none.rotation[j], along = gb_six_dot(w, v) * (R(1.0) - c);
        gb_real third[3];
        gb_six_cross(w, v, third);
        for (int i = 0; i < 3; i++) {
            motion.rotation[i][j] = c * v[i] + s * third[i] + along * w[i];
        }
    }
    motion.translation[0] = R(-0.7) * sign;
    motion.translation[1] = R(0.5) * sign;
    motion.translation[2] = R(0.3) * sign;
    return motion;
}

/* ---- Lines in space that turn about each other: screw.rs ---- */

/* The axis of a joint and what the joint leaves alone: the line of its axis; of a joint that slides, directions: along it, and one across it. */
typedef struct {
    gb_real direction[3];
    gb_real point[3];
    gb_real side[3];
    bool slides;
} gb_six_figure;

/* c and s of the turns, or d^2 and d of the slides, at which functions are sampled. */
static const gb_real gb_six_samples[2][3][2] = {
    {{R(1.0), R(0.0)}, {R(0.0), R(1.0)}, {R(0.0), R(-1.0)}},
    {{R(0.0), R(0.0)}, {R(1.0), R(1.0)}, {R(1.0), R(-1.0)}},
};

/* A vector turned about a direction, given cosine and sine. */
GB_INLINE void gb_six_turned_about(const gb_real *w, const gb_real *v, const gb_real *by, gb_real *out)
{
    const gb_real share = gb_six_dot(w, v);
    gb_real third[3];
    gb_six_cross(w, v, third);
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        const gb_real along = w[i] * share;
        out[i] = along + ((v[i] - along) * by[0] + third[i] * by[1]);
    }
}

/* The figure moved by the joint of an axis, given c and s of its angle, or d^2 and d of its way. */
GB_INLINE gb_six_figure gb_six_moved_by(const gb_six_figure *figure, const gb_six_figure *axis, const gb_real *by)
{
    gb_six_figure moved = *figure;
    gb_real from[3], arm[3];
    if (axis->slides) {
        GB_UNROLL
        for (int i = 0; i < 3; i++) {
            moved.point[i] = figure->point[i] + axis->direction[i] * by[1];
        }
        return moved;
    }
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        from[i] = figure->point[i] - axis->point[i];
    }
    gb_six_turned_about(axis->direction, from, by, arm);
    gb_six_turned_about(axis->direction, figure->direction, by, moved.direction);
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        moved.point[i] = axis->point[i] + arm[i];
    }
    if (figure->slides) {
        gb_six_turned_about(axis->direction, figure->side, by, moved.side);
    }
    return moved;
}

/* The coefficients of 1, c, s, or of 1, d^2, d, of functions that are affine in them, from their values at the samples. */
GB_INLINE void gb_six_coefficients(bool slides, gb_six_lanes f, gb_six_lanes g, gb_six_lanes h, gb_six_lanes *out)
{
    const gb_six_lanes mean = R(0.5) * (g + h);
    out[1] = slides ? mean - f : f - mean;
    out[0] = slides ? f : f - out[1];
    out[2] = R(0.5) * (g - h);
}

/* ---- Chains: chain.rs ---- */

/* The joint that stands so many steps behind the hidden one in the loop. */
GB_INLINE size_t gb_six_joint(gb_formulation formulation, size_t steps)
{
    return (formulation.hidden + steps) % 6;
}

/* The joint whose half angle or way the equations are multiplied by. */
GB_INLINE size_t gb_six_doubled(gb_formulation formulation)
{
    return gb_six_joint(formulation, formulation.second ? 2 : 1);
}

/* That of an attempt: after the last the first again. */
GB_INLINE gb_formulation gb_six_formulation(const gb_chain *chain, size_t attempt)
{
    return chain->formulations[attempt % chain->formulation_count];
}

static gb_six_figure gb_six_figure_of(const gb_chain *chain, size_t joint)
{
    gb_six_figure figure;
    memcpy(figure.direction, chain->directions[joint], sizeof figure.direction);
    memcpy(figure.point, chain->points[joint], sizeof figure.point);
    memcpy(figure.side, chain->across[joint][0], sizeof figure.side);
    figure.slides = chain->slides[joint];
    return figure;
}

/* What a joint leaves alone, moved to where the loop is cut behind the target. */
static gb_six_figure gb_six_place(const gb_chain *chain, gb_formulation formulation, size_t steps, bool ahead, const gb_rigid *displacement)
{
    const gb_six_figure figure = gb_six_figure_of(chain, gb_six_joint(formulation, steps));
    if (ahead != (formulation.hidden + steps >= 6)) {
        return figure;
    }
    const gb_rigid motion = ahead ? gb_six_inverse(displacement) : *displacement;
    gb_six_figure moved;
    gb_six_turned(&motion, figure.direction, moved.direction);
    gb_six_moved(&motion, figure.point, moved.point);
    gb_six_turned(&motion, figure.side, moved.side);
    moved.slides = figure.slides;
    return moved;
}

/* ---- What is affine in the cosine and sine of every joint, the functions of Raghavan and Roth: profile.rs ----
 *
 * Of a line with direction l through a point p, the fourteen functions p, l, p x l, (p.p) l - 2 (p.l) p, p.p and p.l span a space that rigid motions map into
 * itself. When the origin is on the axis of a turn, the part of the four vectors along it and the two scalars stay, six functions; the part of the vectors
 * across it turns. A joint that slides acts on them by polynomials of degree two in its way, 1, d^2, d in the place of 1, c, s. What such a joint leaves
 * alone is its direction l, a direction a across it, and lines along l: a, l, p x l, l x a, p.a and p.(l x a) are fourteen functions of the same kind. */

/* Of each vector the component along the hidden axis, the two scalars, the components along the two directions across; nothing in the last two places. */
#define GB_SIX_FUNCTIONS 16

/* By product, its coefficients in the functions. */
typedef struct {
    gb_real at[GB_SIX_PRODUCTS][GB_SIX_FUNCTIONS];
} gb_six_profile;

GB_INLINE void gb_six_functions(const gb_six_figure *hidden, const gb_real across[2][3], const gb_six_figure *figure, gb_real *values)
{
    const gb_real *l = figure->direction;
    gb_real vectors[4][3], p[3];
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        p[i] = figure->point[i] - hidden->point[i];
        vectors[1][i] = l[i];
    }
    gb_six_cross(p, l, vectors[2]);
    if (figure->slides) {
        gb_six_cross(l, figure->side, vectors[3]);
        memcpy(vectors[0], figure->side, sizeof vectors[0]);
        values[4] = gb_six_dot(p, figure->side);
        values[5] = gb_six_dot(p, vectors[3]);
    } else {
        const gb_real square = gb_six_dot(p, p), along = gb_six_dot(p, l);
        GB_UNROLL
        for (int i = 0; i < 3; i++) {
            vectors[0][i] = p[i];
            vectors[3][i] = l[i] * square - p[i] * (along + along);
        }
        values[4] = square;
        values[5] = along;
    }
    GB_UNROLL
    for (int k = 0; k < 4; k++) {
        values[k] = gb_six_dot(hidden->direction, vectors[k]);
        values[GB_SIX_STILL + k] = gb_six_dot(across[0], vectors[k]);
        values[GB_SIX_STILL + 4 + k] = gb_six_dot(across[1], vectors[k]);
    }
    values[14] = values[15] = R(0.0);
}

/* The functions of a figure that the axis `second` moves first and then the axis `first`. */
static void gb_six_make_profile(const gb_six_figure *hidden, const gb_real across[2][3], const gb_six_figure *first, const gb_six_figure *second,
                                const gb_six_figure *figure, gb_six_profile *profile)
{
    gb_real table[3][3][GB_SIX_FUNCTIONS];
    for (int j = 0; j < 3; j++) {
        const gb_six_figure inner = gb_six_moved_by(figure, second, gb_six_samples[second->slides ? 1 : 0][j]);
        GB_UNROLL
        for (int i = 0; i < 3; i++) {
            const gb_six_figure outer = gb_six_moved_by(&inner, first, gb_six_samples[first->slides ? 1 : 0][i]);
            gb_six_functions(hidden, across, &outer, table[i][j]);
        }
    }
    for (size_t at = 0; at < GB_SIX_FUNCTIONS; at += GB_SIX_LANES) {
        gb_six_lanes by_second[3][3], by_first[3];
        GB_UNROLL
        for (int i = 0; i < 3; i++) {
            gb_six_coefficients(second->slides, gb_six_load(table[i][0] + at), gb_six_load(table[i][1] + at), gb_six_load(table[i][2] + at), by_second[i]);
        }
        GB_UNROLL
        for (int k = 0; k < 3; k++) {
            gb_six_coefficients(first->slides, by_second[0][k], by_second[1][k], by_second[2][k], by_first);
            GB_UNROLL
            for (int i = 0; i < 3; i++) {
                gb_six_store(profile->at[3 * i + k] + at, by_first[i]);
            }
        }
    }
}

/* ---- The equations: rows.rs and reduce.rs ---- */

/* The coefficients of the near products, 1 among them, and of the far ones; nothing in the last three places. */
#define GB_SIX_ROW 20
typedef struct {
    gb_real at[GB_SIX_ROW];
} gb_six_row;

/* The equations still = 0 and constant - x linear = 0 with x the tangent of half the hidden angle, or half the way; after elimination in the near products
 * and the far ones that are left. The first `solved` of the still ones each give one far product, the others are left as they are. */
typedef struct {
    gb_six_row still[GB_SIX_STILL];
    gb_six_row constant[GB_SIX_MOVING];
    gb_six_row linear[GB_SIX_MOVING];
    size_t solved;
    /* The far columns: those that are solved for come first, in the order of their equations. */
    size_t order[GB_SIX_FAR];
} gb_six_equations;

/* The functions that a slide leaves alone: l, the component of p x l along the axis, those of p across it. The same of the functions a, l, p x l, l x a, p.a
 * and p.(l x a), for a fourth joint that slides: ten stay. */
static const unsigned char gb_six_unmoved[2][GB_SIX_STILL] = {{1, 7, 11, 2, 6, 10}, {0, 1, 2, 3, 6, 7}};
/* The other functions, and which multiple of which function -N makes of each, or the constant -2: N p = w, N (p x l) = w x l,
 * N ((p.p) l - 2 (p.l) p) = -2 w x (p x l) - 2 (p.l) w, N (p.p) = 2 p.w, N (p.l) = l.w. In the second case N (p.a) = w.a, N (p.(l x a)) = w.(l x a), and
 * four of those that stay stand among the moving ones: r = 0 and s = 0 as s - x r = 0 and -r - x s = 0, which say the same for all x but i and -i. */
static const unsigned char gb_six_sliding[2][GB_SIX_MOVING] = {{0, 8, 12, 3, 9, 13, 4, 5}, {10, 9, 13, 11, 8, 12, 4, 5}};
static const unsigned char gb_six_images[2][GB_SIX_MOVING] = {{0, 11, 7, 5, 12, 8, 0, 1}, {9, 10, 11, 13, 11, 7, 0, 3}};
static const gb_real gb_six_factors[2][GB_SIX_MOVING] = {
    {R(0.0), R(1.0), R(-1.0), R(2.0), R(-2.0), R(2.0), R(-2.0), R(-1.0)},
    {R(1.0), R(-1.0), R(1.0), R(-1.0), R(1.0), R(-1.0), R(-1.0), R(-1.0)},
};

/* factor (a + sign b) in both sides' products, whose 1 is the same; a and b the functions of these numbers. */
GB_INLINE void gb_six_combine(const gb_six_profile *near, const gb_six_profile *far, size_t function, gb_real sign, gb_real factor, gb_six_row *row)
{
    row->at[0] = factor * (near->at[0][function] + sign * far->at[0][function]);
    GB_UNROLL
    for (size_t k = 1; k < GB_SIX_PRODUCTS; k++) {
        row->at[k] = factor * near->at[k][function];
        row->at[GB_SIX_FAR + k] = factor * (sign * far->at[k][function]);
    }
    GB_UNROLL
    for (size_t k = GB_SIX_COLUMNS; k < GB_SIX_ROW; k++) {
        row->at[k] = R(0.0);
    }
}

/* The hidden joint turns: the vectors across its axis w fulfil Rodrigues' equation b - a = x w x (a + b). */
static void gb_six_turn_rows(const gb_six_profile *near, const gb_six_profile *far, gb_six_equations *rows)
{
    for (size_t k = 0; k < GB_SIX_STILL; k++) {
        gb_six_combine(near, far, k, R(-1.0), R(1.0), &rows->still[k]);
    }
    for (size_t k = 0; k < GB_SIX_MOVING; k++) {
        gb_six_combine(near, far, GB_SIX_STILL + k, R(-1.0), R(1.0), &rows->constant[k]);
        gb_six_combine(near, far, k < 4 ? GB_SIX_STILL + 4 + k : GB_SIX_STILL - 4 + k, R(1.0), k < 4 ? R(1.0) : R(-1.0), &rows->linear[k]);
    }
}

/* The hidden joint slides by 2 x w: this is exp(2 x N) with N^3 = 0, so that b - a = x N (a + b) for all fourteen functions. */
static void gb_six_slide_rows(const gb_six_profile *near, const gb_six_profile *far, bool is_directed, gb_six_equations *rows)
{
    const int kind = is_directed ? 1 : 0;
    for (size_t k = 0; k < GB_SIX_STILL; k++) {
        gb_six_combine(near, far, gb_six_unmoved[kind][k], R(-1.0), R(1.0), &rows->still[k]);
    }
    for (size_t k = 0; k < GB_SIX_MOVING; k++) {
        const bool is_paired = is_directed && k < 4;
        const gb_real factor = gb_six_factors[kind][k];
        gb_six_combine(near, far, gb_six_sliding[kind][k], R(-1.0), is_paired ? factor : R(1.0), &rows->constant[k]);
        gb_six_combine(near, far, gb_six_images[kind][k], is_paired ? R(-1.0) : R(1.0), is_paired ? R(1.0) : factor, &rows->linear[k]);
        if (factor == R(0.0)) {
            memset(&rows->linear[k], 0, sizeof rows->linear[k]);
            rows->linear[k].at[0] = R(-2.0);
        }
    }
}

/* The equation and the place in the order of the columns with the largest share of its equation's size; false where all are small. */
static bool gb_six_find_still(const gb_six_equations *rows, size_t *row_of, size_t *place_of)
{
    gb_real best = GB_SIX_WEAK;
    bool is_found = false;
    for (size_t row = rows->solved; row < GB_SIX_STILL; row++) {
        const gb_real *still = rows->still[row].at, inverse = R(1.0) / gb_six_largest(GB_LEAST_POSITIVE, still, GB_SIX_ROW);
        for (size_t place = rows->solved; place < GB_SIX_FAR; place++) {
            const gb_real share = gb_magnitude(still[rows->order[place]]) * inverse;
            if (share > best) {
                best = share;
                *row_of = row;
                *place_of = place;
                is_found = true;
            }
        }
    }
    return is_found;
}

/* Takes a column, in which `pivot` is one, out of a row. */
GB_INLINE void gb_six_clear(gb_real *row, const gb_real *pivot, size_t column, size_t count)
{
    gb_six_subtract(row, row[column], pivot, 0, count);
    row[column] = R(0.0);
}

/* Solves a still equation for the column at a place, and takes it out of all others. */
static void gb_six_eliminate_still(gb_six_equations *rows, size_t row, size_t place)
{
    const size_t index = rows->solved, column = rows->order[place];
    gb_six_row pivot = rows->still[row];
    rows->still[row] = rows->still[index];
    rows->order[place] = rows->order[index];
    rows->order[index] = column;
    const gb_real inverse = R(1.0) / pivot.at[column];
    for (size_t i = 0; i < GB_SIX_ROW; i++) {
        pivot.at[i] *= inverse;
    }
    rows->still[index] = pivot;
    for (size_t k = 0; k < GB_SIX_STILL; k++) {
        if (k != index) {
            gb_six_clear(rows->still[k].at, pivot.at, column, GB_SIX_ROW);
        }
    }
    for (size_t k = 0; k < GB_SIX_MOVING; k++) {
        gb_six_clear(rows->constant[k].at, pivot.at, column, GB_SIX_ROW);
        gb_six_clear(rows->linear[k].at, pivot.at, column, GB_SIX_ROW);
    }
    rows->solved++;
}

/* The equations of a formulation, the still ones solved for as many far products as they determine well, by complete pivoting. */
static void gb_six_equate(const gb_chain *chain, gb_formulation formulation, const gb_rigid *displacement, gb_six_equations *rows)
{
    const gb_six_figure hidden = gb_six_figure_of(chain, formulation.hidden);
    gb_six_figure near[3], far[3];
    gb_six_profile moved, reached;
    size_t row = 0, place = 0;
    for (size_t k = 0; k < 3; k++) {
        near[k] = gb_six_place(chain, formulation, 1 + k, true, displacement);
        far[k] = gb_six_place(chain, formulation, 5 - k, false, displacement);
    }
    gb_six_make_profile(&hidden, chain->across[formulation.hidden], &near[0], &near[1], &near[2], &moved);
    gb_six_make_profile(&hidden, chain->across[formulation.hidden], &far[0], &far[1], &far[2], &reached);
    if (hidden.slides) {
        gb_six_slide_rows(&moved, &reached, near[2].slides, rows);
    } else {
        gb_six_turn_rows(&moved, &reached, rows);
    }
    rows->solved = 0;
    for (size_t k = 0; k < GB_SIX_FAR; k++) {
        rows->order[k] = GB_SIX_PRODUCTS + k;
    }
    while (rows->solved < GB_SIX_STILL && gb_six_find_still(rows, &row, &place)) {
        gb_six_eliminate_still(rows, row, place);
    }
}

/* ---- The eigenvalue problem (A - x B) v = 0 with sixteen rows and columns: pencil.rs ----
 *
 * Each equation is multiplied by the cosine and by the sine of half of one near joint's angle. In the homogeneous monomials of half that angle (four of
 * degree three instead of three of degree two) there are then as many equations as products, and half a turn is a point like any other. */

typedef struct {
    gb_real at[GB_SIX_ALL];
} gb_six_wide;

typedef struct {
    gb_real at[GB_SIX_SIZE][GB_SIX_SIZE];
} gb_six_matrix;

/* The pencil, and how its unknowns are found in it. */
typedef struct {
    /* A and B. */
    gb_six_matrix constant;
    gb_six_matrix linear;
    /* The columns that are left, as places in all columns. */
    size_t kept[GB_SIX_SIZE];
    /* What was solved for: a column, and its equation. */
    size_t column[GB_SIX_SOLVED];
    gb_six_wide solved[GB_SIX_SOLVED];
    size_t count;
} gb_six_pencil;

/* A row times the cosine (`power` 0) or the sine (`power` 1) of the half angle: 1 = C^2 + S^2, c = C^2 - S^2, s = 2 C S; for a joint that slides, 1 = C^2,
 * d = C S, d^2 = S^2. */
GB_INLINE void gb_six_multiply(const gb_six_row *row, const gb_six_equations *rows, bool second, bool slides, size_t power, gb_real *wide, size_t count)
{
    const size_t step = second ? 1 : 3, other = second ? 3 : 1, left = GB_SIX_FAR - rows->solved;
    memset(wide, 0, count * sizeof *wide);
    GB_UNROLL
    for (size_t k = 0; k < 3; k++) {
        const gb_real one = row->at[k * other], even = row->at[k * other + step], odd = row->at[k * other + 2 * step];
        wide[3 * power + k] = slides ? one : one + even;
        wide[3 * (1 + power) + k] = slides ? odd : odd + odd;
        wide[3 * (2 + power) + k] = slides ? even : one - even;
    }
    for (size_t k = 0; k < left; k++) {
        wide[GB_SIX_NEAR + power * left + k] = row->at[rows->order[rows->solved + k]];
    }
}

/* The place of the largest entry from a row on; false when all are zero or one is not finite. */
static bool gb_six_find_wide(const gb_six_pencil *pencil, size_t first, size_t *row_of, size_t *column_of)
{
    gb_real most = R(0.0);
    for (size_t row = first; row < pencil->count; row++) {
        for (size_t column = 0; column < GB_SIX_ALL; column++) {
            const gb_real entry = gb_magnitude(pencil->solved[row].at[column]);
            if (entry > most) {
                most = entry;
                *row_of = row;
                *column_of = column;
            }
        }
    }
    return most > R(0.0) && gb_six_is_finite(most);
}

/* Solves the still equations that are left, each for its largest column, and takes these columns out of all others. */
static bool gb_six_eliminate_wide(gb_six_pencil *pencil, gb_six_wide *constant, gb_six_wide *linear)
{
    for (size_t index = 0; index < pencil->count; index++) {
        size_t row = 0, column = 0;
        if (!gb_six_find_wide(pencil, index, &row, &column)) {
            return false;
        }
        gb_six_wide pivot = pencil->solved[row];
        pencil->solved[row] = pencil->solved[index];
        const gb_real inverse = R(1.0) / pivot.at[column];
        for (size_t i = 0; i < GB_SIX_ALL; i++) {
            pivot.at[i] *= inverse;
        }
        pencil->solved[index] = pivot;
        pencil->column[index] = column;
        for (size_t k = 0; k < pencil->count; k++) {
            if (k != index) {
                gb_six_clear(pencil->solved[k].at, pivot.at, column, GB_SIX_ALL);
            }
        }
        for (size_t k = 0; k < GB_SIX_SIZE; k++) {
            gb_six_clear(constant[k].at, pivot.at, column, GB_SIX_ALL);
            gb_six_clear(linear[k].at, pivot.at, column, GB_SIX_ALL);
        }
    }
    return true;
}

/* The columns that are kept. */
static void gb_six_keep_columns(gb_six_pencil *pencil)
{
    size_t kept = 0;
    for (size_t column = 0; column < GB_SIX_SIZE + pencil->count; column++) {
        bool is_solved = false;
        for (size_t k = 0; k < pencil->count; k++) {
            is_solved |= pencil->column[k] == column;
        }
        if (!is_solved && kept < GB_SIX_SIZE) {
            pencil->kept[kept++] = column;
        }
    }
}

/* The pencil where some still equations did not determine far products; false when a column is left that no equation determines. */
static GB_APART bool gb_six_make_narrowed(const gb_six_equations *rows, bool second, bool slides, gb_six_pencil *pencil)
{
    gb_six_wide constant[GB_SIX_SIZE], linear[GB_SIX_SIZE];
    for (size_t k = 0; k < GB_SIX_SIZE; k++) {
        gb_six_multiply(&rows->constant[k % GB_SIX_MOVING], rows, second, slides, k / GB_SIX_MOVING, constant[k].at, GB_SIX_ALL);
        gb_six_multiply(&rows->linear[k % GB_SIX_MOVING], rows, second, slides, k / GB_SIX_MOVING, linear[k].at, GB_SIX_ALL);
    }
    pencil->count = 2 * (GB_SIX_STILL - rows->solved);
    for (size_t k = 0; k < pencil->count; k++) {
        gb_six_multiply(&rows->still[rows->solved + k / 2], rows, second, slides, k % 2, pencil->solved[k].at, GB_SIX_ALL);
    }
    if (!gb_six_eliminate_wide(pencil, constant, linear)) {
        return false;
    }
    gb_six_keep_columns(pencil);
    for (size_t i = 0; i < GB_SIX_SIZE; i++) {
        for (size_t j = 0; j < GB_SIX_SIZE; j++) {
            pencil->constant.at[i][j] = constant[i].at[pencil->kept[j]];
            pencil->linear.at[i][j] = linear[i].at[pencil->kept[j]];
        }
    }
    return true;
}

/* The pencil of reduced equations; false when a column is left that no equation determines. */
static bool gb_six_make_pencil(const gb_six_equations *rows, bool second, bool slides, gb_six_pencil *pencil)
{
    if (rows->solved < GB_SIX_STILL) {
        return gb_six_make_narrowed(rows, second, slides, pencil);
    }
    pencil->count = 0;
    for (size_t k = 0; k < GB_SIX_SIZE; k++) {
        pencil->kept[k] = k;
        gb_six_multiply(&rows->constant[k % GB_SIX_MOVING], rows, second, slides, k / GB_SIX_MOVING, pencil->constant.at[k], GB_SIX_SIZE);
        gb_six_multiply(&rows->linear[k % GB_SIX_MOVING], rows, second, slides, k / GB_SIX_MOVING, pencil->linear.at[k], GB_SIX_SIZE);
    }
    return true;
}

/* The values of all columns. */
static void gb_six_widen(const gb_six_pencil *pencil, const gb_real *vector, gb_six_wide *wide)
{
    memset(wide, 0, sizeof *wide);
    for (size_t k = 0; k < GB_SIX_SIZE; k++) {
        wide->at[pencil->kept[k]] = vector[k];
    }
    const gb_six_wide known = *wide;
    for (size_t k = 0; k < pencil->count; k++) {
        wide->at[pencil->column[k]] = -gb_six_product(pencil->solved[k].at, known.at, GB_SIX_ALL);
    }
}

/* ---- Dense linear equations of fixed size by Gauss elimination with partial pivoting (Golub and Van Loan, Algorithm 3.4.1): linear.rs ---- */

/* The row from `k` on with the largest entry in column `k`. */
GB_INLINE size_t gb_six_pivot(const gb_real *rows, size_t k, size_t size, size_t width)
{
    size_t best = k;
    gb_real most = gb_magnitude(rows[k * width + k]);
    for (size_t row = k + 1; row < size; row++) {
        const gb_real entry = gb_magnitude(rows[row * width + k]);
        best = entry > most ? row : best;
        most = gb_larger(most, entry);
    }
    return best;
}

GB_INLINE void gb_six_exchange(gb_real *a, gb_real *b, size_t count)
{
    for (size_t i = 0; i < count; i += GB_SIX_LANES) {
        const gb_six_lanes entries = gb_six_load(a + i);
        gb_six_store(a + i, gb_six_load(b + i));
        gb_six_store(b + i, entries);
    }
}

/* Solves L X = R in place, with the `size` columns of L and then those of R in `rows`, `width` altogether, which fill whole registers: R becomes X, L is used
 * up. The smallest pivot as a share of the largest entry of L; zero when L is singular or not finite, and R means nothing then. */
GB_INLINE gb_real gb_six_solve(gb_real *rows, size_t size, size_t width, gb_real largest)
{
    gb_real least = largest, inverses[GB_SIX_SIZE];
    for (size_t k = 0; k < size; k++) {
        gb_real *pivot = rows + k * width;
        const size_t best = gb_six_pivot(rows, k, size, width);
        const gb_real most = gb_magnitude(rows[best * width + k]);
        if (most <= R(0.0) || !gb_six_is_finite(most)) {
            return R(0.0);
        }
        least = gb_smaller(least, most);
        gb_six_exchange(pivot, rows + best * width, width);
        inverses[k] = R(1.0) / pivot[k];
        for (gb_real *row = pivot + width; row < rows + size * width; row += width) {
            gb_six_subtract(row, row[k] * inverses[k], pivot, (k + 1) / GB_SIX_LANES * GB_SIX_LANES, width);
        }
    }
    for (size_t k = size; k-- > 0;) {
        gb_real *pivot = rows + k * width;
        for (size_t i = size; i < width; i++) {
            pivot[i] *= inverses[k];
        }
        for (gb_real *row = rows; row < pivot; row += width) {
            for (size_t i = size; i < width; i++) {
                row[i] -= row[k] * pivot[i];
            }
        }
    }
    return least / largest;
}

/* B^-1 A for an origin of the half angle; how well B was inverted. */
static gb_real gb_six_invert(const gb_six_pencil *pencil, gb_real origin, gb_real rows[GB_SIX_SIZE][2 * GB_SIX_SIZE])
{
    const gb_six_lanes c = gb_six_of(gb_cosine(origin)), s = gb_six_of(gb_sine(origin));
    gb_real largest = R(0.0);
    for (size_t i = 0; i < GB_SIX_SIZE; i++) {
        for (size_t j = 0; j < GB_SIX_SIZE; j += GB_SIX_LANES) {
            const gb_six_lanes a = gb_six_load(pencil->constant.at[i] + j), b = gb_six_load(pencil->linear.at[i] + j);
            gb_six_store(rows[i] + j, s * a + c * b);
            gb_six_store(rows[i] + GB_SIX_SIZE + j, c * a - s * b);
        }
        largest = gb_six_largest(largest, rows[i], GB_SIX_SIZE);
    }
    return gb_six_solve(rows[0], GB_SIX_SIZE, 2 * GB_SIX_SIZE, largest);
}

/* The matrix of the first origin whose B can be inverted well, or of the best one, and that origin; how well it was inverted, zero where no one could be. */
static gb_real gb_six_standardise(const gb_six_pencil *pencil, size_t attempt, gb_six_matrix *matrix, gb_real *origin)
{
    gb_real conditioning = R(0.0), rows[GB_SIX_SIZE][2 * GB_SIX_SIZE];
    for (size_t index = 0; index < GB_SIX_ORIGINS && !(conditioning >= GB_SIX_SOUND_ORIGIN); index++) {
        const gb_real other = gb_six_origins[(attempt + index) % GB_SIX_ORIGINS], share = gb_six_invert(pencil, other, rows);
        if (share > conditioning) {
            conditioning = share;
            *origin = other;
            for (size_t i = 0; i < GB_SIX_SIZE; i++) {
                memcpy(matrix->at[i], rows[i] + GB_SIX_SIZE, sizeof matrix->at[i]);
            }
        }
    }
    return conditioning;
}

/* ---- The reduction of a matrix to Hessenberg form by Householder reflections (Golub and Van Loan, Algorithm 7.4.2): hessenberg.rs ---- */

/* A = Q H Q^T with H zero below its first subdiagonal and Q orthogonal. */
typedef struct {
    /* H, by rows. */
    gb_six_matrix matrix;
    /* Q = P_0 P_1 ... with P_k = 1 - v v^T: row k is v, of length sqrt(2), or zero where nothing was to be done. */
    gb_six_matrix reflectors;
} gb_six_hessenberg;

/* The scalar product of columns from `first` on, which begins a group of four, in four partial sums that do not wait for one another. */
GB_INLINE gb_real gb_six_long_dot(const gb_real *a, const gb_real *b, size_t first)
{
    gb_real sums[4] = {R(0.0), R(0.0), R(0.0), R(0.0)};
    GB_UNROLL
    for (int lane = 0; lane < 4; lane += GB_SIX_LANES) {
        gb_six_lanes sum = gb_six_load(sums + lane);
        for (size_t i = first + (size_t)lane; i < GB_SIX_SIZE; i += 4) {
            sum = sum + gb_six_load(a + i) * gb_six_load(b + i);
        }
        gb_six_store(sums + lane, sum);
    }
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/* The vector v, of length sqrt(2), whose reflection makes zeros of what stands below the subdiagonal in a column; false where nothing is to be done. */
static bool gb_six_reflector(const gb_six_matrix *h, size_t column, gb_real *v)
{
    for (size_t k = 0; k < GB_SIX_SIZE; k++) {
        v[k] = k > column ? h->at[k][column] : R(0.0);
    }
    const gb_real square = gb_six_long_dot(v, v, 0), head = v[column + 1];
    if (square - head * head <= R(0.0)) {
        return false;
    }
    v[column + 1] += gb_signed(gb_square_root(square), head);
    const gb_real scale = gb_square_root(R(2.0) / gb_six_long_dot(v, v, 0));
    for (size_t k = 0; k < GB_SIX_SIZE; k++) {
        v[k] *= scale;
    }
    return gb_six_is_finite(scale);
}

/* The sum of rows behind `column`, each times its number in v, in a group of four columns. */
GB_INLINE void gb_six_sum_rows(const gb_six_matrix *h, const gb_real *v, size_t column, size_t group, gb_real *sum)
{
    gb_six_lanes sums[4 / GB_SIX_LANES];
    GB_UNROLL
    for (int part = 0; part < 4 / GB_SIX_LANES; part++) {
        sums[part] = gb_six_of(R(0.0));
    }
    for (size_t row = column + 1; row < GB_SIX_SIZE; row++) {
        GB_UNROLL
        for (int part = 0; part < 4 / GB_SIX_LANES; part++) {
            sums[part] = sums[part] + v[row] * gb_six_load(h->at[row] + group + part * GB_SIX_LANES);
        }
    }
    memcpy(sum + group, sums, sizeof sums);
}

/* H := P H P, from the left to rows and from the right to columns from `column + 1` on. In groups of four columns the first of which begins at `column` or
 * before: there only `column` itself changes, for all before it is zero. */
GB_INLINE void gb_six_reflect(gb_six_matrix *h, const gb_real *v, size_t column)
{
    const size_t first = column / 4 * 4, behind = (column + 1) / 4 * 4;
    gb_real sum[GB_SIX_SIZE];
    for (size_t i = first; i < GB_SIX_SIZE; i += 4) {
        gb_six_sum_rows(h, v, column, i, sum);
    }
    for (size_t row = 0; row < GB_SIX_SIZE; row++) {
        if (v[row] != R(0.0)) {
            gb_six_subtract(h->at[row], v[row], sum, first, GB_SIX_SIZE);
        }
        gb_six_subtract(h->at[row], gb_six_long_dot(h->at[row], v, behind), v, behind, GB_SIX_SIZE);
    }
    for (size_t row = column + 2; row < GB_SIX_SIZE; row++) {
        h->at[row][column] = R(0.0);
    }
}

/* Reduces the matrix. */
static void gb_six_reduce(gb_six_hessenberg *form)
{
    memset(&form->reflectors, 0, sizeof form->reflectors);
    for (size_t column = 0; column < GB_SIX_SIZE - 2; column++) {
        gb_real v[GB_SIX_SIZE];
        if (gb_six_reflector(&form->matrix, column, v)) {
            gb_six_reflect(&form->matrix, v, column);
            memcpy(form->reflectors.at[column], v, sizeof v);
        }
    }
}

/* ---- All eigenvalues of a Hessenberg matrix by implicit double-shift QR steps (Golub and Van Loan, Algorithms 7.5.1 and 7.5.2): shifted_qr.rs ----
 *
 * The eigenvalues only: rows and columns outside the block that is being reduced are left alone. (J. G. F. Francis, The QR transformation, Computer Journal 4
 * (1961/62) 265-271 and 332-345.) */

/* An eigenvalue of a real matrix; im is exactly zero when it is real. */
typedef struct {
    gb_real re;
    gb_real im;
} gb_six_eigenvalue;

/* The first row of the lowest block that does not fall apart, which ends at row `high`; a negligible subdiagonal entry becomes zero. */
GB_INLINE size_t gb_six_start_of_block(gb_six_matrix *h, size_t high)
{
    for (size_t row = high; row > 0; row--) {
        const gb_real entry = gb_magnitude(h->at[row][row - 1]);
        const gb_real size = gb_magnitude(h->at[row][row]) + gb_magnitude(h->at[row - 1][row - 1]);
        if (entry <= GB_EPSILON * size || entry < GB_LEAST_POSITIVE) {
            h->at[row][row - 1] = R(0.0);
            return row;
        }
    }
    return 0;
}

/* The eigenvalues of the 2x2 block whose first row is `low`, without cancellation. */
static void gb_six_pair(const gb_six_matrix *h, size_t low, gb_six_eigenvalue *pair)
{
    const gb_real a = h->at[low][low], b = h->at[low][low + 1], c = h->at[low + 1][low], d = h->at[low + 1][low + 1];
    const gb_real half = R(0.5) * (a - d), discriminant = half * half + b * c;
    if (discriminant < R(0.0)) {
        pair[0].re = pair[1].re = R(0.5) * (a + d);
        pair[0].im = gb_square_root(-discriminant);
        pair[1].im = -pair[0].im;
        return;
    }
    const gb_real way = half + gb_signed(gb_square_root(discriminant), half);
    pair[0].re = d + way;
    pair[1].re = way == R(0.0) ? d : d - b * c / way;
    pair[0].im = pair[1].im = R(0.0);
}

/* The first column of (H - a)(H - b) for two shifts, as far as it is not zero. They are the eigenvalues of the last 2x2 block, or numbers of the size of the
 * last subdiagonal entries. */
GB_INLINE void gb_six_first_column(const gb_six_matrix *h, size_t low, size_t high, bool is_exceptional, gb_real *column)
{
    const size_t m = high, i = low;
    gb_real sum = h->at[m - 1][m - 1] + h->at[m][m];
    gb_real product = h->at[m - 1][m - 1] * h->at[m][m] - h->at[m - 1][m] * h->at[m][m - 1];
    if (is_exceptional) {
        const gb_real size = gb_magnitude(h->at[m][m - 1]) + gb_magnitude(h->at[m - 1][m - 2]), centre = h->at[m][m] + R(0.75) * size;
        sum = R(2.0) * centre;
        product = centre * centre + R(0.4375) * size * size;
    }
    column[0] = h->at[i][i] * (h->at[i][i] - sum) + product + h->at[i][i + 1] * h->at[i + 1][i];
    column[1] = h->at[i + 1][i] * (h->at[i][i] + h->at[i + 1][i + 1] - sum);
    column[2] = h->at[i + 1][i] * h->at[i + 2][i + 1];
}

/* Rows from `top` on reflected, `count` of them: by 1 - u w^T. Columns in groups of four, for it is no matter what happens to those behind the block, and
 * those before `top` are set. */
GB_INLINE void gb_six_reflect_rows(gb_six_matrix *h, size_t high, size_t top, size_t count, const gb_real *u, const gb_real *w)
{
    gb_real *first = h->at[top], *second = h->at[top + 1], *third = h->at[top + count - 1];
    for (size_t i = top / 4 * 4; i <= high; i += GB_SIX_LANES) {
        const gb_six_lanes x = gb_six_load(first + i), y = gb_six_load(second + i), z = gb_six_load(third + i);
        const gb_six_lanes share = count == 3 ? w[0] * x + w[1] * y + w[2] * z : w[0] * x + w[1] * y;
        gb_six_store(first + i, x - share);
        gb_six_store(second + i, y - share * u[1]);
        if (count == 3) {
            gb_six_store(third + i, z - share * u[2]);
        }
    }
}

/* The same of columns. */
GB_INLINE void gb_six_reflect_columns(gb_six_matrix *h, size_t low, size_t high, size_t top, size_t count, const gb_real *u, const gb_real *w)
{
    const size_t last = top + 3 < high ? top + 3 : high;
    for (size_t row = low; row <= last; row++) {
        gb_real *entries = h->at[row] + top;
        const gb_real x = entries[0], y = entries[1], z = entries[count - 1];
        const gb_real share = count == 3 ? w[0] * x + w[1] * y + w[2] * z : w[0] * x + w[1] * y;
        entries[0] = x - share;
        entries[1] = y - share * u[1];
        if (count == 3) {
            entries[2] = z - share * u[2];
        }
    }
}

/* Reflects rows and columns from `top` on, two or three, so that `column`, which stands left of them, becomes a multiple of its first unit vector: by
 * 1 - u w^T with u that begins with one and w a multiple of it. */
GB_INLINE void gb_six_chase(gb_six_matrix *h, size_t low, size_t high, size_t top, size_t count, const gb_real *column)
{
    const gb_real square = gb_six_product(column, column, count), length = gb_signed(gb_square_root(square), column[0]);
    if (square >= GB_SIX_FAINT) {
        const gb_real head = column[0] + length, share = R(1.0) + column[0] / length;
        gb_real u[3] = {R(1.0), R(0.0), R(0.0)}, w[3] = {share, R(0.0), R(0.0)};
        for (size_t k = 1; k < count; k++) {
            u[k] = column[k] / head;
            w[k] = u[k] * share;
        }
        gb_six_reflect_rows(h, high, top, count, u, w);
        gb_six_reflect_columns(h, low, high, top, count, u, w);
    }
    if (top > low) {
        h->at[top][top - 1] = -length;
        for (size_t k = 1; k < count; k++) {
            h->at[top + k][top - 1] = R(0.0);
        }
    }
}

/* One double step on rows and columns `low` to `high`: the bulge that the shifts make at the top is chased out at the bottom. */
static void gb_six_step(gb_six_matrix *h, size_t low, size_t high, bool is_exceptional)
{
    gb_real column[3];
    gb_six_first_column(h, low, high, is_exceptional, column);
    for (size_t top = low; top + 1 < high; top++) {
        for (size_t k = 0; k < 3 && top > low; k++) {
            column[k] = h->at[top + k][top - 1];
        }
        gb_six_chase(h, low, high, top, 3, column);
    }
    column[0] = h->at[high - 1][high - 2];
    column[1] = h->at[high][high - 2];
    gb_six_chase(h, low, high, high - 1, 2, column);
}

/* All eigenvalues, complex ones in conjugate pairs; false when an entry is not finite or the iteration does not end, which is not known to happen. */
static bool gb_six_eigenvalues(const gb_six_hessenberg *form, gb_six_eigenvalue *found)
{
    gb_six_matrix h = form->matrix;
    size_t left = GB_SIX_SIZE, steps = 0;
    bool is_finite = true;
    while (left > 0) {
        const size_t low = gb_six_start_of_block(&h, left - 1);
        if (left - low > 2) {
            if (++steps > GB_SIX_QR_STEPS) {
                return false;
            }
            gb_six_step(&h, low, left - 1, steps % 10 == 0);
            continue;
        }
        if (left - low == 2) {
            gb_six_pair(&h, low, &found[low]);
        } else {
            found[low].re = h.at[low][low];
            found[low].im = R(0.0);
        }
        left = low;
        steps = 0;
    }
    for (int k = 0; k < GB_SIX_SIZE; k++) {
        is_finite = is_finite && gb_six_is_finite(found[k].re) && gb_six_is_finite(found[k].im);
    }
    return is_finite;
}

/* Whether two real eigenvalues are so close that their eigenvectors are not known. */
static bool gb_six_are_crowded(const gb_six_eigenvalue *values)
{
    for (int k = 1; k < GB_SIX_SIZE; k++) {
        const gb_six_eigenvalue a = values[k];
        for (int i = 0; i < k && a.im == R(0.0); i++) {
            const gb_six_eigenvalue b = values[i];
            if (b.im == R(0.0) && gb_magnitude(b.re - a.re) <= GB_SIX_CROWDED * (R(1.0) + b.re * b.re + a.re * a.re)) {
                return true;
            }
        }
    }
    return false;
}

/* ---- Eigenvectors of a Hessenberg matrix for known eigenvalues, several at once (Golub and Van Loan, section 7.6.1): inverse_iteration.rs ---- */

/* Registers of eigenvectors that are found at once, which do not wait for one another, and how many eigenvectors these are. */
#define GB_SIX_PARTS (GB_SIX_LANES < 4 ? 2 : 1)
#define GB_SIX_WIDTH (GB_SIX_PARTS * GB_SIX_LANES)

/* H - x after Gauss elimination of the subdiagonal with exchange of neighbouring rows. */
typedef struct {
    /* What is above the diagonal, by columns. */
    gb_six_lanes columns[GB_SIX_SIZE][GB_SIX_SIZE][GB_SIX_PARTS];
    /* One over the diagonal. */
    gb_six_lanes inverses[GB_SIX_SIZE][GB_SIX_PARTS];
    /* Whether a row and the next one were exchanged. */
    gb_six_bits exchanged[GB_SIX_SIZE][GB_SIX_PARTS];
    /* What multiple of the row was subtracted from the next one. */
    gb_six_lanes factors[GB_SIX_SIZE][GB_SIX_PARTS];
} gb_six_eliminated;

/* Exchanges two numbers where it is so. */
GB_INLINE void gb_six_exchange_where(gb_six_lanes *a, gb_six_lanes *b, gb_six_bits is_so)
{
    const gb_six_bits change = (gb_six_bits_of(*a) ^ gb_six_bits_of(*b)) & is_so;
    *a = gb_six_of_bits(gb_six_bits_of(*a) ^ change);
    *b = gb_six_of_bits(gb_six_bits_of(*b) ^ change);
}

/* One over a pivot. */
GB_INLINE gb_six_lanes gb_six_inverted(gb_six_lanes pivot, gb_six_lanes least)
{
    return R(1.0) / gb_six_pick(least, pivot, gb_six_exceeds(least, gb_six_abs(pivot)));
}

/* Eliminates, for one register of eigenvalues; pivots are at least a share of the largest entry. */
GB_INLINE void gb_six_eliminate(gb_six_eliminated *to, const gb_six_matrix *h, gb_real largest, gb_six_lanes x, int part)
{
    gb_six_lanes size = gb_six_of(largest), upper[GB_SIX_SIZE];
    for (int k = 0; k < GB_SIX_SIZE; k++) {
        size = gb_six_greater(size, gb_six_abs(h->at[k][k] - x));
        upper[k] = gb_six_of(h->at[0][k]);
    }
    const gb_six_lanes least = size * GB_EPSILON;
    upper[0] = upper[0] - x;
    for (int k = 0; k < GB_SIX_SIZE - 1; k++) {
        gb_six_lanes pivot = upper[k], other = gb_six_of(h->at[k + 1][k]);
        const gb_six_bits exchanged = gb_six_exceeds(gb_six_abs(other), gb_six_abs(pivot));
        gb_six_exchange_where(&pivot, &other, exchanged);
        const gb_six_lanes inverse = gb_six_inverted(pivot, least), factor = other * inverse;
        for (int j = k + 1; j < GB_SIX_SIZE; j++) {
            gb_six_lanes over = upper[j], below = j == k + 1 ? h->at[j][j] - x : gb_six_of(h->at[k + 1][j]);
            gb_six_exchange_where(&over, &below, exchanged);
            to->columns[j][k][part] = over;
            upper[j] = below - factor * over;
        }
        to->inverses[k][part] = inverse;
        to->exchanged[k][part] = exchanged;
        to->factors[k][part] = factor;
    }
    to->inverses[GB_SIX_SIZE - 1][part] = gb_six_inverted(upper[GB_SIX_SIZE - 1], least);
}

GB_INLINE void gb_six_forward(const gb_six_eliminated *to, gb_six_lanes y[GB_SIX_SIZE][GB_SIX_PARTS])
{
    for (int k = 0; k < GB_SIX_SIZE - 1; k++) {
        for (int part = 0; part < GB_SIX_PARTS; part++) {
            gb_six_lanes upper = y[k][part], lower = y[k + 1][part];
            gb_six_exchange_where(&upper, &lower, to->exchanged[k][part]);
            y[k][part] = upper;
            y[k + 1][part] = lower - to->factors[k][part] * upper;
        }
    }
}

GB_INLINE void gb_six_backward(const gb_six_eliminated *to, gb_six_lanes y[GB_SIX_SIZE][GB_SIX_PARTS])
{
    for (int k = GB_SIX_SIZE - 1; k >= 0; k--) {
        gb_six_lanes known[GB_SIX_PARTS];
        for (int part = 0; part < GB_SIX_PARTS; part++) {
            y[k][part] = known[part] = y[k][part] * to->inverses[k][part];
        }
        for (int row = 0; row < k; row++) {
            for (int part = 0; part < GB_SIX_PARTS; part++) {
                y[row][part] = y[row][part] - known[part] * to->columns[k][row][part];
            }
        }
    }
}

/* Inverse iteration. */
GB_INLINE void gb_six_iterate(const gb_six_eliminated *to, gb_six_lanes y[GB_SIX_SIZE][GB_SIX_PARTS])
{
    for (int round = 0; round < GB_SIX_ROUNDS; round++) {
        if (round > 0) {
            gb_six_forward(to, y);
        }
        gb_six_backward(to, y);
        for (int part = 0; part < GB_SIX_PARTS; part++) {
            gb_six_lanes largest = gb_six_of(GB_LEAST_POSITIVE);
            for (int k = 0; k < GB_SIX_SIZE; k++) {
                largest = gb_six_greater(largest, gb_six_abs(y[k][part]));
            }
            const gb_six_lanes inverse = R(1.0) / largest;
            for (int k = 0; k < GB_SIX_SIZE; k++) {
                y[k][part] = y[k][part] * inverse;
            }
        }
    }
}

/* Q y. */
GB_INLINE void gb_six_turn_back(const gb_six_hessenberg *form, gb_six_lanes y[GB_SIX_SIZE][GB_SIX_PARTS])
{
    for (int column = GB_SIX_SIZE - 3; column >= 0; column--) {
        const gb_real *v = form->reflectors.at[column];
        gb_six_lanes share[GB_SIX_PARTS];
        for (int part = 0; part < GB_SIX_PARTS; part++) {
            share[part] = gb_six_of(R(0.0));
        }
        for (int k = column + 1; k < GB_SIX_SIZE; k++) {
            for (int part = 0; part < GB_SIX_PARTS; part++) {
                share[part] = share[part] + v[k] * y[k][part];
            }
        }
        for (int k = column + 1; k < GB_SIX_SIZE; k++) {
            for (int part = 0; part < GB_SIX_PARTS; part++) {
                y[k][part] = y[k][part] - share[part] * v[k];
            }
        }
    }
}

/* Eigenvectors of A for the real parts of eigenvalues, of any length; not finite only when the matrix is not. */
static void gb_six_eigenvectors(const gb_six_hessenberg *form, const gb_six_eigenvalue *values, size_t count, gb_six_matrix *vectors)
{
    const gb_real largest = gb_six_largest(GB_LEAST_POSITIVE, form->matrix.at[0], GB_SIX_SIZE * GB_SIX_SIZE);
    gb_six_eliminated eliminated;
    for (size_t first = 0; first < count; first += GB_SIX_WIDTH) {
        gb_six_lanes y[GB_SIX_SIZE][GB_SIX_PARTS];
        gb_real x[GB_SIX_WIDTH];
        for (size_t lane = 0; lane < GB_SIX_WIDTH; lane++) {
            x[lane] = values[first + lane < count ? first + lane : count - 1].re;
        }
        for (int part = 0; part < GB_SIX_PARTS; part++) {
            gb_six_eliminate(&eliminated, &form->matrix, largest, gb_six_load(x + part * GB_SIX_LANES), part);
            for (int k = 0; k < GB_SIX_SIZE; k++) {
                y[k][part] = gb_six_of(R(1.0));
            }
        }
        gb_six_iterate(&eliminated, y);
        gb_six_turn_back(form, y);
        for (size_t k = 0; k < GB_SIX_SIZE; k++) {
            gb_real lanes[GB_SIX_WIDTH];
            memcpy(lanes, y[k], sizeof lanes);
            for (size_t lane = 0; lane < GB_SIX_WIDTH && first + lane < count; lane++) {
                vectors->at[first + lane][k] = lanes[lane];
            }
        }
    }
}

/* ---- From the pencil to joint angles: eigenvalues, eigenvectors, back-substitution: candidates.rs ---- */

/* The joint values of a candidate for a solution; that of the joint whose line was used is still missing, and a way may be infinite. */
typedef struct {
    gb_real q[6];
    /* The size of the eigenvalue's imaginary part as a share of 1 + |x|^2: half the way off the real line of the hidden angle. */
    gb_real depth;
} gb_six_candidate;

/* Candidates for solutions of one formulation. */
typedef struct {
    /* Those of real eigenvalues first. */
    gb_six_candidate list[GB_SIX_SIZE];
    size_t count;
    bool are_crowded;
    /* The smallest share of a pivot in the largest entry of the matrix that was inverted. */
    gb_real conditioning;
} gb_six_candidates;

/* Half of the doubled angle, and the products of the other near joint at the greatest monomial: multiples of 1, c, s. */
static gb_real gb_six_half_angle(const gb_real *wide, const gb_real **head)
{
    const gb_real first = gb_six_dot(wide, wide), last = gb_six_dot(wide + 9, wide + 9);
    *head = first >= last ? wide : wide + 9;
    return first >= last ? gb_six_turn(first, gb_six_dot(wide + 3, wide)) : gb_six_turn(gb_six_dot(wide + 6, wide + 9), last);
}

/* The products of the far joints; `head` is the first one of the doubled joint's monomials there. */
static void gb_six_far(const gb_six_equations *rows, const gb_real *wide, gb_real c, gb_real s, gb_real head, bool slides, const gb_real *near, gb_real *far)
{
    const gb_real over = gb_magnitude(c) >= gb_magnitude(s) ? head / (c * c * c) : head / (s * s * s), scale = slides ? over * (c * c) : over;
    const size_t left = GB_SIX_FAR - rows->solved;
    gb_real values[GB_SIX_COLUMNS] = {R(0.0)}, known[GB_SIX_COLUMNS];
    memcpy(values, near, GB_SIX_PRODUCTS * sizeof *values);
    for (size_t k = 0; k < left; k++) {
        values[rows->order[rows->solved + k]] = (c * wide[GB_SIX_NEAR + k] + s * wide[GB_SIX_NEAR + left + k]) / scale;
    }
    memcpy(known, values, sizeof known);
    for (size_t k = 0; k < rows->solved; k++) {
        values[rows->order[k]] = -gb_six_product(rows->still[k].at, known, GB_SIX_COLUMNS);
    }
    memcpy(far, values + GB_SIX_PRODUCTS, GB_SIX_FAR * sizeof *far);
}

/* 1, c, s of an angle, or 1, d^2, d of a way, times the same of another: the products of the near joints. */
static void gb_six_near(const bool *slides, const gb_real *values, gb_real *products)
{
    gb_real factors[2][3], angles[GB_SIX_PADDED(2)] = {R(0.0)}, c[GB_SIX_PADDED(2)], s[GB_SIX_PADDED(2)];
    angles[0] = values[0];
    angles[1] = values[1];
    gb_six_turns(angles, 2, c, s);
    for (int k = 0; k < 2; k++) {
        factors[k][0] = R(1.0);
        factors[k][1] = slides[k] ? values[k] * values[k] : c[k];
        factors[k][2] = slides[k] ? values[k] : s[k];
    }
    for (int k = 0; k < GB_SIX_PRODUCTS; k++) {
        products[k] = factors[0][k / 3] * factors[1][k % 3];
    }
}

/* The joint values, given half the hidden angle and its eigenvector. */
static void gb_six_read(const gb_chain *chain, gb_formulation formulation, const gb_six_equations *rows, const gb_six_pencil *pencil, gb_real hidden,
                        const gb_real *vector, gb_real *q)
{
    const size_t near = formulation.second ? 2 : 1, away = formulation.second ? 1 : 2;
    gb_real ordered[6], products[GB_SIX_PRODUCTS], far[GB_SIX_FAR], half[GB_SIX_PADDED(1)] = {R(0.0)}, c[GB_SIX_PADDED(1)], s[GB_SIX_PADDED(1)];
    const gb_real *head;
    gb_six_wide wide;
    bool slides[6];
    for (size_t steps = 0; steps < 6; steps++) {
        slides[steps] = chain->slides[gb_six_joint(formulation, steps)];
    }
    gb_six_widen(pencil, vector, &wide);
    half[0] = gb_six_half_angle(wide.at, &head);
    gb_six_turns(half, 1, c, s);
    const gb_real sign = gb_signed(R(1.0), head[0]);
    ordered[0] = slides[0] ? R(2.0) * (gb_sine(hidden) / gb_cosine(hidden)) : R(2.0) * hidden;
    ordered[away] = slides[away] ? head[2] / head[0] : gb_six_turn(head[1] * sign, head[2] * sign);
    ordered[near] = slides[near] ? s[0] / c[0] : R(2.0) * half[0];
    ordered[3] = R(0.0);
    gb_six_near(slides + 1, ordered + 1, products);
    gb_six_far(rows, wide.at, c[0], s[0], head[0], slides[near], products, far);
    ordered[4] = slides[4] ? -far[1] : -gb_six_turn(far[0], far[1]);
    ordered[5] = slides[5] ? -far[5] : -gb_six_turn(far[2], far[5]);
    for (size_t steps = 0; steps < 6; steps++) {
        q[gb_six_joint(formulation, steps)] = ordered[steps];
    }
}

/* The eigenvalues no farther off the real line than `deepest`, real ones first, how far off they are, and their number. */
static size_t gb_six_choose(const gb_six_eigenvalue *values, gb_real deepest, gb_six_eigenvalue *chosen, gb_six_candidate *list)
{
    size_t count = 0;
    for (int is_complex = 0; is_complex < 2; is_complex++) {
        for (int k = 0; k < GB_SIX_SIZE; k++) {
            const gb_real re = values[k].re, im = values[k].im, depth = gb_magnitude(im) / (R(1.0) + re * re + im * im);
            if ((im != R(0.0)) == (is_complex == 1) && depth <= deepest) {
                chosen[count] = values[k];
                list[count++].depth = depth;
            }
        }
    }
    return count;
}

/* Candidates at a displacement, of eigenvalues no farther off the real line than `deepest`; each attempt begins with another origin of the half angle. False
 * when the pencil is singular for this target, or not finite. */
static bool gb_six_find_candidates(const gb_chain *chain, const gb_rigid *displacement, size_t attempt, gb_real deepest, gb_six_candidates *found)
{
    const gb_formulation formulation = gb_six_formulation(chain, attempt);
    gb_six_equations rows;
    gb_six_pencil pencil;
    gb_six_hessenberg form;
    gb_six_matrix vectors;
    gb_six_eigenvalue values[GB_SIX_SIZE], chosen[GB_SIX_SIZE];
    gb_real origin = R(0.0);
    gb_six_equate(chain, formulation, displacement, &rows);
    if (!gb_six_make_pencil(&rows, formulation.second, chain->slides[gb_six_doubled(formulation)], &pencil)) {
        return false;
    }
    found->conditioning = gb_six_standardise(&pencil, attempt, &form.matrix, &origin);
    if (!(found->conditioning > R(0.0))) {
        return false;
    }
    gb_six_reduce(&form);
    if (!gb_six_eigenvalues(&form, values)) {
        return false;
    }
    found->count = gb_six_choose(values, deepest, chosen, found->list);
    found->are_crowded = gb_six_are_crowded(values);
    gb_six_eigenvectors(&form, chosen, found->count, &vectors);
    for (size_t k = 0; k < found->count; k++) {
        const gb_real half = origin + gb_angle(R(1.0), chosen[k].re + chosen[k].im);
        gb_six_read(chain, formulation, &rows, &pencil, half, vectors.at[k], found->list[k].q);
    }
    return true;
}

/* ---- Forward kinematics of the chain, and Newton steps on it: polish.rs ---- */

/* What a joint vector reaches. */
typedef struct {
    gb_real axes[6][3];
    gb_real origins[6][3];
    gb_rigid end;
} gb_six_reach;

/* A joint vector and what it misses a target by. */
typedef struct {
    gb_real q[6];
    gb_six_reach reach;
    gb_real miss[6];
    /* The largest of it. */
    gb_real residual;
} gb_six_trial;

/* The cosines and the sines of the joints. */
typedef struct {
    gb_real c[GB_SIX_PADDED(6)];
    gb_real s[GB_SIX_PADDED(6)];
} gb_six_moves;

GB_INLINE void gb_six_find_moves(const gb_real *q, gb_six_moves *moves)
{
    gb_real angles[GB_SIX_PADDED(6)] = {R(0.0)};
    memcpy(angles, q, 6 * sizeof *angles);
    gb_six_turns(angles, 6, moves->c, moves->s);
}

/* Moves a frame by a joint, given all cosines and sines. */
GB_INLINE void gb_six_move(const gb_chain *chain, size_t joint, const gb_real *q, const gb_six_moves *moves, gb_rigid *frame)
{
    if (chain->slides[joint]) {
        gb_six_then_slide(frame, q[joint]);
    } else {
        gb_six_then_turn(frame, moves->c[joint], moves->s[joint]);
    }
}

static void gb_six_find_reach(const gb_chain *chain, const gb_real *q, gb_six_reach *reach)
{
    gb_rigid frame = chain->steps[0];
    gb_six_moves moves;
    gb_six_find_moves(q, &moves);
    for (size_t joint = 0; joint < 6; joint++) {
        if (joint > 0) {
            frame = gb_six_after(&frame, &chain->steps[joint]);
        }
        for (int i = 0; i < 3; i++) {
            reach->axes[joint][i] = frame.rotation[i][2];
            reach->origins[joint][i] = frame.translation[i];
        }
        gb_six_move(chain, joint, q, &moves, &frame);
    }
    reach->end = frame;
}

/* How far the end is from a target: the way, a share of the length scale, and the turn (rad). */
GB_INLINE void gb_six_find_miss(const gb_six_reach *reach, const gb_rigid *target, gb_real *miss)
{
    gb_real turns[3][3];
    GB_UNROLL
    for (int index = 0; index < 3; index++) {
        gb_real is[3], wanted[3];
        GB_UNROLL
        for (int i = 0; i < 3; i++) {
            is[i] = reach->end.rotation[i][index];
            wanted[i] = target->rotation[i][index];
        }
        gb_six_cross(is, wanted, turns[index]);
    }
    GB_UNROLL
    for (int k = 0; k < 3; k++) {
        miss[k] = target->translation[k] - reach->end.translation[k];
        miss[3 + k] = (turns[0][k] + turns[1][k] + turns[2][k]) * R(0.5);
    }
}

/* The value of a joint that brings the end nearest to a target, the frame of the last joint, given all others. */
static gb_real gb_six_closing(const gb_chain *chain, const gb_real *q, size_t joint, const gb_rigid *target)
{
    gb_rigid before = chain->steps[0], behind = gb_six_none;
    gb_six_moves moves;
    gb_six_find_moves(q, &moves);
    for (size_t k = 0; k < joint; k++) {
        gb_six_move(chain, k, q, &moves, &before);
        before = gb_six_after(&before, &chain->steps[k + 1]);
    }
    for (size_t k = joint + 1; k < 6; k++) {
        behind = gb_six_after(&behind, &chain->steps[k]);
        gb_six_move(chain, k, q, &moves, &behind);
    }
    before = gb_six_inverse(&before);
    behind = gb_six_inverse(&behind);
    before = gb_six_after(&before, target);
    const gb_rigid motion = gb_six_after(&before, &behind);
    const gb_real c = motion.rotation[0][0] + motion.rotation[1][1], s = motion.rotation[1][0] - motion.rotation[0][1];
    return chain->slides[joint] ? motion.translation[2] : gb_six_turn(c, s);
}

/* The derivatives of the end's place and turn by a joint. */
GB_INLINE void gb_six_derivatives(const gb_chain *chain, const gb_six_reach *reach, size_t joint, gb_real *column)
{
    const gb_real *axis = reach->axes[joint];
    gb_real arm[3], way[3];
    GB_UNROLL
    for (int k = 0; k < 3; k++) {
        arm[k] = reach->end.translation[k] - reach->origins[joint][k];
    }
    gb_six_cross(axis, arm, way);
    GB_UNROLL
    for (int k = 0; k < 3; k++) {
        column[k] = chain->slides[joint] ? axis[k] : way[k];
        column[3 + k] = chain->slides[joint] ? R(0.0) : axis[k];
    }
}

/* A step that makes the miss vanish to first order, no longer than GB_SIX_LONGEST; false where there is none. */
static bool gb_six_newton(const gb_chain *chain, const gb_six_trial *at, gb_real *step)
{
    gb_real rows[6][8], largest = R(0.0);
    for (size_t joint = 0; joint < 6; joint++) {
        gb_real column[6];
        gb_six_derivatives(chain, &at->reach, joint, column);
        GB_UNROLL
        for (int k = 0; k < 6; k++) {
            rows[k][joint] = column[k];
            largest = gb_larger(largest, gb_magnitude(column[k]));
        }
        rows[joint][6] = at->miss[joint];
        rows[joint][7] = R(0.0);
    }
    if (gb_six_solve(rows[0], 6, 8, largest) <= R(0.0)) {
        return false;
    }
    GB_UNROLL
    for (int k = 0; k < 6; k++) {
        step[k] = rows[k][6];
    }
    const gb_real longest = gb_six_size(step), share = longest > GB_SIX_LONGEST ? GB_SIX_LONGEST / longest : R(1.0);
    GB_UNROLL
    for (int k = 0; k < 6; k++) {
        step[k] = share * step[k];
    }
    return gb_six_is_finite(longest);
}

static void gb_six_try(const gb_chain *chain, const gb_rigid *target, gb_six_trial *trial)
{
    gb_six_find_reach(chain, trial->q, &trial->reach);
    gb_six_find_miss(&trial->reach, target, trial->miss);
    trial->residual = gb_six_size(trial->miss);
}

/* The end of a step, shortened until it leads nearer to the target. */
static void gb_six_follow_step(const gb_chain *chain, const gb_six_trial *at, const gb_real *step, const gb_rigid *target, int *shortened, gb_six_trial *next)
{
    gb_real share = R(1.0);
    for (;;) {
        GB_UNROLL
        for (int joint = 0; joint < 6; joint++) {
            next->q[joint] = at->q[joint] + share * step[joint];
        }
        gb_six_try(chain, target, next);
        if (next->residual < at->residual || at->residual <= GB_SIX_ROUNDING || *shortened >= GB_SIX_SHORTENED) {
            return;
        }
        share = R(0.25) * share;
        ++*shortened;
    }
}

/* Newton steps from q to a target, shortened where they lead away from it; the residual after them, and in `start` before them. */
static gb_real gb_six_polish(const gb_chain *chain, gb_real *q, const gb_rigid *target, gb_real *start)
{
    gb_six_trial trials[2], *at = &trials[0], *next = &trials[1];
    int shortened = 0;
    memcpy(at->q, q, sizeof at->q);
    gb_six_try(chain, target, at);
    *start = at->residual;
    for (int count = 0; count < GB_SIX_STEPS; count++) {
        const gb_real known = at->residual;
        gb_real step[6];
        if (known <= GB_SIX_EXACT || !gb_six_is_finite(known) || !gb_six_newton(chain, at, step)) {
            break;
        }
        gb_six_follow_step(chain, at, step, target, &shortened, next);
        if (next->residual >= known) {
            break;
        }
        gb_six_trial *const other = at;
        at = next;
        next = other;
        if (at->residual > R(0.5) * known && at->residual <= GB_SIX_ROUNDING) {
            break;
        }
    }
    memcpy(q, at->q, sizeof at->q);
    return at->residual;
}

/* Joints that joints behind them make up for, to first order: their columns of the Jacobian depend on those of the joints behind. */
static void gb_six_find_free(const gb_chain *chain, const gb_real *q, bool *is_free)
{
    gb_six_reach reach;
    gb_real kept[6][6];
    int count = 0;
    gb_six_find_reach(chain, q, &reach);
    for (size_t joint = 6; joint-- > 0;) {
        gb_real column[6];
        gb_six_derivatives(chain, &reach, joint, column);
        const gb_real whole = gb_six_norm(column);
        for (int round = 0; round < 2; round++) {
            for (int i = 0; i < count; i++) {
                const gb_real share = gb_six_product(kept[i], column, 6);
                for (int k = 0; k < 6; k++) {
                    column[k] -= share * kept[i][k];
                }
            }
        }
        const gb_real left = gb_six_norm(column);
        is_free[joint] = left <= GB_SIX_SINGULAR * whole;
        if (!is_free[joint]) {
            for (int k = 0; k < 6; k++) {
                kept[count][k] = column[k] / left;
            }
            count++;
        }
    }
}

/* ---- Answers, and what a search for them remembers: answers.rs ---- */

/* A list of joint vectors. */
typedef struct {
    gb_real list[GB_SIX_KEPT][6];
    size_t count;
} gb_six_list;

/* Answers that differ, each with its residual. */
typedef struct {
    gb_real list[GB_SIX_KEPT][6];
    gb_real residual[GB_SIX_KEPT];
    size_t count;
} gb_six_distinct;

/* What has been found at a target. */
typedef struct {
    gb_six_distinct answers;
    /* Where candidates were that polishing led nowhere: next to a self-motion some isolated answer may be near them. */
    gb_six_list lost;
    /* Candidates off the real line, or such that led to no answer, at a target aside: a curve may be next to them. */
    gb_six_list far;
} gb_six_search;

/* The size of a way, of an angle's by the shorter way round. */
GB_INLINE gb_real gb_six_difference(gb_real way, bool slides)
{
    const gb_real turns = slides ? R(0.0) : gb_round(way / GB_TAU);
    return gb_magnitude(way - GB_TAU * turns);
}

/* The largest difference of two joint vectors. */
static gb_real gb_six_distance(const gb_real *a, const gb_real *b, const bool *slides)
{
    gb_real most = R(0.0);
    for (int joint = 0; joint < 6; joint++) {
        most = gb_larger(most, gb_six_difference(a[joint] - b[joint], slides[joint]));
    }
    return most;
}

/* Whether no joint differs by more than a limit. */
static bool gb_six_is_within(const gb_real *a, const gb_real *b, const bool *slides, gb_real limit)
{
    for (int joint = 0; joint < 6; joint++) {
        if (gb_six_difference(a[joint] - b[joint], slides[joint]) > limit) {
            return false;
        }
    }
    return true;
}

/* Adds a joint vector if none is nearly the same, turns counted. */
static void gb_six_remember(gb_six_list *list, const gb_real *q)
{
    static const bool ways[6] = {true, true, true, true, true, true};
    if (list->count == GB_SIX_KEPT) {
        return;
    }
    for (size_t k = 0; k < list->count; k++) {
        if (gb_six_is_within(list->list[k], q, ways, GB_SIX_ALIKE)) {
            return;
        }
    }
    memcpy(list->list[list->count++], q, sizeof list->list[0]);
}

/* Remembers a candidate that polishing led nowhere. */
static void gb_six_lose(gb_six_search *search, const gb_real *q)
{
    for (int joint = 0; joint < 6; joint++) {
        if (!gb_six_is_finite(q[joint])) {
            return;
        }
    }
    gb_six_remember(&search->lost, q);
}

/* Adds an answer, in place of a worse equal one. */
static void gb_six_keep(gb_six_distinct *answers, const gb_real *q, gb_real residual, const bool *slides)
{
    size_t at = 0;
    while (at < answers->count && !gb_six_is_within(answers->list[at], q, slides, GB_SIX_MERGE)) {
        at++;
    }
    if (at == GB_SIX_KEPT || (at < answers->count && !(residual < answers->residual[at]))) {
        return;
    }
    memcpy(answers->list[at], q, sizeof answers->list[at]);
    answers->residual[at] = residual;
    answers->count += at == answers->count ? 1 : 0;
}

/* Moves angles into (-pi, pi]. */
static void gb_six_wrap(gb_real *q, const bool *slides)
{
    for (int joint = 0; joint < 6; joint++) {
        q[joint] = slides[joint] ? q[joint] : gb_wrap(q[joint]);
    }
}

/* Polishes joints that a walk along a curve has led to, and keeps them if they are an answer that is not known. */
static void gb_six_find(const gb_chain *chain, const gb_rigid *target, const gb_real *from, gb_six_search *search)
{
    gb_real q[6], start;
    memcpy(q, from, sizeof q);
    const gb_real residual = gb_six_polish(chain, q, target, &start);
    gb_six_wrap(q, chain->slides);
    if (!(residual <= GB_SIX_ACCEPT)) {
        return;
    }
    for (size_t k = 0; k < search->answers.count; k++) {
        if (gb_six_is_within(search->answers.list[k], q, chain->slides, GB_SIX_APART)) {
            return;
        }
    }
    gb_six_keep(&search->answers, q, residual, chain->slides);
}

/* ---- The Jacobian next to a curve all along which the target is nearly reached: section.rs ----
 *
 * Bordering: A. Griewank and G. W. Reddien, SIAM J. Numerical Analysis 21 (1984) 176-185. */

/* A place on a curve, and the Jacobian there: five directions that lead to somewhere and one that hardly does. */
typedef struct {
    gb_real q[6];
    /* The shortest step behind which only `value` is missed, to first order. */
    gb_real step[6];
    /* The tangent of the curve, of length one. */
    gb_real along[6];
    /* The sum of equations that no joint changes, of length one. */
    gb_real across[6];
    /* What is missed of it. */
    gb_real value;
    /* By how much joints change it after all, about the least singular value. */
    gb_real slope;
} gb_six_point;

/* The Jacobian after five steps of elimination, the factors below its diagonal, with what is missed. */
typedef struct {
    gb_real matrix[6][6];
    gb_real right[6];
    /* The order of the rows, which were moved. */
    size_t rows[6];
    /* The order of the columns, which were not. */
    size_t columns[6];
} gb_six_cut;

/* Brings the largest entry to place k; its size. */
GB_INLINE gb_real gb_six_bring(gb_six_cut *cut, size_t k)
{
    gb_real most = R(0.0), row_of[6];
    size_t row = k, place = k;
    for (size_t i = k; i < 6; i++) {
        for (size_t j = k; j < 6; j++) {
            const gb_real entry = gb_magnitude(cut->matrix[i][cut->columns[j]]);
            if (entry > most) {
                most = entry;
                row = i;
                place = j;
            }
        }
    }
    const gb_real right = cut->right[row];
    const size_t number = cut->rows[row], column = cut->columns[place];
    memcpy(row_of, cut->matrix[row], sizeof row_of);
    memcpy(cut->matrix[row], cut->matrix[k], sizeof row_of);
    memcpy(cut->matrix[k], row_of, sizeof row_of);
    cut->right[row] = cut->right[k];
    cut->right[k] = right;
    cut->rows[row] = cut->rows[k];
    cut->rows[k] = number;
    cut->columns[place] = cut->columns[k];
    cut->columns[k] = column;
    return most;
}

/* Gauss elimination with complete pivoting; false where more than one direction leads nowhere. */
static bool gb_six_eliminate_cut(gb_six_cut *cut)
{
    gb_real first = R(0.0);
    for (size_t k = 0; k < 5; k++) {
        const gb_real most = gb_six_bring(cut, k), *pivot = cut->matrix[k];
        const size_t column = cut->columns[k];
        first = k == 0 ? most : first;
        if (most <= GB_SIX_RANK * first || !gb_six_is_finite(most)) {
            return false;
        }
        for (size_t i = k + 1; i < 6; i++) {
            const gb_real factor = cut->matrix[i][column] / pivot[column];
            for (size_t j = k + 1; j < 6; j++) {
                cut->matrix[i][cut->columns[j]] -= factor * pivot[cut->columns[j]];
            }
            cut->matrix[i][column] = factor;
            cut->right[i] -= factor * cut->right[k];
        }
    }
    return true;
}

/* The sum of equations in which no joint is left, the last one's share one. */
GB_INLINE void gb_six_sum_across(const gb_six_cut *cut, gb_real *across)
{
    across[cut->rows[5]] = R(1.0);
    for (size_t k = 5; k-- > 0;) {
        gb_real sum = R(-0.0);
        for (size_t i = k + 1; i < 6; i++) {
            sum += cut->matrix[i][cut->columns[k]] * across[cut->rows[i]];
        }
        across[cut->rows[k]] = -sum;
    }
}

/* The joints that solve five equations, given the last of them. */
GB_INLINE void gb_six_substitute(const gb_six_cut *cut, const gb_real *right, gb_real last, gb_real *x)
{
    x[cut->columns[5]] = last;
    for (size_t k = 5; k-- > 0;) {
        gb_real known = R(-0.0);
        for (size_t j = k + 1; j < 6; j++) {
            known += cut->matrix[k][cut->columns[j]] * x[cut->columns[j]];
        }
        x[cut->columns[k]] = (right[k] - known) / cut->matrix[k][cut->columns[k]];
    }
}

/* The section at a place's joints; false where more than one direction leads nowhere. */
static bool gb_six_section(const gb_chain *chain, const gb_rigid *target, gb_six_point *at)
{
    static const gb_real zero[6] = {R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0)};
    gb_six_reach reach;
    gb_six_cut cut;
    gb_six_find_reach(chain, at->q, &reach);
    gb_six_find_miss(&reach, target, cut.right);
    for (size_t joint = 0; joint < 6; joint++) {
        gb_real column[6];
        gb_six_derivatives(chain, &reach, joint, column);
        for (int k = 0; k < 6; k++) {
            cut.matrix[k][joint] = column[k];
        }
        cut.rows[joint] = cut.columns[joint] = joint;
    }
    if (!gb_six_eliminate_cut(&cut)) {
        return false;
    }
    gb_six_sum_across(&cut, at->across);
    gb_six_substitute(&cut, zero, R(1.0), at->along);
    gb_six_substitute(&cut, cut.right, R(0.0), at->step);
    const gb_real width = gb_six_norm(at->across), length = gb_six_norm(at->along);
    for (int k = 0; k < 6; k++) {
        at->across[k] = at->across[k] / width;
        at->along[k] = at->along[k] / length;
    }
    const gb_real share = gb_six_product(at->step, at->along, 6);
    for (int k = 0; k < 6; k++) {
        at->step[k] -= share * at->along[k];
    }
    at->value = cut.right[5] / width;
    at->slope = gb_magnitude(cut.matrix[5][cut.columns[5]]) / (width * length);
    return true;
}

/* Whether a curve is here. */
static bool gb_six_is_near(const gb_six_point *at)
{
    return at->slope <= GB_SIX_STEEP && gb_magnitude(at->value) <= GB_SIX_ADRIFT;
}

/* The directions so that they go on from another place's. */
static void gb_six_align(gb_six_point *at, const gb_six_point *other)
{
    const bool is_back = gb_six_product(at->along, other->along, 6) < R(0.0), is_under = gb_six_product(at->across, other->across, 6) < R(0.0);
    for (int k = 0; k < 6; k++) {
        at->along[k] = is_back ? -at->along[k] : at->along[k];
        at->across[k] = is_under ? -at->across[k] : at->across[k];
    }
    at->value = is_under ? -at->value : at->value;
}

/* Steps across the curve from a place's joints, `rounds` at most; whether they lead to it. */
static bool gb_six_settle(const gb_chain *chain, const gb_rigid *target, gb_six_point *at, int rounds)
{
    for (int round = 0; round < rounds; round++) {
        if (!gb_six_section(chain, target, at)) {
            return false;
        }
        const gb_real longest = gb_six_size(at->step), share = longest > GB_SIX_LONGEST ? GB_SIX_LONGEST / longest : R(1.0);
        if (!gb_six_is_finite(longest) || (round >= GB_SIX_EARLY && at->slope > GB_SIX_FLAT)) {
            return false;
        }
        for (int k = 0; k < 6; k++) {
            at->q[k] += share * at->step[k];
        }
        if (longest <= GB_SIX_SETTLED) {
            return gb_six_section(chain, target, at) && gb_six_is_near(at);
        }
    }
    return false;
}

/* ---- Curves all along which the target is nearly reached, as next to a self-motion: curve.rs ----
 *
 * Beside a self-motion the isolated answers of a target may stand anywhere on the curve that the self-motion was, and Newton's steps find none of them: the
 * Jacobian has rank five but for a trace. A walk holds the five equations that joints can change and goes along the tangent; what is missed of the sixth one
 * changes its sign at each answer. (Steps along the tangent: E. L. Allgower and K. Georg, Numerical Continuation Methods, 1990, chapter 3.) */

/* A walk along all curves that are found from some joint vectors. */
typedef struct {
    const gb_chain *chain;
    const gb_rigid *target;
    gb_six_search *search;
    /* Where walks begin; those that another one has passed are left out. */
    gb_six_point starts[GB_SIX_KEPT];
    bool is_open[GB_SIX_KEPT];
    size_t count;
} gb_six_walk;

/* Begins at q too if there is a curve next to it. */
static void gb_six_begin(gb_six_walk *walk, const gb_real *q)
{
    if (walk->count == GB_SIX_KEPT) {
        return;
    }
    gb_six_point *start = &walk->starts[walk->count];
    memcpy(start->q, q, sizeof start->q);
    if (gb_six_settle(walk->chain, walk->target, start, GB_SIX_MANY)) {
        walk->is_open[walk->count++] = true;
    }
}

/* The place that steps across the curve lead to from a share of a way behind q; false where there is none. */
static bool gb_six_advance(const gb_six_walk *walk, const gb_real *q, const gb_real *way, gb_real share, gb_six_point *next)
{
    for (int k = 0; k < 6; k++) {
        next->q[k] = q[k] + share * way[k];
    }
    return gb_six_settle(walk->chain, walk->target, next, GB_SIX_FEW);
}

static void gb_six_way(const gb_real *from, const gb_real *to, gb_real *way)
{
    for (int k = 0; k < 6; k++) {
        way[k] = to[k] - from[k];
    }
}

/* Adds the answer between two places where the sixth equation has different signs, by false position (the Illinois rule: M. Dowell and P. Jarratt, BIT 11
 * (1971) 168-174). */
static void gb_six_change(const gb_six_walk *walk, const gb_six_point *a, const gb_six_point *b)
{
    gb_real low = a->value, high = b->value;
    if ((low <= R(0.0)) == (high <= R(0.0)) || gb_larger(gb_magnitude(low), gb_magnitude(high)) <= GB_SIX_LEVEL) {
        return;
    }
    gb_six_point near = *a, far = *b;
    int side = 0;
    for (int round = 0; round < GB_SIX_NARROWED; round++) {
        gb_six_point middle;
        gb_real way[6];
        gb_six_way(near.q, far.q, way);
        if (!gb_six_advance(walk, near.q, way, low / (low - high), &middle)) {
            break;
        }
        gb_six_align(&middle, a);
        if ((middle.value <= R(0.0)) == (low <= R(0.0))) {
            near = middle;
            high = side < 0 ? R(0.5) * high : far.value;
            low = middle.value;
            side = -1;
        } else {
            far = middle;
            low = side > 0 ? R(0.5) * low : near.value;
            high = middle.value;
            side = 1;
        }
        if (gb_magnitude(middle.value) <= GB_SIX_EXACT) {
            break;
        }
    }
    gb_six_find(walk->chain, walk->target, gb_magnitude(near.value) <= gb_magnitude(far.value) ? near.q : far.q, walk->search);
}

/* Where the sixth equation comes near zero and goes away again, there may be two answers, or a double one. */
static void gb_six_dip(const gb_six_walk *walk, const gb_six_point *a, const gb_six_point *b, const gb_six_point *c)
{
    const gb_real low = a->value, least = b->value, high = c->value, size = gb_magnitude(least);
    if (!(size < gb_magnitude(low) && size < gb_magnitude(high) && size > GB_SIX_LEVEL) || (low <= R(0.0)) != (least <= R(0.0))
        || (high <= R(0.0)) != (least <= R(0.0))) {
        return;
    }
    const gb_real share = R(0.5) * (low - high) / (low - least - least + high);
    const gb_six_point *end = share < R(0.0) ? a : c;
    gb_six_point vertex;
    gb_real way[6];
    gb_six_way(b->q, end->q, way);
    if (gb_six_advance(walk, b->q, way, gb_magnitude(share), &vertex)) {
        gb_six_align(&vertex, b);
        gb_six_change(walk, b, &vertex);
        gb_six_change(walk, &vertex, end);
        gb_six_find(walk->chain, walk->target, vertex.q, walk->search);
    }
}

/* A step along the curve, shorter where it bends; false where it ends. */
static bool gb_six_pace(const gb_six_walk *walk, const gb_six_point *at, gb_real *stride, gb_six_point *next)
{
    for (; *stride >= GB_SIX_SHORT * GB_SIX_STRIDE; *stride *= R(0.5)) {
        if (gb_six_advance(walk, at->q, at->along, *stride, next) && gb_magnitude(gb_six_product(next->along, at->along, 6)) > R(0.9)
            && gb_six_distance(next->q, at->q, walk->chain->slides) <= R(2.0) * *stride) {
            *stride = gb_smaller(R(2.0) * *stride, GB_SIX_STRIDE);
            gb_six_align(next, at);
            return true;
        }
    }
    return false;
}

/* The last place of a walk that has come home, with the turns of its angles that are nearest to the place before. */
static gb_six_point gb_six_beside(const gb_six_point *home, const gb_six_point *at, const bool *slides)
{
    gb_six_point end = *home;
    gb_six_align(&end, at);
    for (int joint = 0; joint < 6; joint++) {
        const gb_real turns = slides[joint] ? R(0.0) : gb_round((at->q[joint] - end.q[joint]) / GB_TAU);
        end.q[joint] = end.q[joint] + GB_TAU * turns;
    }
    return end;
}

/* Walks from `home` until the curve closes or ends; whether it closed. `level` becomes the most that was missed. */
static bool gb_six_leads_home(gb_six_walk *walk, const gb_six_point *home, gb_real *level)
{
    const bool *slides = walk->chain->slides;
    gb_six_point before = *home, at = *home, next;
    gb_real stride = GB_SIX_STRIDE;
    bool is_away = false;
    for (int pace = 0; pace < GB_SIX_PACES; pace++) {
        if (!gb_six_pace(walk, &at, &stride, &next)) {
            return false;
        }
        *level = gb_larger(*level, gb_magnitude(next.value));
        gb_six_change(walk, &at, &next);
        gb_six_dip(walk, &before, &at, &next);
        for (size_t k = 0; k < walk->count; k++) {
            walk->is_open[k] = walk->is_open[k] && gb_six_distance(walk->starts[k].q, next.q, slides) > GB_SIX_STRIDE;
        }
        before = at;
        at = next;
        const gb_real way = gb_six_distance(at.q, home->q, slides);
        is_away |= way > R(3.0) * GB_SIX_STRIDE;
        if (is_away && way <= GB_SIX_STRIDE && gb_six_product(at.along, home->along, 6) > R(0.5)) {
            const gb_six_point end = gb_six_beside(home, &at, slides);
            gb_six_change(walk, &at, &end);
            return true;
        }
    }
    return false;
}

/* Walks along the curves, both ways if they do not close, and adds answers where the sixth equation changes its sign; of a curve that misses nothing, a
 * self-motion, one member. */
static void gb_six_run_walk(gb_six_walk *walk)
{
    for (size_t index = 0; index < walk->count; index++) {
        if (!walk->is_open[index]) {
            continue;
        }
        walk->is_open[index] = false;
        const gb_six_point *start = &walk->starts[index];
        gb_six_point home = *start;
        gb_real level = gb_magnitude(start->value);
        if (!gb_six_leads_home(walk, &home, &level)) {
            for (int k = 0; k < 6; k++) {
                home.along[k] = -start->along[k];
            }
            gb_six_leads_home(walk, &home, &level);
        }
        if (level <= GB_SIX_LEVEL) {
            gb_six_find(walk->chain, walk->target, start->q, walk->search);
        }
    }
}

/* Walks along the curves next to answers, and to candidates that led to none. */
static GB_APART void gb_six_walk_from(const gb_chain *chain, const gb_rigid *target, gb_six_search *search)
{
    gb_six_walk walk;
    walk.chain = chain;
    walk.target = target;
    walk.search = search;
    walk.count = 0;
    for (size_t k = 0; k < search->answers.count; k++) {
        gb_six_point at;
        memcpy(at.q, search->answers.list[k], sizeof at.q);
        if (gb_six_section(chain, target, &at) && gb_six_is_near(&at)) {
            gb_six_begin(&walk, at.q);
        }
    }
    for (size_t k = 0; k < search->far.count; k++) {
        gb_six_begin(&walk, search->far.list[k]);
    }
    for (size_t k = 0; k < search->lost.count; k++) {
        gb_six_begin(&walk, search->lost.list[k]);
    }
    gb_six_run_walk(&walk);
}

/* ---- The solver, formulations in turn until one can be trusted: solve.rs ---- */

/* A target, and where it is put aside for one attempt. */
typedef struct {
    const gb_chain *chain;
    size_t number;
    /* How far aside. */
    gb_real size;
    /* What takes the tip from its place at zero to the target. */
    const gb_rigid *goal;
    /* The frame of the last joint at the target, and at the target aside. */
    const gb_rigid *target;
    gb_rigid near;
    /* The joint whose line is used. */
    size_t missing;
} gb_six_attempt;

/* What an attempt has come to. */
typedef struct {
    /* Its own answers. */
    gb_six_distinct own;
    /* How many candidates led nowhere. */
    size_t lost;
    /* The most that a candidate missed the target by before it was polished. */
    gb_real worst;
} gb_six_tally;

/* Whether a way is so long that it stands for an infinite one, which chains with two sliding joints have among their eigenvalues. */
static bool gb_six_is_infinite(const gb_chain *chain, const gb_real *q)
{
    for (int joint = 0; joint < 6; joint++) {
        if (chain->slides[joint] && !(gb_magnitude(q[joint]) <= GB_SIX_LONG)) {
            return true;
        }
    }
    return false;
}

/* Leads joints that reach the target aside to the target in stages, each a quarter of the way from it that the one before was: next to a self-motion it is as
 * flat as the target is near, and a step must be no longer. The residual at the target, and in `last` the joints of the last stage that succeeded. */
static gb_real gb_six_lead(const gb_six_attempt *attempt, gb_real *q, gb_real *last)
{
    gb_real residual = R(1.0), size = attempt->size, start;
    for (int stage = 0; stage < GB_SIX_STAGES; stage++) {
        size = stage + 1 < GB_SIX_STAGES ? R(0.25) * size : R(0.0);
        const gb_rigid motion = gb_six_aside(size, attempt->number), near = gb_six_after(&motion, attempt->goal);
        const gb_rigid target = gb_six_after(&near, &attempt->chain->last);
        residual = gb_six_polish(attempt->chain, q, &target, &start);
        if (residual > GB_SIX_ACCEPT) {
            break;
        }
        memcpy(last, q, 6 * sizeof *last);
    }
    return residual;
}

/* Joints that reach the target aside brought to the target: at once, or in stages; the residual, and in `last` the last ones that were reached. */
static GB_APART gb_real gb_six_bring_back(const gb_six_attempt *attempt, gb_real *q, gb_real *last)
{
    gb_real start;
    memcpy(last, q, 6 * sizeof *last);
    const gb_real residual = gb_six_polish(attempt->chain, q, attempt->target, &start);
    if (residual <= GB_SIX_ACCEPT) {
        return residual;
    }
    memcpy(q, last, 6 * sizeof *q);
    return gb_six_lead(attempt, q, last);
}

/* Polishes a candidate, and keeps or remembers it. */
static void gb_six_follow(const gb_six_attempt *attempt, const gb_six_candidate *candidate, gb_six_search *search, gb_six_tally *tally)
{
    const gb_chain *chain = attempt->chain;
    const gb_real deep = candidate->depth * candidate->depth, accuracy = gb_larger(tally->worst, GB_SIX_UNKNOWN);
    const bool is_far = deep > GB_SIX_FAR_OFF * accuracy, is_aside = attempt->size > R(0.0);
    gb_real q[6], first[6], last[6], start;
    if ((is_far && !is_aside) || gb_six_is_infinite(chain, candidate->q)) {
        return;
    }
    memcpy(q, candidate->q, sizeof q);
    q[attempt->missing] = gb_six_closing(chain, q, attempt->missing, &attempt->near);
    memcpy(first, q, sizeof q);
    if (is_far) {
        gb_six_remember(&search->far, first);
        return;
    }
    gb_real residual = gb_six_polish(chain, q, &attempt->near, &start);
    memcpy(last, q, sizeof q);
    if (is_aside) {
        residual = gb_six_bring_back(attempt, q, last);
    }
    if (is_aside && (residual > GB_SIX_ACCEPT || candidate->depth > R(0.0))) {
        gb_six_remember(&search->far, first);
    }
    if (residual <= GB_SIX_ACCEPT) {
        tally->worst = candidate->depth == R(0.0) ? gb_larger(tally->worst, start) : tally->worst;
        gb_six_wrap(q, chain->slides);
        gb_six_keep(&search->answers, q, residual, chain->slides);
        gb_six_keep(&tally->own, q, residual, chain->slides);
    } else if (deep <= GB_SIX_OFF * accuracy) {
        tally->lost++;
        gb_six_lose(search, last);
    }
}

/* Adds the answers of one formulation; whether it can be trusted to have found all. */
static bool gb_six_run(const gb_six_attempt *attempt, const gb_rigid *displacement, gb_six_search *search)
{
    const size_t known = search->answers.count;
    const bool is_aside = attempt->size > R(0.0);
    gb_six_candidates candidates;
    gb_six_tally tally;
    if (!gb_six_find_candidates(attempt->chain, displacement, attempt->number, is_aside ? GB_SIX_DEEPEST : GB_SIX_BLURRED, &candidates)) {
        return false;
    }
    tally.own.count = tally.lost = 0;
    tally.worst = R(0.0);
    for (size_t k = 0; k < candidates.count; k++) {
        gb_six_follow(attempt, &candidates.list[k], search, &tally);
    }
    const size_t count = search->answers.count;
    const bool is_unreachable = candidates.count == 0 && candidates.conditioning >= GB_SIX_CLEAR, nothing_lost = search->lost.count == 0;
    const bool is_clear = tally.lost == 0 && count % 2 == 0 && !candidates.are_crowded && (count > 0 || is_unreachable);
    const bool is_confirmed = attempt->number > 0 && known == count && tally.own.count == count && nothing_lost;
    const bool is_sound = tally.worst <= GB_SIX_ACCURATE && candidates.conditioning >= GB_SIX_SOUND;
    return is_clear && (is_confirmed || (is_sound && (!is_aside || nothing_lost)));
}

/* Runs formulations until one can be trusted; their number. What was lost is forgotten then. */
static size_t gb_six_search_all(const gb_chain *chain, const gb_rigid *goal, const gb_rigid *target, gb_six_search *search)
{
    for (size_t number = 0; number < GB_SIX_ATTEMPTS; number++) {
        gb_six_attempt attempt;
        attempt.chain = chain;
        attempt.number = number;
        attempt.size = gb_six_disturbances[number];
        attempt.goal = goal;
        attempt.target = target;
        attempt.missing = gb_six_joint(gb_six_formulation(chain, number), 3);
        /* One run aside shows too little of what may be beside it. */
        const bool is_first_aside = number > 0 && attempt.size > R(0.0) && gb_six_disturbances[number - 1] == R(0.0);
        if (is_first_aside) {
            search->lost.count = 0;
        }
        const gb_rigid motion = gb_six_aside(attempt.size, number), displacement = gb_six_after(&motion, goal);
        attempt.near = gb_six_after(&displacement, &chain->last);
        if (gb_six_run(&attempt, &displacement, search) && !is_first_aside) {
            search->lost.count = 0;
            return number + 1;
        }
    }
    return GB_SIX_ATTEMPTS;
}

static bool gb_six_is_sorted(const gb_real *a, const gb_real *b)
{
    for (int k = 0; k < 6; k++) {
        if (a[k] != b[k]) {
            return a[k] < b[k];
        }
    }
    return true;
}

/* Joints in the unit of the target. */
static gb_six_answer gb_six_tell(const gb_chain *chain, const gb_real *q, bool lost)
{
    gb_six_answer answer;
    for (int joint = 0; joint < 6; joint++) {
        answer.q[joint] = chain->slides[joint] ? q[joint] * chain->length : q[joint];
        answer.free[joint] = false;
    }
    answer.lost = lost;
    return answer;
}

/* Writes what was found, in the unit of the target; how much it is. */
static size_t gb_six_tell_all(const gb_chain *chain, const gb_six_search *search, bool is_isolated, gb_six_answer *out)
{
    size_t count = 0;
    for (; count < search->answers.count; count++) {
        gb_six_answer answer = gb_six_tell(chain, search->answers.list[count], false);
        if (!is_isolated) {
            gb_six_find_free(chain, search->answers.list[count], answer.free);
        }
        size_t place = count;
        for (; place > 0 && !gb_six_is_sorted(out[place - 1].q, answer.q); place--) {
            out[place] = out[place - 1];
        }
        out[place] = answer;
    }
    for (size_t k = 0; k < search->lost.count; k++) {
        out[count++] = gb_six_tell(chain, search->lost.list[k], true);
    }
    return count;
}

GB_LINKAGE size_t gb_six_axes(const gb_chain *chain, const gb_real *target, gb_six_answer *out)
{
    gb_rigid pose;
    gb_six_search search;
    memcpy(pose.translation, target, sizeof pose.translation);
    memcpy(pose.rotation, target + 3, sizeof pose.rotation);
    gb_rigid goal = gb_six_after(&pose, &chain->back);
    for (int i = 0; i < 3; i++) {
        goal.translation[i] = goal.translation[i] * (R(1.0) / chain->length);
    }
    const gb_rigid end = gb_six_after(&goal, &chain->last);
    search.answers.count = search.lost.count = search.far.count = 0;
    const size_t runs = gb_six_search_all(chain, &goal, &end, &search);
    if (runs > 1) {
        gb_six_walk_from(chain, &end, &search);
    }
    /* A run that can be trusted at once has seen no self-motion. */
    return gb_six_tell_all(chain, &search, runs == 1, out);
}

#endif
