/* Steps along a curve of solutions: predictor, corrector and their acceptance: see step.rs
 *
 * The predictor continues the polynomial of degree four through the last piece. The corrector is the simplified Newton method. A step is
 * accepted by an affine-invariant estimate of the Newton-Kantorovich condition (P. Deuflhard, Newton Methods for Nonlinear Problems, 2004, sections 2.1 and
 * 5.2): the second correction must be at most a quarter of the first one. The oriented direction must not turn back. Where it does, the step has left the curve
 * for another one that nearly crosses it. */

/* A point on a curve. */
typedef struct {
    /* Scaled joint values. */
    gb_real x[GB_MOST_ARM_JOINTS];
    /* The direction of travel, of length one. */
    gb_real t[GB_MOST_ARM_JOINTS];
    /* The second derivative by the length. */
    gb_real bend[GB_MOST_ARM_JOINTS];
} gb_arm_point;

/* A piece of a curve, from one step. */
typedef struct {
    gb_arm_point from;
    gb_arm_point to;
    gb_real length;
} gb_arm_piece;

/* A walk along a curve. */
typedef struct {
    gb_arm_point at;
    /* The sign of the direction of travel against the oriented one. */
    gb_real side;
    /* The next step, and the longest one. */
    gb_real pace;
    gb_real longest;
    /* The third and the fourth derivative by the length. */
    gb_real third[GB_MOST_ARM_JOINTS];
    gb_real fourth[GB_MOST_ARM_JOINTS];
    /* Whether the walk has crossed a singular point, where curves meet. */
    bool is_unsure;
} gb_arm_walk;

static const gb_real gb_arm_still[GB_MOST_ARM_JOINTS] = {R(0.0)};

/* The point of a place whose direction of travel is the oriented one times `side`. */
static gb_arm_point gb_arm_point_of(const gb_arm_place *place, gb_real side, const gb_real *bend)
{
    gb_arm_point point;
    gb_arm_copy(place->x, point.x);
    gb_arm_copy(bend, point.bend);
    for (int i = 0; i < GB_MOST_ARM_JOINTS; i++) {
        point.t[i] = place->linear.tangent[i] * side;
    }
    return point;
}

/* The length of the curve between two points, by the slopes at both ends: that of a cubic, and for a circle up to the sixth power of the angle. */
static gb_real gb_arm_length(const gb_arm_point *from, const gb_arm_point *to)
{
    gb_real chord[GB_MOST_ARM_JOINTS];
    gb_arm_plus(to->x, R(-1.0), from->x, chord);
    const gb_real square = gb_arm_dot(chord, chord);
    if (square == R(0.0)) {
        return R(0.0);
    }
    const gb_real distance = gb_square_root(square);
    /* The directions without their shares along the chord. */
    const gb_real first = gb_arm_dot(from->t, chord) / distance, last = gb_arm_dot(to->t, chord) / distance;
    const gb_real a = R(1.0) - first * first, b = R(1.0) - last * last;
    const gb_real both = gb_arm_dot(from->t, to->t) - first * last;
    /* Squares of sines, made squares of angles. */
    const gb_real mean = R(0.5) * (a + b);
    const gb_real slopes = (R(2.0) * a + R(2.0) * b - both) * (R(1.0) + mean / R(3.0));
    const gb_real length = distance * (R(1.0) + slopes / R(30.0) + R(7.0) / R(360.0) * mean * mean);
    /* The polynomial of degree four with the curvature at the beginning differs from the cubic by `fourth u^2 (1 - u)^2`. */
    gb_real change = R(0.0);
    for (int i = 0; i < GB_MOST_ARM_JOINTS; i++) {
        const gb_real start = length * from->t[i], end = length * to->t[i];
        const gb_real fourth = R(0.5) * length * length * from->bend[i] - (R(3.0) * chord[i] - R(2.0) * start - end);
        change += (end - start) * fourth;
    }
    return length - gb_arm_min(gb_arm_max(change / (R(30.0) * length), -GB_ARM_FOURTH * length), GB_ARM_FOURTH * length);
}

static gb_arm_piece gb_arm_piece_of(const gb_arm_point *from, const gb_arm_point *to)
{
    gb_arm_piece piece;
    piece.from = *from;
    piece.to = *to;
    piece.length = gb_arm_length(from, to);
    return piece;
}

