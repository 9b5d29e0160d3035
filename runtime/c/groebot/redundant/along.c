/* Joint values along an arc: see along.rs */

/* A walk along an arc, from its start to its end. */
typedef struct {
    gb_arm_walk walk;
    /* The present piece, and the length of the arc before it. */
    gb_arm_piece piece;
    gb_real before;
    bool is_over;
} gb_arm_journey;

/* A walk from the start of an arc. */
static void gb_arm_set_out(gb_arm_journey *journey, gb_arm_model *model, const gb_arc *arc)
{
    gb_real x[GB_MOST_ARM_JOINTS], bend[GB_MOST_ARM_JOINTS];
    gb_arm_place place;
    model->frozen = arc->is_frozen ? gb_arm_constant(model->arm) : -1;
    gb_arm_scaled(model, arc->start.q, x);
    gb_arm_set_bent(model, x, &place, bend);
    const gb_arm_point at = gb_arm_point_of(&place, arc->side, bend);
    journey->walk = gb_arm_walk_from(&at, arc->side, arc->level);
    journey->piece = gb_arm_piece_of(&at, &at);
    journey->before = R(0.0);
    journey->is_over = arc->length == R(0.0);
}

/* Ends the present piece at the end of the arc, as the trace did, if they have the same length. */
static void gb_arm_shorten(gb_arm_journey *journey, const gb_arm_model *model, const gb_arc *arc)
{
    gb_real x[GB_MOST_ARM_JOINTS], bend[GB_MOST_ARM_JOINTS];
    gb_arm_place place;
    gb_arm_scaled(model, arc->end.q, x);
    gb_arm_set_bent(model, x, &place, bend);
    const gb_arm_point end = gb_arm_point_of(&place, arc->side, bend);
    const gb_arm_piece last = gb_arm_last_piece(model, &journey->piece.from, &end, &journey->piece.to);
    if (gb_magnitude(journey->before + last.length - arc->length) <= GB_ARM_FOURTH * journey->piece.length) {
        journey->piece = last;
    }
}

/* Goes on to the next piece. Returns whether there is one. */
static bool gb_arm_travel(gb_arm_journey *journey, const gb_arm_model *model, const gb_arc *arc)
{
    gb_arm_piece piece;
    if (journey->is_over) {
        return false;
    }
    journey->before += journey->piece.length;
    if (!gb_arm_next_piece(&journey->walk, model, &piece)) {
        journey->is_over = true;
        return false;
    }
    gb_arm_go(&journey->walk, &piece);
    journey->piece = piece;
    journey->is_over = journey->before + piece.length >= arc->length;
    if (journey->is_over) {
        gb_arm_shorten(journey, model, arc);
    }
    return true;
}

/* The point of the curve at a share of a piece, with the direction of travel. */
static gb_arm_point gb_arm_curve_point(const gb_arm_model *model, const gb_arm_piece *piece, gb_real share)
{
    gb_arm_point point = piece->from;
    gb_arm_piece_at(piece, share, point.x);
    for (int k = 0; k < GB_ARM_CORRECTIONS; k++) {
        gb_arm_place place;
        gb_real step[GB_MOST_ARM_JOINTS];
        gb_arm_set_place(model, point.x, &place);
        gb_arm_least(&place.linear, place.values, step);
        gb_arm_plus(point.x, R(-1.0), step, point.x);
        gb_arm_copy(place.linear.tangent, point.t);
        if (gb_arm_norm(step) <= GB_ACCEPTANCE_RESIDUAL || gb_arm_dot(step, step) > R(1.0)) {
            break;
        }
    }
    if (gb_arm_dot(point.t, piece->from.t) < R(0.0)) {
        gb_arm_reverse(point.t);
    }
    return point;
}

/* The scaled joint values of the curve at a share of a piece. */
static void gb_arm_curve_at(const gb_arm_model *model, const gb_arm_piece *piece, gb_real share, gb_real *x)
{
    const gb_arm_point point = gb_arm_curve_point(model, piece, share);
    gb_arm_copy(point.x, x);
}

/* The share of the present piece at a length of the arc. */
static gb_real gb_arm_share_at(const gb_arm_journey *journey, gb_real s)
{
    return gb_arm_share((s - journey->before) / journey->piece.length);
}