/* The coefficients of the joint's cubic with the positions and directions of both ends of the piece, without the constant one. */
GB_INLINE void gb_arm_cubic(const gb_arm_piece *piece, size_t joint, gb_real *cubic)
{
    const gb_real rise = piece->to.x[joint] - piece->from.x[joint];
    const gb_real first = piece->length * piece->from.t[joint], last = piece->length * piece->to.t[joint];
    cubic[0] = first;
    cubic[1] = R(3.0) * rise - R(2.0) * first - last;
    cubic[2] = first + last - R(2.0) * rise;
}

/* The joint values at a share of the length, by these cubics. */
static void gb_arm_piece_at(const gb_arm_piece *piece, gb_real share, gb_real *x)
{
    for (size_t i = 0; i < GB_MOST_ARM_JOINTS; i++) {
        gb_real c[3];
        gb_arm_cubic(piece, i, c);
        x[i] = piece->from.x[i] + share * (c[0] + share * (c[1] + share * c[2]));
    }
}

/* A walk from a point. Steps are divided by four at each level. */
static gb_arm_walk gb_arm_walk_from(const gb_arm_point *at, gb_real side, uint32_t level)
{
    gb_arm_walk walk;
    gb_real share = R(1.0);
    for (uint32_t k = 0; k < level; k++) {
        share *= R(0.25);
    }
    walk.at = *at;
    walk.side = side;
    walk.pace = GB_ARM_FIRST_PACE * share;
    walk.longest = GB_ARM_LONGEST_PACE * share;
    memset(walk.third, 0, sizeof walk.third);
    memset(walk.fourth, 0, sizeof walk.fourth);
    walk.is_unsure = false;
    return walk;
}

/* Corrects the place that a step predicts: writes the point of the curve. Returns the length of the first correction, or -1 if the step is not accepted. */
static gb_real gb_arm_correct(const gb_arm_model *model, const gb_arm_place *place, gb_real side, gb_arm_point *to)
{
    gb_real step[GB_MOST_ARM_JOINTS], turn[GB_MOST_ARM_JOINTS], values[GB_ARM_ROWS], rates[GB_ARM_ROWS];
    gb_arm_least(&place->linear, place->values, step);
    const gb_real size = gb_arm_norm(step);
    const bool is_short = size <= GB_ARM_CORRECTION;
    if (!is_short) {
        return R(-1.0);
    }
    gb_arm_plus(place->x, R(-1.0), step, to->x);
    gb_arm_moving(model, to->x, place->linear.tangent, values, rates);
    gb_arm_least(&place->linear, values, step);
    const bool is_contracting = gb_arm_norm(step) <= GB_ARM_CONTRACTION * size + GB_ACCEPTANCE_RESIDUAL;
    if (!is_contracting) {
        return R(-1.0);
    }
    /* The null vector of the derivatives at the corrected point, by one step of the same method. */
    gb_arm_least(&place->linear, rates, turn);
    const gb_real shrink = side / gb_square_root(R(1.0) + gb_arm_dot(turn, turn));
    gb_arm_plus(to->x, R(-1.0), step, to->x);
    gb_arm_copy(gb_arm_still, to->bend);
    for (int i = 0; i < GB_MOST_ARM_JOINTS; i++) {
        to->t[i] = shrink * (place->linear.tangent[i] - turn[i]);
    }
    return size;
}

/* A step of a certain length: writes the piece. Returns the length of its correction, or -1 if it is not accepted. */
static gb_real gb_arm_attempt(const gb_arm_walk *walk, const gb_arm_model *model, gb_real pace, gb_real side, gb_arm_piece *piece)
{
    const gb_arm_point *at = &walk->at;
    gb_arm_place place;
    gb_arm_point to;
    gb_real x[GB_MOST_ARM_JOINTS];
    for (int i = 0; i < GB_MOST_ARM_JOINTS; i++) {
        const gb_real third = walk->third[i] / R(6.0) + pace / R(24.0) * walk->fourth[i];
        x[i] = at->x[i] + pace * (at->t[i] + pace * (R(0.5) * at->bend[i] + pace * third));
    }
    gb_arm_set_place(model, x, &place);
    if (model->frozen >= 0 && side * gb_arm_dot(place.linear.tangent, at->t) < R(0.0)) {
        /* One of the equations is left out, so that the orientation is not continuous. */
        gb_arm_reverse(place.linear.tangent);
    }
    if (place.linear.pivot <= GB_PIVOTS_REGULAR || side * gb_arm_dot(place.linear.tangent, at->t) < GB_ARM_STRAIGHT) {
        return R(-1.0);
    }
    const gb_real size = gb_arm_correct(model, &place, side, &to);
    if (size >= R(0.0)) {
        *piece = gb_arm_piece_of(at, &to);
    }
    return size;
}

/* A step across a singular point. Beyond it the oriented direction is opposite to the direction of travel. */
GB_COLD static bool gb_arm_leap(gb_arm_walk *walk, const gb_arm_model *model, gb_arm_piece *piece)
{
    const gb_real sides[2] = {-walk->side, walk->side};
    for (int k = 0; k < 2 * GB_ARM_LEAPS; k++) {
        const gb_real leap = gb_arm_leaps[k / 2], side = sides[k % 2];
        if (gb_arm_attempt(walk, model, leap, side, piece) >= R(0.0)) {
            walk->side = side;
            walk->is_unsure = true;
            walk->pace = leap;
            return true;
        }
    }
    return false;
}

/* Replaces the curvature if it is wrong. Its error remains from piece to piece: after a sharp turn, steps would remain short. */
static void gb_arm_renew(gb_arm_walk *walk, const gb_arm_model *model)
{
    gb_real bend[GB_MOST_ARM_JOINTS], error[GB_MOST_ARM_JOINTS];
    gb_arm_place place;
    gb_arm_set_bent(model, walk->at.x, &place, bend);
    gb_arm_plus(bend, R(-1.0), walk->at.bend, error);
    if (gb_arm_norm(error) > GB_ARM_WRONG * gb_arm_norm(bend)) {
        gb_arm_copy(bend, walk->at.bend);
        gb_arm_copy(gb_arm_still, walk->third);
        gb_arm_copy(gb_arm_still, walk->fourth);
    }
}

/* Writes the next piece of the curve. The walk remains where it is until gb_arm_go. False where the curve cannot be followed. */
static bool gb_arm_next_piece(gb_arm_walk *walk, const gb_arm_model *model, gb_arm_piece *piece)
{
    if (walk->pace < GB_ARM_SMALL * walk->longest) {
        gb_arm_renew(walk, model);
    }
    while (walk->pace >= GB_ARM_SHORTEST_PACE) {
        const gb_real size = gb_arm_attempt(walk, model, walk->pace, walk->side, piece);
        if (size >= R(0.0)) {
            const gb_real ratio = R(0.5) * GB_ARM_CORRECTION / gb_arm_max(size, GB_ACCEPTANCE_RESIDUAL);
            const gb_real grown = gb_square_root(gb_square_root(ratio));
            walk->pace = gb_arm_min(walk->longest, walk->pace * gb_arm_min(R(2.0), gb_arm_max(R(0.5), grown)));
            return true;
        }
        walk->pace *= R(0.4);
    }
    return gb_arm_leap(walk, model, piece);
}

/* Moves the walk to the end of a piece. The next prediction continues the polynomial of degree four with the positions and directions of both ends and the
 * curvature at the beginning. */
static void gb_arm_go(gb_arm_walk *walk, const gb_arm_piece *piece)
{
    gb_real bend[GB_MOST_ARM_JOINTS];
    gb_arm_copy(walk->at.bend, bend);
    walk->at = piece->to;
    if (piece->length > R(0.0)) {
        const gb_real inverse = R(1.0) / piece->length, square = piece->length * piece->length;
        for (size_t i = 0; i < GB_MOST_ARM_JOINTS; i++) {
            gb_real c[3];
            gb_arm_cubic(piece, i, c);
            const gb_real fourth = R(0.5) * square * bend[i] - c[1];
            walk->at.bend[i] = bend[i] + R(6.0) * c[2] * inverse * inverse;
            walk->third[i] = (R(6.0) * c[2] + R(12.0) * fourth) * inverse * inverse * inverse;
            walk->fourth[i] = R(24.0) * fourth * inverse * inverse * inverse * inverse;
        }
    }
}

/* Whether a point is on a piece. */
static bool gb_arm_is_on(const gb_arm_model *model, const gb_arm_piece *piece, const gb_real *x)
{
    gb_real away[GB_MOST_ARM_JOINTS], chord[GB_MOST_ARM_JOINTS], near[GB_MOST_ARM_JOINTS];
    gb_arm_difference(model, x, piece->from.x, away);
    if (gb_arm_norm(away) > R(1.1) * piece->length) {
        return false;
    }
    gb_arm_plus(piece->to.x, R(-1.0), piece->from.x, chord);
    const gb_real share = gb_arm_dot(away, chord) / gb_arm_dot(chord, chord);
    const bool is_inside = share >= R(0.0) && share <= R(1.0);
    if (!is_inside) {
        return false;
    }
    gb_arm_piece_at(piece, share, near);
    return gb_arm_are_close(model, near, x, GB_ARM_ON * piece->length + GB_MERGING_JOINTS);
}