GB_LINKAGE int gb_arc_at(const gb_arm *arm, const gb_real *target, const gb_real *limits, const gb_arc *arc, gb_real s, gb_real *q)
{
    gb_arm_model model;
    gb_arm_journey journey;
    gb_real x[GB_MOST_ARM_JOINTS];
    const int code = gb_arm_set_model(&model, arm, target, limits);
    if (code < 0) {
        return code;
    }
    if (s <= R(0.0) || s >= arc->length) {
        gb_arm_copy(s <= R(0.0) ? arc->start.q : arc->end.q, q);
        return 0;
    }
    gb_arm_set_out(&journey, &model, arc);
    while (gb_arm_travel(&journey, &model, arc)) {
        if (s <= journey.before + journey.piece.length) {
            gb_arm_curve_at(&model, &journey.piece, gb_arm_share_at(&journey, s), x);
            gb_arm_unscaled(&model, x, q);
            return 0;
        }
    }
    gb_arm_copy(arc->end.q, q);
    return 0;
}

/* The whole turns that bring angles next to others. */
static void gb_arm_turns_to(const gb_arm *arm, const gb_real *to, const gb_real *from, gb_real *shift)
{
    for (size_t i = 0; i < GB_MOST_ARM_JOINTS; i++) {
        shift[i] = i >= arm->count || arm->slides[i] ? R(0.0) : GB_TAU * gb_round((to[i] - from[i]) / GB_TAU);
    }
}

/* Joint values of scaled ones: within limits, or moved by whole turns. */
static void gb_arm_values(const gb_arm_model *model, const gb_real *x, const gb_real *shift, gb_real *q)
{
    if (!shift) {
        gb_arm_unscaled(model, x, q);
        return;
    }
    gb_arm_copy(shift, q);
    for (size_t i = 0; i < model->count; i++) {
        q[i] += x[i] * model->units[i];
    }
}

/* Samples at equal distances, each moved by whole turns. Without them, angles are moved within limits. */
static void gb_arm_sample_equally(gb_arm_journey *journey, const gb_arm_model *model, const gb_arc *arc, const gb_real *shift, gb_real (*out)[GB_MOST_ARM_JOINTS],
                          size_t count)
{
    gb_real x[GB_MOST_ARM_JOINTS], end[GB_MOST_ARM_JOINTS], last[GB_MOST_ARM_JOINTS];
    size_t k = 1;
    while (k + 1 < count && gb_arm_travel(journey, model, arc)) {
        for (; k + 1 < count; k++) {
            const gb_real s = arc->length * (gb_real)k / (gb_real)(count - 1);
            if (s > journey->before + journey->piece.length) {
                break;
            }
            gb_arm_curve_at(model, &journey->piece, gb_arm_share_at(journey, s), x);
            gb_arm_values(model, x, shift, out[k]);
        }
    }
    gb_arm_copy(arc->end.q, end);
    if (shift) {
        while (gb_arm_travel(journey, model, arc)) {
        }
        gb_arm_values(model, journey->piece.to.x, shift, x);
        gb_arm_turns_to(model->arm, x, end, last);
        gb_arm_plus(end, R(1.0), last, end);
    }
    for (; k < count; k++) {
        gb_arm_copy(end, out[k]);
    }
}

GB_LINKAGE int gb_arc_sample_from(const gb_arm *arm, const gb_real *target, const gb_real *limits, const gb_arc *arc, const gb_real *start,
                                  gb_real (*out)[GB_MOST_ARM_JOINTS], size_t count)
{
    gb_arm_model model;
    gb_arm_journey journey;
    gb_real shift[GB_MOST_ARM_JOINTS];
    const int code = gb_arm_set_model(&model, arm, target, limits);
    if (code < 0 || count == 0) {
        return code;
    }
    gb_arm_copy(start ? start : arc->start.q, out[0]);
    gb_arm_set_out(&journey, &model, arc);
    if (start) {
        gb_arm_turns_to(arm, start, arc->start.q, shift);
    }
    gb_arm_sample_equally(&journey, &model, arc, start ? shift : NULL, out, count);
    return 0;
}

GB_LINKAGE int gb_arc_sample(const gb_arm *arm, const gb_real *target, const gb_real *limits, const gb_arc *arc, gb_real (*out)[GB_MOST_ARM_JOINTS],
                             size_t count)
{
    return gb_arc_sample_from(arm, target, limits, arc, NULL, out, count);
}
